#include "lorica/threat/field_sampler.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lorica/base/error.h"
#include "point_tree.h"

namespace lorica::threat {

using geometry::Vec3d;
using geometry::Vec3f;

namespace {

/// Places nearer to each other than this are one, metres.
constexpr double onePlace = 1e-9;

/// The planes around a value and the share of the upper one.
struct Between {
  std::size_t lower = 0;
  std::size_t upper = 0;
  double share = 0.0;
};

std::optional<Between> between(const std::vector<double>& planes, double value) {
  const double slack = planes.size() > 1 ? 1e-6 * (planes.back() - planes.front()) : 1e-6;
  if (!(value >= planes.front() - slack && value <= planes.back() + slack)) {
    return std::nullopt;
  }
  value = std::clamp(value, planes.front(), planes.back());
  const auto above = std::upper_bound(planes.begin(), planes.end(), value);
  const auto upper = static_cast<std::size_t>(above - planes.begin());
  if (upper == planes.size()) {
    return Between{upper - 1, upper - 1, 0.0};
  }
  const std::size_t lower = upper - 1;
  return Between{lower, upper, (value - planes[lower]) / (planes[upper] - planes[lower])};
}

double spacingOf(const PointTree& tree) {
  constexpr std::size_t most = 1000;
  const std::size_t count = tree.points()->size();
  const std::size_t stride = std::max<std::size_t>(1, count / most);
  std::vector<Neighbour> found;
  double sum = 0.0;
  std::size_t asked = 0;
  for (std::size_t p = 0; p < count && asked < most; p += stride) {
    tree.nearest((*tree.points())[p].cast<double>(), 8, found);
    const auto other =
        std::find_if(found.begin(), found.end(), [](const Neighbour& near) { return near.distance > onePlace; });
    if (other != found.end()) {
      sum += other->distance;
      ++asked;
    }
  }
  return asked > 0 ? sum / static_cast<double>(asked) : 0.0;
}

Stencil meanOf(std::span<const Neighbour> points) {
  Stencil stencil;
  stencil.count = static_cast<std::uint32_t>(std::min(points.size(), stencil.point.size()));
  for (std::size_t i = 0; i < stencil.count; ++i) {
    stencil.point.at(i) = points[i].point;
    stencil.weight.at(i) = 1.0 / stencil.count;
  }
  return stencil;
}

}  // namespace

double typicalSpacing(const ThreatField& field) {
  if (!field.lattice) {
    return spacingOf(PointTree(field.steps.front().points));
  }
  double spacing = std::numeric_limits<double>::infinity();
  for (const std::vector<double>& planes : field.lattice->axes) {
    for (std::size_t i = 1; i < planes.size(); ++i) {
      spacing = std::min(spacing, planes[i] - planes[i - 1]);
    }
  }
  return std::isfinite(spacing) ? spacing : 0.0;
}

FieldSampler::FieldSampler(std::shared_ptr<const ThreatField> field, const SamplerOptions& options)
    : field_(std::move(field)), neighbours_(options.neighbours) {
  LORICA_CHECK(field_ != nullptr && !field_->steps.empty(), "a field with a step");
  LORICA_CHECK(neighbours_ >= 1 && neighbours_ < Stencil().point.size(), "1 to 15 neighbours");
  toField_ = field_->placement.inverse();
  if (field_->lattice) {
    return;
  }
  for (std::size_t s = 0; s < field_->steps.size(); ++s) {
    trees_.push_back(s > 0 && samePoints(s - 1, s) ? trees_.back()
                                                   : std::make_shared<const PointTree>(field_->steps[s].points));
  }
  radius_ = options.radius ? *options.radius : 3.0 * spacingOf(*trees_.front());
}

bool FieldSampler::samePoints(std::size_t a, std::size_t b) const {
  return field_->steps[a].points == field_->steps[b].points;
}

std::optional<FieldSampler::Moment> FieldSampler::momentAt(double time) const {
  const std::vector<Step>& steps = field_->steps;
  if (!field_->timed) {
    return Moment{};
  }
  if (!(time >= steps.front().time && time <= steps.back().time)) {
    return std::nullopt;
  }
  const auto after = std::upper_bound(steps.begin(), steps.end(), time,
                                      [](double wanted, const Step& step) { return wanted < step.time; });
  const auto next = static_cast<std::size_t>(after - steps.begin());
  if (next == steps.size() || steps[next - 1].time == time) {
    return Moment{next - 1, next - 1, 0.0};
  }
  return Moment{next - 1, next, (time - steps[next - 1].time) / (steps[next].time - steps[next - 1].time)};
}

Stencil FieldSampler::latticeStencil(const Vec3d& place) const {
  const Lattice& lattice = *field_->lattice;
  std::array<Between, 3> cell;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::optional<Between> here = between(lattice.axes.at(axis), place[static_cast<Eigen::Index>(axis)]);
    if (!here) {
      return {};
    }
    cell.at(axis) = *here;
  }
  Stencil stencil;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    std::array<std::size_t, 3> at{};
    double weight = 1.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const bool up = (corner >> axis & 1U) != 0;
      at.at(axis) = up ? cell.at(axis).upper : cell.at(axis).lower;
      weight *= up ? cell.at(axis).share : 1.0 - cell.at(axis).share;
    }
    // A corner without weight may be one without a value.
    if (weight > 0.0) {
      stencil.point.at(stencil.count) =
          static_cast<std::uint32_t>((at[2] * lattice.axes[1].size() + at[1]) * lattice.axes[0].size() + at[0]);
      stencil.weight.at(stencil.count) = weight;
      ++stencil.count;
    }
  }
  return stencil;
}

