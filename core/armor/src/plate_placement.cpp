#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "depth_map.h"
#include "lorica/armor/plates.h"
#include "lorica/base/error.h"
#include "lorica/base/units.h"
#include "lorica/geometry/measures.h"
#include "plate_surface.h"

namespace lorica::armor {

namespace {

using geometry::Vec3d;

// Shares of stature, resources/tables/plates.csv: the notch itself, and the joints whose height tells it.
constexpr double kNotch = 0.8191;
constexpr double kSternoclavicular = 0.8162;
constexpr double kC7T1 = 0.8429;

struct Stance {
  double floor = 0.0;
  double stature = 0.0;
  double middle = 0.0;  ///< x of the middle of the skin's box
};

void judgeStance(const geometry::Box3d& box, base::Issues& issues) {
  const Vec3d size = box.sizes();
  if (size.y() < 1.2 || size.y() > 2.3) {
    issues.push_back({base::Severity::warning, "", "plate",
                      fmt::format("the skin is {:.2f} m tall, not 1.2 to 2.3 m: check its units and whether it stands; "
                                  "the plate keeps its real size",
                                  size.y())});
  }
  if (size.x() > 1.25 * size.y() || size.z() > 0.6 * size.y()) {
    issues.push_back({base::Severity::warning, "", "plate",
                      "the body does not stand upright with y up and facing +z: the plate is placed as if it did"});
  }
}

std::string lowered(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// Height of the notch by the joints whose name holds one of `names` and which lie near the midline: the lowest of
/// them, moved from where that joint is in the table to where the notch is. Nothing when that is not plausible.
std::optional<double> notchFromJoints(const human::Skeleton& skeleton, const Stance& stance,
                                      std::initializer_list<const char*> names, double shareOfJoint) {
  std::optional<double> notch;
  for (std::size_t j = 0; j < skeleton.size(); ++j) {
    const human::JointIndex index{j};
    const std::string name = lowered(skeleton.joint(index).name);
    const Vec3d place = skeleton.restPosition(index);
    const bool known =
        std::any_of(names.begin(), names.end(), [&](const char* part) { return name.find(part) != std::string::npos; });
    const double height = place.y() + (kNotch - shareOfJoint) * stance.stature;
    const double share = (height - stance.floor) / stance.stature;
    // A joint called "shoulder" is the collar bone's in some skeletons and the arm's in others.
    const bool medial = std::abs(place.x() - stance.middle) < 0.05 * stance.stature;
    if (known && medial && share >= 0.78 && share <= 0.86) {
      notch = std::min(notch.value_or(height), height);
    }
  }
  return notch;
}

double notchHeight(const human::Skeleton* skeleton, const Stance& stance, base::Issues& issues) {
  if (skeleton != nullptr) {
    std::optional<double> notch =
        notchFromJoints(*skeleton, stance, {"sternoclavicular", "clavic", "collar", "shoulder"}, kSternoclavicular);
    if (!notch) {
      notch = notchFromJoints(*skeleton, stance, {"c7t1", "neck"}, kC7T1);
    }
    if (notch) {
      return *notch;
    }
  }
  issues.push_back({base::Severity::note, "", "plate",
                    fmt::format("no joint tells where the suprasternal notch is: taken at {:.4f} of stature, the mean "
                                "of men in ANSUR II",
                                kNotch)});
  return stance.floor + kNotch * stance.stature;
}

/// The loops in which a horizontal plane cuts a closed skin.
class Section {
 public:
  Section(std::span<const Vec3d> points, std::span<const geometry::Triangle> triangles, double height)
      : points_(points), height_(height) {
    for (const geometry::Triangle& t : triangles) {
      const auto above = [&](std::size_t k) { return points[t[k]].y() >= height; };
      if (above(0) != above(1) || above(1) != above(2)) {
        cut(t);
      }
    }
  }

  /// x of the centre of the largest loop: the trunk, where arms are loops of their own.
  std::optional<double> centreOfLargest() {
    std::map<std::size_t, std::pair<double, double>> loops;  // twice the area, six times the first moment
    for (const Segment& segment : segments_) {
      auto& [area, moment] = loops[root(segment.crossing)];
      area += segment.area;
      moment += segment.moment;
    }
    const auto largest = std::max_element(loops.begin(), loops.end(), [](const auto& a, const auto& b) {
      return std::abs(a.second.first) < std::abs(b.second.first);
    });
    if (largest == loops.end() || largest->second.first == 0.0) {
      return std::nullopt;
    }
    return largest->second.second / (3.0 * largest->second.first);
  }

 private:
  struct Segment {
    std::size_t crossing;
    double area;    ///< twice that of the triangle with the origin
    double moment;  ///< six times its first moment about x = 0
  };

  /// Joins the crossings of the two edges that the plane cuts.
  void cut(const geometry::Triangle& t) {
    std::array<std::size_t, 2> ends{};
    std::array<Vec3d, 2> places;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = t[k];
      const std::uint32_t to = t[(k + 1) % 3];
      const bool rising = points_[to].y() >= height_;
      if (rising == (points_[from].y() >= height_)) {
        continue;
      }
      const auto [known, isNew] = crossings_.try_emplace(std::minmax(from, to), parent_.size());
      if (isNew) {
        parent_.push_back(parent_.size());
      }
      const std::size_t end = rising ? 0 : 1;
      ends[end] = known->second;
      const double share = (height_ - points_[from].y()) / (points_[to].y() - points_[from].y());
      places[end] = points_[from] + share * (points_[to] - points_[from]);
    }
    parent_[root(ends[0])] = root(ends[1]);
    const double area = places[0].x() * places[1].z() - places[1].x() * places[0].z();
    segments_.push_back({ends[0], area, (places[0].x() + places[1].x()) * area});
  }

  std::size_t root(std::size_t i) {
    while (parent_[i] != i) {
      i = parent_[i] = parent_[parent_[i]];
    }
    return i;
  }

  std::span<const Vec3d> points_;
  double height_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> crossings_;  ///< by the ends of the cut edge
  std::vector<std::size_t> parent_;                                           ///< of the crossings: one tree a loop
  std::vector<Segment> segments_;
};

/// x of the trunk's midline: the median of the sections beside the plate.
std::optional<double> midline(std::span<const Vec3d> points, std::span<const geometry::Triangle> triangles, double top,
                              double height) {
  std::vector<double> centres;
  for (int i = 1; i < 10; ++i) {
    if (const auto centre = Section(points, triangles, top - 0.1 * i * height).centreOfLargest()) {
      centres.push_back(*centre);
    }
  }
  if (centres.empty()) {
    return std::nullopt;
  }
  std::sort(centres.begin(), centres.end());
  return centres[centres.size() / 2];
}

/// Points of a face, closer together than the depth map's.
std::vector<Vec3d> faceSamples(const PlateSpec& spec, double depth) {
  constexpr double spacing = 0.0035;
  const int rows = static_cast<int>(std::ceil(spec.height / spacing));
  const int columns = static_cast<int>(std::ceil(spec.width / spacing));
  std::vector<Vec3d> samples;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      samples.push_back(platePoint(spec, 2.0 * i / columns - 1.0, spec.height * j / rows, depth));
    }
  }
  return samples;
}

