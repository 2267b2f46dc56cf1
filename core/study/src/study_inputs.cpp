#include <fmt/format.h>
#include <openssl/evp.h>

#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "json_text.h"
#include "lorica/base/error.h"
#include "lorica/base/files.h"
#include "lorica/study/study_file.h"
#include "lorica/threat/read_threat.h"

namespace lorica::study {

namespace fs = std::filesystem;

namespace {

class Sha256 {
 public:
  Sha256() : context_(EVP_MD_CTX_new(), &EVP_MD_CTX_free) {
    check(EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr));
  }

  void add(std::string_view bytes) { check(EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size())); }

  /// Ends the sum.
  std::string hexadecimal() {
    std::array<unsigned char, 32> digest{};
    check(EVP_DigestFinal_ex(context_.get(), digest.data(), nullptr));
    std::string text;
    for (const unsigned char byte : digest) {
      text += fmt::format("{:02x}", byte);
    }
    return text;
  }

 private:
  static void check(int done) {
    if (done != 1) {
      throw base::Error("the cryptographic library cannot compute SHA-256");
    }
  }

  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

/// Bytes of a regular file: a device would never end. \param remedy what to do when it is not there
std::string readInput(const fs::path& path, const std::string& remedy) {
  std::error_code failure;
  if (!fs::exists(path, failure)) {
    throw base::InputError(path.string(), "", "there is no such file; " + remedy);
  }
  if (!fs::is_regular_file(path, failure)) {
    throw base::InputError(path.string(), "", "is not a regular file; " + remedy);
  }
  return base::readFile(path);
}

int hexadecimalDigit(char letter) {
  const std::string_view digits = "0123456789abcdef";
  const std::size_t at = digits.find(static_cast<char>(letter >= 'A' && letter <= 'F' ? letter - 'A' + 'a' : letter));
  return at == std::string_view::npos ? -1 : static_cast<int>(at);
}

/// The path a uri means: %20 is a space.
std::string percentDecoded(std::string_view uri) {
  std::string path;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const int high = uri[i] == '%' && i + 2 < uri.size() ? hexadecimalDigit(uri[i + 1]) : -1;
    const int low = high >= 0 ? hexadecimalDigit(uri[i + 2]) : -1;
    if (low >= 0) {
      path += static_cast<char>(16 * high + low);
      i += 2;
    } else {
      path += uri[i];
    }
  }
  return path;
}

/// Files the buffers of a .gltf are in, in their order.
std::vector<fs::path> bufferFiles(const fs::path& path, std::string_view gltf) {
  const nlohmann::json tree = nlohmann::json::parse(gltf, nullptr, false);
  if (!tree.is_object()) {
    throw base::InputError(path.string(), "", "is not a glTF file: its content is not a JSON object");
  }
  std::vector<fs::path> files;
  const auto buffers = tree.find("buffers");
  if (buffers == tree.end() || !buffers->is_array()) {
    return files;
  }
  for (const nlohmann::json& buffer : *buffers) {
    const auto uri = buffer.is_object() ? buffer.find("uri") : buffer.end();
    if (uri != buffer.end() && uri->is_string() && !uri->get_ref<const std::string&>().starts_with("data:")) {
      files.push_back(path.parent_path() / percentDecoded(uri->get_ref<const std::string&>()));
    }
  }
  return files;
}

bool isGltf(const fs::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char letter) { return static_cast<char>(letter >= 'A' && letter <= 'Z' ? letter + 32 : letter); });
  return ending == ".gltf";
}

/// Calls `visit` for every mesh of a study, const or not, in the order of the file.
template <class AnyStudy, class Visit>
void forEachMesh(AnyStudy& study, Visit visit) {
  visit(study.human);
  for (auto& organ : study.organs) {
    visit(organ.mesh);
  }
  for (auto& system : study.systems) {
    for (auto& piece : system.pieces) {
      visit(piece.mesh);
    }
  }
}

