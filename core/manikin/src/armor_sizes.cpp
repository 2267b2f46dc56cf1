#include "armor_sizes.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "lorica/base/error.h"
#include "lorica/base/table.h"

namespace lorica::manikin {

/// Written at build time from resources/tables/armor.csv.
std::span<const std::pair<std::string_view, std::string_view>> embeddedArmorTable();

namespace {

const base::Table& table() {
  static const base::Table table(embeddedArmorTable().front().second, "armor.csv");
  return table;
}

/// A number and where it comes from.
struct Entry {
  double value = 0.0;
  std::string origin;
};

std::size_t rowOf(std::string_view item, std::string_view size, std::string_view quantity) {
  for (std::size_t r = 0; r < table().rows(); ++r) {
    if (table().text(r, "item") == item && table().text(r, "size_or_group") == size &&
        table().text(r, "quantity") == quantity) {
      return r;
    }
  }
  throw base::InputError("armor.csv", std::string(item), fmt::format("expected a row {}, {}", size, quantity));
}

Entry entry(std::string_view item, std::string_view size, std::string_view quantity) {
  const std::size_t r = rowOf(item, size, quantity);
  return {table().number(r, "value"),
          fmt::format("{}: {} ({})", quantity, table().text(r, "source"), table().text(r, "verification"))};
}

constexpr double kMillimetre = 0.001;
constexpr std::array kPlateSizes{"XS", "S", "M", "L", "XL"};
constexpr const char* kAnyPlate = "SAPI/ESAPI front or rear plate";

armor::PlateSpec sapi(const std::string& size) {
  const Entry width = entry(kAnyPlate, size, "width");
  const Entry height = entry(kAnyPlate, size, "height");
  const Entry thickness = entry("SAPI plate", "all", "thickness");
  const Entry top = entry("SAPI/ESAPI plate", "all", "top edge of width");
  const Entry cut = entry("SAPI/ESAPI plate", "all", "corner cut height");
  const Entry radius = entry("SAPI/ESAPI plate", "all", "curvature radius horizontal");
  const Entry profile = entry("SAPI/ESAPI plate", "all", "curvature radius vertical");
  const Entry mass = entry("SAPI plate", size, "mass");
  armor::PlateSpec spec;
  spec.width = kMillimetre * width.value;
  spec.height = kMillimetre * height.value;
  spec.thickness = kMillimetre * thickness.value;
  spec.topWidth = 0.01 * top.value * spec.width;
  spec.cornerHeight = kMillimetre * cut.value;
  spec.curvatureRadius = kMillimetre * radius.value;
  spec.verticalCurvature = 1.0 / (kMillimetre * profile.value);
  spec.mass = mass.value;
  spec.source = fmt::format("SAPI plate, size {}; {}; {}; {}; {}; {}; {}; {}", size, width.origin, height.origin,
                            thickness.origin, cut.origin, radius.origin, profile.origin, mass.origin);
  return spec;
}

SheetSpec sheet(std::string_view item, std::string material) {
  const Entry thickness = entry(item, "-", "thickness");
  const Entry density = entry(item, "-", "areal density");
  return {kMillimetre * thickness.value, density.value, std::move(material),
          fmt::format("{}; {}", thickness.origin, density.origin)};
}

}  // namespace

SheetSpec softArmor() {
  return sheet("soft armour panel", "soft armor, aramid or UHMWPE (NIJ IIIA)");
}

double notchOverSternoclavicular() {
  return entry("landmark", "all", "notch above sternoclavicular joint / stature").value;
}

double cervicaleOverC7T1() {
  return entry("landmark", "all", "cervicale above C7/T1 disc / stature").value;
}

SheetSpec carrierFabric() {
  return sheet("carrier fabric", "padded nylon");
}

armor::PlateSpec plateFor(human::Sex sex, double stature) {
  // The navel lies as far below the notch as in the median soldier of this sex, scaled with stature.
  const bool male = sex == human::Sex::male;
  const double medianStature = male ? 1.755 : 1.628;
  const double toNavel = kMillimetre * entry("notch to umbilicus", male ? "male p50" : "female p50", "height").value *
                         stature / medianStature;
  const double room = toNavel - kMillimetre * (entry("front plate", "all", "bottom above navel").value +
                                               entry("front plate", "all", "top below notch").value);
  std::string best;
  double least = 1.0;
  for (const char* size : kPlateSizes) {
    const double misfit = std::abs(kMillimetre * entry(kAnyPlate, size, "height").value - room);
    if (misfit < least) {
      least = misfit;
      best = size;
    }
  }
  return sapi(best);
}

armor::PlateSpec sidePlateBeside(const armor::PlateSpec& plate) {
  const bool large = plate.height > 0.32;
  const char* size = large ? "7x8" : "6x8";
  const Entry width = entry("ESBI side plate", size, "width");
  const Entry height = entry("ESBI side plate", size, "height");
  const Entry mass = entry("ESBI side plate", size, "mass");
  const Entry thickness = entry("ESBI side plate", "all", "thickness");
  const Entry radius = entry("ESBI side plate", "all", "curvature radius horizontal");
  armor::PlateSpec spec;
  spec.width = kMillimetre * width.value;
  spec.height = kMillimetre * height.value;
  spec.thickness = kMillimetre * thickness.value;
  spec.topWidth = spec.width - 0.03;
  spec.cornerHeight = 0.015;
  spec.curvatureRadius = kMillimetre * radius.value;
  spec.mass = mass.value;
  spec.source = fmt::format("ESBI side plate, {} in; {}; {}; {}; {}; {}; corners cut 15 mm (assumed)", size,
                            width.origin, height.origin, thickness.origin, radius.origin, mass.origin);
  return spec;
}

HelmetSpec helmetFor(double headCircumference) {
  // The first size whose range, "55-57" cm, does not end below the head; the largest for larger heads.
  std::string size = "XL";
  for (const char* smaller : {"S", "M", "L"}) {
    const std::string& range = table().text(rowOf("ACH", smaller, "head circumference range"), "value");
    if (100.0 * headCircumference < std::stod(range.substr(range.find('-') + 1))) {
      size = smaller;
      break;
    }
  }
  const Entry thickness = entry("ACH", "all", "shell thickness");
  const Entry mass = entry("ACH", size, "mass");
  const Entry pads = entry("ACH", "all", "pad thickness");
  HelmetSpec spec;
  spec.size = size;
  spec.thickness = kMillimetre * thickness.value;
  spec.mass = mass.value;
  spec.pads = kMillimetre * pads.value;
  spec.material = kHelmetMaterial;
  spec.source = fmt::format(
      "ACH helmet, size {}; head circumference range: sizing practice (from memory, unverified); {}; {}; {}; areal "
      "density: mass over the generated shell's area",
      size, thickness.origin, mass.origin, pads.origin);
  return spec;
}

}  // namespace lorica::manikin
