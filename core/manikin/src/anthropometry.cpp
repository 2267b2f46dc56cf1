#include "anthropometry.h"

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
}

double surveyValue(human::Sex sex, std::string_view dimension, double score) {
  return percentilesOf(sex, dimension).at(score);
}

double Anthropometry::size(std::string_view dimension, GrowsWith with) const {
  return percentilesOf(person_.sex, dimension).at(with == GrowsWith::stature ? statureScore_ : buildScore_);
}

}  // namespace lorica::manikin
