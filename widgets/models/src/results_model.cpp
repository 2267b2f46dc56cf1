#include "lorica/models/results_model.h"

#include "lorica/base/error.h"
#include "lorica/models/model_texts.h"
#include "lorica/models/numbers.h"

namespace lorica::models {

using analysis::ResultRow;
using Model = ResultsModel;

namespace {

QString textOf(const ResultRow& row, int column) {
  switch (column) {
    case Model::sourceColumn:
      return QString::fromStdString(row.source);
    case Model::systemColumn:
      return QString::fromStdString(row.system);
    case Model::modelColumn:
      return QString::fromStdString(row.model);
    case Model::poseColumn:
      return QString::fromStdString(row.pose);
    case Model::structureColumn:
      return QString::fromStdString(row.structure);
    case Model::kindColumn:
      return QString::fromStdString(row.kind);
    default:
      return QString::fromStdString(row.injuryClass);
  }
}

std::uint64_t countOf(const ResultRow& row, int column) {
  switch (column) {
    case Model::shotsColumn:
      return row.shots;
    case Model::anyColumn:
      return row.count.any;
    case Model::firstColumn:
      return row.count.first;
    case Model::unprotectedColumn:
      return row.unprotected();
    default:
      return row.count.shielded;
  }
}

std::optional<double> shareOf(const ResultRow& row, int column) {
  const std::optional<stats::Interval> interval = row.coverageInterval();
  switch (column) {
    case Model::ofShotsColumn:
      return row.percentOfShots();
    case Model::ofBodyHitsColumn:
      return row.percentOfBodyHits();
    case Model::coverageColumn:
      return row.coverage();
    case Model::lowColumn:
      return interval ? std::optional(interval->low) : std::nullopt;
    default:
      return interval ? std::optional(interval->high) : std::nullopt;
  }
}

bool isText(int column) {
  return column < Model::shotsColumn;
}
bool isCount(int column) {
  return column >= Model::shotsColumn && column < Model::ofShotsColumn;
}
bool isFraction(int column) {
  return column >= Model::coverageColumn;
}

}  // namespace

std::optional<document::ItemRef> itemOf(const ResultRow& row) {
  using document::ItemKind;
  if (row.kind == "organ") {
    return document::ItemRef{ItemKind::organ, row.structure};
  }
  if (row.kind == "armor") {
    return document::ItemRef{ItemKind::piece, row.structure};
  }
  if (row.kind == "region") {
    return document::ItemRef{ItemKind::region, row.structure};
  }
  if (row.kind == "body" && row.structure == "body") {
    return document::ItemRef{ItemKind::body, ""};
  }
  return std::nullopt;
}

ResultsModel::ResultsModel(QObject* parent) : QAbstractTableModel(parent) {}

void ResultsModel::setRecord(std::shared_ptr<const document::RunRecord> record) {
  beginResetModel();
  record_ = std::move(record);
  endResetModel();
}

QStringList ResultsModel::distinct(Column column) const {
  LORICA_CHECK(isText(column), "a column of text is needed");
  QStringList texts;
  for (int r = 0; r < rowCount(); ++r) {
    const QString text = textOf(row(r), column);
    if (!texts.contains(text)) {
      texts.append(text);
    }
  }
  return texts;
}

QByteArray ResultsModel::csv(const std::vector<int>& rows) const {
  std::vector<ResultRow> chosen;
  chosen.reserve(rows.size());
  for (const int r : rows) {
    chosen.push_back(row(r));
  }
  return QByteArray::fromStdString(analysis::summaryCsv(chosen));
}

int ResultsModel::rowCount(const QModelIndex& parent) const {
  return parent.isValid() || record_ == nullptr ? 0 : static_cast<int>(record_->summary.size());
}

int ResultsModel::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : columnTotal;
}

