#include "vessel_routes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "lorica/base/error.h"
#include "organ_shapes.h"
#include "tables.h"

namespace lorica::manikin {

namespace {

constexpr double kStep = 0.005;

/// A bone that carries waypoints: its joints in the canonical man and in the body.
struct Bone {
  Vec3d canonicalFrom, canonicalTo;
  Vec3d from, to;

  Vec3d toBody(const Vec3d& p, double scale) const {
    const Vec3d canonicalAxis = canonicalTo - canonicalFrom;
    const Vec3d axis = to - from;
    const double share = (p - canonicalFrom).dot(canonicalAxis) / canonicalAxis.squaredNorm();
    const Vec3d offset = p - canonicalFrom - share * canonicalAxis;
    return from + share * axis + scale * (geometry::Quatd::FromTwoVectors(canonicalAxis, axis) * offset);
  }
};

/// The table holds the left side.
Vec3d canonicalJoint(const std::string& name, bool right) {
  const base::Table& table = jointTable();
  const std::size_t row = table.find("joint", name + "_L");
  const Vec3d left =
      kCanonicalStature * Vec3d(table.number(row, "x_left_frac_stature"), table.number(row, "y_up_frac_stature_male"),
                                table.number(row, "z_fwd_frac_stature"));
  return right ? Vec3d(-left.x(), left.y(), left.z()) : left;
}

std::map<std::string, Bone> bonesOf(const human::Skeleton& skeleton, const std::string& side) {
  std::map<std::string, Bone> bones;
  const auto add = [&](const char* name, const std::string& from, const std::string& to) {
    const bool right = side == "_R";
    bones[name] = {canonicalJoint(from, right), canonicalJoint(to, right), jointPlace(skeleton, from + side),
                   jointPlace(skeleton, to + side)};
  };
  add("clavicle", "sternoclavicular", "glenohumeral");
  add("arm", "glenohumeral", "elbow");
  add("forearm", "elbow", "wrist");
  add("thigh", "hip", "knee");
  add("shank", "knee", "ankle");
  return bones;
}

/// One vessel's rows of the table, from the heart outwards.
struct Course {
  std::string run;
  std::string parent;
  std::string side;  ///< middle, left, right or both
  bool artery = true;
  std::vector<std::size_t> rows;
};

std::vector<Course> courses() {
  const base::Table& table = vesselTable();
  std::vector<Course> all;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::string& run = table.text(row, "run");
    const std::string& side = table.text(row, "side");
    const bool artery = table.text(row, "kind") == "artery";
    if (all.empty() || all.back().run != run || all.back().side != side || all.back().artery != artery) {
      all.push_back({run, table.text(row, "parent"), side, artery, {}});
    }
    all.back().rows.push_back(row);
  }
  return all;
}

std::size_t nearestStation(const Vessel& vessel, const Vec3d& p) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < vessel.stations.size(); ++i) {
    if ((vessel.stations[i].place - p).squaredNorm() < (vessel.stations[best].place - p).squaredNorm()) {
      best = i;
    }
  }
  return best;
}

class Settler {
 public:
  Settler(std::vector<Vessel>& vessels, const Surroundings& around) : vessels_(vessels), around_(around) {
    for (std::size_t v = 0; v < vessels.size(); ++v) {
      for (std::size_t i = 0; i < vessels[v].stations.size(); ++i) {
        where_.push_back({v, i});
        start_.push_back(vessels[v].stations[i].place);
      }
    }
  }

  void run() {
    constexpr int rounds = 60;
    for (int round = 0; round < rounds; ++round) {
      findForks();
      push_.assign(where_.size(), Vec3d::Zero());
      pushApart();
      pushFromSolids();
      if (round % 3 == 0 || round + 3 > rounds) {
        pushInside();
      }
      for (std::size_t n = 0; n < where_.size(); ++n) {
        const double length = push_[n].norm();
        constexpr double most = 0.004;
        place(n) += length > most ? Vec3d(push_[n] * (most / length)) : push_[n];
      }
      holdForks();
      if (round + 2 < rounds) {
        smoothDisplacements();
        holdForks();
      }
    }
  }

