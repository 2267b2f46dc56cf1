#include "lorica/manikin/armor_systems.h"

#include <fmt/format.h>

#include <algorithm>

#include "armor_helmet.h"
#include "armor_outlines.h"
#include "armor_panel.h"
#include "armor_sizes.h"
#include "fields.h"
#include "lorica/base/error.h"
#include "lorica/geometry/measures.h"

namespace lorica::manikin {

namespace {

using geometry::TriangleMesh;

constexpr double kGap = 0.0015;         ///< between two soft layers
constexpr double kLoose = 0.002;        ///< of pieces over the creases of hip and shoulder
constexpr double kUnderPlate = 0.0015;  ///< between a plate and what is worn under it
constexpr double kHelmetStandoff = 0.017;

constexpr double kFree = 0.0012;  ///< least distance of a side plate to the skin, arms included

bool beside(armor::PlateSide side) {
  return side == armor::PlateSide::left || side == armor::PlateSide::right;
}

/// Of a piece's vertices from a closed surface; negative inside.
double leastDistance(const geometry::ClosestPointTree& surface, const TriangleMesh& piece, base::Threads threads) {
  std::vector<double> distance(piece.positions.size());
  base::parallelFor(distance.size(), 128, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      distance[v] = surface.signedDistance(piece.positions[v].cast<double>());
    }
  });
  return *std::min_element(distance.begin(), distance.end());
}

/// A soft piece as others see it that lie over it.
struct Layer {
  Outline outline;
  Outline height;  ///< of its inner face over the cloth
  double thickness = 0.0;
  bool onArms = false;
};

/// `loose` over the cloth, and just over the layers below, where there are any.
Outline heightOver(std::vector<Layer> below, double loose) {
  return [below = std::move(below), loose](const Vec3d& p) {
    double height = loose;
    for (const Layer& layer : below) {
      const double there = smoothStep(-0.028, -0.004, layer.outline(p));
      if (there > 0.0) {
        height = std::max(height, loose + there * (layer.height(p) + layer.thickness + kGap - loose));
      }
    }
    return height;
  };
}

Layer layerOver(Outline outline, std::vector<Layer> below, double thickness, double loose = 0.0) {
  return {std::move(outline), heightOver(std::move(below), loose), thickness};
}

/// Everything the systems are made from.
class Armorer {
 public:
  Armorer(const Body& body, base::Threads threads, const base::Progress& progress)
      : body_(body),
        threads_(threads),
        progress_(progress),
        shares_(bodyShares(body)),
        marks_(armorLandmarks(body, shares_)),
        wholeSkin_(body.skin),
        trunkSkin_(withoutArms(body.skin, shares_)),
        cloth_(drapedCloth(body, shares_, marks_, wholeSkin_.tree, {}, threads)),
        outlines_(marks_),
        plate_(plateFor(body.person.sex, marks_.stature)),
        sidePlate_(sidePlateBeside(plate_)),
        plateTop_(marks_.notch.y() - armor::PlatePlacement{}.belowNotch) {}

  ArmorSystem fullTorso() const;
  ArmorSystem plateCarrier() const;
  ArmorSystem helmet() const;

 private:
  ArmorPiece soft(const std::string& name, const Layer& layer, const SheetSpec& sheet, bool protecting) const;
  TriangleMesh wornUnder(const std::vector<ArmorPiece>& pieces) const;
  armor::PlacedPlate placed(const TriangleMesh& under, armor::PlateSide side, double top) const;
  double sidePlateTop(const TriangleMesh& under) const;
  /// Returns where the plates lie, in the order of `sides`.
  std::vector<geometry::RigidTransform> addPlates(ArmorSystem& system,
                                                  const std::vector<armor::PlateSide>& sides) const;
  void addBags(ArmorSystem& system, const SheetSpec& fabric, const geometry::RigidTransform& front,
               const geometry::RigidTransform& back) const;

  const Body& body_;
  base::Threads threads_;
  base::Progress progress_;
  BodyShares shares_;
  ArmorLandmarks marks_;
  SkinUnder wholeSkin_;
  SkinUnder trunkSkin_;  ///< across the fold of an armpit the arm may be nearer to a vest, but does not carry it
  Cloth cloth_;
  Outlines outlines_;
  armor::PlateSpec plate_;
  armor::PlateSpec sidePlate_;
  double plateTop_;
};

ArmorPiece Armorer::soft(const std::string& name, const Layer& layer, const SheetSpec& sheet, bool protecting) const {
  progress_.check();
  Panel panel = cutPanel(cloth_, {layer.outline, layer.height, layer.thickness, layer.onArms}, body_,
                         layer.onArms ? wholeSkin_ : trunkSkin_, threads_);
  ArmorPiece piece;
  piece.name = name;
  piece.mesh = std::move(panel.mesh);
  piece.carriage = armor::Carriage::skinned;
  piece.weights = std::move(panel.weights);
  piece.material = sheet.material;
  piece.arealDensity = sheet.arealDensity;
  piece.area = panel.middleArea;
  piece.mass = piece.arealDensity * piece.area;
  piece.protecting = protecting;
  piece.source = sheet.source + "; cut to the body (assumed)";
  return piece;
}