struct Faces {
  std::vector<Vec3d> front;
  std::vector<Vec3d> back;
};

struct Fit {
  geometry::Quatd pitch = geometry::Quatd::Identity();
  Vec3d shift = Vec3d::Zero();
  double meanGap = std::numeric_limits<double>::infinity();  ///< behind the back face, over the grown skin
};

/// The plate pitched by an angle, its top edge at `top`, pushed forward until it only touches the grown skin.
Fit touch(const Faces& faces, const DepthMap& map, double degrees, double middle, double top) {
  Fit fit;
  fit.pitch = Eigen::AngleAxisd(base::radians(degrees), Vec3d::UnitX());
  double highest = kNothing;
  for (const auto* face : {&faces.front, &faces.back}) {
    for (const Vec3d& sample : *face) {
      highest = std::max(highest, (fit.pitch * sample).y());
    }
  }
  fit.shift = {middle, top - highest, kNothing};
  double sum = 0.0;
  int over = 0;  // samples of the back face that have skin before them
  for (const auto* face : {&faces.front, &faces.back}) {
    for (const Vec3d& sample : *face) {
      const Vec3d p = fit.pitch * sample;
      const double skin = map.at(p.x() + fit.shift.x(), p.y() + fit.shift.y());
      if (skin > kNothing) {
        fit.shift.z() = std::max(fit.shift.z(), skin - p.z());
        sum += face == &faces.back ? p.z() - skin : 0.0;
        over += face == &faces.back ? 1 : 0;
      }
    }
  }
  if (over > 0) {
    fit.meanGap = fit.shift.z() + sum / over;
  }
  return fit;
}

