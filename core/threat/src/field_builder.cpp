#include "field_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <numeric>
#include <utility>

#include "lorica/base/error.h"

namespace lorica::threat {

using geometry::Positions;
using geometry::Vec3f;

namespace {

/// Which row stands where in the steps: rows in the order of their times, and where each step begins.
struct Order {
  std::vector<std::uint32_t> rows;  ///< empty: as they are
  std::vector<std::size_t> begin;   ///< of each step, and the end
};

Order orderOf(const PointRows& table) {
  const std::size_t count = table.places.size();
  Order order;
  if (table.times.empty()) {
    order.begin = {0, count};
    return order;
  }
  if (!std::is_sorted(table.times.begin(), table.times.end())) {
    order.rows.resize(count);
    std::iota(order.rows.begin(), order.rows.end(), 0U);
    std::stable_sort(order.rows.begin(), order.rows.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return table.times[a] < table.times[b]; });
  }
  const auto timeAt = [&](std::size_t i) { return table.times[order.rows.empty() ? i : order.rows[i]]; };
  for (std::size_t i = 0; i < count; ++i) {
    if (i == 0 || timeAt(i) != timeAt(i - 1)) {
      order.begin.push_back(i);
    }
  }
  order.begin.push_back(count);
  return order;
}

/// Positions as a key that sorts, with one zero.
std::array<float, 3> keyOf(const Vec3f& place) {
  return {place.x() + 0.0F, place.y() + 0.0F, place.z() + 0.0F};
}

std::size_t pointsAtOnePlace(const Positions& points) {
  std::vector<std::array<float, 3>> keys(points.size());
  std::transform(points.begin(), points.end(), keys.begin(), keyOf);
  std::sort(keys.begin(), keys.end());
  return static_cast<std::size_t>(keys.end() - std::unique(keys.begin(), keys.end()));
}

void checkIds(const Step& step, bool timed, const std::string& file) {
  std::vector<std::int64_t> ids = step.ids;
  std::sort(ids.begin(), ids.end());
  const auto twice = std::adjacent_find(ids.begin(), ids.end());
  if (timed && twice != ids.end()) {
    throw base::InputError(
        file, fmt::format("time {:g} s", step.time),
        fmt::format("the id {} is there twice; a fragment is at one place at one time, remove one", *twice));
  }
}

/// The planes of a lattice that the points fill, if they do.
std::optional<Lattice> latticeOf(const Positions& points) {
  Lattice lattice;
  std::size_t left = points.size();
  std::vector<float> coordinates(points.size());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t p = 0; p < points.size(); ++p) {
      coordinates[p] = keyOf(points[p]).at(axis);
    }
    std::sort(coordinates.begin(), coordinates.end());
    const auto end = std::unique(coordinates.begin(), coordinates.end());
    const auto planes = static_cast<std::size_t>(end - coordinates.begin());
    if (planes < 2 || left % planes != 0) {
      return std::nullopt;
    }
    left /= planes;
    lattice.axes.at(axis).assign(coordinates.begin(), end);
    coordinates.resize(points.size());
  }
  return left == 1 ? std::optional(std::move(lattice)) : std::nullopt;
}

/// Index in the lattice of each point; nothing when two share one.
std::optional<std::vector<std::uint32_t>> placesIn(const Lattice& lattice, const Positions& points) {
  std::vector<std::uint32_t> places(points.size());
  std::vector<bool> taken(points.size(), false);
  for (std::size_t p = 0; p < points.size(); ++p) {
    std::array<std::size_t, 3> at{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::vector<double>& planes = lattice.axes.at(axis);
      at.at(axis) = static_cast<std::size_t>(
          std::lower_bound(planes.begin(), planes.end(), static_cast<double>(keyOf(points[p]).at(axis))) -
          planes.begin());
    }
    const std::size_t index = (at[2] * lattice.axes[1].size() + at[1]) * lattice.axes[0].size() + at[0];
    if (taken[index]) {
      return std::nullopt;
    }
    taken[index] = true;
    places[p] = static_cast<std::uint32_t>(index);
  }
  return places;
}

