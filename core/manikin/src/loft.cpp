#include "loft.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lorica/base/error.h"

namespace lorica::manikin {

namespace {

constexpr double kSpacing = 0.004;
constexpr std::array kValues{&Section::halfBreadth, &Section::front,      &Section::back,
                             &Section::widest,      &Section::squareness, &Section::aside};

/// Slopes of a monotone cubic through the sections' values.
std::vector<double> slopes(std::span<const Section> sections, double Section::*value) {
  const std::size_t n = sections.size();
  std::vector<double> secant(n - 1);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    secant[i] = (sections[i + 1].*value - sections[i].*value) / (sections[i + 1].at - sections[i].at);
  }
  std::vector<double> slope(n);
  slope.front() = secant.front();
  slope.back() = secant.back();
  for (std::size_t i = 1; i + 1 < n; ++i) {
    if (secant[i - 1] * secant[i] <= 0.0) {
      slope[i] = 0.0;
      continue;
    }
    // Weighted harmonic mean: never steeper than three times the flatter side.
    const double before = sections[i].at - sections[i - 1].at;
    const double after = sections[i + 1].at - sections[i].at;
    const double w1 = 2.0 * after + before;
    const double w2 = after + 2.0 * before;
    slope[i] = (w1 + w2) / (w1 / secant[i - 1] + w2 / secant[i]);
  }
  return slope;
}

/// Each pass of (1, 2, 1) / 4 spreads by half a sample squared; the ends stay.
void soften(std::vector<Section>& samples, double Section::*value, int passes) {
  for (int pass = 0; pass < 2 * passes; ++pass) {
    double before = samples.front().*value;
    for (std::size_t i = 1; i + 1 < samples.size(); ++i) {
      const double here = samples[i].*value;
      samples[i].*value = 0.25 * (before + 2.0 * here + samples[i + 1].*value);
      before = here;
    }
  }
}

}  // namespace

Loft::Loft(const LoftFrame& frame, std::span<const Section> sections, double startDome, double endDome, double softness)
    : frame_(frame), startDome_(startDome), endDome_(endDome) {
  LORICA_CHECK(sections.size() >= 2 && startDome > 0.0 && endDome > 0.0, "two sections and two domes");
  begin_ = sections.front().at;
  end_ = sections.back().at;
  const auto count = static_cast<std::size_t>(std::ceil((end_ - begin_) / kSpacing)) + 1;
  perMetre_ = static_cast<double>(count - 1) / (end_ - begin_);
  samples_.resize(count);
  for (const auto value : kValues) {
    const std::vector<double> slope = slopes(sections, value);
    std::size_t i = 0;
    for (std::size_t s = 0; s < count; ++s) {
      const double at = begin_ + static_cast<double>(s) / perMetre_;
      while (i + 2 < sections.size() && at > sections[i + 1].at) {
        ++i;
      }
      const double span = sections[i + 1].at - sections[i].at;
      const double t = std::clamp((at - sections[i].at) / span, 0.0, 1.0);
      const double t2 = t * t;
      const double t3 = t2 * t;
      samples_[s].at = at;
      samples_[s].*value = (2.0 * t3 - 3.0 * t2 + 1.0) * sections[i].*value + (t3 - 2.0 * t2 + t) * span * slope[i] +
                           (3.0 * t2 - 2.0 * t3) * sections[i + 1].*value + (t3 - t2) * span * slope[i + 1];
    }
    soften(samples_, value, static_cast<int>(std::lround(softness * softness * perMetre_ * perMetre_)));
  }
}

Section Loft::sectionAt(double at) const {
  const double place = (std::clamp(at, begin_, end_) - begin_) * perMetre_;
  const auto i = std::min(static_cast<std::size_t>(place), samples_.size() - 2);
  const double t = place - static_cast<double>(i);
  Section section;
  section.at = at;
  for (const auto value : kValues) {
    section.*value = (1.0 - t) * samples_[i].*value + t * samples_[i + 1].*value;
  }
  return section;
}

double Loft::field(const Vec3d& p) const {
  const Vec3d local = p - frame_.origin;
  const double along = frame_.axis.dot(local);
  const Section s = sectionAt(along);
  const double middle = s.back + s.widest * (s.front - s.back);
  const double across = std::abs(frame_.side.dot(local) - s.aside);
  const double ahead = frame_.front.dot(local) - middle;
  const double depth = ahead > 0.0 ? s.front - middle : middle - s.back;
  const double u = across / s.halfBreadth;
  const double v = std::abs(ahead) / depth;
  const double beyond =
      along < begin_ ? (begin_ - along) / startDome_ : (along > end_ ? (along - end_) / endDome_ : 0.0);
  const double dome = along < begin_ ? startDome_ : endDome_;
  const double n = s.squareness;
  const double radius = std::pow(std::pow(u, n) + std::pow(v, n), 1.0 / n);
  const double whole = std::hypot(radius, beyond);
  if (whole < 1e-6) {
    return -std::min(s.halfBreadth, depth);
  }
  double steepness = beyond / (whole * dome);
  if (radius > 1e-9) {
    const double du = std::pow(u / radius, n - 1.0) / s.halfBreadth;
    const double dv = std::pow(v / radius, n - 1.0) / depth;
    steepness = std::hypot(steepness, radius / whole * std::hypot(du, dv));
  }
  return (whole - 1.0) / std::max(steepness, 0.5 / std::max(s.halfBreadth, depth));
}

}  // namespace lorica::manikin
