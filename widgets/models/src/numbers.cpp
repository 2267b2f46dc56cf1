#include "lorica/models/numbers.h"

#include <QLocale>

namespace lorica::models {

QString grouped(std::uint64_t count) {
  static const QLocale english(QLocale::English, QLocale::UnitedStates);
  return english.toString(static_cast<qulonglong>(count));
}

QString fixed(double value, int decimals) {
  return QString::number(value, 'f', decimals);
}

}  // namespace lorica::models