template <class AnyStudy, class Visit>
void forEachInput(AnyStudy& study, Visit visit) {
  forEachMesh(study, [&](auto& mesh) {
    if (auto* input = std::get_if<InputFile>(&mesh.from)) {
      visit(*input);
    }
  });
  for (auto& motion : study.motions) {
    visit(motion.file);
  }
  for (auto& source : study.sources) {
    if (source.type == SourceType::list) {
      visit(source.list);
    }
  }
  for (auto& threat : study.threats) {
    if (auto* input = std::get_if<InputFile>(&threat.from)) {
      visit(*input);
    }
  }
}

}  // namespace

std::string sha256(std::string_view bytes) {
  Sha256 sum;
  sum.add(bytes);
  return sum.hexadecimal();
}

std::string readInput(const fs::path& path) {
  return readInput(path, "put it back or correct the path in the study");
}

std::string sha256OfInput(const fs::path& path) {
  return sha256OfInput(path, readInput(path));
}

std::string sha256OfInput(const fs::path& path, std::string_view bytes) {
  Sha256 sum;
  sum.add(bytes);
  if (isGltf(path)) {
    for (const fs::path& buffer : bufferFiles(path, bytes)) {
      sum.add(readInput(buffer, fmt::format("put it back, {} needs it", path.filename().string())));
    }
  }
  for (const fs::path& part : threat::filesOfSeries(path)) {
    sum.add(readInput(part, fmt::format("put it back, {} needs it", path.filename().string())));
  }
  return sum.hexadecimal();
}

fs::path resolve(const InputFile& input, const fs::path& studyFile) {
  return (fs::absolute(studyFile).parent_path() / input.path).lexically_normal();
}

Study rebased(Study study, const fs::path& fromFile, const fs::path& toFile) {
  const fs::path folder = fs::absolute(toFile).lexically_normal().parent_path();
  if (folder == fs::absolute(fromFile).lexically_normal().parent_path()) {
    return study;
  }
  forEachInput(study, [&](InputFile& input) {
    if (fs::path(input.path).is_absolute()) {
      return;
    }
    const fs::path file = resolve(input, fromFile);
    const fs::path relative = file.lexically_relative(folder);
    input.path = (relative.empty() ? file : relative).generic_string();
  });
  return study;
}

std::vector<InputFile> inputFiles(const Study& study) {
  std::vector<InputFile> files;
  std::set<std::string> seen;
  forEachInput(study, [&](const InputFile& input) {
    if (seen.insert(input.path).second) {
      files.push_back(input);
    }
  });
  return files;
}

base::Issues checkInputs(const Study& study, const fs::path& studyFile) {
  base::Issues issues;
  std::map<fs::path, std::string> hashes;  // of the files seen so far; empty when already complained about
  forEachInput(study, [&](const InputFile& input) {
    const fs::path path = resolve(input, studyFile);
    const auto [place, fresh] = hashes.emplace(path, "");
    std::string& hash = place->second;
    const auto complain = [&](const std::string& file, const std::string& where, const std::string& text) {
      issues.push_back({base::Severity::error, file, where, text});
      hash.clear();
    };
    if (fresh) {
      try {
        hash = sha256OfInput(path);
      } catch (const base::InputError& failure) {
        complain(failure.file(), failure.place(), failure.text());
      }
    }
    if (!hash.empty() && !input.sha256.empty() && hash != input.sha256) {
      complain(path.string(), "",
               fmt::format("has changed since the study was made (expected {}, found {}); run `lorica-cli check "
                           "--accept-inputs` to take the new one",
                           input.sha256.substr(0, 12), hash.substr(0, 12)));
    }
  });
  return issues;
}

Study withCurrentHashes(const Study& study, const fs::path& studyFile) {
  Study updated = study;
  std::map<fs::path, std::string> hashes;
  forEachInput(updated, [&](InputFile& input) {
    const auto [place, fresh] = hashes.emplace(resolve(input, studyFile), "");
    if (fresh) {
      place->second = sha256OfInput(place->first);
    }
    input.sha256 = place->second;
  });
  return updated;
}

}  // namespace lorica::study
