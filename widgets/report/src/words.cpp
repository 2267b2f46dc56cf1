#include "words.h"

#include <QCoreApplication>
#include <QStringList>
#include <cmath>

#include "lorica/models/model_texts.h"
#include "lorica/models/numbers.h"

namespace lorica::report {

namespace {

struct Text {
  Q_DECLARE_TR_FUNCTIONS(lorica::report)
};

const QString dash = QStringLiteral("\u2013");

std::optional<double> difference(std::optional<double> share) {
  return share ? std::optional(100.0 * *share) : std::nullopt;
}

}  // namespace

QString modelLabel(const std::string& model) {
  const auto known = viscera::organModelNamed(model);
  for (const models::ModelText& one : models::modelTexts()) {
    if (known == one.model) {
      return one.label;
    }
  }
  return text(model);
}

QString structureLabel(const std::string& structure, const std::string& kind) {
  if (kind == "class") {
    return structure == "essential" ? Text::tr("Essential organs") : Text::tr("Desirable organs");
  }
  if (kind == "aggregate") {
    return structure == "organs" ? Text::tr("All organs") : Text::tr("Armor");
  }
  return kind == "body" && structure == "body" ? Text::tr("Whole body") : text(structure);
}

QString number(std::optional<double> value, int decimals, bool sign) {
  if (!value) {
    return dash;
  }
  QString digits = models::fixed(std::abs(*value), decimals);
  const bool zero = digits.toDouble() == 0.0;
  if (!zero && *value < 0.0) {
    digits.prepend(QChar(0x2212));
  } else if (!zero && sign) {
    digits.prepend(u'+');
  }
  return digits;
}

QString percent(std::optional<double> share) {
  return number(difference(share), 1);
}

QString range(const analysis::Coverage& coverage) {
  return coverage.low && coverage.high ? percent(coverage.low) + dash + percent(coverage.high) : QString();
}

QString percentWithRange(const analysis::Coverage& coverage) {
  if (!coverage.value) {
    return dash;
  }
  const QString interval = range(coverage);
  return interval.isEmpty() ? QStringLiteral("%1 %").arg(percent(coverage.value))
                            : QStringLiteral("%1 % (%2)").arg(percent(coverage.value), interval);
}

QString points(std::optional<double> share) {
  return number(difference(share), 1, true);
}

QString probability(std::optional<double> p) {
  if (!p) {
    return dash;
  }
  return *p < 0.001 ? QStringLiteral("< 0.001") : models::fixed(*p, 3);
}

QString listed(std::span<const std::string> names, std::size_t most) {
  if (names.empty()) {
    return Text::tr("none");
  }
  QStringList shown;
  for (std::size_t i = 0; i < names.size() && (i < most || names.size() == most + 1); ++i) {
    shown.push_back(text(names[i]));
  }
  const auto rest = names.size() - static_cast<std::size_t>(shown.size());
  const QString all = shown.join(QStringLiteral(", "));
  return rest == 0 ? all : Text::tr("%1 and %2 more").arg(all, QString::number(rest));
}

QString shortHash(const std::string& hash) {
  return hash.empty() ? Text::tr("no hash") : text(hash.substr(0, 12));
}

}  // namespace lorica::report
