#pragma once

/// \file
/// The built-in human, whole: body, motions, organs and armor of a person.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lorica/base/parallel.h"
#include "lorica/base/progress.h"
#include "lorica/human/clip.h"
#include "lorica/manikin/armor_systems.h"
#include "lorica/manikin/body.h"
#include "lorica/manikin/organs.h"

namespace lorica::manikin {

/// Goes up whenever any part of a human comes out other than before, so that none is kept too long.
inline constexpr std::uint32_t kHumanVersion = 7;

struct Human {
  Body body;
  std::vector<human::Clip> clips;    ///< taskClips()
  std::vector<Organ> organs;         ///< organsOf()
  std::vector<ArmorSystem> systems;  ///< armorOf()
};

/// Makes everything anew. The same bytes at any number of threads.
/// Cost: some ten seconds on two cores.
/// \throw base::InputError as checkPerson(), base::Cancelled
Human makeHuman(const human::Person& person, base::Threads threads, const base::Progress& progress = {});

/// A human as bytes of the program's own, for keeping; readHuman() gives back the same one, the motions made anew.
std::string humanBytes(const Human& human);
/// \param name what errors call the bytes
/// \throw base::InputError when the bytes are damaged or of another version of the program
Human readHuman(std::string_view bytes, const std::string& name);

/// The human of a person: the median man is part of the program, others come from the folder where they are kept, else
/// they are made anew and kept there; one that cannot be read is made anew, one that cannot be kept is given all the
/// same. The folder is $LORICA_CACHE, else lorica in
/// $XDG_CACHE_HOME or ~/.cache. \throw as makeHuman()
Human keptHuman(const human::Person& person, base::Threads threads, const base::Progress& progress = {});

/// keptHuman() where that takes no making; nothing otherwise. Cost: reading, some tenths of a second.
/// \throw base::InputError as checkPerson()
std::optional<Human> humanIfKept(const human::Person& person);

}  // namespace lorica::manikin
