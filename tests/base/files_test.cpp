#include "lorica/base/files.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <system_error>
#include <thread>

#include "lorica/base/error.h"

namespace lorica::base {
namespace {

namespace fs = std::filesystem;

/// An empty folder that goes away with the test.
class Folder {
 public:
  Folder() {
    std::string pattern = (fs::temp_directory_path() / "lorica-base-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) {
      throw std::system_error(errno, std::generic_category(), pattern);
    }
    path_ = pattern;
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  fs::path operator/(const fs::path& name) const { return path_ / name; }
  std::set<std::string> names() const {
    std::set<std::string> found;
    for (const fs::directory_entry& entry : fs::directory_iterator(path_)) {
      found.insert(entry.path().filename().string());
    }
    return found;
  }

 private:
  fs::path path_;
};

/// While it lives, files of this process cannot grow beyond `bytes`: a disk that is full, for tests.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : oldHandler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit limit{std::min(bytes, old_.rlim_max), old_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, oldHandler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit old_{};
  void (*oldHandler_)(int);
};

template <class Call>
void expectInputErrorNaming(const fs::path& path, const Call& call) {
  try {
    call();
    ADD_FAILURE() << "no exception for " << path;
  } catch (const InputError& error) {
    EXPECT_EQ(error.file(), path.string());
    EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos) << error.what();
    EXPECT_FALSE(error.text().empty());
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
  }
}

std::string everyByte() {
  std::string bytes;
  for (int value = 0; value < 256; ++value) {
    bytes.push_back(static_cast<char>(value));
  }
  return bytes;
}

TEST(ReadFile, OfAMissingFileNamesIt) {
  const Folder folder;
  expectInputErrorNaming(folder / "absent.json", [&] { readFile(folder / "absent.json"); });
  expectInputErrorNaming(folder / "no/such/folder.json", [&] { readFile(folder / "no/such/folder.json"); });
}

TEST(ReadFile, OfAFolderNamesIt) {
  const Folder folder;
  fs::create_directory(folder / "models");
  expectInputErrorNaming(folder / "models", [&] { readFile(folder / "models"); });
}

TEST(ReadFile, OfAFileUsedAsAFolderNamesIt) {
  const Folder folder;
  writeFileAtomically(folder / "file", "bytes");
  expectInputErrorNaming(folder / "file/inner", [&] { readFile(folder / "file/inner"); });
}

TEST(ReadFile, OfAForbiddenFileNamesIt) {
  if (geteuid() == 0) {
    GTEST_SKIP() << "nothing is forbidden to the superuser";
  }
  const Folder folder;
  writeFileAtomically(folder / "secret", "bytes");
  fs::permissions(folder / "secret", fs::perms::none);
  expectInputErrorNaming(folder / "secret", [&] { readFile(folder / "secret"); });
}

TEST(WriteFile, IsReadBackByteForByte) {
  const Folder folder;
  for (const std::string& bytes : {std::string(), std::string("text\n"), std::string("\r\n\0\x1a\n\r", 6), everyByte(),
                                   std::string(3'000'001, '\0')}) {
    writeFileAtomically(folder / "file.bin", bytes);
    EXPECT_TRUE(readFile(folder / "file.bin") == bytes) << bytes.size() << " bytes";
    EXPECT_EQ(fs::file_size(folder / "file.bin"), bytes.size());
  }
  EXPECT_EQ(folder.names(), std::set<std::string>{"file.bin"});
}

RC_GTEST_PROP(WriteFile, IsReadBackForAnyBytes, (const std::string& first, const std::string& second)) {
  const Folder folder;
  writeFileAtomically(folder / "file.bin", first);
  RC_ASSERT(readFile(folder / "file.bin") == first);
  writeFileAtomically(folder / "file.bin", second);
  RC_ASSERT(readFile(folder / "file.bin") == second);
  RC_ASSERT(folder.names().size() == 1U);
}

TEST(WriteFile, MakesMissingFolders) {
  const Folder folder;
  writeFileAtomically(folder / "a/b/c/file", "deep");
  EXPECT_EQ(readFile(folder / "a/b/c/file"), "deep");
}

TEST(WriteFile, OverAFolderLeavesItAndNothingElse) {
  const Folder folder;
  writeFileAtomically(folder / "target/kept", "old");
  expectInputErrorNaming(folder / "target", [&] { writeFileAtomically(folder / "target", "new"); });
  EXPECT_EQ(readFile(folder / "target/kept"), "old");
  EXPECT_EQ(folder.names(), std::set<std::string>{"target"});
}

TEST(WriteFile, BelowAFileLeavesIt) {
  const Folder folder;
  writeFileAtomically(folder / "file", "old");
  expectInputErrorNaming(folder / "file/inner", [&] { writeFileAtomically(folder / "file/inner", "new"); });
  EXPECT_EQ(readFile(folder / "file"), "old");
  EXPECT_EQ(folder.names(), std::set<std::string>{"file"});
}

TEST(WriteFile, WithoutRoomLeavesTheOldFileAndNothingElse) {
  const Folder folder;
  writeFileAtomically(folder / "result.csv", "old");
  const std::string large(1'000'000, 'x');
  bool refused = false;
  {
    const FileSizeLimit limit(4096);
    try {
      writeFileAtomically(folder / "result.csv", large);
    } catch (const InputError&) {
      refused = true;
    }
  }
  EXPECT_TRUE(refused);
  EXPECT_EQ(readFile(folder / "result.csv"), "old");
  EXPECT_EQ(folder.names(), std::set<std::string>{"result.csv"});
}

TEST(WriteFile, IntoAForbiddenFolderLeavesTheOldFile) {
  if (geteuid() == 0) {
    GTEST_SKIP() << "nothing is forbidden to the superuser";
  }
  const Folder folder;
  writeFileAtomically(folder / "locked/file", "old");
  fs::permissions(folder / "locked", fs::perms::owner_read | fs::perms::owner_exec);
  expectInputErrorNaming(folder / "locked/file", [&] { writeFileAtomically(folder / "locked/file", "new"); });
  fs::permissions(folder / "locked", fs::perms::owner_all);
  EXPECT_EQ(readFile(folder / "locked/file"), "old");
}

/// Reads one file again and again while another thread replaces it, and returns how often the bytes read were neither
/// the one content nor the other.
template <class Read>
int tornReads(const Read& read) {
  const Folder folder;
  const std::string small(1'000, 'a');
  const std::string large(200'000, 'b');
  writeFileAtomically(folder / "file", small);
  std::atomic<bool> stop{false};
  std::thread writer([&] {
    for (bool useLarge = true; !stop; useLarge = !useLarge) {
      writeFileAtomically(folder / "file", useLarge ? large : small);
    }
  });
  int torn = 0;
  for (int i = 0; i < 5000; ++i) {
    const std::string seen = read(folder / "file");
    torn += seen == small || seen == large ? 0 : 1;
  }
  stop = true;
  writer.join();
  return torn;
}

TEST(WriteFile, ShowsAnyReaderTheOldOrTheNewFileButNeverHalfOfOne) {
  EXPECT_EQ(tornReads([](const fs::path& path) {
              std::ifstream stream(path, std::ios::binary);
              return std::string(std::istreambuf_iterator<char>(stream), {});
            }),
            0);
}

TEST(ReadFile, OfAFileThatIsBeingReplacedIsTheOldOrTheNewOne) {
  EXPECT_EQ(tornReads([](const fs::path& path) { return readFile(path); }), 0);
}

TEST(NewFolders, TakeAwayWhatTheyMadeUnlessItHoldsSomething) {
  const Folder folder;
  fs::create_directories(folder / "old");
  {
    NewFolders made;
    made.willMake(folder / "a/b");
    made.willMake(folder / "old");
    made.willMake(folder / "kept/below");
    requireWritableFolder(folder / "a/b");
    writeFileAtomically(folder / "kept/file", "bytes");
    requireWritableFolder(folder / "kept/below");
  }
  EXPECT_FALSE(fs::exists(folder / "a"));
  EXPECT_TRUE(fs::exists(folder / "old")) << "it was there before";
  EXPECT_TRUE(fs::exists(folder / "kept/file"));
  EXPECT_FALSE(fs::exists(folder / "kept/below"));
}

TEST(RequireWritableFolder, MakesItAndLeavesItEmpty) {
  const Folder folder;
  requireWritableFolder(folder / "a/b");
  EXPECT_TRUE(fs::is_empty(folder / "a/b"));
}

TEST(RequireWritableFolder, NamesTheFolderThatCannotBe) {
  const Folder folder;
  writeFileAtomically(folder / "file", "bytes");
  expectInputErrorNaming(folder / "file/below", [&] { requireWritableFolder(folder / "file/below"); });
}

}  // namespace
}  // namespace lorica::base
