#include "random_study.h"

#include <cmath>

namespace lorica::test {

using namespace study;

namespace {

template <class Value>
Value oneOf(std::initializer_list<Value> values) {
  return *rc::gen::elementOf(std::vector<Value>(values));
}

bool coin() {
  return *rc::gen::arbitrary<bool>();
}

/// Letters that need care in JSON, in pointers and in UTF-8.
std::string words() {
  const std::vector<std::string> pieces{"a",
                                        "Z",
                                        "0",
                                        " ",
                                        "\"",
                                        "\\",
                                        "/",
                                        "~",
                                        ".",
                                        "@",
                                        ":",
                                        "{",
                                        "]",
                                        "'",
                                        ",",
                                        "\xC3\xA9",
                                        "\xE2\x82\xAC",
                                        "\xF0\x9F\x98\x80"};
  std::string text;
  for (const std::string& piece : *rc::gen::container<std::vector<std::string>>(rc::gen::elementOf(pieces))) {
    text += piece;
  }
  return text;
}

/// Different for different kinds and indices.
std::string uniqueName(const char* kind, std::size_t index) {
  return words() + kind + std::to_string(index);
}

/// Free text may have line breaks and be empty.
std::string freeText() {
  return coin() ? words() + oneOf<std::string>({"", "\n\t", std::string("\0x", 2)}) : "";
}

double anyNumber(double limit) {
  const double mantissa = static_cast<double>(*rc::gen::arbitrary<std::int64_t>()) * 0x1p-63;
  return coin() ? std::round(mantissa * 100.0) : mantissa * limit * std::exp2(-*rc::gen::inRange(0, 60));
}

geometry::Vec3d anyVector() {
  const double limit = 99999.0;
  const double x = anyNumber(limit);
  const double y = anyNumber(limit);
  return {x, y, anyNumber(limit)};
}

double anyMetresOfMillimetres(double low, double high) {
  const double share = std::abs(anyNumber(1.0));
  const double mm = low + (high - low) * (share - std::floor(share));
  return (coin() ? std::ceil(mm) : mm) / 1000.0;
}

template <class Item, class Make>
std::vector<Item> several(Make make) {
  std::vector<Item> items;
  const auto count = *rc::gen::inRange<std::size_t>(0, 4);
  for (std::size_t i = 0; i < count; ++i) {
    items.push_back(make(i));
  }
  return items;
}

std::vector<std::string> names() {
  return several<std::string>([](std::size_t i) { return uniqueName("p", i); });
}

/// Path and hash.
InputFile anyInput() {
  InputFile file;
  file.path = uniqueName("file", 0);
  if (coin()) {
    file.sha256 = *rc::gen::container<std::string>(64, rc::gen::elementOf(std::string("0123456789abcdef")));
  }
  return file;
}

MeshSource anyMesh() {
  MeshSource mesh;
  if (coin()) {
    mesh.from = Builtin{uniqueName("builtin", 0)};
  } else {
    InputFile file = anyInput();
    if (coin()) {
      file.units = oneOf({base::LengthUnit::metre, base::LengthUnit::centimetre, base::LengthUnit::millimetre,
                          base::LengthUnit::inch});
    }
    if (coin()) {
      file.up = oneOf({'y', 'z'});
    }
    mesh.from = file;
  }
  mesh.parts = names();
  return mesh;
}

LatticeSettings anyLattice() {
  using Layout = LatticeSettings::Layout;
  LatticeSettings lattice;
  lattice.layout = oneOf({Layout::boundingBox, Layout::uniform, Layout::perAxis, Layout::cellSize});
  if (lattice.layout == Layout::uniform || lattice.layout == Layout::perAxis) {
    for (int& count : lattice.cells) {
      count = *rc::gen::inRange(1, 4) * oneOf({1, 250});
    }
  }
  if (lattice.layout == Layout::cellSize && coin()) {
    lattice.cellMetres = anyMetresOfMillimetres(0.2, 2000.0);
  }
  lattice.prune = coin();
  return lattice;
}

Organ anyOrgan(std::size_t index) {
  Organ organ;
  organ.name = uniqueName("organ", index);
  organ.mesh = anyMesh();
  organ.injuryClass = oneOf<std::string>({"", "essential", "desirable"});
  if (coin()) {
    organ.joint = uniqueName("joint", 0);
  }
  organ.lattice = anyLattice();
  organ.description = freeText();
  return organ;
}

ArmorPiece anyPiece(std::size_t index) {
  ArmorPiece piece;
  piece.name = uniqueName("piece", index);
  piece.mesh = anyMesh();
  piece.carriage = oneOf({Carriage::rigid, Carriage::skinned});
  piece.nonProtecting = names();
  if (coin()) {
    piece.arealDensity = std::abs(anyNumber(9999.0)) + 0.001;
  }
  piece.material = coin() ? uniqueName("material", 0) : "";
  piece.description = freeText();
  return piece;
}

ArmorSystem anySystem(std::size_t index) {
  ArmorSystem system;
  system.name = uniqueName("system", index);
  system.pieces = several<ArmorPiece>([&](std::size_t i) { return anyPiece(10 * index + i); });
  system.description = freeText();
  return system;
}

Pose anyPose(std::size_t index) {
  Pose pose;
  pose.name = uniqueName("pose", index);
  if (coin()) {
    pose.what = ClipPose{uniqueName("clip", 0), std::abs(anyNumber(1e5))};
  } else {
    TurnedPose turned;
    turned.turns = several<TurnedPose::Turn>([](std::size_t i) {
      return TurnedPose::Turn{uniqueName("joint", i), anyVector()};
    });
    turned.rootOffset = coin() ? anyVector() : geometry::Vec3d::Zero();
    pose.what = turned;
  }
  pose.description = freeText();
  return pose;
}

/// Positive, in metres as a file in mm gives it.
double anySize() {
  return *rc::gen::inRange(1, 900000) / 1000.0;
}

DegreeRange anyRange(int low, int high) {
  const int from = *rc::gen::inRange(low, high);
  return {from / 2.0, *rc::gen::inRange(from + 1, high + 1) / 2.0};
}

void shapeSource(Source& source) {
  switch (source.type) {
    case SourceType::point:
      source.position = anyVector();
      source.sampler = oneOf({Sampler::cone, Sampler::rectangle, Sampler::disk, Sampler::thesis});
      if (source.sampler == Sampler::rectangle) {
        source.width = anySize();
        source.height = anySize();
      } else if (source.sampler == Sampler::disk) {
        source.radius = anySize();
      }
      break;
    case SourceType::parallel:
      source.azimuth.from = *rc::gen::inRange(-720, 721) / 2.0;
      source.elevation.from = *rc::gen::inRange(-180, 181) / 2.0;
      break;
    case SourceType::band:
      source.azimuth = anyRange(-360, 360);
      source.elevation = anyRange(-180, 180);
      break;
    case SourceType::list:
      source.list = anyInput();
      break;
    case SourceType::sphere:
      break;
  }
}

Source anySource(std::size_t index) {
  Source source;
  source.name = uniqueName("source", index);
  source.type =
      oneOf({SourceType::point, SourceType::parallel, SourceType::band, SourceType::sphere, SourceType::list});
  shapeSource(source);
  source.description = freeText();
  if (source.type == SourceType::list) {
    return source;
  }
  if (coin()) {
    source.target = anyVector();
  } else if (coin()) {
    source.targetStructure = uniqueName("organ", index);
  }
  if (source.sampler != Sampler::thesis && coin()) {
    source.sequence = source.type == SourceType::parallel ? oneOf({Sequence::sobol, Sequence::grid}) : Sequence::sobol;
  }
  if (source.sequence == Sequence::grid) {
    source.cell = *rc::gen::inRange(1, 1000000) / 100.0 / 1000.0;
  } else {
    source.shots =
        oneOf<std::uint64_t>({1, 100000, *rc::gen::inRange<std::uint64_t>(1, 1000000000000ULL), 1000000000000ULL});
  }
  return source;
}

Threat anyThreat(std::size_t index) {
  Threat threat;
  threat.name = uniqueName("threat", index);
  threat.description = freeText();
  if (coin()) {
    threat.from = BlastCharge{anySize(), anyVector()};
  } else {
    InputFile file = anyInput();
    file.units = coin() ? std::optional(base::LengthUnit::inch) : std::nullopt;
    file.up = coin() ? std::optional('z') : std::nullopt;
    threat.from = file;
    threat.timeUnits = coin() ? std::optional(TimeUnit::microsecond) : std::nullopt;
    threat.attribute = coin() ? uniqueName("attribute", 0) : "";
    threat.reach = coin() ? std::optional(anySize()) : std::nullopt;
    threat.offset = coin() ? anyVector() : geometry::Vec3d::Zero();
    threat.turn = coin() ? anyVector() : geometry::Vec3d::Zero();
  }
  threat.threshold = coin() ? std::optional(anyNumber(1e6)) : std::nullopt;
  threat.timeOffset = *rc::gen::inRange(-1000000, 1000000) / 1000.0;
  threat.display.visible = coin();
  if (coin()) {
    threat.display.range = {anyNumber(1e3), 1e6};
  }
  return threat;
}

std::optional<StopRule> anyStop() {
  if (coin()) {
    return std::nullopt;
  }
  return StopRule{{"heart"}, *rc::gen::inRange(1, 501) / 1000.0, *rc::gen::inRange(1U, 100001U)};
}

Overlap anyOverlap() {
  Overlap overlap;
  overlap.policy =
      oneOf({shotline::OverlapPolicy::allClaim, shotline::OverlapPolicy::outermost, shotline::OverlapPolicy::priority});
  if (overlap.policy == shotline::OverlapPolicy::priority) {
    overlap.order = names();
  }
  return overlap;
}

Analyses anyAnalyses() {
  Analyses analyses;
  analyses.compare = coin();
  analyses.convergence = coin();
  if (coin()) {
    analyses.directions = DirectionGrid{oneOf({5.0, 30.0, 90.0}), *rc::gen::inRange<std::uint64_t>(1, 1000000)};
  }
  if (coin()) {
    analyses.motion = MotionSettings{uniqueName("clip", 0), *rc::gen::inRange(1U, 100U), oneOf({12.5, 30.0, 120.0})};
  }
  if (coin()) {
    analyses.gaps = GapSettings{{uniqueName("organ", 0), "body"},
                                oneOf({0.0, 0.1, 0.95}),
                                *rc::gen::inRange(1U, 1000U),
                                oneOf({0.0, 0.0123, 0.03}),
                                coin()};
  }
  if (coin()) {
    analyses.anatomy = AnatomySettings{*rc::gen::inRange(2U, 100U), oneOf({0.0, 1.0, 2.5}), coin(), {}};
    if (coin()) {
      analyses.anatomy->deviations = {{uniqueName("organ", 0), {0.001, 0.0125, 0.0}}};
    }
  }
  return analyses;
}

Display anyDisplay(std::size_t index) {
  Display display;
  display.structure = uniqueName("structure", index);
  display.visible = coin();
  if (coin()) {
    display.colour = {*rc::gen::arbitrary<std::uint8_t>(), *rc::gen::arbitrary<std::uint8_t>(),
                      *rc::gen::arbitrary<std::uint8_t>()};
  }
  if (coin()) {
    const double share = std::abs(anyNumber(1.0));
    display.opacity = share - std::floor(share);
  }
  return display;
}

Motion anyMotion(std::size_t index) {
  Motion motion;
  motion.name = uniqueName("motion", index);
  motion.file.path = uniqueName("path", index);
  motion.file.sha256 = coin() ? std::string(64, 'c') : "";
  if (coin()) {
    motion.file.up = oneOf<char>({'y', 'z'});
  }
  if (coin()) {
    motion.jointRoles = {{uniqueName("role", 0), {uniqueName("joint", 0), uniqueName("joint", 1)}}};
  }
  motion.inPlace = coin();
  motion.description = freeText();
  return motion;
}

Study makeStudy() {
  Study study;
  study.name = coin() ? uniqueName("study", 0) : "";
  study.description = freeText();
  study.human = anyMesh();
  if (std::holds_alternative<Builtin>(study.human.from)) {
    study.person = {coin() ? human::Sex::female : human::Sex::male, 1.4 + std::min(std::abs(anyNumber(0.5)), 1.0),
                    50.0 + std::min(std::abs(anyNumber(50.0)), 100.0)};
  } else if (coin()) {
    study.jointRoles = {{uniqueName("role", 0), {uniqueName("joint", 0)}},
                        {uniqueName("role", 1), {uniqueName("joint", 1), uniqueName("joint", 2)}}};
  }
  study.motions = several<Motion>(anyMotion);
  study.organs = several<Organ>(anyOrgan);
  study.systems = several<ArmorSystem>(anySystem);
  study.poses = several<Pose>(anyPose);
  for (const Pose& pose : study.poses) {
    if (coin()) {
      study.runPoses.push_back(pose.name);
    }
  }
  if (coin()) {
    study.runPoses.emplace_back(oneOf<std::string>({"rest", "walk@0.125"}));
  }
  study.sources = several<Source>(anySource);
  study.threats = several<Threat>(anyThreat);
  study.stop = anyStop();
  study.overlap = anyOverlap();
  study.analyses = anyAnalyses();
  study.models.clear();
  for (const OrganModel model :
       {OrganModel::staticJoint, OrganModel::staticSkin, OrganModel::dynamicThesis, OrganModel::dynamic}) {
    if (coin()) {
      study.models.push_back(model);
    }
  }
  study.trials = oneOf<std::uint32_t>({1, 5, 100000});
  study.seed = *rc::gen::arbitrary<std::uint64_t>();
  study.siteSpacing = anyMetresOfMillimetres(5.0, 500.0);
  study.skinning = oneOf<Skinning>({Skinning::rotationCentres, Skinning::linear});
  study.deformer = oneOf<Deformer>({Deformer::softBody, Deformer::lattice});
  study.displays = several<Display>(anyDisplay);
  return study;
}

}  // namespace

rc::Gen<Study> anyStudy() {
  return rc::gen::exec(makeStudy);
}

}  // namespace lorica::test
