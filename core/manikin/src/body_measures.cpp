#include "lorica/manikin/body_measures.h"

#include <algorithm>
#include <map>
#include <optional>

#include "anthropometry.h"
#include "lorica/base/error.h"
#include "lorica/geometry/measures.h"
#include "tables.h"
#include "tape.h"

namespace lorica::manikin {

using geometry::Vec3d;

namespace {

/// A plane through `place`; `across` and `along` are its axes, of unit length.
struct Plane {
  Vec3d place;
  Vec3d normal;
  Vec3d across;
  Vec3d along;
};

Plane planeAt(const Vec3d& place, const Vec3d& normal) {
  const Vec3d n = normal.normalized();
  // What runs sideways is cut from front to back.
  const Vec3d wanted = std::abs(n.x()) < 0.9 ? Vec3d::UnitX() : Vec3d::UnitZ();
  const Vec3d across = (wanted - wanted.dot(n) * n).normalized();
  return {place, n, across, n.cross(across)};
}

/// The points where a plane cuts the edges of a mesh, and which piece of the section each belongs to.
class Section {
 public:
  Section(const geometry::TriangleMesh& mesh, const Plane& plane) : mesh_(mesh), plane_(plane) {
    heights_.reserve(mesh.positions.size());
    for (const geometry::Vec3f& position : mesh.positions) {
      heights_.push_back(plane.normal.dot(position.cast<double>() - plane.place));
    }
    for (const geometry::Triangle& triangle : mesh.triangles) {
      std::optional<std::size_t> first;  // a plane cuts none or two of a triangle's edges
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = triangle[k];
        const std::uint32_t b = triangle[(k + 1) % 3];
        if ((heights_[a] < 0.0) == (heights_[b] < 0.0)) {
          continue;
        }
        const std::size_t point = cut(a, b);
        if (first) {
          pieceOf_[piece(*first)] = piece(point);
        }
        first = point;
      }
    }
  }

  /// What is read around the piece whose middle is nearest to the place.
  TapeReading nearest() {
    std::map<std::size_t, std::vector<Eigen::Vector2d>> pieces;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      pieces[piece(i)].push_back(points_[i]);
    }
    LORICA_CHECK(!pieces.empty(), "the plane cuts the mesh");
    TapeReading reading;
    double least = 0.0;
    for (auto& [root, outline] : pieces) {
      Eigen::AlignedBox2d box;
      for (const Eigen::Vector2d& point : outline) {
        box.extend(point);
      }
      const double away = box.center().norm();
      if (reading.girth == 0.0 || away < least) {
        least = away;
        reading = {hullGirth(std::move(outline)), box.sizes().x(), box.sizes().y()};
      }
    }
    return reading;
  }

 private:
  std::size_t cut(std::uint32_t a, std::uint32_t b) {
    const auto [entry, fresh] = pointOf_.try_emplace({std::min(a, b), std::max(a, b)}, points_.size());
    if (fresh) {
      const Vec3d from = mesh_.positions[a].cast<double>() - plane_.place;
      const Vec3d to = mesh_.positions[b].cast<double>() - plane_.place;
      const Vec3d point = from + heights_[a] / (heights_[a] - heights_[b]) * (to - from);
      points_.emplace_back(plane_.across.dot(point), plane_.along.dot(point));
      pieceOf_.push_back(pieceOf_.size());
    }
    return entry->second;
  }

  std::size_t piece(std::size_t point) {
    while (pieceOf_[point] != point) {
      point = pieceOf_[point] = pieceOf_[pieceOf_[point]];
    }
    return point;
  }

  const geometry::TriangleMesh& mesh_;
  Plane plane_;
  std::vector<double> heights_;  ///< of the vertices over the plane
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> pointOf_;
  std::vector<Eigen::Vector2d> points_;
  std::vector<std::size_t> pieceOf_;  ///< by way of other points, the last of which points at itself
};

class Measurer {
 public:
  explicit Measurer(const Body& body) : body_(body), sizes_(body.person) {}

  std::vector<BodyMeasure> all() {
    const geometry::Box3d box = geometry::bounds(body_.skin.positions);
    add("stature", box.sizes().y(), "stature", GrowsWith::stature);
    addHeadAndNeck();
    addTrunk();
    addLimbs();
    return std::move(measures_);
  }

