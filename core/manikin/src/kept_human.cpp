#include <fmt/format.h>

#include <bit>
#include <cstdlib>
#include <filesystem>

#include "lorica/base/error.h"
#include "lorica/base/files.h"
#include "lorica/manikin/human.h"

// The median man, put into the program at build time.
extern "C" {
extern const char loricaMedianHuman[];
extern const char loricaMedianHumanEnd[];
}

namespace lorica::manikin {

namespace {

std::filesystem::path cacheFolder() {
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): nobody sets variables
    return std::string(value == nullptr ? "" : value);
  };
  if (const std::string own = variable("LORICA_CACHE"); !own.empty()) {
    return own;
  }
  if (const std::string shared = variable("XDG_CACHE_HOME"); !shared.empty()) {
    return std::filesystem::path(shared) / "lorica";
  }
  const std::string home = variable("HOME");
  return home.empty() ? std::filesystem::path() : std::filesystem::path(home) / ".cache" / "lorica";
}

/// Where the human of a person is kept; empty when nowhere.
std::filesystem::path fileFor(const human::Person& person) {
  const std::filesystem::path folder = cacheFolder();
  if (folder.empty()) {
    return {};
  }
  // The bits of the sizes, not their decimals: two persons never share a file.
  return folder / fmt::format("human-{}-{}-{:016x}-{:016x}.bin", kHumanVersion,
                              person.sex == human::Sex::male ? "male" : "female",
                              std::bit_cast<std::uint64_t>(person.stature), std::bit_cast<std::uint64_t>(person.mass));
}

}  // namespace

std::optional<Human> humanIfKept(const human::Person& person) {
  checkPerson(person);
  if (person == human::Person{}) {
    return readHuman({loricaMedianHuman, static_cast<std::size_t>(loricaMedianHumanEnd - loricaMedianHuman)},
                     "the built-in human");
  }
  const std::filesystem::path file = fileFor(person);
  std::error_code ignored;
  if (!file.empty() && std::filesystem::exists(file, ignored)) {
    try {
      Human human = readHuman(base::readFile(file), file.string());
      if (human.body.person == person) {
        return human;
      }
    } catch (const base::InputError&) {
      // As good as none: keptHuman() makes it anew, which also mends the file.
    }
  }
  return std::nullopt;
}

Human keptHuman(const human::Person& person, base::Threads threads, const base::Progress& progress) {
  if (std::optional<Human> kept = humanIfKept(person)) {
    return *std::move(kept);
  }
  Human human = makeHuman(person, threads, progress);
  if (const std::filesystem::path file = fileFor(person); !file.empty()) {
    try {
      base::writeFileAtomically(file, humanBytes(human));
    } catch (const base::InputError&) {
      // Without a place to keep it the next one takes as long as this one; nothing else is lost.
    }
  }
  return human;
}

}  // namespace lorica::manikin
