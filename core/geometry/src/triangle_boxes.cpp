#include "triangle_boxes.h"

#include <numeric>

namespace lorica::geometry {

TriangleBoxes::TriangleBoxes(const TriangleMesh& mesh) : order_(mesh.triangles.size()) {
  if (order_.empty()) {
    return;
  }
  std::iota(order_.begin(), order_.end(), 0U);
  std::vector<Box> boxes;
  std::vector<Vec3f> centres;
  boxes.reserve(order_.size());
  centres.reserve(order_.size());
  for (std::size_t t = 0; t < order_.size(); ++t) {
    boxes.push_back(boxOf(mesh, t));
    centres.emplace_back(boxes.back().center());
  }
  nodes_.reserve(order_.size());
  build(0, static_cast<std::uint32_t>(order_.size()), centres, boxes);
  boxes_.reserve(order_.size());
  for (const std::uint32_t triangle : order_) {
    boxes_.push_back(boxes[triangle]);
  }
}

std::uint32_t TriangleBoxes::build(std::uint32_t begin, std::uint32_t end, const std::vector<Vec3f>& centres,
                                   const std::vector<Box>& boxes) {
  constexpr std::uint32_t leafSize = 4;
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  Node node;
  node.begin = begin;
  node.end = end;
  Box spread;
  for (std::uint32_t i = begin; i < end; ++i) {
    node.box.extend(boxes[order_[i]]);
    spread.extend(centres[order_[i]]);
  }
  nodes_.push_back(node);
  if (end - begin <= leafSize) {
    return index;
  }
  Eigen::Index axis = 0;
  spread.sizes().maxCoeff(&axis);
  const std::uint32_t middle = begin + (end - begin) / 2;
  const auto at = [this](std::uint32_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t a, std::uint32_t b) {
    return centres[a][axis] < centres[b][axis] || (centres[a][axis] == centres[b][axis] && a < b);
  });
  const std::uint32_t left = build(begin, middle, centres, boxes);
  const std::uint32_t right = build(middle, end, centres, boxes);
  nodes_[index].left = left;
  nodes_[index].right = right;
  return index;
}

}  // namespace lorica::geometry
