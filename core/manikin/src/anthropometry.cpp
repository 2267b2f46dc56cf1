#include "anthropometry.h"

#include <algorithm>
#include <cmath>

#include "lorica/base/table.h"
#include "tables.h"

namespace lorica::manikin {

std::size_t surveyRow(human::Sex sex, std::string_view dimension) {
  // The table's rows of a dimension stand together, the man's first.
  return anthropometryTable().find("dimension", dimension) + (sex == human::Sex::male ? 0 : 1);
}

namespace {

struct Percentiles {
  double p5;
  double p50;
  double p95;

  double at(double score) const { return p50 + score * (score < 0.0 ? p50 - p5 : p95 - p50); }
  double scoreOf(double value) const { return (value - p50) / (value < p50 ? p50 - p5 : p95 - p50); }
  /// The value over the nearest one within the percentiles.
  double beyond(double value) const { return value / std::clamp(value, p5, p95); }
};

Percentiles percentilesOf(human::Sex sex, std::string_view dimension) {
  const base::Table& table = anthropometryTable();
  const std::size_t row = surveyRow(sex, dimension);
  const double unit = table.text(row, "unit") == "mm" ? 1e-3 : 1.0;
  return {unit * table.number(row, "p5"), unit * table.number(row, "p50"), unit * table.number(row, "p95")};
}

}  // namespace

Anthropometry::Anthropometry(const human::Person& person) : person_(person) {
  const Percentiles stature = percentilesOf(person.sex, "stature");
  const Percentiles mass = percentilesOf(person.sex, "weightkg");
  statureScore_ = stature.scoreOf(person.stature);
  const Percentiles build{mass.p5 / stature.p5, mass.p50 / stature.p50, mass.p95 / stature.p95};
  buildScore_ = build.scoreOf(person.mass / person.stature);
  beyondStature_ = stature.beyond(person.stature);
  beyondBuild_ = build.beyond(person.mass / person.stature);
}

double surveyValue(human::Sex sex, std::string_view dimension, double score) {
  return percentilesOf(sex, dimension).at(score);
}

double Anthropometry::size(std::string_view dimension, GrowsWith with) const {
  const Percentiles survey = percentilesOf(person_.sex, dimension);
  if (with != GrowsWith::build) {
    const double within = survey.at(std::clamp(statureScore_, -1.0, 1.0));
    return with == GrowsWith::head ? within : within * beyondStature_;
  }
  const double alike = survey.at(std::clamp(buildScore_, -1.0, 1.0)) * std::sqrt(beyondBuild_);
  return buildScore_ > 1.0 ? std::min(alike, survey.at(buildScore_)) : alike;
}

}  // namespace lorica::manikin
