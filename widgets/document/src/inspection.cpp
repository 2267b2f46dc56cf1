#include "lorica/document/inspection.h"

#include <algorithm>

#include "lorica/document/study_document.h"

namespace lorica::document {

namespace {

// Opacities under which what lies behind or within can still be read.
constexpr double skinOverDrivers = 0.10;
constexpr double organOfDrivers = 0.5;
constexpr double othersAround = 0.08;
constexpr double skinOverColours = 0.12;
constexpr double armorOverAll = 0.04;  // several layers of it lie over one another

bool isOrgan(const study::Study& study, const std::string& structure) {
  return std::any_of(study.organs.begin(), study.organs.end(),
                     [&](const study::Organ& organ) { return organ.name == structure; });
}

}  // namespace

Appearance drawnAppearance(const StudyDocument& document, const std::string& structure) {
  Appearance look = appearanceOf(document.study(), structure);
  const Inspection& inspection = document.inspection();
  const auto atMost = [&look](double opacity) { look.opacity = std::min(look.opacity, opacity); };
  const bool organ = isOrgan(document.study(), structure);
  if (inspection.showsDrivers()) {
    if (structure == inspection.organ) {
      look.visible = true;
      atMost(organOfDrivers);
    } else {
      atMost(structure == "body" ? skinOverDrivers : organ ? othersAround : armorOverAll);
    }
  } else if (inspection.colouring != Colouring::own && !organ) {
    atMost(structure == "body" ? skinOverColours : armorOverAll);
  }
  return look;
}

}  // namespace lorica::document