TriangleMesh Armorer::wornUnder(const std::vector<ArmorPiece>& pieces) const {
  TriangleMesh under = trunkSkin_.mesh;
  for (const ArmorPiece& piece : pieces) {
    if (piece.carriage == armor::Carriage::skinned) {
      geometry::append(under, piece.mesh);
    }
  }
  return under;
}

armor::PlacedPlate Armorer::placed(const TriangleMesh& under, armor::PlateSide side, double top) const {
  armor::PlatePlacement placement;
  placement.clearance = kUnderPlate;
  placement.top = top;
  return armor::placePlate(under, &body_.skeleton, side, beside(side) ? sidePlate_ : plate_, placement);
}

double Armorer::sidePlateTop(const TriangleMesh& under) const {
  // As high as the hanging arms allow, on both sides.
  double top = marks_.armpit - 0.055;
  const auto free = [&](armor::PlateSide side) {
    return leastDistance(wholeSkin_.tree, placed(under, side, top).mesh, threads_) > kFree;
  };
  for (int step = 0; step < 12 && !(free(armor::PlateSide::left) && free(armor::PlateSide::right)); ++step) {
    top -= 0.006;
  }
  return top;
}

std::vector<geometry::RigidTransform> Armorer::addPlates(ArmorSystem& system,
                                                         const std::vector<armor::PlateSide>& sides) const {
  std::vector<geometry::RigidTransform> places;
  const TriangleMesh under = wornUnder(system.pieces);
  const double besideTop = std::any_of(sides.begin(), sides.end(), beside) ? sidePlateTop(under) : 0.0;
  for (const armor::PlateSide side : sides) {
    const armor::PlateSpec& spec = beside(side) ? sidePlate_ : plate_;
    ArmorPiece piece;
    switch (side) {
      case armor::PlateSide::front:
        piece.name = "plate_front";
        break;
      case armor::PlateSide::back:
        piece.name = "plate_back";
        break;
      case armor::PlateSide::left:
        piece.name = "side_plate_left";
        break;
      case armor::PlateSide::right:
        piece.name = "side_plate_right";
        break;
    }
    armor::PlacedPlate plate = placed(under, side, beside(side) ? besideTop : plateTop_);
    piece.mesh = std::move(plate.mesh);
    places.push_back(plate.place);
    piece.material = kPlateMaterial;
    piece.carriedAt = places.back() * Vec3d::Zero();
    piece.area = armor::frontalArea(spec);
    piece.arealDensity = spec.mass / piece.area;
    piece.mass = spec.mass;
    piece.source = spec.source + "; areal density: mass over area";
    system.pieces.push_back(std::move(piece));
  }
  return places;
}

ArmorSystem Armorer::fullTorso() const {
  const SheetSpec sheet = softArmor();
  const double t = sheet.thickness;
  const Layer front = layerOver(outlines_.vestFront(), {}, t);
  const Layer back = layerOver(outlines_.vestBack(), {front}, t);
  ArmorSystem system{"full_torso", {}};
  system.pieces.push_back(soft("vest_front", front, sheet, true));
  system.pieces.push_back(soft("vest_back", back, sheet, true));
  const Layer left = layerOver(outlines_.side(1.0), {front, back}, t);
  const Layer right = layerOver(outlines_.side(-1.0), {front, back}, t);
  system.pieces.push_back(soft("side_left", left, sheet, true));
  system.pieces.push_back(soft("side_right", right, sheet, true));
  system.pieces.push_back(soft("collar", layerOver(outlines_.collar(), {front, back}, t), sheet, true));
  for (const double sign : {1.0, -1.0}) {
    Layer shoulder = layerOver(outlines_.shoulder(sign), {front, back}, t, kLoose);
    shoulder.onArms = true;
    system.pieces.push_back(soft(sign > 0.0 ? "shoulder_left" : "shoulder_right", shoulder, sheet, true));
  }
  // Of a slim person it reaches as far around as the side panels do.
  const Layer groin = layerOver(outlines_.groin(), {front, left, right}, t, kLoose);
  system.pieces.push_back(soft("groin", groin, sheet, true));
  addPlates(system, {armor::PlateSide::front, armor::PlateSide::back, armor::PlateSide::left, armor::PlateSide::right});
  return system;
}

