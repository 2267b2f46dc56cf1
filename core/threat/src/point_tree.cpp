#include "point_tree.h"

#include <vtkFloatArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStaticPointLocator.h>

#include <algorithm>

#include "lorica/base/error.h"

namespace lorica::threat {

using geometry::Positions;
using geometry::Vec3d;

struct PointTree::Locator {
  explicit Locator(const Positions& points) {
    // VTK reads the coordinates where they are, and never writes to them.
    array->SetNumberOfComponents(3);
    array->SetArray(const_cast<float*>(points.front().data()),  // NOLINT(cppcoreguidelines-pro-type-const-cast)
                    static_cast<vtkIdType>(3 * points.size()), 1);
    places->SetData(array);
    data->SetPoints(places);
    search->SetDataSet(data);
    search->BuildLocator();
  }

  vtkNew<vtkFloatArray> array;
  vtkNew<vtkPoints> places;
  vtkNew<vtkPolyData> data;
  vtkNew<vtkStaticPointLocator> search;
};

namespace {

constexpr std::size_t fewPoints = 32;

}  // namespace

PointTree::PointTree(std::shared_ptr<const Positions> points) : points_(std::move(points)) {
  LORICA_CHECK(points_ != nullptr && !points_->empty(), "points to search");
  if (points_->size() > fewPoints) {
    locator_ = std::make_unique<Locator>(*points_);
  }
}

PointTree::~PointTree() = default;

void PointTree::add(const Vec3d& place, std::uint32_t point, std::vector<Neighbour>& found) const {
  found.push_back({((*points_)[point].cast<double>() - place).norm(), point});
}

void PointTree::nearest(const Vec3d& place, std::size_t count, std::vector<Neighbour>& found) const {
  found.clear();
  count = std::min(count, points_->size());
  if (locator_ == nullptr) {
    for (std::uint32_t p = 0; p < points_->size(); ++p) {
      add(place, p, found);
    }
  } else {
    const vtkNew<vtkIdList> ids;
    locator_->search->FindClosestNPoints(static_cast<int>(count), place.data(), ids);
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i) {
      add(place, static_cast<std::uint32_t>(ids->GetId(i)), found);
    }
  }
  std::sort(found.begin(), found.end());
  found.resize(std::min(found.size(), count));
}

void PointTree::within(const Vec3d& place, double radius, std::vector<Neighbour>& found) const {
  found.clear();
  if (locator_ == nullptr) {
    for (std::uint32_t p = 0; p < points_->size(); ++p) {
      add(place, p, found);
    }
  } else {
    const vtkNew<vtkIdList> ids;
    // A little wider, since VTK compares squares of floats; the distance is decided below.
    locator_->search->FindPointsWithinRadius(radius * (1.0 + 1e-6), place.data(), ids);
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i) {
      add(place, static_cast<std::uint32_t>(ids->GetId(i)), found);
    }
  }
  std::erase_if(found, [&](const Neighbour& neighbour) { return neighbour.distance > radius; });
  std::sort(found.begin(), found.end());
}

}  // namespace lorica::threat
