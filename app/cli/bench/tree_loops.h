#pragma once

/// \file
/// All crossings of rays by the trees of other libraries, one thread: what else could be had.

#include <cstdint>
#include <memory>
#include <span>

#include "lorica/analysis/posed_scene.h"

namespace lorica::bench {

/// CGAL's AABB tree over all triangles of a posed scene, in double precision. There when CGAL was at build time.
class CgalTree {
 public:
  static bool available();
  /// \pre available()
  explicit CgalTree(const analysis::PosedScene& posed);
  ~CgalTree();
  CgalTree(const CgalTree&) = delete;
  CgalTree& operator=(const CgalTree&) = delete;

  /// Finds all intersections of each ray and sorts them. Returns their number.
  std::uint64_t allHits(std::span<const raycast::Ray> rays) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

/// A vtkOBBTree for each mesh of a posed scene. It gives points in order, and of a mesh only those that go in and out
/// in turn.
class VtkTrees {
 public:
  explicit VtkTrees(const analysis::PosedScene& posed);
  ~VtkTrees();
  VtkTrees(const VtkTrees&) = delete;
  VtkTrees& operator=(const VtkTrees&) = delete;

  std::uint64_t allHits(std::span<const raycast::Ray> rays) const;

 private:
  struct Trees;
  std::unique_ptr<Trees> trees_;
};

}  // namespace lorica::bench
