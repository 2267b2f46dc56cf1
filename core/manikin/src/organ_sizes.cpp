#include <algorithm>
#include <cmath>
#include <string_view>

#include "lorica/base/table.h"
#include "lorica/manikin/organs.h"
#include "tables.h"

namespace lorica::manikin {

namespace {

using human::Person;
using human::Sex;

/// The adults of ICRP 89.
Person reference(Sex sex) {
  return sex == Sex::male ? Person{Sex::male, 1.76, 73.0} : Person{Sex::female, 1.63, 60.0};
}

/// Whom an organ grows with.
enum class Rule { constant, leanMass, lung, heart, length };

Rule ruleOf(std::string_view name) {
  if (name == "brain" || name == "eyes" || name == "bladder") {
    return Rule::constant;
  }
  if (name == "spinal_cord") {
    return Rule::length;
  }
  if (name == "heart") {
    return Rule::heart;
  }
  return name.starts_with("lung_") ? Rule::lung : Rule::leanMass;
}

double growth(Rule rule, const Person& person, const OrganOptions& options, double innerChestBreadth) {
  const Person adult = reference(person.sex);
  const double stature = person.stature / adult.stature;
  if (rule == Rule::constant) {
    return 1.0;
  }
  if (options.scaling == OrganScaling::thesis && rule != Rule::length) {
    const double ratio = rule == Rule::heart ? heartTransverseDiameter(person) / heartTransverseDiameter(adult)
                                             : lungWidth(person, options.lungFormula, innerChestBreadth) /
                                                   lungWidth(adult, options.lungFormula,
                                                             innerChestBreadth * adult.stature / person.stature);
    return std::pow(ratio, 3.0);
  }
  if (rule == Rule::length) {
    return options.scaling == OrganScaling::thesis ? 1.0 : stature;
  }
  if (rule == Rule::lung) {
    return std::pow(stature, person.sex == Sex::male ? 2.7634 : 2.6049);
  }
  return leanBodyMass(person) / leanBodyMass(adult);
}

}  // namespace

double heartTransverseDiameter(const Person& person) {
  constexpr double kilogramsPerPound = 0.45359237;
  constexpr double metresPerInch = 0.0254;
  const double ratio = person.mass / kilogramsPerPound / (person.stature / metresPerInch);
  return 0.01 * 8.6566 * std::pow(ratio, 0.4895) - (person.sex == Sex::female ? 0.008 : 0.0);
}

double lungWidth(const Person& person, LungFormulaUnit unit, double innerChestBreadth) {
  const double metres = unit == LungFormulaUnit::inches ? 0.0254 : 0.01;
  const double width = metres * 1.9381 * std::pow(heartTransverseDiameter(person) / metres, 1.083);
  return std::min(width, innerChestBreadth);
}

double leanBodyMass(const Person& person) {
  const double centimetres = 100.0 * person.stature;
  return person.sex == Sex::male ? 0.407 * person.mass + 0.267 * centimetres - 19.2
                                 : 0.252 * person.mass + 0.473 * centimetres - 48.3;
}

std::vector<OrganTarget> organTargets(const Person& person, const OrganOptions& options, double innerChestBreadth) {
  const base::Table& table = organTable();
  const std::string_view sex = person.sex == Sex::male ? "male" : "female";
  std::vector<OrganTarget> targets;
  for (const std::string& name : organNames()) {
    OrganTarget target;
    target.name = name;
    double mass = 0.0;
    for (std::size_t row = 0; row < table.rows(); ++row) {
      if (table.text(row, "structure") != name || table.text(row, "sex") != sex) {
        continue;
      }
      const double grams = table.number(row, "count") * table.number(row, "mass_g");
      mass += 1e-3 * grams;
      target.volume += 1e-6 * grams / table.number(row, "density_g_cm3");
      const std::string source = table.text(row, "mass_source") + ", " + table.text(row, "mass_verification");
      if (target.source.find(source) == std::string::npos) {
        target.source += (target.source.empty() ? "" : "; ") + source;
      }
    }
    if (target.volume > 0.0) {
      target.density = mass / target.volume;
      target.volume *= growth(ruleOf(name), person, options, innerChestBreadth);
    } else {
      target.source = "no volume with its contents is published";
    }
    targets.push_back(std::move(target));
  }
  return targets;
}

const std::vector<std::string>& organNames() {
  static const std::vector<std::string> names{
      "heart",           "lung_left",    "lung_right", "liver",    "stomach",
      "kidney_left",     "kidney_right", "spleen",     "pancreas", "small_intestine",
      "large_intestine", "trachea",      "bladder",    "brain",    "spinal_cord",
      "thyroid",         "eyes",         "arteries",   "veins"};
  return names;
}

}  // namespace lorica::manikin
