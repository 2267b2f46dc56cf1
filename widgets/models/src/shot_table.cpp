#include "lorica/models/shot_table.h"

#include <algorithm>
#include <array>

#include "lorica/base/units.h"
#include "lorica/models/model_texts.h"
#include "lorica/models/numbers.h"

namespace lorica::models {

namespace {

struct Column {
  const char* csv;
  const char* title;
  const char* tip;
  QString ShotRow::*text;
};

constexpr std::array<Column, 11> columns{{
    {"structure", QT_TRANSLATE_NOOP("lorica::models::ShotTable", "Structure"), "", &ShotRow::structure},
    {"kind", QT_TRANSLATE_NOOP("lorica::models::ShotTable", "Kind"), "", &ShotRow::kind},
    {"system_or_model", QT_TRANSLATE_NOOP("lorica::models::ShotTable", "System or model"), "", &ShotRow::group},
    {"enter_mm", QT_TRANSLATE_NOOP("lorica::models::ShotTable", "Enter mm"),
     QT_TRANSLATE_NOOP("lorica::models::ShotTable", "From the start of the shot"), &ShotRow::enter},
    {"exit_mm", QT_TRANSLATE_NOOP("lorica::models::ShotTable", "Exit mm"),
     QT_TRANSLATE_NOOP("lorica::models::ShotTable", "From the start of the shot; an open mesh has no inside"),
     &ShotRow::exit},
    {"thickness_mm", QT_TRANSLATE_NOOP("lorica::models::ShotTable", "Thickness mm"),
     QT_TRANSLATE_NOOP("lorica::models::ShotTable", "Along the shot"), &ShotRow::thickness},
    {"normal_thickness_mm", QT_TRANSLATE_NOOP("lorica::models::ShotTable", "Normal mm"),
     QT_TRANSLATE_NOOP("lorica::models::ShotTable",
                       "Along the shot times the cosine of the angle at entry: the thickness of a plate"),
     &ShotRow::normalThickness},
    {"obliquity_in_deg", QT_TRANSLATE_NOOP("lorica::models::ShotTable", "In °"),
     QT_TRANSLATE_NOOP("lorica::models::ShotTable", "Angle between the shot and the surface's normal, at entry"),
     &ShotRow::obliquityIn},
    {"obliquity_out_deg", QT_TRANSLATE_NOOP("lorica::models::ShotTable", "Out °"),
     QT_TRANSLATE_NOOP("lorica::models::ShotTable", "Angle between the shot and the surface's normal, at the exit"),
     &ShotRow::obliquityOut},
    {"depth_mm", QT_TRANSLATE_NOOP("lorica::models::ShotTable", "Depth mm"),
     QT_TRANSLATE_NOOP("lorica::models::ShotTable", "From the first skin to the entry; negative before the skin"),
     &ShotRow::depth},
    {"protected", QT_TRANSLATE_NOOP("lorica::models::ShotTable", "Protected"),
     QT_TRANSLATE_NOOP("lorica::models::ShotTable", "Whether the shot meets armor of the system before"),
     &ShotRow::isProtected},
}};

QString millimetres(double metres) {
  return fixed(1000.0 * metres, 2);
}

bool armorBefore(std::span<const analysis::NamedPassage> passages, double enter) {
  return std::any_of(passages.begin(), passages.end(), [enter](const analysis::NamedPassage& other) {
    return other.kind == "armor" && other.passage.enter < enter;
  });
}

ShotRow rowOf(const analysis::NamedPassage& named, std::span<const analysis::NamedPassage> all) {
  const shotline::Passage& passage = named.passage;
  const QString none = QStringLiteral("-");
  ShotRow row;
  row.structure = QString::fromStdString(named.structure);
  row.kind = QString::fromStdString(named.kind);
  row.group = QString::fromStdString(named.group);
  row.enter = millimetres(passage.enter);
  row.exit = passage.closed ? millimetres(passage.exit) : QStringLiteral("open");
  row.thickness = passage.closed ? millimetres(passage.thickness()) : none;
  row.normalThickness = passage.closed ? millimetres(passage.normalThickness()) : none;
  row.obliquityIn = fixed(base::degrees(passage.obliquityIn), 1);
  row.obliquityOut = fixed(base::degrees(passage.obliquityOut), 1);
  row.depth = named.depth ? millimetres(*named.depth) : none;
  if (named.kind != "armor") {
    row.isProtected = armorBefore(all, passage.enter) ? ShotTable::tr("yes") : ShotTable::tr("no");
  }
  return row;
}

QString quoted(const QString& text) {
  if (!text.contains(u',') && !text.contains(u'"')) {
    return text;
  }
  return u'"' + QString(text).replace(u'"', QLatin1String("\"\"")) + u'"';
}

}  // namespace

std::vector<ShotRow> shotRows(const analysis::ShotDetails& shot, const study::Overlap& overlap,
                              const std::string& system, const std::string& model) {
  const std::vector<analysis::NamedPassage> passages = analysis::passagesUnder(shot.passages, system, model);
  std::vector<std::pair<double, ShotRow>> placed;
  for (const analysis::NamedPassage& passage : passages) {
    placed.emplace_back(passage.passage.enter, rowOf(passage, passages));
  }
  for (const shotline::Segment& segment : analysis::segmentsOf(overlap, passages)) {
    if (segment.owners.empty()) {
      ShotRow gap;
      gap.structure = ShotTable::tr("gap");
      gap.enter = millimetres(segment.from);
      gap.exit = millimetres(segment.to);
      gap.thickness = millimetres(segment.to - segment.from);
      placed.emplace_back(segment.from, std::move(gap));
    }
  }
  std::stable_sort(placed.begin(), placed.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<ShotRow> rows;
  for (auto& [begin, row] : placed) {
    rows.push_back(std::move(row));
  }
  return rows;
}

QString shotSummary(const analysis::ShotDetails& shot, const std::string& system, const std::string& model) {
  const std::vector<analysis::NamedPassage> passages = analysis::passagesUnder(shot.passages, system, model);
  QStringList armor;
  QStringList organs;
  const analysis::NamedPassage* first = nullptr;
  for (const analysis::NamedPassage& passage : passages) {
    QStringList& names = passage.kind == "armor" ? armor : organs;
    const QString name = QString::fromStdString(passage.structure);
    if (passage.kind != "body" && !names.contains(name)) {
      names.append(name);
    }
    first = first == nullptr && passage.kind == "organ" ? &passage : first;
  }
  const auto list = [](const QStringList& names) {
    return names.isEmpty() ? ShotTable::tr("none") : names.join(QStringLiteral(", "));
  };
  if (passages.empty()) {
    return ShotTable::tr("The shot crosses nothing.");
  }
  QString text = ShotTable::tr("Armor in order: %1. Organs in order: %2.").arg(list(armor), list(organs));
  if (first != nullptr) {
    text += armorBefore(passages, first->passage.enter) ? ShotTable::tr(" Armor comes before the first organ.")
                                                        : ShotTable::tr(" Nothing protects the first organ.");
  }
  return text;
}

void ShotTable::setRows(std::vector<ShotRow> rows) {
  beginResetModel();
  rows_ = std::move(rows);
  endResetModel();
}

int ShotTable::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(rows_.size());
}

int ShotTable::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(columns.size());
}

