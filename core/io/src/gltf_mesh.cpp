#include "gltf_mesh.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "polygons.h"

namespace lorica::io {

using geometry::Triangle;
using human::Influence;

namespace {

struct Primitive {
  const tinygltf::Primitive& source;
  std::string place;  // "mesh 0 'Body', primitive 1"
};

int attribute(const tinygltf::Primitive& primitive, const std::string& name) {
  const auto found = primitive.attributes.find(name);
  return found == primitive.attributes.end() ? -1 : found->second;
}

void checkCorners(const std::uint32_t* begin, const std::uint32_t* end, const Primitive& primitive,
                  std::size_t vertices, const Reading& reading) {
  std::uint32_t highest = 0;
  for (const std::uint32_t* corner = begin; corner < end; ++corner) {
    highest = std::max(highest, *corner);
  }
  if (highest >= vertices) {
    const auto* first = std::find_if(begin, end, [&](std::uint32_t corner) { return corner >= vertices; });
    reading.fail(fmt::format("{}, indices, accessor {}", primitive.place, primitive.source.indices),
                 fmt::format("index {} is {}, but the primitive has {} vertices", first - begin, *first, vertices));
  }
}

std::vector<std::uint32_t> cornersOf(const AccessorReader& accessors, const Primitive& primitive, std::size_t vertices,
                                     const Reading& reading) {
  if (primitive.source.indices < 0) {
    std::vector<std::uint32_t> corners(vertices);
    std::iota(corners.begin(), corners.end(), 0U);
    return corners;
  }
  std::vector<std::uint32_t> corners =
      accessors.integers(primitive.source.indices, Shape::scalar, true, primitive.place + ", indices");
  checkCorners(corners.data(), corners.data() + corners.size(), primitive, vertices, reading);
  return corners;
}

/// Fans turn around their first corner but begin with their second one (glTF 2.0, section 3.7.2.1); which corner of a
/// triangle stands first does not matter.
std::vector<Triangle> trianglesOf(const AccessorReader& accessors, const Primitive& primitive, std::size_t vertices,
                                  const Reading& reading) {
  const bool isFan = primitive.source.mode == TINYGLTF_MODE_TRIANGLE_FAN;
  const bool isStrip = primitive.source.mode == TINYGLTF_MODE_TRIANGLE_STRIP;
  const bool isIndexed = primitive.source.indices >= 0;
  std::vector<Triangle> triangles;
  if (isFan || isStrip) {
    const std::vector<std::uint32_t> corners = cornersOf(accessors, primitive, vertices, reading);
    isFan ? appendFan(triangles, corners) : appendStrip(triangles, corners);
    return triangles;
  }
  const std::string place = primitive.place + ", indices";
  const std::size_t corners = isIndexed ? accessors.count(primitive.source.indices, Shape::scalar, place) : vertices;
  if (corners % 3 != 0) {
    reading.fail(primitive.place, fmt::format("has {} corners, which is no multiple of 3", corners));
  }
  if (isIndexed) {
    triangles = accessors.triangles(primitive.source.indices, place);
    checkCorners(triangles.data()->data(), triangles.data()->data() + corners, primitive, vertices, reading);
    return triangles;
  }
  for (std::uint32_t corner = 0; corner < corners; corner += 3) {
    triangles.push_back({corner, corner + 1, corner + 2});
  }
  return triangles;
}

template <class T>
void append(std::vector<T>& all, std::vector<T>&& more) {
  if (all.empty()) {
    all = std::move(more);
  } else {
    all.insert(all.end(), more.begin(), more.end());
  }
}

/// Numbers n for which JOINTS_n and WEIGHTS_n exist. \throw when one is without the other
std::vector<int> weightSets(const Primitive& primitive, const Reading& reading) {
  std::vector<int> sets;
  for (const auto& [name, accessor] : primitive.source.attributes) {
    for (const std::string_view prefix : {"JOINTS_", "WEIGHTS_"}) {
      if (!name.starts_with(prefix)) {
        continue;
      }
      const std::string number = name.substr(prefix.size());
      const std::string other = (prefix == "JOINTS_" ? "WEIGHTS_" : "JOINTS_") + number;
      if (attribute(primitive.source, other) < 0) {
        reading.fail(primitive.place, fmt::format("has {} but no {}", oneLine(name, 40), oneLine(other, 40)));
      }
      if (prefix == "JOINTS_" && number.size() == 1 && number[0] >= '0' && number[0] <= '9') {
        sets.push_back(number[0] - '0');
      }
    }
  }
  return sets;
}

class WeightReader {
 public:
  WeightReader(const AccessorReader& accessors, const Primitive& primitive, std::size_t vertices,
               std::size_t skinJoints, const Reading& reading)
      : accessors_(accessors), primitive_(primitive), vertices_(vertices), skinJoints_(skinJoints), reading_(reading) {}

