#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkOBBTree.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <vector>

#include "tree_loops.h"

namespace lorica::bench {

namespace {

vtkSmartPointer<vtkPolyData> polyDataOf(const raycast::Scene& scene, raycast::MeshIndex mesh) {
  const raycast::MeshTopology& topology = scene.topology(mesh);
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(static_cast<vtkIdType>(topology.vertices));
  for (std::size_t v = 0; v < topology.vertices; ++v) {
    points->SetPoint(static_cast<vtkIdType>(v), scene.positions(mesh)[v].cast<double>().eval().data());
  }
  vtkNew<vtkCellArray> cells;
  for (const geometry::Triangle& t : topology.triangles) {
    cells->InsertNextCell({static_cast<vtkIdType>(t[0]), static_cast<vtkIdType>(t[1]), static_cast<vtkIdType>(t[2])});
  }
  vtkSmartPointer<vtkPolyData> data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(cells);
  return data;
}

}  // namespace

struct VtkTrees::Trees {
  std::vector<vtkSmartPointer<vtkOBBTree>> all;
};

VtkTrees::VtkTrees(const analysis::PosedScene& posed) : trees_(std::make_unique<Trees>()) {
  for (std::size_t m = 0; m < posed.scene().meshes(); ++m) {
    auto tree = vtkSmartPointer<vtkOBBTree>::New();
    tree->SetDataSet(polyDataOf(posed.scene(), raycast::MeshIndex{m}));
    tree->SetTolerance(0.0);
    tree->BuildLocator();
    trees_->all.push_back(std::move(tree));
  }
}

VtkTrees::~VtkTrees() = default;

std::uint64_t VtkTrees::allHits(std::span<const raycast::Ray> rays) const {
  constexpr double far = 100.0;  // metres; a ray there ends
  std::uint64_t found = 0;
  vtkNew<vtkPoints> points;
  for (const raycast::Ray& ray : rays) {
    const geometry::Vec3d from = ray.origin.cast<double>();
    const geometry::Vec3d to = from + far * ray.direction.cast<double>().normalized();
    for (const vtkSmartPointer<vtkOBBTree>& tree : trees_->all) {
      points->Reset();
      tree->IntersectWithLine(from.data(), to.data(), points, nullptr);
      found += static_cast<std::uint64_t>(points->GetNumberOfPoints());
    }
  }
  return found;
}

}  // namespace lorica::bench