Stencil FieldSampler::pointStencil(const Vec3d& place, const PointTree& tree) const {
  static thread_local std::vector<Neighbour> found;
  tree.nearest(place, neighbours_ + 1, found);
  if (found.front().distance <= onePlace) {
    tree.within(place, onePlace, found);
    return meanOf(found);
  }
  const bool more = found.size() > neighbours_;
  const double reach = more ? std::min(radius_, found.back().distance) : radius_;
  Stencil stencil;
  double sum = 0.0;
  for (const Neighbour& near : found) {
    if (near.distance < reach && stencil.count < neighbours_) {
      const double root = 1.0 / near.distance - 1.0 / reach;
      stencil.point.at(stencil.count) = near.point;
      stencil.weight.at(stencil.count) = root * root;
      sum += root * root;
      ++stencil.count;
    }
  }
  if (sum > 0.0) {
    for (std::uint32_t i = 0; i < stencil.count; ++i) {
      stencil.weight.at(i) /= sum;
    }
    return stencil;
  }
  // All that are near are equally far.
  tree.within(place, std::min(radius_, found.front().distance * (1.0 + 1e-9)), found);
  return meanOf(found);
}

Stencil FieldSampler::stencil(const Vec3d& place, std::size_t step) const {
  const Vec3d own = toField_.isIdentity() ? place : toField_ * place;
  return field_->lattice ? latticeStencil(own) : pointStencil(own, *trees_[step]);
}

std::optional<Vec3d> FieldSampler::blend(const Stencil& stencil, std::size_t step, std::size_t attribute) const {
  const std::vector<float>& values = field_->steps[step].values[attribute];
  const std::size_t width = field_->attributes[attribute].components;
  Vec3d sum = Vec3d::Zero();
  for (std::uint32_t i = 0; i < stencil.count; ++i) {
    for (std::size_t k = 0; k < width; ++k) {
      sum[static_cast<Eigen::Index>(k)] +=
          stencil.weight.at(i) * static_cast<double>(values[stencil.point.at(i) * width + k]);
    }
  }
  if (stencil.count == 0 || !sum.allFinite()) {
    return std::nullopt;
  }
  return sum;
}

std::optional<Vec3d> FieldSampler::blendAt(const Vec3d& place, double time, std::size_t attribute) const {
  LORICA_CHECK(attribute < field_->attributes.size(), "an attribute of the field");
  const std::optional<Moment> moment = momentAt(time);
  if (!moment) {
    return std::nullopt;
  }
  const Stencil first = stencil(place, moment->before);
  const std::optional<Vec3d> before = blend(first, moment->before, attribute);
  if (moment->before == moment->after || !before) {
    return before;
  }
  const std::optional<Vec3d> after = samePoints(moment->before, moment->after)
                                         ? blend(first, moment->after, attribute)
                                         : blend(stencil(place, moment->after), moment->after, attribute);
  return after ? std::optional<Vec3d>((1.0 - moment->share) * *before + moment->share * *after) : std::nullopt;
}

std::optional<double> FieldSampler::value(const Vec3d& place, double time, std::size_t attribute) const {
  const std::optional<Vec3d> blended = blendAt(place, time, attribute);
  if (!blended) {
    return std::nullopt;
  }
  return field_->attributes[attribute].components == 1 ? blended->x() : blended->norm();
}

std::optional<Vec3d> FieldSampler::vector(const Vec3d& place, double time, std::size_t attribute) const {
  LORICA_CHECK(field_->attributes.at(attribute).components == 3, "a vector");
  const std::optional<Vec3d> blended = blendAt(place, time, attribute);
  return blended ? std::optional<Vec3d>(field_->placement.rotation * *blended) : std::nullopt;
}

std::optional<double> FieldSampler::value(const Stencil& stencil, std::size_t step, std::size_t attribute) const {
  const std::optional<Vec3d> blended = blend(stencil, step, attribute);
  if (!blended) {
    return std::nullopt;
  }
  return field_->attributes[attribute].components == 1 ? blended->x() : blended->norm();
}

std::vector<float> FieldSampler::values(std::span<const Vec3f> places, double time, std::size_t attribute,
                                        base::Threads threads) const {
  std::vector<float> result(places.size(), std::numeric_limits<float>::quiet_NaN());
  base::parallelFor(places.size(), 256, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      if (const std::optional<double> here = value(places[p].cast<double>(), time, attribute)) {
        result[p] = static_cast<float>(*here);
      }
    }
  });
  return result;
}

}  // namespace lorica::threat