 private:
  struct Where {
    std::size_t vessel, station;
  };

  Vec3d& place(std::size_t n) { return vessels_[where_[n].vessel].stations[where_[n].station].place; }
  double radius(std::size_t n) const { return vessels_[where_[n].vessel].stations[where_[n].station].radius; }

  /// Forks near each station; two stations that share one may touch.
  void findForks() {
    near_.assign(where_.size(), {});
    for (std::size_t v = 0; v < vessels_.size(); ++v) {
      if (!vessels_[v].parent) {
        continue;
      }
      const Station& root = vessels_[*vessels_[v].parent].stations[vessels_[v].leaves];
      const double reach = root.radius + 3.5 * vessels_[v].stations.front().radius + 0.004;
      for (std::size_t n = 0; n < where_.size(); ++n) {
        const bool same = vessels_[where_[n].vessel].artery == vessels_[v].artery;
        if (same && (place(n) - root.place).norm() < reach) {
          near_[n].push_back(v);
        }
      }
    }
  }

  bool shareFork(std::size_t a, std::size_t b) const {
    return std::any_of(near_[a].begin(), near_[a].end(), [&](std::size_t fork) {
      return std::find(near_[b].begin(), near_[b].end(), fork) != near_[b].end();
    });
  }

  void pushApart() {
    std::vector<std::size_t> order(where_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return place(a).y() < place(b).y(); });
    constexpr double window = 0.030;
    for (std::size_t i = 0; i < order.size(); ++i) {
      for (std::size_t j = i + 1; j < order.size() && place(order[j]).y() - place(order[i]).y() < window; ++j) {
        const std::size_t a = order[i];
        const std::size_t b = order[j];
        const Where& wa = where_[a];
        const Where& wb = where_[b];
        const bool neighbours =
            wa.vessel == wb.vessel && std::max(wa.station, wb.station) < std::min(wa.station, wb.station) + 12;
        const double wanted = radius(a) + radius(b) + around_.gap;
        const Vec3d between = place(b) - place(a);
        const double distance = between.norm();
        if (neighbours || distance >= wanted || distance < 1e-9 || shareFork(a, b)) {
          continue;
        }
        // The thinner one gives way.
        const double share = radius(b) / (radius(a) + radius(b));
        const Vec3d push = (wanted - distance) / distance * between;
        push_[a] -= share * push;
        push_[b] += (1.0 - share) * push;
      }
    }
  }

  template <class Field>
  void pushFrom(std::size_t n, const Field& field) {
    const Vec3d p = place(n);
    const double lacking = radius(n) + around_.gap - field(p);
    if (!(lacking > 0.0)) {
      return;
    }
    constexpr double h = 0.001;
    Vec3d gradient;
    for (int axis = 0; axis < 3; ++axis) {
      gradient[axis] = field(p + h * Vec3d::Unit(axis)) - field(p - h * Vec3d::Unit(axis));
    }
    if (gradient.allFinite() && gradient.norm() > 1e-6) {
      push_[n] += lacking * gradient.normalized();
    }
  }

  void pushFromSolids() {
    for (std::size_t n = 0; n < where_.size(); ++n) {
      for (const Lattice* solid : around_.solids) {
        pushFrom(n, [&](const Vec3d& p) { return solid->at(p); });
      }
      pushFrom(n, around_.bone);
    }
  }

  void pushInside() {
    for (std::size_t n = 0; n < where_.size(); ++n) {
      const Vec3d p = place(n);
      // Where a branch leaves, the wall is fuller than the tubes.
      constexpr double fork = 0.002;
      const double wanted = radius(n) + around_.skinDepth + (near_[n].empty() ? 0.0 : fork);
      const auto found = around_.skin->closest(p, wanted + 0.05);
      if (!found || found->distance < 1e-9) {
        continue;
      }
      const bool inside = found->pseudoNormal.dot(p - found->point) < 0.0;
      const Vec3d inward = (inside ? 1.0 : -1.0) / found->distance * (p - found->point);
      const double depth = inside ? found->distance : -found->distance;
      if (depth < wanted) {
        push_[n] += (wanted - depth) * inward;
      }
    }
  }

  void holdForks() {
    for (Vessel& vessel : vessels_) {
      if (vessel.parent) {
        vessel.stations.front().place = vessels_[*vessel.parent].stations[vessel.leaves].place;
      }
    }
  }

  void smoothDisplacements() {
    std::vector<Vec3d> moved(where_.size());
    for (std::size_t n = 0; n < where_.size(); ++n) {
      moved[n] = place(n) - start_[n];
    }
    for (std::size_t n = 0; n < where_.size(); ++n) {
      const bool first = where_[n].station == 0;
      const bool last = where_[n].station + 1 == vessels_[where_[n].vessel].stations.size();
      const Vec3d before = first ? moved[n] : moved[n - 1];
      const Vec3d after = last ? moved[n] : moved[n + 1];
      place(n) = start_[n] + 0.5 * moved[n] + 0.25 * (before + after);
    }
  }

  std::vector<Vessel>& vessels_;
  const Surroundings& around_;
  std::vector<Where> where_;
  std::vector<Vec3d> start_;
  std::vector<Vec3d> push_;
  std::vector<std::vector<std::size_t>> near_;
};

}  // namespace

