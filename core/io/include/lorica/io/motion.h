#pragma once

/// \file
/// Recorded motions in: BVH (Biovision hierarchy), which motion capture and most animation programs write.

#include <filesystem>
#include <optional>
#include <string_view>

#include "lorica/io/import.h"

namespace lorica::io {

struct Motion {
  human::Skeleton skeleton;  ///< y up, in the file's unit; the end sites are no joints
  human::Clip clip;          ///< named by the file's stem; a key for every frame, at its time
  std::size_t frames = 0;
  double frameSeconds = 0.0;
  UpAxis up = UpAxis::y;  ///< of the file
  bool upGuessed = false;
  base::Issues issues;  ///< what was ignored
};

/// Reads a motion. Positions of a joint stand for its offset, rotations are applied in the order of the channels. A
/// file whose skeleton reaches further along z than along y is taken to have z up unless `up` says otherwise. A first
/// frame that shows how the recording was calibrated and from which the second one jumps is left out; frames keep their
/// times. Cost: that of reading its numbers. Thread-safe. \throw base::InputError
/// naming the file and the line
Motion importMotion(const std::filesystem::path& path, std::optional<UpAxis> up = std::nullopt);
/// The same of a file whose bytes were read already.
Motion importMotion(const std::filesystem::path& path, std::string_view bytes, std::optional<UpAxis> up);

}  // namespace lorica::io
