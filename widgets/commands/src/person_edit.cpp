#include <map>

#include "find.h"
#include "lorica/commands/edits.h"
#include "lorica/manikin/armor_systems.h"
#include "lorica/study/human_study.h"

namespace lorica::commands {

using document::Change;

namespace {

/// kg/m2 of the built-in armor of a person, by the built-in's name, as a new study has them.
std::map<std::string, std::optional<double>> builtinDensities(const human::Person& person) {
  study::HumanStudyOptions options{person, study::OrganChoice::none, {}};
  for (const manikin::SystemFacts& system : manikin::armorFacts(person)) {
    options.systems.push_back(system.name);
  }
  std::map<std::string, std::optional<double>> densities;
  for (const study::ArmorSystem& system : study::humanStudy(options).systems) {
    for (const study::ArmorPiece& piece : system.pieces) {
      densities.emplace(std::get<study::Builtin>(piece.mesh.from).name, piece.arealDensity);
    }
  }
  return densities;
}

}  // namespace

void setPerson(StudyDocument& document, const human::Person& person) {
  const study::Study& study = document.study();
  LORICA_CHECK(std::holds_alternative<study::Builtin>(study.human.from), "a study of the built-in human");
  if (study.person == person) {
    return;
  }
  const auto before = builtinDensities(study.person);
  const auto after = builtinDensities(person);
  study::Study changed = study;
  changed.person = person;
  for (study::ArmorSystem& system : changed.systems) {
    for (study::ArmorPiece& piece : system.pieces) {
      const auto* builtin = std::get_if<study::Builtin>(&piece.mesh.from);
      const auto known = builtin == nullptr ? before.end() : before.find(builtin->name);
      // What somebody put in by hand stays.
      if (known != before.end() && known->second == piece.arealDensity && after.contains(builtin->name)) {
        piece.arealDensity = after.at(builtin->name);
      }
    }
  }
  const document::Changes what =
      changed.systems == study.systems ? document::Changes(Change::human) : Change::human | Change::armor;
  document.undoStack().push(new ReplaceStudy(document, std::move(changed), what, Text::tr("Change the person")));
}

}  // namespace lorica::commands