 private:
  Vec3d joint(const char* name) const {
    const auto found = body_.skeleton.find(name);
    LORICA_CHECK(found.has_value(), "the skeleton has the joints of the joint table");
    return body_.skeleton.restPosition(*found);
  }
  double heightOf(const char* dimension) const { return sizes_.size(dimension, GrowsWith::stature); }
  TapeReading read(const Vec3d& place, const Vec3d& normal) const {
    return Section(body_.skin, planeAt(place, normal)).nearest();
  }
  TapeReading level(double height) const { return read({0.0, height, 0.0}, Vec3d::UnitY()); }

  void add(std::string name, double value, const std::string& dimension, GrowsWith with) {
    const base::Table& table = anthropometryTable();
    const std::size_t row = surveyRow(body_.person.sex, dimension);
    measures_.push_back({std::move(name), value, sizes_.size(dimension, with), dimension,
                         table.text(row, "source") + "; " + table.text(row, "verification")});
  }

  /// The largest girth at a right angle to `normal` on the way from one place to another.
  double largestGirth(const Vec3d& from, const Vec3d& to, const Vec3d& normal) const {
    constexpr int steps = 12;
    double girth = 0.0;
    for (int i = 0; i <= steps; ++i) {
      girth = std::max(girth, read(from + static_cast<double>(i) / steps * (to - from), normal).girth);
    }
    return girth;
  }

  void addHeadAndNeck() {
    // Around the forehead, where the head is largest above the brow.
    const double eye = joint("eye_L").y();
    const double above = body_.person.stature - eye;
    add("head_girth", largestGirth({0.0, eye + 0.20 * above, 0.0}, {0.0, eye + 0.40 * above, 0.0}, Vec3d::UnitY()),
        "headcircumference", GrowsWith::head);
    const Vec3d low = joint("spine_C7T1");
    const Vec3d neck = joint("head_C0C1") - low;
    // Under the larynx; the throat lies before the joints.
    add("neck_girth", read(low + 0.45 * neck + Vec3d(0.0, 0.0, 0.012), neck).girth, "neckcircumference",
        GrowsWith::build);
  }

  void addTrunk() {
    const TapeReading chest = level(heightOf("chestheight"));
    add("chest_girth", chest.girth, "chestcircumference", GrowsWith::build);
    add("chest_breadth", chest.breadth, "chestbreadth", GrowsWith::build);
    add("chest_depth", chest.depth, "chestdepth", GrowsWith::build);
    add("waist_girth", level(heightOf("waistheightomphalion")).girth, "waistcircumference", GrowsWith::build);
    const TapeReading hip = level(heightOf("buttockheight"));
    add("hip_girth", hip.girth, "buttockcircumference", GrowsWith::build);
    add("hip_breadth", hip.breadth, "hipbreadth", GrowsWith::build);
    add("hip_depth", hip.depth, "buttockdepth", GrowsWith::build);
  }

  void addLimbs() {
    // The thigh is taped under the buttock, where the legs have just parted.
    const Vec3d hip = joint("hip_L");
    const Vec3d knee = joint("knee_L");
    const double under = heightOf("crotchheight") - 0.0256 * body_.person.stature;
    const Vec3d thigh = hip + (hip.y() - under) / (hip.y() - knee.y()) * (knee - hip);
    add("thigh_girth", read({thigh.x(), under, 0.0}, Vec3d::UnitY()).girth, "thighcircumference", GrowsWith::build);
    const Vec3d shank = joint("ankle_L") - knee;
    add("calf_girth", largestGirth(knee + 0.15 * shank, knee + 0.55 * shank, Vec3d::UnitY()), "calfcircumference",
        GrowsWith::build);
    const Vec3d shoulder = joint("glenohumeral_L");
    const Vec3d upper = joint("elbow_L") - shoulder;
    add("upper_arm_girth", largestGirth(shoulder + 0.46 * upper, shoulder + 0.62 * upper, upper),
        "bicepscircumferenceflexed", GrowsWith::build);
  }

  const Body& body_;
  Anthropometry sizes_;
  std::vector<BodyMeasure> measures_;
};

}  // namespace

std::vector<BodyMeasure> measureBody(const Body& body) {
  return Measurer(body).all();
}

double measuredMass(const Body& body) {
  return (geometry::signedVolume(body.skin) - lungAir(body.person)) * meanDensity(body.person.sex);
}

}  // namespace lorica::manikin
