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
#include "lorica/shotline/partition.h"
#include "lorica/shotline/source.h"
#include "lorica/threat/read_threat.h"
#include "lorica/viscera/organ_rig.h"

namespace lorica::study {

/// A file the study reads. Relative paths are relative to the study file, with '/' between folders.
struct InputFile {
  std::string path;
  std::string
      sha256;  ///< 64 lower-case hexadecimal digits of its bytes (with those of the files a .gltf or .pvd names)
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
using shotline::Sampler;
using shotline::Sequence;
using threat::TimeUnit;
using viscera::Deformer;
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

/// A recorded motion that the body does, as one more of its clips.
struct Motion {
  std::string name;  ///< of the clip
  InputFile file{};  ///< BVH; without units
  /// What the joints of the recorded skeleton stand for, where their names do not say it.
  std::vector<human::RoleEntry> jointRoles{};
  bool inPlace = false;       ///< the pelvis stays over where it rests
  std::string description{};  ///< free text
  bool operator==(const Motion&) const = default;
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

enum class SourceType {
  point,     ///< one place, near or far
  parallel,  ///< one direction, from far away
  band,      ///< directions between two azimuths and two elevations, from far away
  sphere,    ///< every direction
  list       ///< shots of a CSV file
};

/// From one angle up to another, degrees.
struct DegreeRange {
  double from = 0.0;
  double to = 0.0;
  bool operator==(const DegreeRange&) const = default;
};

/// Where shots come from. Azimuth and elevation as lorica/shotline/source.h has them. The file keeps only what the type
/// and the sampler use.
struct Source {
  std::string name;
  geometry::Vec3d position = geometry::Vec3d::Zero();  ///< of a point, metres
  std::optional<geometry::Vec3d> target;  ///< middle of the shots; default: the centre of the posed skin's box
  Sampler sampler = Sampler::cone;        ///< of a point
  std::uint64_t shots = 100000;           ///< per trial; a grid and a list have their own number
  std::string description{};              ///< free text
  SourceType type = SourceType::point;
  std::string targetStructure{};         ///< instead of `target`: the centre of an organ's or a piece's box
  double width = 0.0;                    ///< of sampler rectangle, metres
  double height = 0.0;                   ///< of sampler rectangle, metres
  double radius = 0.0;                   ///< of sampler disk, metres
  DegreeRange azimuth{};                 ///< of parallel (`from` alone) and band
  DegreeRange elevation{};               ///< likewise, -90 to 90
  Sequence sequence = Sequence::random;  ///< grid for parallel alone; random for thesis and list
  double cell = 0.0;                     ///< largest size of a cell of the grid, metres
  InputFile list{};                      ///< of type list
  bool operator==(const Source&) const = default;
};

/// Who owns what several structures claim, in what is told of single shots.
struct Overlap {
  shotline::OverlapPolicy policy = shotline::OverlapPolicy::allClaim;
  std::vector<std::string> order{};  ///< of `priority`: organs and pieces, the strongest first
  bool operator==(const Overlap&) const = default;
};

/// Trials go on, beyond those of the study, until the intervals are narrow enough.
struct StopRule {
  std::vector<std::string> structures{};  ///< organs
  double halfWidth = 0.01;  ///< of the coverage under every armor system; without armor, of the share of shots
  std::uint32_t maxTrials = 1000;
  bool operator==(const StopRule&) const = default;
};

/// Coverage by direction: parallel beams from the middles of equal steps of azimuth and elevation.
struct DirectionGrid {
  double step = 30.0;           ///< degrees, divides 180
  std::uint64_t shots = 10000;  ///< of each beam
  bool operator==(const DirectionGrid&) const = default;
};

/// Coverage over a motion clip: every so many of its frames, the first and the last among them.
struct MotionSettings {
  std::string clip{};
  std::uint32_t every = 1;
  double framesPerSecond = 30.0;
  bool operator==(const MotionSettings&) const = default;
};

/// Where shots reach a structure past the armor: patches of the skin, and heat maps. The rule is that of
/// lorica/shotline/open_patches.h.
struct GapSettings {
  std::vector<std::string> structures{};  ///< "body" or organs
  double openShare = 0.1;                 ///< of the shots through a place, above which it is open
  std::uint32_t minShots = 20;            ///< on a patch, and for a triangle or its surroundings to be judged
  double radius = 0.03;                   ///< metres, of those surroundings
  bool maps = true;                       ///< also write the heat maps
  bool operator==(const GapSettings&) const = default;
};

/// How far the coverage is open because nobody knows where in a person the organs lie: they are moved at random.
struct AnatomySettings {
  std::uint32_t draws = 50;
  double scale = 1.0;         ///< of all displacements
  bool verifiedOnly = false;  ///< leave out published magnitudes whose source nobody has looked up again
  struct Deviation {
    std::string organ;
    geometry::Vec3d metres = geometry::Vec3d::Zero();  ///< standard deviation to the left, up and forward
    bool operator==(const Deviation&) const = default;
  };
  std::vector<Deviation> deviations{};  ///< in place of the published ones
  bool operator==(const AnatomySettings&) const = default;
};

/// What a run works out beside the tables of coverage.
struct Analyses {
  bool compare = false;      ///< systems and models on the same shots, pieces left out, mass and area
  bool convergence = false;  ///< coverage after each trial
  std::optional<DirectionGrid> directions{};
  std::optional<MotionSettings> motion{};
  std::optional<GapSettings> gaps{};
  std::optional<AnatomySettings> anatomy{};
  bool operator==(const Analyses&) const = default;
};

/// A charge in free air, whose blast the program works out (lorica/threat/blast.h).
struct BlastCharge {
  double tntKilograms = 1.0;
  geometry::Vec3d position = geometry::Vec3d::Zero();  ///< metres
  bool operator==(const BlastCharge&) const = default;
};

/// How threat data are drawn; changes no number.
struct ThreatDisplay {
  bool visible = true;
  std::optional<std::array<double, 2>> range{};  ///< of the attribute, from the first to the last colour
  bool operator==(const ThreatDisplay&) const = default;
};

/// Threat data on and around the body (lorica/threat/threat_field.h).
struct Threat {
  std::string name;
  std::variant<InputFile, BlastCharge> from;
  std::optional<TimeUnit> timeUnits{};               ///< of a file that does not say them, when not seconds
  std::string attribute{};                           ///< of a file; empty: the first
  std::optional<double> threshold{};                 ///< of the attribute, in its unit
  std::optional<double> reach{};                     ///< metres from scattered points beyond which there is no value
  double timeOffset = 0.0;                           ///< seconds, added to the times of the data
  geometry::Vec3d offset = geometry::Vec3d::Zero();  ///< metres, where a file's origin lies in the scene
  geometry::Vec3d turn = geometry::Vec3d::Zero();    ///< degrees of a file about the scene's x, then y, then z
  ThreatDisplay display{};
  std::string description{};  ///< free text
  bool operator==(const Threat&) const = default;
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
  std::vector<Motion> motions;  ///< beside the clips that the body has
  std::vector<Organ> organs;
  std::vector<ArmorSystem> systems;  ///< `unarmored` is always computed and not listed
  std::vector<Pose> poses;           ///< beside `rest`
  /// Poses a run computes: names, or clips at a time written CLIP@SECONDS; empty: rest and all of `poses`.
  std::vector<std::string> runPoses;
  std::vector<Source> sources;
  std::vector<Threat> threats;
  std::vector<OrganModel> models{OrganModel::staticJoint, OrganModel::dynamic};
  std::uint32_t trials = 5;
  std::uint64_t seed = 1;
  double siteSpacing = 0.04;  ///< metres between interior sites
  Skinning skinning = Skinning::rotationCentres;
  Deformer deformer = Deformer::softBody;  ///< of OrganModel::dynamic
  std::optional<StopRule> stop;            ///< none: `trials` and no more
  Overlap overlap;
  Analyses analyses;
  std::vector<Display> displays;  ///< each structure at most once
  bool operator==(const Study&) const = default;
};

}  // namespace lorica::study