/// Of all pitches the one whose mean gap is smallest. The largest says little: it lies at a corner, where every trunk
/// curves away from a plate.
Fit bestFit(const Faces& faces, const DepthMap& map, double middle, double top) {
  Fit best = touch(faces, map, 0.0, middle, top);
  for (int half = 1; half <= 60; ++half) {
    for (const double degrees : {0.5 * half, -0.5 * half}) {
      const Fit fit = touch(faces, map, degrees, middle, top);
      best = fit.meanGap < best.meanGap ? fit : best;
    }
  }
  return best;
}

/// Every side is handled as the front of a body that has turned: exactly, so that left and right mirror each other.
geometry::Mat3d turnToFront(PlateSide side) {
  geometry::Mat3d turn = geometry::Mat3d::Identity();
  switch (side) {
    case PlateSide::front:
      break;
    case PlateSide::back:
      turn.diagonal() << -1.0, 1.0, -1.0;
      break;
    case PlateSide::left:
      turn << 0.0, 0.0, -1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0;
      break;
    case PlateSide::right:
      turn << 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, -1.0, 0.0, 0.0;
      break;
  }
  return turn;
}

}  // namespace

PlacedPlate placePlate(const geometry::TriangleMesh& skin, const human::Skeleton* skeleton, PlateSide side,
                       const PlateSpec& spec, const PlatePlacement& placement) {
  LORICA_CHECK(!skin.triangles.empty(), "a plate needs a skin to lie on");
  PlacedPlate placed{plate(spec), {}, {}};
  const geometry::Box3d box = geometry::bounds(skin.positions);
  judgeStance(box, placed.issues);
  const Stance stance{box.min().y(), box.sizes().y(), box.center().x()};
  const double top =
      placement.top ? *placement.top : notchHeight(skeleton, stance, placed.issues) - placement.belowNotch;

  const geometry::Mat3d turn = turnToFront(side);
  std::vector<Vec3d> points;
  points.reserve(skin.positions.size());
  for (const geometry::Vec3f& position : skin.positions) {
    points.emplace_back(turn * position.cast<double>());
  }
  const Vec3d centre = turn * box.center();
  const double middle = midline(points, skin.triangles, top, spec.height).value_or(centre.x());
  const double reach = placement.clearance + 0.01;
  const geometry::Box3d under(Vec3d(middle - 0.5 * spec.width - reach, top - spec.height - reach, 0.0),
                              Vec3d(middle + 0.5 * spec.width + reach, top + reach, 0.0));
  const DepthMap map(points, skin.triangles, under, placement.clearance);
  Fit best = bestFit({faceSamples(spec, 0.0), faceSamples(spec, 1.0)}, map, middle, top);
  if (!std::isfinite(best.meanGap)) {
    placed.issues.push_back({base::Severity::warning, "", "plate",
                             "there is no skin where the plate belongs: it is placed before the body's box"});
    const double foremost = std::max((turn * box.min()).z(), (turn * box.max()).z());
    best.pitch = geometry::Quatd::Identity();
    best.shift = {middle, top - 0.5 * spec.height, foremost + placement.clearance + 0.5 * spec.width};
  }
  placed.place = {geometry::Quatd(turn.transpose()) * best.pitch, turn.transpose() * best.shift};
  for (geometry::Vec3f& position : placed.mesh.positions) {
    position = (turn.transpose() * (best.pitch * position.cast<double>() + best.shift)).cast<float>();
  }
  return placed;
}

}  // namespace lorica::armor
