#pragma once

/// \file
/// Whole files in and out. Writing is all or nothing: a reader never sees half a file, a failure leaves the old one.

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace lorica::base {

/// The bytes of a file.
/// \throw InputError when it is missing, is a folder or cannot be read
std::string readFile(const std::filesystem::path& path);

/// Writes beside `path` and renames over it; makes the folder when it is missing.
/// \throw InputError when the place cannot be written
void writeFileAtomically(const std::filesystem::path& path, std::string_view bytes);

struct FileBytes {
  std::filesystem::path path;
  std::string bytes;
};

/// The same for files that belong together: all drafts are written before the first is renamed.
/// \throw InputError when one cannot be written; then the old ones stay
void writeFilesAtomically(const std::vector<FileBytes>& files);

/// A file that is written piece by piece: beside its place until commit() puts it there. Without, nothing stays.
class FileDraft {
 public:
  /// Makes the folder when it is missing. \throw InputError when the place cannot be written
  explicit FileDraft(std::filesystem::path path);
  FileDraft(const FileDraft&) = delete;
  FileDraft& operator=(const FileDraft&) = delete;
  ~FileDraft();

  /// \throw InputError, as when the disk is full
  void write(std::string_view bytes);
  /// \throw InputError; then the old file stays
  void commit();

 private:
  [[noreturn]] void fail() const;

  std::filesystem::path path_;
  std::ofstream stream_;
  bool committed_ = false;
};

/// Folders that were not there before: those among them that are empty at its end go again, so that work that fails
/// leaves no trace.
class NewFolders {
 public:
  NewFolders() = default;
  NewFolders(const NewFolders&) = delete;
  NewFolders& operator=(const NewFolders&) = delete;
  ~NewFolders();

  /// Notes which of the folder and those above it are still to be made.
  void willMake(const std::filesystem::path& folder);

 private:
  std::vector<std::filesystem::path> made_;  // outer ones first
};

/// Makes the folder when it is missing and tries whether files can be made in it, before long work is done for it.
/// \throw InputError
void requireWritableFolder(const std::filesystem::path& folder);

}  // namespace lorica::base