QVariant ResultsModel::data(const QModelIndex& index, int role) const {
  if (!checkIndex(index, CheckIndexOption::IndexIsValid | CheckIndexOption::ParentIsInvalid)) {
    return {};
  }
  const ResultRow& here = row(index.row());
  const int column = index.column();
  if (role == itemRole) {
    const std::optional<document::ItemRef> item = itemOf(here);
    return item ? QVariant::fromValue(*item) : QVariant();
  }
  if (role == Qt::TextAlignmentRole) {
    return QVariant((isText(column) ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
  }
  if (isText(column)) {
    // The tooltip as well: a narrow column cuts long names.
    const bool shows = role == Qt::DisplayRole || role == Qt::ToolTipRole;
    if (shows && column == modelColumn) {
      return modelFromFile(here.model);
    }
    return shows || role == rawRole ? textOf(here, column) : QVariant();
  }
  if (role != Qt::DisplayRole && role != rawRole) {
    return {};
  }
  if (isCount(column)) {
    const std::uint64_t count = countOf(here, column);
    return role == rawRole ? QVariant(static_cast<qulonglong>(count)) : QVariant(grouped(count));
  }
  const std::optional<double> share = shareOf(here, column);
  if (!share) {
    return {};
  }
  if (role == rawRole) {
    return *share;
  }
  return isFraction(column) ? fixed(100.0 * *share, 1) : fixed(*share, 2);
}

QVariant ResultsModel::headerData(int section, Qt::Orientation orientation, int role) const {
  struct Heading {
    QString title;
    QString meaning;
  };
  if (orientation != Qt::Horizontal || section < 0 || section >= columnTotal) {
    return {};
  }
  if (role == Qt::TextAlignmentRole) {
    return QVariant((isText(section) ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
  }
  if (role != Qt::DisplayRole && role != Qt::ToolTipRole) {
    return {};
  }
  const std::array<Heading, columnTotal> headings{{
      {tr("Source"), tr("The source of the shots.")},
      {tr("System"), tr("The armor system; \"unarmored\" is the body without any.")},
      {tr("Model"), tr("The model of the organs. Rows of body, regions and armor do not depend on it and repeat.")},
      {tr("Pose"), tr("The pose: rest, a pose of the study, or a clip at a time in seconds.")},
      {tr("Structure"),
       tr("What is counted. \"miss\": shots that do not cross the skin. \"organs\" and \"armor\": any of "
          "them, each shot once.")},
      {tr("Kind"), tr("What sort of thing that is: body, region of the skin, organ, armor piece, or aggregate.")},
      {tr("Class"), tr("Injury class of the organ: essential, desirable or none.")},
      {tr("Shots"), tr("All shots of this source at this pose, over all trials.")},
      {tr("Any hit"), tr("Shots that cross the structure. One shot can cross many: do not add these up.")},
      {tr("First hit"), tr("Shots that meet it first. Body and regions: the skin, before any armor. Organs: before any "
                           "other organ, skin and armor ignored. Armor: before the skin.")},
      {tr("Unprotected"), tr("Any hits without armor in front.")},
      {tr("Protected"), tr("Any hits that cross armor of this system before the structure. For a piece of armor: "
                           "another piece.")},
      {tr("% of shots"), tr("Any hits in percent of all shots. Depends on how tightly the source is aimed.")},
      {tr("% of body hits"), tr("Share of the shots that hit the body which also cross the structure, in percent.")},
      {tr("Coverage %"), tr("Protected hits in percent of any hits. Blank without a hit. It says whether armor is met "
                            "first, not whether it stops anything.")},
      {tr("Low %"), tr("Lower end of the coverage's 95 % interval (Wilson), in percent. It holds the uncertainty from "
                       "the number of shots alone.")},
      {tr("High %"), tr("Upper end of the coverage's 95 % interval (Wilson), in percent. It holds the uncertainty from "
                        "the number of shots alone.")},
  }};
  const Heading& heading = headings[static_cast<std::size_t>(section)];
  return role == Qt::DisplayRole ? heading.title : heading.meaning;
}

ResultsFilter::ResultsFilter(QObject* parent) : QSortFilterProxyModel(parent) {}

void ResultsFilter::setWanted(ResultsModel::Column column, const QString& text) {
  LORICA_CHECK(isText(column), "a column of text is needed");
  wanted_[static_cast<std::size_t>(column)] = text;
  invalidateFilter();
}

void ResultsFilter::setText(const QString& text) {
  text_ = text.trimmed();
  invalidateFilter();
}

std::vector<int> ResultsFilter::shownRows() const {
  std::vector<int> rows;
  for (int r = 0; r < rowCount(); ++r) {
    rows.push_back(mapToSource(index(r, 0)).row());
  }
  return rows;
}

bool ResultsFilter::filterAcceptsRow(int row, const QModelIndex& parent) const {
  const auto textAt = [&](int column) {
    return sourceModel()->index(row, column, parent).data(Model::rawRole).toString();
  };
  for (int column = 0; column < Model::shotsColumn; ++column) {
    const QString& wanted = wanted_[static_cast<std::size_t>(column)];
    if (!wanted.isEmpty() && wanted != textAt(column)) {
      return false;
    }
  }
  return text_.isEmpty() || textAt(Model::structureColumn).contains(text_, Qt::CaseInsensitive) ||
         textAt(Model::classColumn).contains(text_, Qt::CaseInsensitive);
}

bool ResultsFilter::lessThan(const QModelIndex& left, const QModelIndex& right) const {
  const QVariant a = left.data(Model::rawRole);
  const QVariant b = right.data(Model::rawRole);
  const auto isBlank = [](const QVariant& value) { return !value.isValid() || value.toString().isEmpty(); };
  if (isBlank(a) || isBlank(b)) {
    // Descending order asks with the sides swapped.
    return sortOrder() == Qt::AscendingOrder ? !isBlank(a) && isBlank(b) : isBlank(a) && !isBlank(b);
  }
  if (isText(left.column())) {
    return a.toString().compare(b.toString(), Qt::CaseInsensitive) < 0;
  }
  return isCount(left.column()) ? a.toULongLong() < b.toULongLong() : a.toDouble() < b.toDouble();
}

}  // namespace lorica::models
