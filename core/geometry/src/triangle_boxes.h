#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "lorica/geometry/triangle_mesh.h"

namespace lorica::geometry {

/// A tree of boxes over the triangles of a mesh. Boxes are closed and of the vertices' own precision, so nothing that
/// touches is missed. Immutable; queries are thread-safe.
class TriangleBoxes {
 public:
  using Box = Eigen::AlignedBox3f;

  explicit TriangleBoxes(const TriangleMesh& mesh);

  static Box boxOf(const TriangleMesh& mesh, std::size_t triangle) {
    Box box;
    for (const std::uint32_t vertex : mesh.triangles[triangle]) {
      box.extend(mesh.positions[vertex]);
    }
    return box;
  }

  /// Calls `use(triangle)` for every triangle whose box shares a point with `box`, in the order of the tree.
  template <class Use>
  void forEachOverlap(const Box& box, const Use& use) const {
    std::array<std::uint32_t, 64> stack{};  // the tree halves its range, so it is at most 32 deep
    std::size_t size = 0;
    if (!nodes_.empty()) {
      stack[size++] = 0;
    }
    while (size > 0) {
      const Node& node = nodes_[stack[--size]];
      if (!node.box.intersects(box)) {
        continue;
      }
      if (node.left == 0) {
        for (std::uint32_t i = node.begin; i < node.end; ++i) {
          if (boxes_[i].intersects(box)) {
            use(order_[i]);
          }
        }
      } else {
        stack[size++] = node.right;
        stack[size++] = node.left;
      }
    }
  }

 private:
  struct Node {
    Box box;
    std::uint32_t begin = 0;  ///< range of order_
    std::uint32_t end = 0;
    std::uint32_t left = 0;  ///< children; 0 in a leaf
    std::uint32_t right = 0;
  };

  std::uint32_t build(std::uint32_t begin, std::uint32_t end, const std::vector<Vec3f>& centres,
                      const std::vector<Box>& boxes);

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;  ///< triangles, those of a leaf together
  std::vector<Box> boxes_;            ///< in that order
};

}  // namespace lorica::geometry
