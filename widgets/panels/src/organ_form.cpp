#include <QDoubleSpinBox>
#include <cmath>

#include "item_form_parts.h"
#include "item_forms.h"
#include "lorica/commands/edits.h"
#include "lorica/models/numbers.h"

namespace lorica::panels {

using document::ItemKind;
using document::StudyDocument;

namespace {

std::vector<Choice> jointChoices(const StudyDocument& document, const study::Organ& organ) {
  QString nearest = Text::tr("Nearest");
  std::vector<Choice> choices;
  const auto& loaded = document.loaded();
  if (loaded != nullptr && loaded->body->body().skeleton) {
    const human::Skeleton& skeleton = *loaded->body->body().skeleton;
    const analysis::LoadedOrgan* rigged = findNamed(loaded->organs, organ.name);
    if (!organ.joint && rigged != nullptr && rigged->rig.joint) {
      nearest = Text::tr("Nearest (%1)").arg(shown(skeleton.joint(*rigged->rig.joint).name));
    }
    for (const human::Joint& joint : skeleton.joints()) {
      choices.push_back({shown(joint.name), shown(joint.name)});
    }
  }
  choices.insert(choices.begin(), {nearest, QString()});
  if (organ.joint && std::none_of(choices.begin(), choices.end(),
                                  [&](const Choice& choice) { return choice.id == shown(*organ.joint); })) {
    choices.push_back({shown(*organ.joint), shown(*organ.joint)});
  }
  return choices;
}

void addLatticeRows(PropertyForm& form, const std::string& name) {
  using Layout = study::LatticeSettings::Layout;
  StudyDocument& document = form.document();
  const auto lattice = [&document, name] { return namedOrNone(document.study().organs, name).lattice; };
  form.section(Text::tr("Lattice"));
  const auto change = [&document, name, lattice](const std::function<void(study::LatticeSettings&)>& edit) {
    study::LatticeSettings wanted = lattice();
    edit(wanted);
    commands::setLattice(document, name, wanted);
  };
  form.choice(
      {"layout", Text::tr("Layout"), Text::tr("How the control points around the organ are laid out")},
      [] {
        return std::vector<Choice>{{Text::tr("By size of cells"), QString::number(int(Layout::cellSize))},
                                   {Text::tr("Equal count per axis"), QString::number(int(Layout::uniform))},
                                   {Text::tr("Count for each axis"), QString::number(int(Layout::perAxis))},
                                   {Text::tr("One box"), QString::number(int(Layout::boundingBox))}};
      },
      [lattice] { return QString::number(int(lattice().layout)); },
      [change](const QString& id) {
        change([&](study::LatticeSettings& wanted) { wanted.layout = Layout(id.toInt()); });
      });
  QDoubleSpinBox* size = form.number(
      {"cell", Text::tr("Cell size")}, {0.2, 2000.0, 5.0, 1, Text::tr(" mm")},
      [lattice] { return 1000.0 * lattice().cellMetres; },
      [change](double millimetres) {
        change([&](study::LatticeSettings& wanted) { wanted.cellMetres = millimetres / 1000.0; });
      });
  form.showRowWhile(size, [lattice] { return lattice().layout == Layout::cellSize; });
  QDoubleSpinBox* count = form.number(
      {"cells", Text::tr("Cells per axis")}, {1.0, 1000.0, 1.0, 0, {}},
      [lattice] { return static_cast<double>(lattice().cells[0]); },
      [change](double cells) {
        change([&](study::LatticeSettings& wanted) { wanted.cells.fill(static_cast<int>(cells)); });
      });
  form.showRowWhile(count, [lattice] { return lattice().layout == Layout::uniform; });
  QWidget* counts = form.triple(
      {"axis_cells", Text::tr("Cells")}, {1.0, 1000.0, 1.0, 0, {}},
      [lattice] {
        const auto cells = lattice().cells;
        return geometry::Vec3d(cells[0], cells[1], cells[2]);
      },
      [change](const geometry::Vec3d& cells) {
        change([&](study::LatticeSettings& wanted) {
          for (int axis = 0; axis < 3; ++axis) {
            wanted.cells[static_cast<std::size_t>(axis)] = static_cast<int>(std::lround(cells[axis]));
          }
        });
      });
  form.showRowWhile(counts, [lattice] { return lattice().layout == Layout::perAxis; });
  form.fact({"control_points", Text::tr("Control points")}, [&document, name] {
    const analysis::LoadedOrgan* organ =
        document.loaded() == nullptr ? nullptr : findNamed(document.loaded()->organs, name);
    if (organ == nullptr) {
      return unknown();
    }
    const viscera::Lattice& made = organ->rig.lattice;
    return Text::tr("%1 (%2 × %3 × %4 cells)")
        .arg(models::grouped(made.controlPoints.size()))
        .arg(made.cells[0])
        .arg(made.cells[1])
        .arg(made.cells[2]);
  });
}

}  // namespace

void fillOrgan(PropertyForm& form, const std::string& name) {
  StudyDocument& document = form.document();
  const auto organ = [&document, name]() -> const study::Organ& { return namedOrNone(document.study().organs, name); };
  const FindMesh mesh = [&document, name]() -> std::pair<const geometry::TriangleMesh*, const raycast::MeshTopology*> {
    const analysis::LoadedOrgan* loaded =
        document.loaded() == nullptr ? nullptr : findNamed(document.loaded()->organs, name);
    return loaded == nullptr ? std::pair<const geometry::TriangleMesh*, const raycast::MeshTopology*>{}
                             : std::pair{&loaded->rig.rest, loaded->topology.get()};
  };
  form.section(Text::tr("Organ"));
  addNameRow(form, {ItemKind::organ, name});
  addDescriptionRow(form, {ItemKind::organ, name}, [organ] { return organ().description; });
  form.fact({"file", Text::tr("File")}, [organ] { return sourceText(organ().mesh); });
  form.fact({"parts", Text::tr("Parts")}, [organ] { return partsText(organ().mesh); });
  addMeshRows(form, mesh);
  form.section(Text::tr("Analysis"));
  form.choice(
      {"class", Text::tr("Injury class"),
       Text::tr("Essential and desirable coverage, after Breeze et al. 2016; each has a total in the results")},
      [] {
        return std::vector<Choice>{{Text::tr("None"), QString()},
                                   {Text::tr("Essential"), QStringLiteral("essential")},
                                   {Text::tr("Desirable"), QStringLiteral("desirable")}};
      },
      [organ] { return shown(organ().injuryClass); },
      [&document, name](const QString& id) { commands::setInjuryClass(document, name, id.toStdString()); });
  form.choice(
      {"joint", Text::tr("Joint"), Text::tr("Carries the organ in the model \"static, by joint\"")},
      [&document, organ] { return jointChoices(document, organ()); },
      [organ] { return shown(organ().joint.value_or("")); },
      [&document, name](const QString& id) {
        commands::setJoint(document, name, id.isEmpty() ? std::nullopt : std::optional(id.toStdString()));
      });
  addLatticeRows(form, name);
  addLookRows(form, name);
}

}  // namespace lorica::panels