QVariant ShotTable::data(const QModelIndex& index, int role) const {
  if (!checkIndex(index, CheckIndexOption::IndexIsValid)) {
    return {};
  }
  const auto column = static_cast<std::size_t>(index.column());
  const ShotRow& row = rows_[static_cast<std::size_t>(index.row())];
  const QString& text = row.*columns[column].text;
  if (role == Qt::DisplayRole || role == Qt::ToolTipRole) {
    const bool isModel = columns[column].text == &ShotRow::group && row.kind == QLatin1String("organ");
    return isModel ? modelFromFile(text.toStdString()) : text;
  }
  if (role == Qt::TextAlignmentRole) {
    const bool number = column >= 3 && column + 1 < columns.size();
    return QVariant::fromValue(Qt::AlignVCenter | (number ? Qt::AlignRight : Qt::AlignLeft));
  }
  return {};
}

QVariant ShotTable::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal || section < 0 || section >= static_cast<int>(columns.size())) {
    return {};
  }
  const Column& column = columns[static_cast<std::size_t>(section)];
  if (role == Qt::DisplayRole) {
    return tr(column.title);
  }
  return role == Qt::ToolTipRole && *column.tip != '\0' ? QVariant(tr(column.tip)) : QVariant();
}

QString ShotTable::csv() const {
  QStringList lines;
  QStringList names;
  for (const Column& column : columns) {
    names.append(QString::fromLatin1(column.csv));
  }
  lines.append(names.join(u','));
  for (const ShotRow& row : rows_) {
    QStringList cells;
    for (const Column& column : columns) {
      const QString& text = row.*column.text;
      cells.append(text == u"-" ? QString() : quoted(text));
    }
    lines.append(cells.join(u','));
  }
  return lines.join(u'\n') + u'\n';
}

}  // namespace lorica::models
