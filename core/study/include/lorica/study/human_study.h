#pragma once

/// \file
/// A new study of the built-in human: everything an analyst starts from, in one value.

#include <string>
#include <vector>

#include "lorica/human/person.h"
#include "lorica/study/study.h"

namespace lorica::study {

enum class OrganChoice {
  all,    ///< every organ and vessel of the built-in human
  torso,  ///< those that lie in the trunk: without brain, eyes, thyroid, and the vessels, which leave it
  none
};

struct HumanStudyOptions {
  human::Person person;
  OrganChoice organs = OrganChoice::all;
  /// Of manikin::armorFacts(), in the order of the study; unknown ones are the caller's mistake.
  std::vector<std::string> systems{"full_torso", "plate_carrier"};
};

/// Injury classes, lattices, poses, sources, models and trials are those of the sample study. Pieces that do not
/// protect are left out. Pieces of a system that shares a name with one before it are all named SYSTEM_PIECE, since
/// each piece has its rows.
/// \throw base::InputError as manikin::checkPerson()
Study humanStudy(const HumanStudyOptions& options);

/// "man, 175.5 cm, 84.6 kg"
std::string describe(const human::Person& person);

}  // namespace lorica::study
