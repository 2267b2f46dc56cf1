#pragma once

/// \file
/// A study as a value: which human, which organs and armor, in which poses, shot at from where. Equal values give the
/// same file, the same file the same results.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "lorica/armor/piece_rig.h"
#include "lorica/base/units.h"
#include "lorica/geometry/vectors.h"
#include "lorica/human/joint_roles.h"
#include "lorica/human/person.h"
#include "lorica/shotline/point_source.h"
#include "lorica/viscera/organ_rig.h"

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

/// How the control points of an organ are laid out. The file keeps only what the layout uses.
using LatticeSettings = viscera::LatticeOptions;
using armor::Carriage;
using human::Skinning;
using viscera::Deformer;
using shotline::Sampler;
using viscera::OrganModel;

struct Organ {
  std::string name;
  MeshSource mesh;
  std::string injuryClass;           ///< "essential", "desirable" or empty
  std::optional<std::string> joint;  ///< carries static_joint; default the nearest
  LatticeSettings lattice;
  std::string description{};  ///< free text
  bool operator==(const Organ&) const = default;
};

struct ArmorPiece {
  std::string name;
  MeshSource mesh;  ///< builtin: front_plate, back_plate
  Carriage carriage = Carriage::rigid;
  std::vector<std::string> nonProtecting;  ///< names of parts that never count; '*' stands for any run of letters
  std::optional<double> arealDensity;      ///< kg/m2
  std::string material;
  std::string description{};  ///< free text
  bool operator==(const ArmorPiece&) const = default;
};

struct ArmorSystem {
  std::string name;
  std::vector<ArmorPiece> pieces;
  std::string description{};  ///< free text
  bool operator==(const ArmorSystem&) const = default;
};

/// Turns of joints against rest, degrees about the scene's axes, x then y then z; each joint at most once.
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

/// Reads CLIP@SECONDS; the last '@' counts. Nothing for any other text.
std::optional<ClipPose> clipPoseNamed(std::string_view text);

/// A named pose; one named CLIP@SECONDS is that clip at that time. The pose `rest` always exists and is not listed.
struct Pose {
  std::string name;
  std::variant<ClipPose, TurnedPose> what;
  std::string description{};  ///< free text
  bool operator==(const Pose&) const = default;
};

/// A point that shots come from.
struct Source {
  std::string name;
  geometry::Vec3d position = geometry::Vec3d::Zero();  ///< metres
  std::optional<geometry::Vec3d> target;               ///< default: the centre of the posed skin's box
  Sampler sampler = Sampler::cone;
  std::uint64_t shots = 100000;  ///< per trial
  std::string description{};     ///< free text
  bool operator==(const Source&) const = default;
};

/// How a structure is drawn where that is not the program's default; changes no number.
struct Display {
  std::string structure;  ///< "body", an organ or an armor piece
  bool visible = true;
  std::optional<std::array<std::uint8_t, 3>> colour;  ///< red, green, blue, sRGB
  std::optional<double> opacity;                      ///< 0 to 1
  bool operator==(const Display&) const = default;
};

struct Study {
  std::string name;
  std::string description;
  MeshSource human;      ///< builtin: human
  human::Person person;  ///< whom a built-in human stands for
  /// What the joints of a file's skeleton stand for, where their names do not say it: the task motions run on them.
  std::vector<human::RoleEntry> jointRoles;
  std::vector<Organ> organs;
  std::vector<ArmorSystem> systems;  ///< `unarmored` is always computed and not listed
  std::vector<Pose> poses;           ///< beside `rest`
  /// Poses a run computes: names, or clips at a time written CLIP@SECONDS; empty: rest and all of `poses`.
  std::vector<std::string> runPoses;
  std::vector<Source> sources;
  std::vector<OrganModel> models{OrganModel::staticJoint, OrganModel::dynamic};
  std::uint32_t trials = 5;
  std::uint64_t seed = 1;
  double siteSpacing = 0.04;  ///< metres between interior sites
  Skinning skinning = Skinning::rotationCentres;
  Deformer deformer = Deformer::softBody;  ///< of OrganModel::dynamic
  std::vector<Display> displays;  ///< each structure at most once
  bool operator==(const Study&) const = default;
};

}  // namespace lorica::study
