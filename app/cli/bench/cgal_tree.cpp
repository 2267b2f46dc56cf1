#include <algorithm>
#include <vector>

#include "lorica/base/error.h"
#include "tree_loops.h"

#ifdef LORICA_CGAL

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

namespace lorica::bench {

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using AabbTree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 pointOf(const geometry::Vec3f& p) {
  return {static_cast<double>(p.x()), static_cast<double>(p.y()), static_cast<double>(p.z())};
}

Triangles trianglesOf(const raycast::Scene& scene) {
  Triangles triangles;
  for (std::size_t m = 0; m < scene.meshes(); ++m) {
    const geometry::Vec3f* positions = scene.positions(raycast::MeshIndex{m});
    for (const geometry::Triangle& t : scene.topology(raycast::MeshIndex{m}).triangles) {
      triangles.emplace_back(pointOf(positions[t[0]]), pointOf(positions[t[1]]), pointOf(positions[t[2]]));
    }
  }
  return triangles;
}

}  // namespace

struct CgalTree::Tree {
  Triangles triangles;
  AabbTree tree;
};

bool CgalTree::available() {
  return true;
}

CgalTree::CgalTree(const analysis::PosedScene& posed) : tree_(std::make_unique<Tree>()) {
  tree_->triangles = trianglesOf(posed.scene());
  tree_->tree.insert(tree_->triangles.cbegin(), tree_->triangles.cend());
  tree_->tree.build();
}

std::uint64_t CgalTree::allHits(std::span<const raycast::Ray> rays) const {
  std::uint64_t found = 0;
  std::vector<AabbTree::Intersection_and_primitive_id<Kernel::Ray_3>::Type> crossings;
  std::vector<double> distances;
  for (const raycast::Ray& ray : rays) {
    const Kernel::Point_3 origin = pointOf(ray.origin);
    const Kernel::Vector_3 direction(origin, pointOf(ray.origin + ray.direction));
    crossings.clear();
    distances.clear();
    tree_->tree.all_intersections(Kernel::Ray_3(origin, direction), std::back_inserter(crossings));
    for (const auto& crossing : crossings) {
      if (const auto* point = boost::get<Kernel::Point_3>(&crossing.first)) {
        distances.push_back(CGAL::squared_distance(origin, *point));
      }
    }
    std::sort(distances.begin(), distances.end());
    found += distances.size();
  }
  return found;
}

}  // namespace lorica::bench

#else

namespace lorica::bench {

struct CgalTree::Tree {};

bool CgalTree::available() {
  return false;
}
CgalTree::CgalTree(const analysis::PosedScene& /*posed*/) {
  LORICA_CHECK(available(), "CGAL was there when the program was built");
}
std::uint64_t CgalTree::allHits(std::span<const raycast::Ray> /*rays*/) const {
  return 0;
}

}  // namespace lorica::bench

#endif

namespace lorica::bench {

CgalTree::~CgalTree() = default;

}  // namespace lorica::bench
