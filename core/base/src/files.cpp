#include "lorica/base/files.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <system_error>

#include "lorica/base/error.h"

namespace lorica::base {

namespace fs = std::filesystem;

std::string readFile(const fs::path& path) {
  std::error_code failure;
  const fs::file_status status = fs::status(path, failure);
  if (!fs::exists(status)) {
    throw InputError(path.string(), "", "there is no such file");
  }
  if (fs::is_directory(status)) {
    throw InputError(path.string(), "", "is a folder, a file was expected");
  }
  std::ifstream stream(path, std::ios::binary);
  std::string bytes;
  if (stream && fs::is_regular_file(status)) {
    // The size of what was opened: the path may mean another file by now.
    stream.seekg(0, std::ios::end);
    bytes.resize(static_cast<std::size_t>(std::max<std::streamoff>(0, stream.tellg())));
    stream.seekg(0);
    stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(stream.gcount()));
  } else if (stream) {
    bytes.assign(std::istreambuf_iterator<char>(stream), {});
  }
  if (stream.bad() || !stream.is_open()) {
    throw InputError(path.string(), "", "cannot be read; check its permissions");
  }
  return bytes;
}

namespace {

fs::path draftOf(const fs::path& path) {
  fs::path draft = path;
  draft += ".part" + std::to_string(::getpid());
  return draft;
}

/// Writes the draft of a file, or throws and leaves none.
void writeDraft(const FileBytes& file) {
  std::error_code failure;
  if (file.path.has_parent_path()) {
    fs::create_directories(file.path.parent_path(), failure);
  }
  if (fs::is_directory(file.path, failure)) {
    throw InputError(file.path.string(), "", "is a folder; a file was to be written there");
  }
  std::ofstream stream(draftOf(file.path), std::ios::binary | std::ios::trunc);
  stream.write(file.bytes.data(), static_cast<std::streamsize>(file.bytes.size()));
  stream.flush();
  if (!stream) {
    stream.close();
    fs::remove(draftOf(file.path), failure);
    throw InputError(file.path.string(), "",
                     "cannot be written; check that the folder exists, is writable and has room");
  }
}

}  // namespace

void writeFilesAtomically(const std::vector<FileBytes>& files) {
  std::error_code ignored;
  const auto dropDrafts = [&] {
    for (const FileBytes& file : files) {
      fs::remove(draftOf(file.path), ignored);
    }
  };
  try {
    for (const FileBytes& file : files) {
      writeDraft(file);
    }
  } catch (const InputError&) {
    dropDrafts();
    throw;
  }
  for (const FileBytes& file : files) {
    std::error_code failure;
    fs::rename(draftOf(file.path), file.path, failure);
    if (failure) {
      dropDrafts();
      throw InputError(file.path.string(), "", "cannot be replaced: " + failure.message());
    }
  }
}

void writeFileAtomically(const fs::path& path, std::string_view bytes) {
  writeFilesAtomically({{path, std::string(bytes)}});
}

NewFolders::~NewFolders() {
  std::error_code ignored;  // of those that hold something
  for (auto folder = made_.rbegin(); folder != made_.rend(); ++folder) {
    fs::remove(*folder, ignored);
  }
}

void NewFolders::willMake(const fs::path& folder) {
  std::error_code ignored;
  if (folder.empty() || fs::exists(folder, ignored)) {
    return;
  }
  willMake(folder.parent_path());
  if (made_.empty() || made_.back() != folder) {
    made_.push_back(folder);
  }
}

void requireWritableFolder(const fs::path& folder) {
  std::error_code ignored;
  const fs::path probe = folder / ".lorica-probe";
  try {
    writeFileAtomically(probe, "");
  } catch (const InputError&) {
    // The user knows the folder, not the probe.
    throw InputError(folder.string(), "",
                     "cannot be written; check that the folder can be made, is writable and has room");
  }
  fs::remove(probe, ignored);
}

FileDraft::FileDraft(fs::path path) : path_(std::move(path)) {
  std::error_code failure;
  if (path_.has_parent_path()) {
    fs::create_directories(path_.parent_path(), failure);
  }
  stream_.open(draftOf(path_), std::ios::binary | std::ios::trunc);
  if (!stream_) {
    fail();
  }
}

FileDraft::~FileDraft() {
  if (!committed_) {
    stream_.close();
    std::error_code failure;
    fs::remove(draftOf(path_), failure);
  }
}

void FileDraft::fail() const {
  throw InputError(path_.string(), "",
                   "cannot be written; check the folder, its permissions and the space on the disk");
}

void FileDraft::write(std::string_view bytes) {
  stream_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!stream_) {
    fail();
  }
}

void FileDraft::commit() {
  stream_.close();
  std::error_code failure;
  if (stream_) {
    fs::rename(draftOf(path_), path_, failure);
  }
  if (!stream_ || failure) {
    fail();
  }
  committed_ = true;
}

}  // namespace lorica::base
