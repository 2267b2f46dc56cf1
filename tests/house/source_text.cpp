#include "source_text.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <optional>
#include <regex>

namespace lorica::house {

namespace fs = std::filesystem;

std::string Finding::where() const {
  return line == 0 ? path + ": " + text : path + ":" + std::to_string(line) + ": " + text;
}

std::string lines(const Findings& findings) {
  std::string all;
  for (const Finding& finding : findings) {
    all += finding.where() + "\n";
  }
  return all;
}

namespace {

bool isLeftOut(const std::string& topName) {
  return topName == ".git" || topName == "out" || topName.starts_with("build");
}

std::optional<SourceFile> readText(const fs::path& file, const fs::path& project) {
  std::ifstream in(file, std::ios::binary);
  SourceFile source{fs::relative(file, project).generic_string(), std::string(std::istreambuf_iterator<char>(in), {})};
  if (source.text.find('\0') != std::string::npos) {
    return std::nullopt;
  }
  return source;
}

}  // namespace

std::vector<std::string> topLevelEntries(const fs::path& project) {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(project)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<SourceFile> projectFiles(const fs::path& project) {
  std::vector<SourceFile> files;
  const auto add = [&](const fs::path& file) {
    if (auto source = readText(file, project)) {
      files.push_back(std::move(*source));
    }
  };
  for (const std::string& name : topLevelEntries(project)) {
    const fs::path path = project / name;
    if (isLeftOut(name)) {
      continue;  // .git is a file in a second work tree
    }
    if (fs::is_regular_file(path)) {
      add(path);
    } else if (fs::is_directory(path)) {
      for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path)) {
        if (entry.is_regular_file()) {
          add(entry.path());
        }
      }
    }
  }
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.path < b.path; });
  return files;
}

namespace {

/// Walks over C++ and blanks what is not code.
class Blanker {
 public:
  explicit Blanker(std::string_view cpp) : text_(cpp) {}

  std::string run() {
    while (at_ < text_.size()) {
      if (text_.compare(at_, 2, "//") == 0) {
        blankTo(text_.find('\n', at_));
      } else if (text_.compare(at_, 2, "/*") == 0) {
        const std::size_t end = text_.find("*/", at_ + 2);
        blankTo(end == std::string::npos ? end : end + 2);
      } else if (text_[at_] == '"') {
        blankLiteral();
      } else if (text_[at_] == '\'' && !isDigitSeparator()) {
        blankQuoted('\'');
      } else {
        ++at_;
      }
    }
    return std::move(text_);
  }

 private:
  bool isDigitSeparator() const {
    return at_ > 0 && std::isxdigit(static_cast<unsigned char>(text_[at_ - 1])) != 0 && at_ + 1 < text_.size() &&
           std::isxdigit(static_cast<unsigned char>(text_[at_ + 1])) != 0;
  }

  void blankTo(std::size_t end) {
    for (end = std::min(end, text_.size()); at_ < end; ++at_) {
      if (text_[at_] != '\n') {
        text_[at_] = ' ';
      }
    }
  }

  void blankLiteral() {
    if (at_ == 0 || text_[at_ - 1] != 'R') {
      blankQuoted('"');
      return;
    }
    const std::size_t open = text_.find('(', at_);
    if (open == std::string::npos) {
      blankTo(open);
      return;
    }
    const std::string close = ")" + text_.substr(at_ + 1, open - at_ - 1) + "\"";
    const std::size_t end = text_.find(close, open);
    blankTo(end == std::string::npos ? end : end + close.size());
  }

  void blankQuoted(char quote) {
    std::size_t end = at_ + 1;
    while (end < text_.size() && text_[end] != quote && text_[end] != '\n') {
      end += text_[end] == '\\' ? 2 : 1;
    }
    const std::size_t inner = at_ + 1;
    at_ = inner;
    blankTo(end);
    at_ = std::min(end + 1, text_.size());
  }

  std::string text_;
  std::size_t at_ = 0;
};

}  // namespace

std::string codeOnly(std::string_view cpp) {
  return Blanker(cpp).run();
}

std::vector<std::string_view> splitLines(std::string_view text) {
  std::vector<std::string_view> all;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    all.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return all;
}

std::vector<Include> includes(std::string_view cpp) {
  static const std::regex pattern(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
  // Blanking would take the quoted names away, so a directive counts when it survives as code.
  const std::string code = codeOnly(cpp);
  const std::vector<std::string_view> codeLines = splitLines(code);
  const std::vector<std::string_view> rawLines = splitLines(cpp);
  std::vector<Include> all;
  for (std::size_t i = 0; i < rawLines.size(); ++i) {
    std::match_results<std::string_view::const_iterator> match;
    if (codeLines[i].find('#') != std::string_view::npos &&
        std::regex_search(rawLines[i].begin(), rawLines[i].end(), match, pattern)) {
      all.push_back({i + 1, match[2].str(), match[1].str() == "<"});
    }
  }
  return all;
}

}  // namespace lorica::house
