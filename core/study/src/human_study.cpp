#include "lorica/study/human_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>

#include "lorica/base/error.h"
#include "lorica/manikin/armor_systems.h"
#include "lorica/manikin/organs.h"
#include "lorica/study/study_file.h"

namespace lorica::study {

namespace {

constexpr std::array<std::string_view, 5> kBeyondTrunk{"brain", "eyes", "thyroid", "arteries", "veins"};

std::vector<Organ> organsFor(OrganChoice choice, const std::vector<Organ>& sample) {
  std::vector<Organ> organs;
  if (choice == OrganChoice::none) {
    return organs;
  }
  for (const std::string& name : manikin::organNames()) {
    if (choice == OrganChoice::torso &&
        std::find(kBeyondTrunk.begin(), kBeyondTrunk.end(), name) != kBeyondTrunk.end()) {
      continue;
    }
    Organ organ;
    organ.name = name;
    organ.mesh.from = Builtin{"human/" + name};
    const auto known = std::find_if(sample.begin(), sample.end(), [&](const Organ& o) { return o.name == name; });
    if (known != sample.end()) {
      organ.injuryClass = known->injuryClass;
      organ.lattice = known->lattice;
    }
    organs.push_back(std::move(organ));
  }
  return organs;
}

/// To the hundredth: a table's number is not known better.
double rounded(double density) {
  return std::round(100.0 * density) / 100.0;
}

ArmorSystem systemFor(const manikin::SystemFacts& facts, std::set<std::string>& taken) {
  ArmorSystem system{facts.name, {}};
  const bool shared = std::any_of(facts.pieces.begin(), facts.pieces.end(), [&](const manikin::PieceFacts& piece) {
    return piece.protecting && taken.contains(piece.name);
  });
  for (const manikin::PieceFacts& made : facts.pieces) {
    if (!made.protecting) {
      continue;
    }
    ArmorPiece piece;
    piece.name = shared ? facts.name + "_" + made.name : made.name;
    piece.mesh.from = Builtin{"human/" + facts.name + "/" + made.name};
    piece.carriage = made.carriage;
    piece.material = made.material;
    if (made.arealDensity) {
      piece.arealDensity = rounded(*made.arealDensity);
    }
    taken.insert(piece.name);
    system.pieces.push_back(std::move(piece));
  }
  return system;
}

}  // namespace

std::string describe(const human::Person& person) {
  return fmt::format("{}, {:.1f} cm, {:.1f} kg", person.sex == human::Sex::male ? "man" : "woman",
                     100.0 * person.stature, person.mass);
}

Study humanStudy(const HumanStudyOptions& options) {
  manikin::checkPerson(options.person);
  Study study = parseStudy(templateText("sample"), "sample");
  study.name = describe(options.person);
  study.description.clear();
  study.person = options.person;
  study.organs = organsFor(options.organs, study.organs);
  study.systems.clear();
  study.displays.clear();
  std::set<std::string> taken;
  const std::vector<manikin::SystemFacts> known = manikin::armorFacts(options.person);
  for (const std::string& name : options.systems) {
    const auto facts =
        std::find_if(known.begin(), known.end(), [&](const auto& system) { return system.name == name; });
    LORICA_CHECK(facts != known.end(), "a system of the built-in human");
    study.systems.push_back(systemFor(*facts, taken));
  }
  for (Pose& pose : study.poses) {
    pose.description.clear();
  }
  for (Source& source : study.sources) {
    source.description.clear();
  }
  return study;
}

}  // namespace lorica::study
