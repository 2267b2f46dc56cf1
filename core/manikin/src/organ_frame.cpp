#include "organ_frame.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "fields.h"
#include "lorica/base/error.h"
#include "lorica/geometry/measures.h"

namespace lorica::manikin {

namespace {

/// A joint of the spine in the canonical man, shares of stature (joint table, male).
struct SpineKnot {
  const char* joint;
  double height;
  double depth;
};
constexpr std::array<SpineKnot, 8> kSpine{{{"spine_L5S1", 0.5801, -0.0261},
                                           {"spine_L3L4", 0.6189, -0.0176},
                                           {"spine_L1L2", 0.6553, -0.0256},
                                           {"spine_T10T11", 0.7079, -0.0441},
                                           {"spine_T6T7", 0.7687, -0.0486},
                                           {"spine_T2T3", 0.8211, -0.0314},
                                           {"spine_C7T1", 0.8429, -0.0235},
                                           {"head_C0C1", 0.9092, -0.0113}}};
constexpr double kPelvisHeight = 0.5130;

/// Where the skin is measured, and what the canonical man measures there (m; depths from the discs).
struct Site {
  double height;  ///< share of stature, canonical
  double halfBreadth;
  double back;
  double front;
};
constexpr std::array<Site, 9> kSites{{{0.5130, 0.1735, -0.072, 0.140},
                                      {0.5801, 0.1660, -0.068, 0.152},
                                      {0.6189, 0.1600, -0.079, 0.140},
                                      {0.6553, 0.1560, -0.073, 0.150},
                                      {0.7079, 0.1520, -0.060, 0.183},
                                      {0.7450, 0.1520, -0.065, 0.190},
                                      {0.8211, 0.1520, -0.072, 0.125},
                                      {0.8660, 0.0600, -0.055, 0.080},
                                      {0.9550, 0.0770, -0.085, 0.110}}};

/// A body that is larger than its stature tells carries half of the rest outside its cavities, as fat.
double cavityRatio(double measured, double canonical, double stature) {
  const double excess = measured / (canonical * stature) - 1.0;
  return stature * (1.0 + (excess > 0.0 ? 0.5 * excess : excess));
}

bool isArm(std::string_view joint) {
  constexpr std::array<std::string_view, 10> stems{"acromioclavicular",
                                                   "glenohumeral",
                                                   "elbow",
                                                   "radioulnar",
                                                   "wrist",
                                                   "thumb",
                                                   "index",
                                                   "middle",
                                                   "ring",
                                                   "little"};
  return std::any_of(stems.begin(), stems.end(), [&](std::string_view stem) { return joint.starts_with(stem); });
}

double depthScale(double dz, double back, double front) {
  return back + (front - back) * smoothStep(-0.05, 0.05, dz);
}

}  // namespace

Curve::Curve(std::vector<double> knots, std::vector<double> values)
    : knots_(std::move(knots)), values_(std::move(values)) {
  const std::size_t n = knots_.size();
  LORICA_CHECK(n >= 2 && values_.size() == n, "a curve needs two knots and a value at each");
  std::vector<double> secants(n - 1);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    LORICA_CHECK(knots_[i + 1] > knots_[i], "knots rise");
    secants[i] = (values_[i + 1] - values_[i]) / (knots_[i + 1] - knots_[i]);
  }
  slopes_.resize(n);
  slopes_.front() = secants.front();
  slopes_.back() = secants.back();
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double product = secants[i - 1] * secants[i];
    slopes_[i] = product <= 0.0 ? 0.0 : 2.0 * product / (secants[i - 1] + secants[i]);
  }
}

double Curve::operator()(double x) const {
  if (x <= knots_.front()) {
    return values_.front() + slopes_.front() * (x - knots_.front());
  }
  if (x >= knots_.back()) {
    return values_.back() + slopes_.back() * (x - knots_.back());
  }
  const auto i = static_cast<std::size_t>(std::upper_bound(knots_.begin(), knots_.end(), x) - knots_.begin()) - 1;
  const double span = knots_[i + 1] - knots_[i];
  const double t = (x - knots_[i]) / span;
  const double u = 1.0 - t;
  return u * u * (1.0 + 2.0 * t) * values_[i] + t * t * (1.0 + 2.0 * u) * values_[i + 1] +
         t * u * span * (u * slopes_[i] - t * slopes_[i + 1]);
}

Vec3d Level::toCanonical(double x, double z) const {
  const double dz = z - spine;
  return {x / breadth, canonicalHeight, canonicalSpine + dz / depthScale(dz, back, front)};
}

Vec3d jointPlace(const human::Skeleton& skeleton, std::string_view name) {
  const auto joint = skeleton.find(name);
  LORICA_CHECK(joint.has_value(), "the body has the joints of the joint table");
  return skeleton.restPosition(*joint);
}

