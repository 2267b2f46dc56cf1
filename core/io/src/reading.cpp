#include "reading.h"

#include <algorithm>

namespace lorica::io {

namespace {

bool isContinuationByte(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

}  // namespace

std::string oneLine(std::string_view text, std::size_t limit) {
  if (text.size() > limit) {
    while (limit > 0 && isContinuationByte(text[limit])) {
      --limit;
    }
    text = text.substr(0, limit);
  }
  std::string line(text);
  std::replace_if(
      line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20U || c == 0x7F; }, ' ');
  const std::size_t begin = line.find_first_not_of(' ');
  return begin == std::string::npos ? "" : line.substr(begin, line.find_last_not_of(' ') - begin + 1);
}

}  // namespace lorica::io
