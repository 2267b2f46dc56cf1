#include "lorica/models/numbers.h"

#include "lorica/base/readable.h"

namespace lorica::models {

QString grouped(std::uint64_t count) {
  return QString::fromStdString(base::readableCount(count));
}

QString fixed(double value, int decimals) {
  return QString::number(value, 'f', decimals);
}

}  // namespace lorica::models
