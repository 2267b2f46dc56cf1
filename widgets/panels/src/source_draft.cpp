#include <QLocale>

#include "item_form_parts.h"
#include "lorica/base/error.h"
#include "lorica/commands/shot_edits.h"
#include "lorica/panels/shot_forms.h"

namespace lorica::panels {

namespace {

/// A sentence of the core as people read it.
QString asSentence(const std::string& text) {
  QString sentence = QString::fromStdString(text);
  if (!sentence.isEmpty()) {
    sentence[0] = sentence[0].toUpper();
  }
  return sentence.endsWith(u'.') ? sentence : sentence + u'.';
}

/// The field of a form that a place in the study file belongs to, such as /sources/0/target_structure.
QString fieldOfPlace(const QString& place) {
  const QString key = place.section(u'/', 3, 3);
  if (key == u"target_structure") {
    return QStringLiteral("target");
  }
  return key == u"cell_mm" ? QStringLiteral("cell") : QStringLiteral("position");
}

/// Whether a plan of one is a plan of the other.
bool sameAim(study::Source a, const study::Source& b) {
  a.shots = b.shots;
  a.description = b.description;
  return a == b;
}

}  // namespace

SourceDraft::SourceDraft(document::StudyDocument& document, std::function<std::string()> name)
    : document_(document), name_(std::move(name)) {}

void SourceDraft::settle() {
  const study::Source* now = findNamed(document_.study().sources, name_());
  if (draft_ && (now == nullptr || *now != base_)) {
    draft_.reset();
    troubles_.clear();
  }
}

const study::Source& SourceDraft::source() {
  static const study::Source none;
  settle();
  if (draft_) {
    return *draft_;
  }
  const study::Source* now = findNamed(document_.study().sources, name_());
  return now == nullptr ? none : *now;
}

bool SourceDraft::isPending() {
  settle();
  return draft_.has_value();
}

QString SourceDraft::troubleOf(const QString& field) {
  settle();
  if (const auto found = troubles_.find(field); found != troubles_.end()) {
    return found->second;
  }
  const auto& plan = document_.plan();
  if (draft_ || plan == nullptr || !plan->trouble) {
    return {};
  }
  const auto& sources = plan->study->study.sources;
  const QString place = QString::fromStdString(plan->trouble->place);
  const std::size_t index = place.section(u'/', 2, 2).toULongLong();
  const bool mine = place.startsWith(u"/sources/") && index < sources.size() && sources[index].name == name_() &&
                    sameAim(sources[index], source());
  return mine && fieldOfPlace(place) == field ? asSentence(plan->trouble->text) : QString();
}

void SourceDraft::edit(const QString& field, const QString& label, const std::function<void(study::Source&)>& change,
                       Drag drag) {
  const study::Source* now = findNamed(document_.study().sources, name_());
  if (now == nullptr) {
    return;
  }
  study::Source wanted = source();
  change(wanted);
  wanted = commands::asWritten(std::move(wanted));
  const std::vector<commands::FieldTrouble> found = commands::sourceTroubles(wanted);
  troubles_.clear();
  if (found.empty()) {
    draft_.reset();
    commands::setSource(document_, now->name, wanted, field, Text::tr("%1 of source %2").arg(label, shown(now->name)),
                        drag == Drag::yes ? commands::Merge::yes : commands::Merge::no);
  } else {
    base_ = *now;
    draft_ = std::move(wanted);
    for (const commands::FieldTrouble& one : found) {
      troubles_.emplace(one.field, one.sentence);
    }
  }
  if (told_) {
    told_();
  }
}

void SourceDraft::setFile(const QString& file) {
  try {
    const study::InputFile input = commands::shotListInput(document_, file.toStdU16String());
    edit("file", Text::tr("File"), [&](study::Source& source) { source.list = input; });
  } catch (const base::InputError& error) {
    const study::Source* now = findNamed(document_.study().sources, name_());
    if (now == nullptr) {
      return;
    }
    study::Source wanted = source();
    wanted.list = {file.toStdString(), {}, {}, {}};
    base_ = *now;
    draft_ = std::move(wanted);
    troubles_ = {
        {QStringLiteral("file"), asSentence((error.place().empty() ? "" : error.place() + ": ") + error.text())}};
    if (told_) {
      told_();
    }
  }
}

QString measureText(const shotline::Measure& measure) {
  switch (measure.basis) {
    case shotline::Basis::solidAngle:
      return Text::tr("%1 sr of solid angle").arg(QLocale::c().toString(measure.total, 'g', 4));
    case shotline::Basis::area:
      return Text::tr("%1 m² of presented area").arg(QLocale::c().toString(measure.total, 'g', 4));
    case shotline::Basis::shots:
      break;
  }
  return {};
}

const analysis::ShotSource* plannedSource(const document::StudyDocument& document, const std::string& name) {
  const auto& plan = document.plan();
  const study::Source* now = findNamed(document.study().sources, name);
  if (plan == nullptr || now == nullptr) {
    return nullptr;
  }
  const auto& planned = plan->study->study.sources;
  for (std::size_t i = 0; i < std::min(planned.size(), plan->result.sources.size()); ++i) {
    if (planned[i].name == name && sameAim(planned[i], *now)) {
      return &plan->result.sources[i];
    }
  }
  return nullptr;
}

}  // namespace lorica::panels