  /// Four influences per vertex and set.
  std::vector<Influence> read(const std::vector<int>& sets) {
    const std::size_t stride = 4 * sets.size();
    std::vector<Influence> all(vertices_ * stride);
    for (std::size_t s = 0; s < sets.size(); ++s) {
      readSet(sets[s], all.data() + 4 * s, stride);
    }
    return all;
  }

 private:
  void readSet(int set, Influence* first, std::size_t stride) {
    const std::string joints = fmt::format("{}, JOINTS_{}", primitive_.place, set);
    const std::string weights = fmt::format("{}, WEIGHTS_{}", primitive_.place, set);
    const auto jointValues =
        accessors_.integers(attribute(primitive_.source, fmt::format("JOINTS_{}", set)), Shape::vec4, false, joints);
    const auto weightValues = accessors_.numbers(attribute(primitive_.source, fmt::format("WEIGHTS_{}", set)),
                                                 Shape::vec4, {.normalisedIntegers = true}, weights);
    checkCount(jointValues.size() / 4, joints);
    checkCount(weightValues.count, weights);
    for (std::size_t v = 0; v < vertices_; ++v) {
      for (std::size_t k = 0; k < 4; ++k) {
        const std::uint32_t joint = jointValues[4 * v + k];
        const double weight = weightValues.values[4 * v + k];
        if (joint >= skinJoints_) {
          reading_.fail(joints,
                        fmt::format("vertex {} uses joint {}, but its skin has {} joints", v, joint, skinJoints_));
        }
        if (weight < 0.0) {
          reading_.fail(weights, fmt::format("vertex {} has the negative weight {}", v, weight));
        }
        first[v * stride + k] = {joint, weight};
      }
    }
  }

  void checkCount(std::size_t count, const std::string& place) const {
    if (count != vertices_) {
      reading_.fail(place, fmt::format("has {} elements for {} vertices", count, vertices_));
    }
  }

  const AccessorReader& accessors_;
  const Primitive& primitive_;
  std::size_t vertices_;
  std::size_t skinJoints_;
  const Reading& reading_;
};

/// Makes room for `influences` places per vertex; the new ones are empty.
void widen(std::vector<Influence>& weights, std::size_t from, std::size_t to, std::size_t vertices) {
  if (from == to) {
    return;
  }
  std::vector<Influence> wide(vertices * to);
  for (std::size_t v = 0; v < vertices && from > 0; ++v) {
    std::copy_n(weights.begin() + static_cast<std::ptrdiff_t>(v * from), from,
                wide.begin() + static_cast<std::ptrdiff_t>(v * to));
  }
  weights = std::move(wide);
}

std::vector<geometry::Vec3d> positionsOf(const tinygltf::Model& model, const AccessorReader& accessors,
                                         const Primitive& primitive) {
  const bool quantised = std::find(model.extensionsUsed.begin(), model.extensionsUsed.end(), "KHR_mesh_quantization") !=
                         model.extensionsUsed.end();
  return accessors.points(attribute(primitive.source, "POSITION"),
                          {.normalisedIntegers = quantised, .plainIntegers = quantised},
                          primitive.place + ", POSITION");
}

class MeshReader {
 public:
  MeshReader(const tinygltf::Model& model, std::size_t skinJoints, const Reading& reading, MeshExtras& extras)
      : model_(model), accessors_(model, reading), skinJoints_(skinJoints), reading_(reading), extras_(extras) {}

