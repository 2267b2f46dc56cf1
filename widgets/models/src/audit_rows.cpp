/// \file
/// Builds the rows of the deformation audit's tables.

#include <QCoreApplication>
#include <algorithm>
#include <set>

#include "lorica/models/audit_table.h"

#include "lorica/models/model_texts.h"

namespace lorica::models {

namespace {

using analysis::DeformationTables;
using analysis::ModelDeformation;
using viscera::AuditBasis;
using viscera::ContactAudit;
using viscera::OrganAudit;

struct Text {
  Q_DECLARE_TR_FUNCTIONS(lorica::models)
};

constexpr double percent = 100.0;
constexpr double millimetres = 1e3;
constexpr double cubicCentimetres = 1e6;

QString shown(const std::string& text) {
  return QString::fromStdString(text);
}

/// Names hold no line ends, so a line is a row.
QByteArrayList linesOf(const std::string& csv) {
  QByteArrayList lines = QByteArray::fromStdString(csv).split('\n');
  lines.removeLast();
  for (QByteArray& line : lines) {
    line.append('\n');
  }
  return lines;
}

AuditCell cell(std::optional<double> value, double scale, const QString& why) {
  return value ? AuditCell{*value * scale, {}} : AuditCell{std::nullopt, why};
}

AuditCell cell(const std::optional<viscera::Estimate>& estimate, double scale, const QString& unit,
               const QString& why) {
  if (!estimate) {
    return {std::nullopt, why};
  }
  return {estimate->value * scale,
          Text::tr("Sampled; standard error %1%2").arg(QString::number(estimate->error * scale, 'g', 2), unit)};
}

QString noVolume() {
  return Text::tr("Made of open patches that enclose no volume: only its surface can be measured.");
}

QString basisTip(AuditBasis basis) {
  switch (basis) {
    case AuditBasis::closed:
      return Text::tr("A closed surface: everything can be measured.");
    case AuditBasis::closedParts:
      return Text::tr("Nearly closed: volume and overlap are those of its closed parts.");
    case AuditBasis::surface:
      return noVolume();
  }
  return {};
}

std::vector<AuditCell> organCells(const OrganAudit& organ, const viscera::LatticeQuality& lattice) {
  const bool open = organ.basis == AuditBasis::surface;
  const QString openSkin = Text::tr("The skin does not close: nothing can be told to lie beyond it.");
  const QString rigid = Text::tr("A rigid organ has no lattice.");
  const QString noTouch = Text::tr("It touched no other organ at rest.");
  std::vector<AuditCell> cells(measureTotal);
  const auto put = [&](Measure measure, AuditCell made) { cells[static_cast<std::size_t>(measure)] = std::move(made); };
  put(Measure::volume, cell(organ.volumeChange, percent, noVolume()));
  put(Measure::outside, cell(organ.outsideShare, percent, QStringLiteral(" %"), open ? noVolume() : openSkin));
  put(Measure::protrusion, cell(organ.protrusion, millimetres, openSkin));
  put(Measure::overlap, cell(organ.overlap, cubicCentimetres, Text::tr(" cm³"), noVolume()));
  put(Measure::gap, cell(organ.gap ? std::optional(organ.gap->mean) : std::nullopt, millimetres, noTouch));
  if (organ.gap) {
    cells[static_cast<std::size_t>(Measure::gap)].why =
        Text::tr("Largest %1 mm").arg(millimetres * organ.gap->largest, 0, 'f', 1);
  }
  const bool hasCells = lattice.cells > 0;
  put(Measure::inverted,
      cell(hasCells ? std::optional(static_cast<double>(lattice.inverted)) : std::nullopt, 1.0, rigid));
  put(Measure::jacobian, cell(hasCells ? std::optional(lattice.smallestJacobian) : std::nullopt, 1.0, rigid));
  put(Measure::stretch, cell(organ.largestStretch, 1.0, {}));
  return cells;
}

using Pair = std::pair<std::size_t, std::size_t>;

/// What the file has for a pair in a pose: that of two organs that do not meet, where the audit has none.
ContactAudit contactOf(const viscera::PoseAudit& audit, const Pair& pair) {
  const auto found = std::find_if(audit.contacts.begin(), audit.contacts.end(), [&](const ContactAudit& contact) {
    return Pair(contact.first, contact.second) == pair;
  });
  if (found != audit.contacts.end()) {
    return *found;
  }
  ContactAudit none{pair.first, pair.second, {}, {}, {}};
  if (audit.organs[pair.first].volume && audit.organs[pair.second].volume) {
    none.overlap = viscera::Estimate{};
    none.overlapBeyondRest = 0.0;
  }
  return none;
}

std::vector<AuditColumn> textColumns(const QStringList& things) {
  std::vector<AuditColumn> columns;
  for (const QString& thing : things) {
    columns.push_back({thing, {}, 0});
  }
  columns.push_back({Text::tr("Model"), Text::tr("The model that moves the organ."), 0});
  columns.push_back({Text::tr("Pose"), Text::tr("The pose that was measured."), 0});
  return columns;
}

}  // namespace

MeasureText textOf(Measure measure) {
  switch (measure) {
    case Measure::volume:
      return {measure, Text::tr("Volume %"), Text::tr("Change of the organ's volume against rest, in percent."),
              Text::tr(" %"), 2};
    case Measure::outside:
      return {measure, Text::tr("Outside %"),
              Text::tr("Share of the organ's volume outside the posed skin, in percent."), Text::tr(" %"), 2};
    case Measure::protrusion:
      return {measure, Text::tr("Protrusion mm"),
              Text::tr("How far the organ's farthest point lies beyond the posed skin."), Text::tr(" mm"), 1};
    case Measure::overlap:
      return {measure, Text::tr("Overlap cm³"), Text::tr("Volume that the organ shares with other organs."),
              Text::tr(" cm³"), 1};
    case Measure::gap:
      return {measure, Text::tr("Gap mm"),
              Text::tr("Mean distance that opened where the organ touched another one at rest."), Text::tr(" mm"), 2};
    case Measure::inverted:
      return {measure, Text::tr("Inverted"), Text::tr("Cells of the organ's lattice that turned inside out."), {}, 0};
    case Measure::jacobian:
      return {measure,
              Text::tr("Jacobian"),
              Text::tr("Smallest Jacobian: volume now over volume at rest where the lattice is squeezed most; 1 is no "
                       "change, 0 or less is "
                       "inside out."),
              {},
              3};
    case Measure::stretch:
      return {measure,
              Text::tr("Stretch"),
              Text::tr("Length now over length at rest of the edge of the organ's surface that is stretched most."),
              {},
              3};
  }
  return {};
}

AuditTableData organTable(const DeformationTables& tables) {
  AuditTableData data;
  data.columns = textColumns({Text::tr("Organ")});
  data.textColumns = static_cast<int>(data.columns.size());
  for (int m = 0; m < measureTotal; ++m) {
    const MeasureText text = textOf(static_cast<Measure>(m));
    const auto worse = text.measure == Measure::volume     ? AuditColumn::Worse::fartherFromZero
                       : text.measure == Measure::jacobian ? AuditColumn::Worse::smaller
                                                           : AuditColumn::Worse::larger;
    data.columns.push_back({text.title, text.meaning, text.decimals, worse});
  }
  const QByteArrayList lines = linesOf(analysis::deformationCsv(tables));
  data.csvHeader = lines.front();
  for (const ModelDeformation* from : analysis::rowsInOrder(tables)) {
    for (std::size_t o = 0; o < from->audit.organs.size(); ++o) {
      AuditRow row;
      row.texts = {shown(tables.organs[o]), modelLabel(tables.models[from->model]), shown(tables.poses[from->pose])};
      row.cells = organCells(from->audit.organs[o], from->lattices[o]);
      row.item = {document::ItemKind::organ, tables.organs[o]};
      row.tip = basisTip(from->audit.organs[o].basis);
      const std::string gaveWay = analysis::gaveWay(tables.organs[o], from->audit.organs[o], from->lattices[o]);
      if (!gaveWay.empty()) {
        row.tip += Text::tr("\nGave way: %1").arg(shown(gaveWay));
      }
      row.csv = lines[static_cast<qsizetype>(data.rows.size()) + 1];
      data.rows.push_back(std::move(row));
    }
  }
  return data;
}

AuditTableData contactTable(const DeformationTables& tables) {
  AuditTableData data;
  data.columns = textColumns({Text::tr("Organ"), Text::tr("and")});
  data.textColumns = static_cast<int>(data.columns.size());
  data.columns.push_back({Text::tr("Overlap cm³"), Text::tr("Volume that the two organs share."), 2});
  data.columns.push_back(
      {Text::tr("Beyond rest cm³"), Text::tr("How much of that they did not share at rest already."), 2});
  data.columns.push_back({Text::tr("Gap mm"), Text::tr("Mean distance that opened where they touched at rest."), 2});
  data.columns.push_back({Text::tr("Largest gap mm"), Text::tr("Largest distance that opened there."), 1});
  std::set<Pair> pairs;
  for (const ModelDeformation& row : tables.rows) {
    for (const ContactAudit& contact : row.audit.contacts) {
      pairs.emplace(contact.first, contact.second);
    }
  }
  const QByteArrayList lines = linesOf(analysis::contactsCsv(tables));
  data.csvHeader = lines.front();
  const QString open = Text::tr("One of the two is made of open patches that enclose no volume.");
  const QString noTouch = Text::tr("They did not touch at rest.");
  for (const ModelDeformation* from : analysis::rowsInOrder(tables)) {
    for (const Pair& pair : pairs) {
      const ContactAudit contact = contactOf(from->audit, pair);
      const auto& gap = contact.gap;
      AuditRow row;
      row.texts = {shown(tables.organs[pair.first]), shown(tables.organs[pair.second]),
                   modelLabel(tables.models[from->model]), shown(tables.poses[from->pose])};
      row.cells = {cell(contact.overlap, cubicCentimetres, Text::tr(" cm³"), open),
                   cell(contact.overlapBeyondRest, cubicCentimetres, open),
                   cell(gap ? std::optional(gap->mean) : std::nullopt, millimetres, noTouch),
                   cell(gap ? std::optional(gap->largest) : std::nullopt, millimetres, noTouch)};
      row.item = {document::ItemKind::organ, tables.organs[pair.first]};
      row.csv = lines[static_cast<qsizetype>(data.rows.size()) + 1];
      data.rows.push_back(std::move(row));
    }
  }
  return data;
}

}  // namespace lorica::models
