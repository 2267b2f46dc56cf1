#pragma once

/// \file
/// A study as a value: which human, which organs and armor, in which poses, shot at from where. Equal values give the
/// same file, the same file the same results.

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "lorica/base/units.h"
#include "lorica/geometry/vectors.h"

namespace lorica::study {

/// A file the study reads. Relative paths are relative to the study file, with '/' between folders.
struct InputFile {
  std::string path;
  std::string sha256;  ///< 64 lower-case hexadecimal digits of its bytes (with those of the buffers a .gltf refers to)
  std::optional<base::LengthUnit> units;  ///< only when the format or the guess was overruled
  std::optional<char> up;                 ///< 'y' or 'z', likewise
  bool operator==(const InputFile&) const = default;
};

/// Something the program makes itself, by name.
struct Builtin {
  std::string name;
  bool operator==(const Builtin&) const = default;
};

/// Part selection inside a file; empty means every part.
struct MeshSource {
  std::variant<InputFile, Builtin> from;
  std::vector<std::string> parts;
  bool operator==(const MeshSource&) const = default;
};

/// How the control points of an organ are laid out (thesis section 3.3).
struct LatticeSettings {
  enum class Layout { boundingBox, uniform, perAxis, cellSize };
  Layout layout = Layout::cellSize;
  std::array<int, 3> cells{1, 1, 1};  ///< uniform: the first; perAxis: x, y, z
  double cellMetres = 0.04;           ///< cellSize: as many cells per axis as bring them near this size
  bool prune = true;
  bool operator==(const LatticeSettings&) const = default;
};

struct Organ {
  std::string name;
  MeshSource mesh;
  std::string injuryClass;            ///< "essential", "desirable" or empty
  std::optional<std::string> joint;   ///< carries static_joint; default the nearest
  LatticeSettings lattice;
  bool operator==(const Organ&) const = default;
};

enum class Carriage { rigid, skinned };

struct ArmorPiece {
  std::string name;
  MeshSource mesh;                          ///< builtin: front_plate, back_plate
  Carriage carriage = Carriage::rigid;
  std::vector<std::string> nonProtecting;   ///< names of parts that never count; '*' stands for any run of letters
  std::optional<double> arealDensity;       ///< kg/m2
  std::string material;
  bool operator==(const ArmorPiece&) const = default;
};

struct ArmorSystem {
  std::string name;
  std::vector<ArmorPiece> pieces;
  bool operator==(const ArmorSystem&) const = default;
};

/// Turns of joints against rest, degrees about the scene's axes, x then y then z.
struct TurnedPose {
  struct Turn {
    std::string joint;
    geometry::Vec3d degrees = geometry::Vec3d::Zero();
    bool operator==(const Turn&) const = default;
  };
  std::vector<Turn> turns;
  geometry::Vec3d rootOffset = geometry::Vec3d::Zero();  ///< metres
  bool operator==(const TurnedPose&) const = default;
};

struct ClipPose {
  std::string clip;
  double seconds = 0.0;
  bool operator==(const ClipPose&) const = default;
};

/// A named pose. The pose `rest` always exists and is not listed.
struct Pose {
  std::string name;
  std::variant<ClipPose, TurnedPose> what;
  bool operator==(const Pose&) const = default;
};

enum class Sampler {
  cone,   ///< uniform in the solid angle that bounds the posed skin
  thesis  ///< Eq 15, for comparison only
};

/// A point that shots come from.
struct Source {
  std::string name;
  geometry::Vec3d position = geometry::Vec3d::Zero();  ///< metres
  std::optional<geometry::Vec3d> target;               ///< default: the centre of the posed skin's box
  Sampler sampler = Sampler::cone;
  std::uint64_t shots = 100000;                        ///< per trial
  bool operator==(const Source&) const = default;
};

enum class OrganModel { staticJoint, staticSkin, dynamicThesis, dynamic };

/// "static_joint", "static_skin", "dynamic_thesis", "dynamic".
std::string name(OrganModel model);
std::optional<OrganModel> organModelNamed(std::string_view name);

struct Study {
  std::string name;
  std::string description;
  MeshSource human;                   ///< builtin: plain
  std::vector<Organ> organs;
  std::vector<ArmorSystem> systems;   ///< `unarmored` is always computed and not listed
  std::vector<Pose> poses;            ///< beside `rest`
  std::vector<std::string> runPoses;  ///< names of the poses a run computes; empty: rest and all of `poses`
  std::vector<Source> sources;
  std::vector<OrganModel> models{OrganModel::staticJoint, OrganModel::dynamic};
  std::uint32_t trials = 5;
  std::uint64_t seed = 1;
  double siteSpacing = 0.04;          ///< metres between interior sites
  bool operator==(const Study&) const = default;
};

}  // namespace lorica::study