  void read(const Primitive& primitive) {
    const int mode = primitive.source.mode;
    if (mode < TINYGLTF_MODE_POINTS || mode > TINYGLTF_MODE_TRIANGLE_FAN) {
      reading_.fail(primitive.place, fmt::format("has the unknown mode {}", mode));
    }
    if (mode < TINYGLTF_MODE_TRIANGLES) {
      ++extras_.pointsOrLines;
      return;
    }
    extras_.morphTargets = extras_.morphTargets || !primitive.source.targets.empty();
    const VertexRange range = vertices(primitive);
    std::vector<Triangle> triangles = trianglesOf(accessors_, primitive, range.count, reading_);
    for (std::size_t t = 0; range.first > 0 && t < triangles.size(); ++t) {
      for (std::uint32_t& corner : triangles[t]) {
        corner += range.first;
      }
    }
    append(part_.triangles, std::move(triangles));
  }

  RawPart take() { return std::move(part_); }

 private:
  struct VertexRange {
    std::uint32_t first = 0;
    std::size_t count = 0;
  };

  /// The primitive's vertices within the part; primitives of the same accessors share them.
  VertexRange vertices(const Primitive& primitive) {
    const auto known = ranges_.find(primitive.source.attributes);
    if (known != ranges_.end()) {
      return known->second;
    }
    if (attribute(primitive.source, "POSITION") < 0) {
      reading_.fail(primitive.place, "has no POSITION");
    }
    std::vector<geometry::Vec3d> positions = positionsOf(model_, accessors_, primitive);
    if (part_.positions.size() + positions.size() > UINT32_MAX) {
      reading_.fail(primitive.place, "has more vertices than can be counted");
    }
    const VertexRange range{static_cast<std::uint32_t>(part_.positions.size()), positions.size()};
    if (skinJoints_ > 0) {
      appendWeights(primitive, positions.size());
    }
    append(part_.positions, std::move(positions));
    ranges_.emplace(primitive.source.attributes, range);
    return range;
  }

  void appendWeights(const Primitive& primitive, std::size_t vertices) {
    const std::vector<int> sets = weightSets(primitive, reading_);
    if (sets.empty()) {
      reading_.fail(primitive.place, "belongs to a skin but has no JOINTS_0 and WEIGHTS_0");
    }
    extras_.weightSets = std::max(extras_.weightSets, sets.size());
    std::vector<Influence> weights = WeightReader(accessors_, primitive, vertices, skinJoints_, reading_).read(sets);
    const std::size_t widest = std::max(part_.influences, 4 * sets.size());
    widen(part_.weights, part_.influences, widest, part_.positions.size());
    widen(weights, 4 * sets.size(), widest, vertices);
    part_.influences = widest;
    append(part_.weights, std::move(weights));
  }

  const tinygltf::Model& model_;
  AccessorReader accessors_;
  std::size_t skinJoints_;
  const Reading& reading_;
  MeshExtras& extras_;
  RawPart part_;
  std::map<std::map<std::string, int>, VertexRange> ranges_;
};

}  // namespace

RawPart readMesh(const tinygltf::Model& model, std::size_t mesh, std::size_t skinJoints, const Reading& reading,
                 MeshExtras& extras) {
  const tinygltf::Mesh& source = model.meshes[mesh];
  const std::string name = oneLine(source.name, 80);
  const std::string place = fmt::format("mesh {}{}", mesh, name.empty() ? "" : " '" + name + "'");
  MeshReader reader(model, skinJoints, reading, extras);
  for (std::size_t p = 0; p < source.primitives.size(); ++p) {
    reader.read({source.primitives[p], fmt::format("{}, primitive {}", place, p)});
  }
  return reader.take();
}

}  // namespace lorica::io
