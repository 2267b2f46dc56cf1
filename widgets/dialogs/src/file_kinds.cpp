#include "lorica/dialogs/file_kinds.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <optional>
#include <string_view>

#include "lorica/analysis/import_study.h"

namespace lorica::dialogs {

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::string_view, 6> meshEndings = {".glb", ".gltf", ".obj", ".stl", ".ply", ".off"};
constexpr std::array<std::string_view, 9> armorWords = {"vest",    "plate",  "helmet", "armor", "armour",
                                                        "carrier", "shield", "sapi",   "kevlar"};
constexpr std::array<std::string_view, 5> bodyWords = {"body", "skin", "human", "manikin", "makehuman"};

std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string endingOf(const fs::path& file) {
  return lowerCase(file.extension().string());
}

template <std::size_t N>
bool holdsAny(const std::string& text, const std::array<std::string_view, N>& words) {
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view word) { return text.find(word) != std::string::npos; });
}

/// Whether a glTF file has a skin, which it says in its JSON near the beginning.
bool hasSkeleton(const fs::path& file) {
  if (endingOf(file) != ".glb" && endingOf(file) != ".gltf") {
    return false;
  }
  std::ifstream stream(file, std::ios::binary);
  constexpr std::size_t headerBytes = 20;
  constexpr std::size_t mostBytes = std::size_t{64} << 20U;
  std::string text(headerBytes, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(headerBytes));
  std::size_t length = mostBytes;
  if (text.starts_with("glTF")) {
    length = 0;
    for (std::size_t byte = 0; byte < 4; ++byte) {
      length |= static_cast<std::size_t>(static_cast<unsigned char>(text[12 + byte])) << (8 * byte);
    }
  }
  text.resize(headerBytes + std::min(length, mostBytes));
  stream.read(text.data() + headerBytes, static_cast<std::streamsize>(text.size() - headerBytes));
  return text.find("\"skins\"") != std::string::npos;
}

}  // namespace

bool isStudyFile(const fs::path& file) {
  return endingOf(file) == ".json";
}

bool isMeshFile(const fs::path& file) {
  const std::string ending = endingOf(file);
  return std::find(meshEndings.begin(), meshEndings.end(), ending) != meshEndings.end();
}

std::vector<FileRole> guessRoles(std::span<const fs::path> files, bool wantsSkin) {
  std::vector<FileRole> roles(files.size(), FileRole::organ);
  std::optional<std::size_t> skin;
  int bestLooks = 0;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const std::string stem = lowerCase(files[i].stem().string());
    if (holdsAny(stem, armorWords)) {
      roles[i] = FileRole::armor;
      continue;
    }
    const bool namedBody = holdsAny(stem, bodyWords) && analysis::injuryClassOf(stem).empty();
    const int looks = (hasSkeleton(files[i]) ? 2 : 0) + (namedBody ? 1 : 0);
    if (looks > bestLooks) {
      bestLooks = looks;
      skin = i;
    }
  }
  if (!skin && files.size() == 1 && wantsSkin && roles[0] == FileRole::organ &&
      analysis::injuryClassOf(files[0].stem().string()).empty()) {
    skin = 0;
  }
  if (skin) {
    roles[*skin] = wantsSkin ? FileRole::skin : FileRole::ignore;
  }
  return roles;
}

fs::path freeStudyFile(const fs::path& folder, const std::string& stem) {
  std::error_code none;
  fs::path file = folder / (stem + ".lorica.json");
  for (int number = 2; fs::exists(file, none); ++number) {
    file = folder / (stem + "_" + std::to_string(number) + ".lorica.json");
  }
  return file;
}

}  // namespace lorica::dialogs