SkinSection skinSection(const Body& body, double height) {
  constexpr double midline = 0.02;
  std::vector<bool> arm(body.skeleton.size());
  for (std::size_t j = 0; j < arm.size(); ++j) {
    arm[j] = isArm(body.skeleton.joints()[j].name);
  }
  const auto onArm = [&](std::uint32_t vertex) {
    const std::size_t strongest = body.weights.strongest(vertex).value;
    return static_cast<bool>(arm[strongest]);
  };
  SkinSection section{0.0, 1e9, -1e9};
  for (const geometry::Triangle& triangle : body.skin.triangles) {
    if (onArm(triangle[0]) || onArm(triangle[1]) || onArm(triangle[2])) {
      continue;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d a = body.skin.positions[triangle[k]].cast<double>();
      const Vec3d b = body.skin.positions[triangle[(k + 1) % 3]].cast<double>();
      if ((a.y() < height) == (b.y() < height)) {
        continue;
      }
      const Vec3d p = a + (height - a.y()) / (b.y() - a.y()) * (b - a);
      section.halfBreadth = std::max(section.halfBreadth, std::abs(p.x()));
      if (std::abs(p.x()) < midline) {
        section.back = std::min(section.back, p.z());
        section.front = std::max(section.front, p.z());
      }
    }
  }
  LORICA_CHECK(section.front > section.back, "the skin has a trunk and a head");
  return section;
}

AnatomyFrame::AnatomyFrame(const Body& body) {
  const geometry::Box3d box = geometry::bounds(body.skin.positions);
  scale_ = (box.max().y() - box.min().y()) / kCanonicalStature;
  const Vec3d pelvis = jointPlace(body.skeleton, "pelvis_root");
  // The sacrum goes on below the spine, where no joint follows it.
  std::vector<double> heights{pelvis.y()};
  std::vector<double> depths{pelvis.z() + kCanonicalStature * scale_ * kSpine.front().depth};
  std::vector<double> canonicalHeights{kCanonicalStature * kPelvisHeight};
  std::vector<double> canonicalDepths{kCanonicalStature * kSpine.front().depth};
  for (const SpineKnot& knot : kSpine) {
    const Vec3d place = jointPlace(body.skeleton, knot.joint);
    heights.push_back(place.y());
    depths.push_back(place.z());
    canonicalHeights.push_back(kCanonicalStature * knot.height);
    canonicalDepths.push_back(kCanonicalStature * knot.depth);
  }
  spine_ = Curve(heights, depths);
  canonicalSpine_ = Curve(canonicalHeights, canonicalDepths);
  heights.push_back(box.max().y());
  canonicalHeights.push_back(kCanonicalStature);
  height_ = Curve(heights, canonicalHeights);
  const Curve toBodyHeight(canonicalHeights, heights);

  std::vector<double> siteHeights;
  std::vector<double> breadths;
  std::vector<double> fronts;
  std::vector<double> backs;
  for (const Site& site : kSites) {
    const double height = toBodyHeight(kCanonicalStature * site.height);
    const SkinSection section = skinSection(body, height);
    const double spine = spine_(height);
    siteHeights.push_back(height);
    // Across the shoulders the skin says nothing of the cavity, which goes on as the chest does.
    const bool shoulders = site.height > 0.8 && site.height < 0.85;
    breadths.push_back(shoulders ? breadths.back() : cavityRatio(section.halfBreadth, site.halfBreadth, scale_));
    fronts.push_back(cavityRatio(section.front - spine, site.front, scale_));
    backs.push_back(cavityRatio(section.back - spine, site.back, scale_));
    if (site.height == 0.7450) {
      chestHalfBreadth_ = section.halfBreadth;
    }
  }
  // Level beyond the first and the last site.
  for (std::vector<double>* ratios : {&breadths, &fronts, &backs}) {
    ratios->insert(ratios->begin(), ratios->front());
    ratios->push_back(ratios->back());
  }
  siteHeights.insert(siteHeights.begin(), siteHeights.front() - 0.05 * scale_);
  siteHeights.push_back(siteHeights.back() + 0.05 * scale_);
  breadth_ = Curve(siteHeights, breadths);
  front_ = Curve(siteHeights, fronts);
  back_ = Curve(siteHeights, backs);
}

Level AnatomyFrame::level(double height) const {
  Level found;
  found.canonicalHeight = height_(height);
  found.spine = spine_(height);
  found.canonicalSpine = canonicalSpine_(found.canonicalHeight);
  found.breadth = breadth_(height);
  found.front = front_(height);
  found.back = back_(height);
  return found;
}

Vec3d AnatomyFrame::toCanonical(const Vec3d& place) const {
  return level(place.y()).toCanonical(place.x(), place.z());
}

Vec3d AnatomyFrame::toBody(const Vec3d& canonical) const {
  double low = -1.0;
  double high = 4.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (height_(middle) < canonical.y() ? low : high) = middle;
  }
  const double height = 0.5 * (low + high);
  const Level there = level(height);
  const double wanted = canonical.z() - there.canonicalSpine;
  double dz = wanted;
  for (int i = 0; i < 60; ++i) {
    dz = wanted * depthScale(dz, there.back, there.front);
  }
  return {canonical.x() * there.breadth, height, there.spine + dz};
}

}  // namespace lorica::manikin
