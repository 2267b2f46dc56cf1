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

void writeFileAtomically(const fs::path& path, std::string_view bytes) {
  std::error_code failure;
  if (path.has_parent_path()) {
    fs::create_directories(path.parent_path(), failure);
  }
  fs::path draft = path;
  draft += ".part" + std::to_string(::getpid());
  {
    std::ofstream stream(draft, std::ios::binary | std::ios::trunc);
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    stream.flush();
    if (!stream) {
      stream.close();
      fs::remove(draft, failure);
      throw InputError(path.string(), "", "cannot be written; check that the folder exists, is writable and has room");
    }
  }
  fs::rename(draft, path, failure);
  if (failure) {
    const std::string reason = failure.message();
    fs::remove(draft, failure);
    throw InputError(path.string(), "", "cannot be replaced: " + reason);
  }
}

}  // namespace lorica::base
