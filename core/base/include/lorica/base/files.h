#pragma once

/// \file
/// Whole files in and out. Writing is all or nothing: a reader never sees half a file, a failure leaves the old one.

#include <filesystem>
#include <string>
#include <string_view>

namespace lorica::base {

/// The bytes of a file.
/// \throw InputError when it is missing, is a folder or cannot be read
std::string readFile(const std::filesystem::path& path);

/// Writes beside `path` and renames over it; makes the folder when it is missing.
/// \throw InputError when the place cannot be written
void writeFileAtomically(const std::filesystem::path& path, std::string_view bytes);

}  // namespace lorica::base
