#include "motion_table.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "lorica/base/error.h"
#include "tables.h"

namespace lorica::manikin {

namespace {

struct Keys {
  std::vector<double> times;
  std::vector<double> values;
};

Keys keysOf(std::string_view motion, std::string_view joint, std::string_view axis) {
  const base::Table& table = motionTable();
  Keys keys;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (table.text(row, "motion") == motion && table.text(row, "joint") == joint && table.text(row, "axis") == axis) {
      const bool timed = !table.text(row, "time_fraction").empty();
      keys.times.push_back(timed ? table.number(row, "time_fraction") : 0.0);
      keys.values.push_back(table.number(row, "value"));
    }
  }
  LORICA_CHECK(!keys.times.empty(), "the table has the motion, joint and axis");
  return keys;
}

}  // namespace

Curve Curve::clamped(std::vector<double> times, std::vector<double> values) {
  LORICA_CHECK(!times.empty() && times.size() == values.size(), "a value for every key");
  const auto n = static_cast<Eigen::Index>(times.size());
  Eigen::MatrixXd a = Eigen::MatrixXd::Identity(n, n);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(n);
  const auto t = [&](Eigen::Index i) { return times[static_cast<std::size_t>(i)]; };
  const auto v = [&](Eigen::Index i) { return values[static_cast<std::size_t>(i)]; };
  // Slopes that make the second derivative continuous.
  for (Eigen::Index i = 1; i + 1 < n; ++i) {
    const double before = t(i) - t(i - 1);
    const double after = t(i + 1) - t(i);
    a(i, i - 1) = 1.0 / before;
    a(i, i) = 2.0 * (1.0 / before + 1.0 / after);
    a(i, i + 1) = 1.0 / after;
    b(i) = 3.0 * ((v(i) - v(i - 1)) / (before * before) + (v(i + 1) - v(i)) / (after * after));
  }
  const Eigen::VectorXd slopes = a.partialPivLu().solve(b);
  Curve curve;
  curve.times_ = std::move(times);
  curve.values_ = std::move(values);
  curve.slopes_.assign(slopes.begin(), slopes.end());
  return curve;
}

Curve Curve::periodic(std::vector<double> times, std::vector<double> values) {
  LORICA_CHECK(times.size() >= 3 && times.size() == values.size(), "a value for every key");
  const auto n = static_cast<Eigen::Index>(times.size());
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd b(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index left = (i + n - 1) % n;
    const Eigen::Index right = (i + 1) % n;
    const auto t = [&](Eigen::Index k) { return times[static_cast<std::size_t>(k)]; };
    const auto v = [&](Eigen::Index k) { return values[static_cast<std::size_t>(k)]; };
    const double before = t(i) - t(left) + (i == 0 ? 1.0 : 0.0);
    const double after = t(right) - t(i) + (i + 1 == n ? 1.0 : 0.0);
    a(i, left) += 1.0 / before;
    a(i, i) += 2.0 * (1.0 / before + 1.0 / after);
    a(i, right) += 1.0 / after;
    b(i) = 3.0 * ((v(i) - v(left)) / (before * before) + (v(right) - v(i)) / (after * after));
  }
  const Eigen::VectorXd slopes = a.partialPivLu().solve(b);
  Curve curve;
  curve.times_ = std::move(times);
  curve.values_ = std::move(values);
  curve.slopes_.assign(slopes.begin(), slopes.end());
  curve.times_.push_back(curve.times_.front() + 1.0);
  curve.values_.push_back(curve.values_.front());
  curve.slopes_.push_back(curve.slopes_.front());
  curve.periodic_ = true;
  return curve;
}

double Curve::at(double time) const {
  if (periodic_) {
    time -= std::floor(time - times_.front());
  }
  if (time <= times_.front()) {
    return values_.front();
  }
  if (time >= times_.back()) {
    return values_.back();
  }
  const auto k = static_cast<std::size_t>(std::upper_bound(times_.begin(), times_.end(), time) - times_.begin()) - 1;
  const double step = times_[k + 1] - times_[k];
  const double u = (time - times_[k]) / step;
  const double u2 = u * u;
  const double u3 = u2 * u;
  return (2 * u3 - 3 * u2 + 1) * values_[k] + step * (u3 - 2 * u2 + u) * slopes_[k] +
         (-2 * u3 + 3 * u2) * values_[k + 1] + step * (u3 - u2) * slopes_[k + 1];
}

double minimumJerk(double u) {
  const double t = std::clamp(u, 0.0, 1.0);
  return t * t * t * (10.0 + t * (-15.0 + 6.0 * t));
}

Curve tableCurve(std::string_view motion, std::string_view joint, std::string_view axis) {
  Keys keys = keysOf(motion, joint, axis);
  return Curve::clamped(std::move(keys.times), std::move(keys.values));
}

Curve tableCycle(std::string_view motion, std::string_view joint, std::string_view axis) {
  Keys keys = keysOf(motion, joint, axis);
  if (keys.times.back() == 1.0) {
    keys.values.front() = 0.5 * (keys.values.front() + keys.values.back());
    keys.times.pop_back();
    keys.values.pop_back();
  }
  return Curve::periodic(std::move(keys.times), std::move(keys.values));
}

double tableValue(std::string_view motion, std::string_view joint, std::string_view axis) {
  return keysOf(motion, joint, axis).values.front();
}

double tableSum(std::string_view motion, const std::vector<std::string_view>& joints, std::string_view axis,
                double timeFraction) {
  double sum = 0.0;
  for (const std::string_view joint : joints) {
    const Keys keys = keysOf(motion, joint, axis);
    for (std::size_t i = 0; i < keys.times.size(); ++i) {
      sum += keys.times[i] == timeFraction ? keys.values[i] : 0.0;
    }
  }
  return sum;
}

}  // namespace lorica::manikin
