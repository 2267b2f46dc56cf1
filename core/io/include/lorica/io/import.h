#pragma once

/// \file
/// Models in: glTF 2.0 (.gltf, .glb), OBJ, STL, PLY, OFF. Every index, count, length and number is checked; what
/// cannot be used ends in an InputError, what can be lived with in an Issue.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lorica/base/issue.h"
#include "lorica/base/units.h"
#include "lorica/geometry/triangle_mesh.h"
#include "lorica/human/clip.h"
#include "lorica/human/skinning.h"

namespace lorica::io {

enum class UpAxis { y, z };

struct ImportOptions {
  std::optional<base::LengthUnit> units;  ///< default: metres for glTF, else guessed from the size
  std::optional<UpAxis> up;               ///< default: y for glTF, else guessed from the shape
};

/// One node of the file with its triangles: a part of the structure the file is.
struct Part {
  std::string name;                           ///< unique in the model; "part_N" when the file gives none
  geometry::TriangleMesh mesh;                ///< welded, in the scene's frame and metres, at rest
  std::optional<human::SkinWeights> weights;  ///< one entry per vertex, joints of `skeleton`
  bool protects = true;                       ///< false when the node's extras say "protecting": false
};

struct Model {
  std::vector<Part> parts;                  ///< at least one, none without triangles
  std::optional<human::Skeleton> skeleton;  ///< present when a part is skinned
  std::vector<human::Clip> clips;           ///< on `skeleton`; unnamed ones are clip_0, clip_1, ...
  base::LengthUnit units = base::LengthUnit::metre;
  bool unitsGuessed = false;
  UpAxis up = UpAxis::y;
  bool upGuessed = false;
  base::Issues issues;  ///< what was ignored, mended or guessed
};

/// Reads a model; the format is told by the content where it can be, else by the file's ending.
/// Vertices that differ only in normals or texture coordinates are welded; those of a skin when their weights agree
/// within 1e-3. Triangles without area after welding are dropped and counted in an issue, except where a closed surface
/// needs them. Closed surfaces that are inside out are turned (an issue says so). Vertices of no triangle go.
/// The rest pose of a skinned part is its bind pose, placed in the scene as its root joint is. A part without skin
/// below a joint is tied to that joint. The result does not depend on the number of threads. Thread-safe. Cost: a few
/// times that of parsing the file. \throw base::InputError naming the file and the place
Model importModel(const std::filesystem::path& path, const ImportOptions& options = {});
/// The same of a file whose bytes were read already.
Model importModel(const std::filesystem::path& path, std::string_view bytes, const ImportOptions& options);

}  // namespace lorica::io