/// Turns points that fill a lattice into one.
void takeAsLattice(ThreatField& field) {
  const Positions* points = field.steps.front().points.get();
  const bool same = std::all_of(field.steps.begin(), field.steps.end(),
                                [&](const Step& step) { return step.points.get() == points && step.ids.empty(); });
  if (!same || points->size() < 8) {
    return;
  }
  std::optional<Lattice> lattice = latticeOf(*points);
  if (!lattice) {
    return;
  }
  const std::optional<std::vector<std::uint32_t>> places = placesIn(*lattice, *points);
  if (!places) {
    return;
  }
  for (Step& step : field.steps) {
    for (std::size_t a = 0; a < field.attributes.size(); ++a) {
      const std::size_t width = field.attributes[a].components;
      std::vector<float> sorted(step.values[a].size());
      for (std::size_t p = 0; p < places->size(); ++p) {
        std::copy_n(step.values[a].begin() + static_cast<std::ptrdiff_t>(p * width), width,
                    sorted.begin() + static_cast<std::ptrdiff_t>((*places)[p] * width));
      }
      step.values[a] = std::move(sorted);
    }
  }
  for (Step& step : field.steps) {
    step.points.reset();
  }
  field.lattice = std::move(lattice);
}

}  // namespace

void checkScattered(ThreatField& field, const std::string& file, base::Issues& issues) {
  std::size_t doubled = 0;
  const Step* before = nullptr;
  std::size_t here = 0;
  for (Step& step : field.steps) {
    const Positions& points = *step.points;
    if (before != nullptr && before->points->size() == points.size() &&
        std::equal(points.begin(), points.end(), before->points->begin())) {
      step.points = before->points;
    } else {
      here = pointsAtOnePlace(points);
    }
    doubled += here;
    checkIds(step, field.timed, file);
    before = &step;
  }
  if (doubled > 0) {
    issues.push_back({base::Severity::warning, file, "",
                      fmt::format("{} point(s) lie at the place of another at the same time; the mean of those at one "
                                  "place counts there",
                                  doubled)});
  }
}

ThreatField fieldOf(PointRows rows, const std::string& file, base::Issues& issues, const base::Progress& progress) {
  LORICA_CHECK(!rows.places.empty() && rows.places.size() <= std::numeric_limits<std::uint32_t>::max(),
               "rows that an index can count");
  const Order order = orderOf(rows);
  ThreatField field;
  field.attributes = std::move(rows.attributes);
  field.timed = !rows.times.empty();
  const bool whole = order.rows.empty() && order.begin.size() == 2;
  const auto rowAt = [&](std::size_t i) { return order.rows.empty() ? i : order.rows[i]; };
  for (std::size_t s = 0; s + 1 < order.begin.size(); ++s) {
    progress.check();
    const std::size_t begin = order.begin[s];
    const std::size_t end = order.begin[s + 1];
    Step step;
    step.time = field.timed ? rows.times[rowAt(begin)] : 0.0;
    if (whole) {
      step.points = std::make_shared<const Positions>(std::move(rows.places));
      step.ids = std::move(rows.ids);
      step.values = std::move(rows.values);
      field.steps.push_back(std::move(step));
      break;
    }
    Positions points(end - begin);
    step.ids.resize(rows.ids.empty() ? 0 : end - begin);
    for (std::size_t i = begin; i < end; ++i) {
      points[i - begin] = rows.places[rowAt(i)];
      if (!rows.ids.empty()) {
        step.ids[i - begin] = rows.ids[rowAt(i)];
      }
    }
    for (std::size_t a = 0; a < field.attributes.size(); ++a) {
      const std::size_t width = field.attributes[a].components;
      std::vector<float>& values = step.values.emplace_back((end - begin) * width);
      for (std::size_t i = begin; i < end; ++i) {
        std::copy_n(rows.values[a].begin() + static_cast<std::ptrdiff_t>(rowAt(i) * width), width,
                    values.begin() + static_cast<std::ptrdiff_t>((i - begin) * width));
      }
    }
    step.points = std::make_shared<const Positions>(std::move(points));
    field.steps.push_back(std::move(step));
    progress.report(static_cast<double>(end) / static_cast<double>(order.begin.back()));
  }
  checkScattered(field, file, issues);
  takeAsLattice(field);
  return field;
}

}  // namespace lorica::threat
