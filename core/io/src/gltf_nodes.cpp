#include "gltf_nodes.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace lorica::io {

using geometry::Affine3d;
using geometry::Mat3d;
using geometry::Quatd;
using geometry::Vec3d;

namespace {

constexpr double shearTolerance = 1e-4;       // of the cosine between axes: single precision files stay far below
constexpr double largestNumber = 1e30;        // keeps products and determinants finite
constexpr double quaternionTolerance = 1e-3;  // of the length

void checkSize(const std::vector<double>& values, std::size_t expected, const char* what, const std::string& place,
               const Reading& reading) {
  if (values.size() != expected) {
    reading.fail(place, fmt::format("its {} has {} numbers, {} were expected", what, values.size(), expected));
  }
  if (!std::all_of(values.begin(), values.end(), [](double v) { return std::abs(v) <= largestNumber; })) {
    reading.fail(place, fmt::format("its {} is not finite or beyond all measure", what));
  }
}

human::Trs readTrs(const tinygltf::Node& node, const std::string& place, Reading& reading) {
  human::Trs trs;
  if (!node.translation.empty()) {
    checkSize(node.translation, 3, "translation", place, reading);
    trs.translation = Vec3d(node.translation.data());
  }
  if (!node.scale.empty()) {
    checkSize(node.scale, 3, "scale", place, reading);
    trs.scale = Vec3d(node.scale.data());
  }
  if (!node.rotation.empty()) {
    checkSize(node.rotation, 4, "rotation", place, reading);
    const Quatd rotation(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
    if (rotation.norm() == 0.0) {
      reading.fail(place, "its rotation is the zero quaternion");
    }
    if (std::abs(rotation.norm() - 1.0) > quaternionTolerance) {
      reading.warn(place, "its rotation is no unit quaternion and was normalised");
    }
    trs.rotation = rotation.normalized();
  }
  return trs;
}

Affine3d readMatrix(const std::vector<double>& values, const std::string& place, const Reading& reading) {
  checkSize(values, 16, "matrix", place, reading);
  const Eigen::Matrix4d matrix(values.data());  // column by column, like the file
  if ((matrix.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).cwiseAbs().maxCoeff() > 1e-6) {
    reading.fail(place, "its matrix is no transform: the last row must be 0 0 0 1");
  }
  Affine3d frame;
  frame.matrix() = matrix;
  frame.makeAffine();
  return frame;
}

void readTransform(const tinygltf::Model& model, std::size_t node, NodeGraph& graph, Reading& reading) {
  const tinygltf::Node& source = model.nodes[node];
  const std::string place = nodeName(model, node);
  if (source.matrix.empty()) {
    graph.local[node] = readTrs(source, place, reading);
    graph.localFrame[node] = graph.local[node].matrix();
    return;
  }
  graph.localFrame[node] = readMatrix(source.matrix, place, reading);
  const Decomposed parts = decompose(graph.localFrame[node]);
  if (parts.sheared || parts.mirrored) {
    reading.warn(place,
                 fmt::format("its matrix {}; a joint cannot do that exactly", parts.sheared ? "shears" : "mirrors"));
  }
  graph.local[node] = parts.trs;
}

void link(const tinygltf::Model& model, NodeGraph& graph, const Reading& reading) {
  for (std::size_t node = 0; node < model.nodes.size(); ++node) {
    for (const int child : model.nodes[node].children) {
      if (child < 0 || static_cast<std::size_t>(child) >= model.nodes.size()) {
        reading.fail(nodeName(model, node),
                     fmt::format("has node {} as a child, but the file has {} nodes", child, model.nodes.size()));
      }
      auto& parent = graph.parent[static_cast<std::size_t>(child)];
      if (parent) {
        reading.fail(nodeName(model, static_cast<std::size_t>(child)),
                     fmt::format("is a child of two nodes, {} and {}", *parent, node));
      }
      parent = node;
    }
  }
}

void sortParentsFirst(const tinygltf::Model& model, NodeGraph& graph, const Reading& reading) {
  std::vector<std::size_t> stack;
  for (std::size_t node = model.nodes.size(); node-- > 0;) {
    if (!graph.parent[node]) {
      stack.push_back(node);
    }
  }
  while (!stack.empty()) {
    const std::size_t node = stack.back();
    stack.pop_back();
    graph.order.push_back(node);
    const auto& children = model.nodes[node].children;
    for (auto child = children.rbegin(); child != children.rend(); ++child) {
      stack.push_back(static_cast<std::size_t>(*child));
    }
  }
  if (graph.order.size() == model.nodes.size()) {
    return;
  }
  std::vector<bool> reached(model.nodes.size(), false);
  for (const std::size_t node : graph.order) {
    reached[node] = true;
  }
  const auto lost = static_cast<std::size_t>(std::find(reached.begin(), reached.end(), false) - reached.begin());
  reading.fail(nodeName(model, lost), "its parents go round in a circle");
}

/// The nodes of the default scene, else of the first, else all.
void chooseScene(const tinygltf::Model& model, NodeGraph& graph, Reading& reading) {
  if (model.scenes.empty()) {
    graph.inScene = graph.order;
    return;
  }
  const int index = model.defaultScene < 0 ? 0 : model.defaultScene;
  if (static_cast<std::size_t>(index) >= model.scenes.size()) {
    reading.fail("scene", fmt::format("is {}, but the file has {} scenes", index, model.scenes.size()));
  }
  std::vector<bool> wanted(model.nodes.size(), false);
  for (const int root : model.scenes[static_cast<std::size_t>(index)].nodes) {
    if (root < 0 || static_cast<std::size_t>(root) >= model.nodes.size()) {
      reading.fail(fmt::format("scene {}", index),
                   fmt::format("refers to node {}, but the file has {} nodes", root, model.nodes.size()));
    }
    wanted[static_cast<std::size_t>(root)] = true;
  }
  for (const std::size_t node : graph.order) {
    if (wanted[node] || (graph.parent[node] && wanted[*graph.parent[node]])) {
      wanted[node] = true;
      graph.inScene.push_back(node);
    }
  }
  if (model.scenes.size() > 1) {
    reading.note("scenes", fmt::format("only scene {} of {} is read", index, model.scenes.size()));
  }
}

}  // namespace

std::string nodeName(const tinygltf::Model& model, std::size_t node) {
  const std::string name = oneLine(model.nodes[node].name, 80);
  return name.empty() ? fmt::format("node {}", node) : fmt::format("node {} '{}'", node, name);
}

Decomposed decompose(const Affine3d& frame) {
  Decomposed result;
  result.trs.translation = frame.translation();
  Mat3d axes = frame.linear();
  Vec3d scale = axes.colwise().norm();
  if (axes.determinant() < 0.0) {
    result.mirrored = true;
    scale.x() = -scale.x();
  }
  for (int axis = 0; axis < 3; ++axis) {
    axes.col(axis) /= scale[axis] == 0.0 ? 1.0 : scale[axis];
  }
  if ((axes.transpose() * axes - Mat3d::Identity()).cwiseAbs().maxCoeff() > shearTolerance) {
    result.sheared = true;
    const Eigen::JacobiSVD<Mat3d> svd(axes, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Mat3d sign = Mat3d::Identity();
    sign(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0;
    axes = svd.matrixU() * sign * svd.matrixV().transpose();
    scale = (axes.transpose() * frame.linear()).diagonal();
  }
  result.trs.rotation = Quatd(axes).normalized();
  result.trs.scale = scale;
  return result;
}

NodeGraph readNodes(const tinygltf::Model& model, Reading& reading) {
  NodeGraph graph;
  const std::size_t count = model.nodes.size();
  graph.parent.resize(count);
  graph.depth.resize(count, 0);
  graph.local.resize(count);
  graph.localFrame.assign(count, Affine3d::Identity());
  graph.frame.assign(count, Affine3d::Identity());
  link(model, graph, reading);
  sortParentsFirst(model, graph, reading);
  chooseScene(model, graph, reading);
  for (const std::size_t node : graph.order) {
    readTransform(model, node, graph, reading);
    const auto& parent = graph.parent[node];
    graph.depth[node] = parent ? graph.depth[*parent] + 1 : 0;
    graph.frame[node] = parent ? graph.frame[*parent] * graph.localFrame[node] : graph.localFrame[node];
    if (!graph.frame[node].matrix().allFinite()) {
      reading.fail(nodeName(model, node), "its transform in the scene is not finite");
    }
  }
  return graph;
}

}  // namespace lorica::io
