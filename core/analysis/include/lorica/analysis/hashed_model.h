#pragma once

/// \file
/// A file that is new to a study: its model and its hash, at the same time.

#include <filesystem>
#include <string>

#include "lorica/io/import.h"

namespace lorica::analysis {

struct HashedModel {
  io::Model model;
  std::string sha256;  ///< study::sha256OfInput
};

/// io::importModel and study::sha256OfInput side by side. Cost: that of the slower one, where two threads can be had.
/// \throw base::InputError, that of the hash when both fail
HashedModel importHashed(const std::filesystem::path& path, const io::ImportOptions& options = {});

}  // namespace lorica::analysis
