#pragma once

/// \file
/// Imports of bytes through a file of their own, and what a good error looks like.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "lorica/base/error.h"
#include "lorica/io/import.h"

namespace lorica::test {

/// A folder that goes away with the object.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "lorica_io_XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    std::filesystem::remove(path_ / name);  // some file systems wait for the disk when a file is overwritten
    std::ofstream(path_ / name, std::ios::binary) << bytes;
    return path_ / name;
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline io::Model importBytes(const std::string& bytes, const std::string& name, const io::ImportOptions& options = {}) {
  const ScratchFolder folder;
  return io::importModel(folder.write(name, bytes), options);
}

/// The import ends in an InputError of one line that names the file and holds `about`.
inline void expectRefused(const std::string& bytes, const std::string& name, const std::string& about) {
  try {
    importBytes(bytes, name);
    ADD_FAILURE() << "was read; expected an error about '" << about << "'";
  } catch (const base::InputError& error) {
    const std::string line = error.what();
    EXPECT_NE(line.find(name), std::string::npos) << line;
    EXPECT_NE(line.find(about), std::string::npos) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  }
}

/// How many issues of the severity hold the text.
inline std::size_t issuesAbout(const io::Model& model, base::Severity severity, const std::string& about) {
  std::size_t count = 0;
  for (const base::Issue& issue : model.issues) {
    count += issue.severity == severity && issue.line().find(about) != std::string::npos ? 1 : 0;
  }
  return count;
}

inline std::vector<float> flat(const geometry::Positions& positions) {
  std::vector<float> numbers;
  for (const geometry::Vec3f& p : positions) {
    numbers.insert(numbers.end(), {p.x(), p.y(), p.z()});
  }
  return numbers;
}

}  // namespace lorica::test