std::vector<Vessel> vesselRoutes(const Body& body, const AnatomyFrame& frame) {
  const base::Table& table = vesselTable();
  const std::map<std::string, Bone> left = bonesOf(body.skeleton, "_L");
  const std::map<std::string, Bone> right = bonesOf(body.skeleton, "_R");
  std::vector<Vessel> vessels;
  const auto find = [&](const std::string& run, bool artery, const std::string& end) {
    for (const std::string& name : {run + end, run}) {
      const auto found = std::find_if(vessels.begin(), vessels.end(),
                                      [&](const Vessel& v) { return v.artery == artery && v.name == name; });
      if (found != vessels.end()) {
        return static_cast<std::size_t>(found - vessels.begin());
      }
    }
    throw base::InputError("vessels", run, "stands after a vessel that leaves it");
  };
  const auto add = [&](const Course& course, const std::string& end) {
    Vessel vessel{course.run + end, course.artery, std::nullopt, 0, {}};
    if (!course.parent.empty()) {
      vessel.parent = find(course.parent, course.artery, end);
    }
    const bool fromMiddle = vessel.parent && vessels[*vessel.parent].name == course.parent;
    std::vector<Station> waypoints;
    for (const std::size_t row : course.rows) {
      Vec3d p =
          kCanonicalStature * Vec3d(table.number(row, "x_left_frac_stature"), table.number(row, "y_up_frac_stature"),
                                    table.number(row, "z_fwd_frac_stature"));
      // Both sides are given as the left one; where they leave a vessel of the middle, the place is the middle's.
      const bool shared = row == course.rows.front() && fromMiddle;
      if (course.side == "both" && end == "_R" && !shared) {
        p.x() = -p.x();
      }
      const std::string& carrier = table.text(row, "frame");
      const Vec3d place =
          carrier == "trunk" ? frame.toBody(p) : (end == "_R" ? right : left).at(carrier).toBody(p, frame.scale());
      waypoints.push_back({place, 0.5e-3 * table.number(row, "diameter_mm") * frame.scale()});
    }
    vessel.stations = smoothTube(waypoints, kStep * frame.scale());
    if (vessel.parent) {
      vessel.leaves = nearestStation(vessels[*vessel.parent], vessel.stations.front().place);
      vessel.stations.front().place = vessels[*vessel.parent].stations[vessel.leaves].place;
    }
    vessels.push_back(std::move(vessel));
  };
  for (const Course& course : courses()) {
    if (course.side == "middle") {
      add(course, "");
    }
    if (course.side == "left" || course.side == "both") {
      add(course, "_L");
    }
    if (course.side == "right" || course.side == "both") {
      add(course, "_R");
    }
  }
  return vessels;
}

void settle(std::vector<Vessel>& vessels, const Surroundings& around) {
  Settler(vessels, around).run();
}

}  // namespace lorica::manikin
