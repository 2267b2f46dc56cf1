#include "column_names.h"

#include <algorithm>
#include <array>

namespace lorica::threat {

namespace {

/// The unit as written in a name, and as it is kept.
constexpr auto knownUnits = std::to_array<std::pair<std::string_view, std::string_view>>(
    {{"m_s", "m/s"},   {"km_s", "km/s"},     {"mm_us", "mm/us"}, {"kg_m3", "kg/m3"},  {"g_cm3", "g/cm3"},
     {"Pa_s", "Pa*s"}, {"kPa_ms", "kPa*ms"}, {"Pa", "Pa"},       {"hPa", "hPa"},      {"kPa", "kPa"},
     {"MPa", "MPa"},   {"GPa", "GPa"},       {"bar", "bar"},     {"mbar", "mbar"},    {"psi", "psi"},
     {"atm", "atm"},   {"m", "m"},           {"cm", "cm"},       {"mm", "mm"},        {"in", "in"},
     {"s", "s"},       {"ms", "ms"},         {"us", "us"},       {"\xC2\xB5s", "us"}, {"kg", "kg"},
     {"g", "g"},       {"mg", "mg"},         {"J", "J"},         {"kJ", "kJ"},        {"N", "N"},
     {"K", "K"},       {"C", "C"},           {"dB", "dB"},       {"pct", "%"},        {"percent", "%"}});

std::string_view trimmed(std::string_view text) {
  const char* blank = " \t\r\"'";
  const std::size_t begin = text.find_first_not_of(blank);
  return begin == std::string_view::npos ? std::string_view()
                                         : text.substr(begin, text.find_last_not_of(blank) - begin + 1);
}

std::string keptUnit(std::string_view unit) {
  const auto* known =
      std::find_if(knownUnits.begin(), knownUnits.end(), [&](const auto& entry) { return entry.first == unit; });
  return std::string(known == knownUnits.end() ? unit : known->second);
}

}  // namespace

std::string lowerCase(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](char letter) {
    return static_cast<char>(letter >= 'A' && letter <= 'Z' ? letter - 'A' + 'a' : letter);
  });
  return lower;
}

ColumnName columnName(std::string_view text) {
  text = trimmed(text);
  if (!text.empty() && (text.back() == ')' || text.back() == ']')) {
    const std::size_t open = text.rfind(text.back() == ')' ? '(' : '[');
    if (open != std::string_view::npos && open > 0) {
      return {std::string(trimmed(text.substr(0, open))),
              keptUnit(trimmed(text.substr(open + 1, text.size() - open - 2)))};
    }
  }
  for (const auto& [written, kept] : knownUnits) {
    if (text.size() > written.size() + 1 && text.ends_with(written) && text[text.size() - written.size() - 1] == '_') {
      return {std::string(text.substr(0, text.size() - written.size() - 1)), std::string(kept)};
    }
  }
  return {std::string(text), ""};
}

std::optional<base::LengthUnit> lengthUnit(const std::string& unit) {
  return base::lengthUnitNamed(unit);
}

std::optional<TimeUnit> timeUnit(const std::string& unit) {
  if (unit == "s") {
    return TimeUnit::second;
  }
  if (unit == "ms") {
    return TimeUnit::millisecond;
  }
  return unit == "us" ? std::optional(TimeUnit::microsecond) : std::nullopt;
}

bool isIdName(std::string_view name) {
  const std::string lower = lowerCase(name);
  return lower == "id" || lower == "fragment" || lower == "fragment_id" || lower == "track";
}

}  // namespace lorica::threat
