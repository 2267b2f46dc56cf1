#include "lorica/document/inspection.h"

#include <algorithm>

#include "lorica/document/study_document.h"

namespace lorica::document {

namespace {

// Opacities under which what lies behind or within can still be read.
constexpr double skinOverDrivers = 0.10;
constexpr double organOfDrivers = 0.5;
constexpr double othersAround = 0.08;
constexpr double overColours = 0.15;

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
      atMost(structure == "body" ? skinOverDrivers : othersAround);
    }
  } else if (inspection.colouring != Colouring::own && !organ) {
    atMost(overColours);
  }
  return look;
}

}  // namespace lorica::document
