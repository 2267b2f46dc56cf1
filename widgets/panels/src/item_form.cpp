#include "item_form.h"

#include <QPushButton>

#include "item_form_parts.h"
#include "item_forms.h"
#include "lorica/commands/edits.h"
#include "lorica/panels/shot_forms.h"

namespace lorica::panels {

using document::ItemKind;
using document::ItemRef;
using document::StudyDocument;

namespace {

void fillStudy(PropertyForm& form) {
  StudyDocument& document = form.document();
  form.section(Text::tr("Study"));
  form.line(
      {"name", Text::tr("Name")}, [&document] { return shown(document.study().name); },
      [&document](const QString& name) { commands::setStudyName(document, name.toStdString()); });
  form.paragraph(
      {"description", Text::tr("Description")}, [&document] { return shown(document.study().description); },
      [&document](const QString& text) { commands::setStudyDescription(document, text.toStdString()); });
  form.section(Text::tr("Run"));
  addRunRows(form);
  addStopRows(form);
  form.section(Text::tr("Analyses"));
  addAnalysesRows(form);
  form.section(Text::tr("Body"));
  using study::Deformer;
  form.choice(
      {"deformer", Text::tr("Organs deform"), Text::tr("What the model \"Dynamic\" stands for")},
      [] {
        return std::vector<Choice>{
            {Text::tr("As one soft body"), QString::number(int(Deformer::softBody)),
             Text::tr("All together: they keep their volume and their contacts, and stay inside the skin")},
            {Text::tr("Each by itself"), QString::number(int(Deformer::lattice)),
             Text::tr("By a lattice that follows blended interior sites: plain, and several times faster")}};
      },
      [&document] { return QString::number(int(document.study().deformer)); },
      [&document](const QString& id) { commands::setDeformer(document, Deformer(id.toInt())); });
  form.fact({"spacing", Text::tr("Interior sites")},
            [&document] { return Text::tr("%1 mm apart").arg(readable(1000.0 * document.study().siteSpacing, 1)); });
}

QString turnsText(const study::TurnedPose& pose) {
  QStringList lines;
  for (const study::TurnedPose::Turn& turn : pose.turns) {
    lines.append(Text::tr("%1: x %2°, y %3°, z %4°")
                     .arg(shown(turn.joint), readable(turn.degrees.x(), 2), readable(turn.degrees.y(), 2),
                          readable(turn.degrees.z(), 2)));
  }
  if (pose.rootOffset != geometry::Vec3d::Zero()) {
    lines.append(
        Text::tr("moved by %1, %2, %3 m")
            .arg(readable(pose.rootOffset.x(), 3), readable(pose.rootOffset.y(), 3), readable(pose.rootOffset.z(), 3)));
  }
  return lines.isEmpty() ? Text::tr("none") : lines.join(u'\n');
}

void fillPose(PropertyForm& form, const std::string& name) {
  StudyDocument& document = form.document();
  const auto pose = [&document, name]() -> const study::Pose& { return namedOrNone(document.study().poses, name); };
  form.section(Text::tr("Pose"));
  addNameRow(form, {ItemKind::pose, name});
  if (name != "rest") {
    addDescriptionRow(form, {ItemKind::pose, name}, [pose] { return pose().description; });
  }
  if (name == "rest") {
    form.note({"what", QLatin1String("")}, [] { return Text::tr("The body as it was made."); });
  } else if (std::holds_alternative<study::ClipPose>(pose().what)) {
    const auto clip = [pose] {
      const auto* moment = std::get_if<study::ClipPose>(&pose().what);
      return moment == nullptr ? study::ClipPose{} : *moment;
    };
    form.fact({"clip", Text::tr("Clip")}, [clip] { return shown(clip().clip); });
    form.fact({"time", Text::tr("Time")}, [clip] { return Text::tr("%1 s").arg(readable(clip().seconds, 6)); });
  } else {
    form.note({"turns", Text::tr("Turned joints")}, [pose] {
      const auto* turned = std::get_if<study::TurnedPose>(&pose().what);
      return turned == nullptr ? unknown() : turnsText(*turned);
    });
  }
  auto* show = new QPushButton(Text::tr("Show"), &form);
  show->setObjectName(QStringLiteral("show"));
  show->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
  QObject::connect(show, &QPushButton::clicked, &form, [&document, name] { document.showPose(name); });
  form.row(QLatin1String(""), show);
}

void fillSource(PropertyForm& form, const std::string& name) {
  StudyDocument& document = form.document();
  form.section(Text::tr("Source of shots"));
  addNameRow(form, {ItemKind::source, name});
  addDescriptionRow(form, {ItemKind::source, name},
                    [&document, name] { return namedOrNone(document.study().sources, name).description; });
  const auto draft = std::make_shared<SourceDraft>(document, [name] { return name; });
  draft->onEdit([&form] { form.refresh(); });
  addSourceRows(form, draft);
}

}  // namespace

PropertyForm* makeItemForm(StudyDocument& document, const ItemRef& item, QWidget* parent) {
  auto* form = new PropertyForm(document, parent);
  switch (item.kind) {
    case ItemKind::study:
      fillStudy(*form);
      break;
    case ItemKind::body:
      fillBody(*form);
      break;
    case ItemKind::region:
      fillRegion(*form, item.name);
      break;
    case ItemKind::organ:
      fillOrgan(*form, item.name);
      break;
    case ItemKind::system:
      fillSystem(*form, item.name);
      break;
    case ItemKind::piece:
      fillPiece(*form, item.name);
      break;
    case ItemKind::pose:
      fillPose(*form, item.name);
      break;
    case ItemKind::source:
      fillSource(*form, item.name);
      break;
    case ItemKind::run:
      fillRun(*form, item.name);
      break;
  }
  return form;
}

}  // namespace lorica::panels
