#include "lorica/stats/philox.h"

namespace lorica::stats {

std::uint32_t sourceId(std::string_view name) {
  std::uint32_t hash = 0x811C9DC5U;
  for (const char letter : name) {
    hash = (hash ^ static_cast<unsigned char>(letter)) * 0x01000193U;
  }
  return hash;
}

}  // namespace lorica::stats
