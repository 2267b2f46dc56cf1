#include <fmt/format.h>

#include <cstdio>

#include "commands.h"
#include "console.h"
#include "human_files.h"
#include "lorica/base/error.h"
#include "lorica/base/files.h"
#include "lorica/base/readable.h"

namespace lorica::cli {

namespace fs = std::filesystem;

namespace {

human::Person personOf(const GenerateArguments& arguments) {
  if (arguments.stature && arguments.mass) {
    return {arguments.sex, *arguments.stature, *arguments.mass};
  }
  return manikin::personAtPercentile(arguments.sex, arguments.percentile.value_or(50.0));
}

/// Empty when a human can be made.
std::string objection(const GenerateArguments& arguments) {
  const double percentile = arguments.percentile.value_or(50.0);
  if (!(percentile >= 0.1 && percentile <= 99.9)) {
    return fmt::format("--percentile: expected 0.1 to 99.9, found {:.4g}", percentile);
  }
  try {
    manikin::checkPerson(personOf(arguments));
  } catch (const base::InputError& error) {
    return fmt::format("--{}: {}", error.place(), error.text());
  }
  return {};
}

void say(const manikin::Human& human, const fs::path& folder) {
  std::size_t pieces = 0;
  for (const manikin::ArmorSystem& system : human.systems) {
    pieces += system.pieces.size();
  }
  const human::Person& person = human.body.person;
  fmt::print(
      "{}: a {} of {:.3f} m and {:.1f} kg: skin of {} triangles, {} joints, {} clips; {} organs; {} armor "
      "systems of {} pieces; facts.json has the sizes\nmake a study of it with\n",
      folder.string(), person.sex == human::Sex::male ? "man" : "woman", person.stature, person.mass,
      base::readableCount(human.body.skin.triangles.size()), human.body.skeleton.size(), human.clips.size(),
      human.organs.size(), human.systems.size(), pieces);
  const std::string name = folder.string();
  fmt::print(
      "  lorica-cli import {0}/body.glb {0}/organs/*.glb --system {1} --armor {0}/armor/{1} --out "
      "study.lorica.json\n",
      name, human.systems.front().name);
}

}  // namespace

int generateHuman(const GenerateArguments& arguments) {
  if (const std::string text = objection(arguments); !text.empty()) {
    fmt::print(stderr, "lorica-cli: {}; see lorica-cli generate human --help\n", text);
    return wrongUsage;
  }
  base::NewFolders folders;
  folders.willMake(arguments.out);
  base::requireWritableFolder(arguments.out);
  manikin::Human human;
  {
    Stage stage("generating", false);
    human = manikin::keptHuman(personOf(arguments), {}, stage.progress().part(0.0, 0.9));
    const std::vector<base::FileBytes> files = humanFiles(human, arguments.out, stage.progress().part(0.9, 1.0));
    for (const base::FileBytes& file : files) {
      folders.willMake(file.path.parent_path());
    }
    base::writeFilesAtomically(files);
  }
  say(human, arguments.out);
  return done;
}

}  // namespace lorica::cli