void Armorer::addBags(ArmorSystem& system, const SheetSpec& fabric, const geometry::RigidTransform& front,
                      const geometry::RigidTransform& back) const {
  const auto add = [&](std::string name, const TriangleMesh& inPlateFrame, const geometry::RigidTransform& place) {
    ArmorPiece piece;
    piece.name = std::move(name);
    piece.mesh = {geometry::transformed(inPlateFrame.positions, place), inPlateFrame.triangles};
    piece.material = fabric.material;
    piece.arealDensity = fabric.arealDensity;
    piece.carriedAt = place * Vec3d::Zero();  // the middle of the plate
    piece.protecting = false;
    return piece;
  };
  constexpr double gap = 0.002;
  for (const auto& [name, place] : {std::pair("bag_front", front), std::pair("bag_back", back)}) {
    ArmorPiece bag = add(name, armor::plateCover(plate_, gap, fabric.thickness), place);
    bag.area = 0.5 * geometry::area(bag.mesh);
    bag.mass = bag.arealDensity * bag.area;
    bag.source = fabric.source;
    system.pieces.push_back(std::move(bag));
  }
  // Three pouches side by side for rifle magazines.
  constexpr double width = 0.070;
  constexpr double height = 0.125;
  constexpr double depth = 0.030;
  const double face = gap + fabric.thickness + 0.001;
  for (int k = 0; k < 3; ++k) {
    const double middle = (k - 1) * (width + 0.006);
    ArmorPiece pouch = add(
        fmt::format("pouch_{}", k + 1),
        armor::boxOnPlate(plate_, middle - 0.5 * width, middle + 0.5 * width, 0.02, 0.02 + height, face, face + depth),
        front);
    pouch.area = geometry::area(pouch.mesh);
    pouch.mass = pouch.arealDensity * pouch.area;
    pouch.material = kPouchMaterial;
    pouch.source = fabric.source + "; pouch of 70 x 125 x 30 mm (assumed); area: all its faces";
    system.pieces.push_back(std::move(pouch));
  }
}

ArmorSystem Armorer::plateCarrier() const {
  const SheetSpec fabric = carrierFabric();
  const double t = fabric.thickness;
  const Layer front = layerOver(outlines_.carrierFront(plate_, plateTop_), {}, t);
  const Layer back = layerOver(outlines_.carrierBack(plate_, plateTop_), {front}, t);
  ArmorSystem system{"plate_carrier", {}};
  system.pieces.push_back(soft("carrier_front", front, fabric, false));
  system.pieces.push_back(soft("carrier_back", back, fabric, false));
  for (const double sign : {1.0, -1.0}) {
    system.pieces.push_back(soft(sign > 0.0 ? "cummerbund_left" : "cummerbund_right",
                                 layerOver(outlines_.cummerbund(sign, plate_, plateTop_), {front, back}, t), fabric,
                                 false));
  }
  const auto places = addPlates(system, {armor::PlateSide::front, armor::PlateSide::back});
  addBags(system, fabric, places[0], places[1]);
  return system;
}

ArmorSystem Armorer::helmet() const {
  const HelmetSpec spec = helmetFor(headCircumference(body_, shares_));
  Helmet shell = helmetOn(body_, shares_, kHelmetStandoff, spec.thickness, threads_);
  ArmorPiece piece;
  piece.name = "helmet";
  piece.mesh = std::move(shell.mesh);
  piece.material = spec.material;
  piece.area = shell.middleArea;
  piece.mass = spec.mass;
  piece.arealDensity = piece.mass / piece.area;
  piece.source = spec.source;
  return {"helmet", {std::move(piece)}};
}

ArmorSystem joined(std::string name, const ArmorSystem& first, const ArmorSystem& second) {
  ArmorSystem system{std::move(name), first.pieces};
  system.pieces.insert(system.pieces.end(), second.pieces.begin(), second.pieces.end());
  return system;
}

}  // namespace

std::vector<ArmorSystem> armorOf(const Body& body, base::Threads threads, const base::Progress& progress) {
  LORICA_CHECK(body.weights.vertices() == body.skin.positions.size(), "weights for every vertex of the skin");
  const Armorer armorer(body, threads, progress);
  std::vector<ArmorSystem> systems;
  systems.push_back(armorer.fullTorso());
  progress.report(0.6);
  systems.push_back(armorer.plateCarrier());
  progress.report(0.9);
  systems.push_back(armorer.helmet());
  systems.push_back(joined("full_torso_helmet", systems[0], systems[2]));
  systems.push_back(joined("plate_carrier_helmet", systems[1], systems[2]));
  return systems;
}

armor::RigidCarrier carrierOf(const ArmorSystem& system, const ArmorPiece& piece) {
  if (!piece.carriedAt) {
    return {};
  }
  // A system's plates stand before what is fixed to them.
  const auto plate = std::find_if(system.pieces.begin(), system.pieces.end(),
                                  [&](const ArmorPiece& other) { return other.carriedAt == piece.carriedAt; });
  LORICA_CHECK(plate != system.pieces.end(), "a piece of the system");
  return {armor::CarriedBy::skin, piece.carriedAt, &plate->mesh};
}

}  // namespace lorica::manikin
