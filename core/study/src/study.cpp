#include "lorica/study/study.h"

#include <charconv>
#include <cmath>

namespace lorica::study {

std::optional<ClipPose> clipPoseNamed(std::string_view text) {
  const std::size_t at = text.rfind('@');
  if (at == std::string_view::npos || at == 0) {
    return std::nullopt;
  }
  const std::string_view seconds = text.substr(at + 1);
  if (seconds.empty() || seconds.front() == '-') {
    return std::nullopt;
  }
  ClipPose pose{std::string(text.substr(0, at)), 0.0};
  const auto [end, failure] = std::from_chars(seconds.data(), seconds.data() + seconds.size(), pose.seconds);
  if (failure != std::errc() || end != seconds.data() + seconds.size() || !std::isfinite(pose.seconds)) {
    return std::nullopt;
  }
  return pose;
}

}  // namespace lorica::study
