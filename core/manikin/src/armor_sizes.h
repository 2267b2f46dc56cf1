#pragma once

/// \file
/// What armor is made of and how large it comes, from resources/tables/armor.csv.

#include <string>

#include "lorica/armor/plates.h"
#include "lorica/human/person.h"

namespace lorica::manikin {

inline constexpr const char* kPlateMaterial = "ceramic plate on a fibre backing";
inline constexpr const char* kPouchMaterial = "nylon, empty pouch";
inline constexpr const char* kHelmetMaterial = "aramid shell";

struct SheetSpec {
  double thickness = 0.0;     ///< m
  double arealDensity = 0.0;  ///< kg/m2
  std::string material;
  std::string source;
};

struct HelmetSpec {
  std::string size;
  double thickness = 0.0;  ///< m
  double mass = 0.0;       ///< kg
  double pads = 0.0;       ///< m, of the pads under the shell
  std::string material;
  std::string source;
};

SheetSpec softArmor();
SheetSpec carrierFabric();

/// Heights over joints, as shares of stature.
double notchOverSternoclavicular();
double cervicaleOverC7T1();

/// The SAPI plate that reaches from just below the notch to nearest 2 in above the navel.
/// \param stature m, of the body itself
armor::PlateSpec plateFor(human::Sex sex, double stature);

/// 6 x 8 in beside plates up to M, 7 x 8 in beside larger ones.
armor::PlateSpec sidePlateBeside(const armor::PlateSpec& plate);

/// \param headCircumference m
HelmetSpec helmetFor(double headCircumference);

}  // namespace lorica::manikin
