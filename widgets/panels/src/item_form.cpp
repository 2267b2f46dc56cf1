#include "item_form.h"

#include <QCoreApplication>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QPushButton>
#include <algorithm>
#include <cmath>

#include "lorica/commands/edits.h"
#include "lorica/document/appearance.h"
#include "lorica/geometry/measures.h"
#include "lorica/models/numbers.h"

namespace lorica::panels {

using document::ItemKind;
using document::ItemRef;
using document::StudyDocument;

namespace {

struct Text {
  Q_DECLARE_TR_FUNCTIONS(lorica::panels::PropertiesPanel)
};

template <class Named>
const Named* findNamed(const std::vector<Named>& items, const std::string& name) {
  const auto found = std::find_if(items.begin(), items.end(), [&](const Named& item) { return item.name == name; });
  return found == items.end() ? nullptr : &*found;
}

template <class Named>
const Named* findNamed(const std::vector<std::shared_ptr<const Named>>& items, const std::string& name) {
  const auto found = std::find_if(items.begin(), items.end(), [&](const auto& item) { return item->name == name; });
  return found == items.end() ? nullptr : found->get();
}

/// The thing of that name, or an empty one: forms are drawn once more after their thing is gone.
template <class Named>
const Named& namedOrNone(const std::vector<Named>& items, const std::string& name) {
  static const Named none;
  const Named* found = findNamed(items, name);
  return found == nullptr ? none : *found;
}

const study::ArmorPiece& pieceNamed(const study::Study& study, const std::string& name) {
  static const study::ArmorPiece none;
  for (const study::ArmorSystem& system : study.systems) {
    if (const study::ArmorPiece* piece = findNamed(system.pieces, name)) {
      return *piece;
    }
  }
  return none;
}

QString shown(const std::string& text) {
  return QString::fromStdString(text);
}

QString unknown() {
  return QString(QChar(0x2014));
}

QString sourceText(const study::MeshSource& mesh) {
  if (const auto* builtin = std::get_if<study::Builtin>(&mesh.from)) {
    return Text::tr("built in: %1").arg(shown(builtin->name));
  }
  return shown(std::get<study::InputFile>(mesh.from).path);
}

QString partsText(const study::MeshSource& mesh) {
  QStringList names;
  for (const std::string& part : mesh.parts) {
    names.append(shown(part));
  }
  return names.isEmpty() ? Text::tr("all") : names.join(QStringLiteral(", "));
}

/// Three digits or more.
QString amount(double value) {
  return std::abs(value) < 100.0 ? readable(value, 1) : models::grouped(static_cast<std::uint64_t>(std::lround(value)));
}

QString areaText(double squareMetres) {
  return Text::tr("%1 cm²").arg(amount(squareMetres * 1e4));
}

/// What is known of a mesh at rest.
struct MeshFacts {
  const void* of = nullptr;  ///< the mesh they were computed for
  QString triangles = unknown();
  QString closed = unknown();
  QString volume = unknown();
  QString area = unknown();
};

MeshFacts factsOf(const geometry::TriangleMesh& mesh, const raycast::MeshTopology& topology) {
  MeshFacts facts;
  const bool closed = std::all_of(topology.closed.begin(), topology.closed.end(), [](bool is) { return is; });
  facts.triangles = models::grouped(mesh.triangles.size());
  facts.closed = closed ? Text::tr("closed") : Text::tr("open");
  facts.area = areaText(geometry::area(mesh));
  if (closed) {
    facts.volume = Text::tr("%1 cm³").arg(amount(std::max(0.0, geometry::signedVolume(mesh)) * 1e6));
  } else {
    facts.volume = Text::tr("none, the surface is open");
  }
  return facts;
}

/// Facts that are computed once for every mesh, not for every refresh. \param mesh and its topology; null: not loaded
class FactsCache {
 public:
  using Find = std::function<std::pair<const geometry::TriangleMesh*, const raycast::MeshTopology*>()>;
  explicit FactsCache(Find find) : find_(std::move(find)) {}
  const MeshFacts& get() {
    const auto [mesh, topology] = find_();
    if (mesh == nullptr) {
      facts_ = {};
    } else if (facts_.of != mesh) {
      facts_ = factsOf(*mesh, *topology);
      facts_.of = mesh;
    }
    return facts_;
  }

 private:
  Find find_;
  MeshFacts facts_;
};

using Facts = std::shared_ptr<FactsCache>;

void addMeshRows(PropertyForm& form, const Facts& facts) {
  form.fact({"triangles", Text::tr("Triangles")}, [facts] { return facts->get().triangles; });
  form.fact({"surface", Text::tr("Surface")}, [facts] { return facts->get().closed; });
  form.fact({"volume", Text::tr("Volume")}, [facts] { return facts->get().volume; });
  form.fact({"area", Text::tr("Area")}, [facts] { return facts->get().area; });
}

void addLookRows(PropertyForm& form, const std::string& structure) {
  StudyDocument& document = form.document();
  const auto look = [&document, structure] { return document::appearanceOf(document.study(), structure); };
  form.section(Text::tr("Look"));
  form.check(
      {"visible", QLatin1String("")}, Text::tr("Visible"), [look] { return look().visible; },
      [&document, structure](bool on) { commands::setVisible(document, structure, on); });
  form.colour(
      {"colour", Text::tr("Colour")}, [look] { return look().colour; },
      [&document, structure](const QColor& colour) {
        commands::setColour(
            document, structure,
            std::array{static_cast<std::uint8_t>(colour.red()), static_cast<std::uint8_t>(colour.green()),
                       static_cast<std::uint8_t>(colour.blue())});
      },
      [&document, structure] { commands::setColour(document, structure, std::nullopt); });
  form.number(
      {"opacity", Text::tr("Opacity")}, {0.0, 100.0, 5.0, 0, Text::tr(" %")}, [look] { return 100.0 * look().opacity; },
      [&document, structure](double percent) { commands::setOpacity(document, structure, percent / 100.0); });
}

/// The name: to edit where it can be changed. What is wrong with a name is said below it.
void addNameRow(PropertyForm& form, const ItemRef& item) {
  StudyDocument& document = form.document();
  if (!commands::canRemove(item)) {
    form.fact({"name", Text::tr("Name")}, [item] { return shown(item.name); });
    return;
  }
  const auto trouble = std::make_shared<QString>();
  form.line(
      {"name", Text::tr("Name")}, [item] { return shown(item.name); },
      [&document, &form, item, trouble](const QString& name) {
        *trouble = commands::renameTrouble(document, item, name.toStdString());
        form.refresh();
        if (trouble->isEmpty() && name.toStdString() != item.name) {
          commands::renameItem(document, item, name.toStdString());
        }
      });
  QLabel* why = form.note({"name_trouble", QLatin1String("")}, [trouble] { return *trouble; });
  form.showRowWhile(why, [trouble] { return !trouble->isEmpty(); });
}

void addDescriptionRow(PropertyForm& form, const std::function<std::string()>& get) {
  QLabel* text = form.note({"description", Text::tr("Description")}, [get] { return shown(get()); });
  form.showRowWhile(text, [get] { return !get().empty(); });
}

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
  form.section(Text::tr("Body"));
  form.fact({"spacing", Text::tr("Interior sites")},
            [&document] { return Text::tr("%1 mm apart").arg(readable(1000.0 * document.study().siteSpacing, 1)); });
}

void fillBody(PropertyForm& form) {
  StudyDocument& document = form.document();
  const auto facts = std::make_shared<FactsCache>(
      [&document]() -> std::pair<const geometry::TriangleMesh*, const raycast::MeshTopology*> {
        if (document.loaded() == nullptr) {
          return {};
        }
        const parenting::BodyRig& body = *document.loaded()->body;
        return {&body.body().skin, body.skinTopology().get()};
      });
  form.section(Text::tr("Body"));
  form.fact({"file", Text::tr("File")}, [&document] { return sourceText(document.study().human); });
  form.fact({"size", Text::tr("Size at rest")},
            [&document] {
              if (document.loaded() == nullptr) {
                return unknown();
              }
              const geometry::Vec3d size = geometry::bounds(document.loaded()->body->body().skin.positions).sizes();
              return Text::tr("%1 × %2 × %3 m")
                  .arg(models::fixed(size.x(), 3), models::fixed(size.y(), 3), models::fixed(size.z(), 3));
            })
      ->setToolTip(Text::tr("Wide, high and deep"));
  addMeshRows(form, facts);
  form.fact({"joints", Text::tr("Joints")}, [&document] {
    if (document.loaded() == nullptr) {
      return unknown();
    }
    const auto& skeleton = document.loaded()->body->body().skeleton;
    return skeleton ? models::grouped(skeleton->size()) : Text::tr("no skeleton: shot at rest only");
  });
  form.note({"clips", Text::tr("Clips")}, [&document] {
    QStringList clips;
    if (document.loaded() != nullptr) {
      for (const human::Clip& clip : document.loaded()->clips) {
        clips.append(Text::tr("%1, %2 s").arg(shown(clip.name), models::fixed(clip.duration(), 2)));
      }
    }
    return clips.isEmpty() ? unknown() : clips.join(u'\n');
  });
  form.fact({"sites", Text::tr("Interior sites")}, [&document] {
    return document.loaded() == nullptr ? unknown()
                                        : Text::tr("%1, %2 mm apart")
                                              .arg(models::grouped(document.loaded()->body->sites().size()),
                                                   readable(1000.0 * document.study().siteSpacing, 1));
  });
  addLookRows(form, "body");
}

double regionArea(const StudyDocument& document, const std::string& region) {
  const parenting::Body& body = document.loaded()->body->body();
  const auto& names = body.regions.names;
  const auto index = std::find(names.begin(), names.end(), region) - names.begin();
  double sum = 0.0;
  for (std::size_t t = 0; t < body.skin.triangles.size(); ++t) {
    if (body.regions.ofTriangle[t] == index) {
      const geometry::Vec3d a = body.skin.corner(t, 0);
      sum += 0.5 * (body.skin.corner(t, 1) - a).cross(body.skin.corner(t, 2) - a).norm();
    }
  }
  return sum;
}

void fillRegion(PropertyForm& form, const std::string& name) {
  StudyDocument& document = form.document();
  form.section(Text::tr("Body region"));
  form.fact({"name", Text::tr("Name")}, [name] { return shown(name); });
  form.fact({"area", Text::tr("Area at rest")}, [&document, name] {
    return document.loaded() == nullptr ? unknown() : areaText(regionArea(document, name));
  });
}

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

void fillOrgan(PropertyForm& form, const std::string& name) {
  StudyDocument& document = form.document();
  const auto organ = [&document, name]() -> const study::Organ& { return namedOrNone(document.study().organs, name); };
  const auto facts = std::make_shared<FactsCache>(
      [&document, name]() -> std::pair<const geometry::TriangleMesh*, const raycast::MeshTopology*> {
        const analysis::LoadedOrgan* loaded =
            document.loaded() == nullptr ? nullptr : findNamed(document.loaded()->organs, name);
        return loaded == nullptr ? std::pair<const geometry::TriangleMesh*, const raycast::MeshTopology*>{}
                                 : std::pair{&loaded->rig.rest, loaded->topology.get()};
      });
  form.section(Text::tr("Organ"));
  addNameRow(form, {ItemKind::organ, name});
  addDescriptionRow(form, [organ] { return organ().description; });
  form.fact({"file", Text::tr("File")}, [organ] { return sourceText(organ().mesh); });
  form.fact({"parts", Text::tr("Parts")}, [organ] { return partsText(organ().mesh); });
  addMeshRows(form, facts);
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

void fillSystem(PropertyForm& form, const std::string& name) {
  StudyDocument& document = form.document();
  const auto system = [&document, name]() -> const study::ArmorSystem& {
    return namedOrNone(document.study().systems, name);
  };
  form.section(Text::tr("Armor system"));
  addNameRow(form, {ItemKind::system, name});
  addDescriptionRow(form, [system] { return system().description; });
  form.note({"pieces", Text::tr("Pieces")}, [system] {
    QStringList names;
    for (const study::ArmorPiece& piece : system().pieces) {
      names.append(shown(piece.name));
    }
    return names.isEmpty() ? Text::tr("none") : names.join(u'\n');
  });
  form.fact({"area", Text::tr("Area"), {}}, [&document, name] {
    if (document.loaded() == nullptr) {
      return unknown();
    }
    double sum = 0.0;
    const analysis::LoadedStudy& loaded = *document.loaded();
    for (std::size_t p = 0; p < loaded.pieces.size(); ++p) {
      if (loaded.study.systems[loaded.systemOfPiece[p]].name == name) {
        sum += geometry::area(loaded.pieces[p]->rig.rest);
      }
    }
    return areaText(sum);
  });
}

void fillPiece(PropertyForm& form, const std::string& name) {
  StudyDocument& document = form.document();
  const auto piece = [&document, name]() -> const study::ArmorPiece& { return pieceNamed(document.study(), name); };
  const auto facts = std::make_shared<FactsCache>(
      [&document, name]() -> std::pair<const geometry::TriangleMesh*, const raycast::MeshTopology*> {
        const analysis::LoadedPiece* loaded =
            document.loaded() == nullptr ? nullptr : findNamed(document.loaded()->pieces, name);
        return loaded == nullptr ? std::pair<const geometry::TriangleMesh*, const raycast::MeshTopology*>{}
                                 : std::pair{&loaded->rig.rest, loaded->topology.get()};
      });
  form.section(Text::tr("Armor piece"));
  addNameRow(form, {ItemKind::piece, name});
  addDescriptionRow(form, [piece] { return piece().description; });
  form.fact({"file", Text::tr("File")}, [piece] { return sourceText(piece().mesh); });
  form.fact({"material", Text::tr("Material")},
            [piece] { return piece().material.empty() ? unknown() : shown(piece().material); });
  form.fact({"density", Text::tr("Areal density")}, [piece] {
    return piece().arealDensity ? Text::tr("%1 kg/m²").arg(readable(*piece().arealDensity, 3)) : unknown();
  });
  addMeshRows(form, facts);
  form.section(Text::tr("Analysis"));
  form.choice(
      {"carriage", Text::tr("Carriage"), Text::tr("How the piece follows the body")},
      [] {
        return std::vector<Choice>{
            {Text::tr("Rigid"), QStringLiteral("rigid"), Text::tr("Plates and helmets: moves as one")},
            {Text::tr("Follows the skin"), QStringLiteral("skinned"), Text::tr("Soft armor: bends")}};
      },
      [piece] {
        return piece().carriage == study::Carriage::rigid ? QStringLiteral("rigid") : QStringLiteral("skinned");
      },
      [&document, name](const QString& id) {
        commands::setCarriage(document, name, id == u"rigid" ? study::Carriage::rigid : study::Carriage::skinned);
      });
  QPlainTextEdit* patterns = form.paragraph(
      {"non_protecting", Text::tr("Not protecting"),
       Text::tr("Names of parts, one a line, such as straps and pouches. * stands for any run of letters.")},
      [piece] {
        QStringList lines;
        for (const std::string& part : piece().nonProtecting) {
          lines.append(shown(part));
        }
        return lines.join(u'\n');
      },
      [&document, &form, name](const QString& text) {
        std::vector<std::string> parts;
        for (const QString& line : text.split(u'\n')) {
          if (const QString part = line.simplified(); !part.isEmpty()) {
            parts.push_back(part.toStdString());
          }
        }
        commands::setNonProtecting(document, name, parts);
        form.refresh();
      });
  patterns->setPlaceholderText(Text::tr("none"));
  addLookRows(form, name);
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
  addDescriptionRow(form, [pose] { return pose().description; });
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
  addDescriptionRow(form, [&document, name] { return namedOrNone(document.study().sources, name).description; });
  addSourceRows(form, [name] { return name; });
}

QString joined(const std::vector<std::string>& names) {
  QStringList all;
  for (const std::string& one : names) {
    all.append(shown(one));
  }
  return all.join(u'\n');
}

void fillRun(PropertyForm& form, const std::string& name) {
  const auto& runs = form.document().runs();
  const auto found = std::find_if(runs.begin(), runs.end(), [&](const auto& run) { return run->name == name; });
  form.section(Text::tr("Run"));
  if (found == runs.end()) {
    return;
  }
  const document::RunRecord& run = **found;
  const analysis::RunResult& result = run.result;
  raycast::CastCounts counts;
  std::size_t finished = 0;
  for (const analysis::SourcePoseResult& part : result.results) {
    counts.add(part.counts);
    finished += part.trials.size();
  }
  const auto fixedFact = [&form](const char* id, const QString& label, const QString& text, const QString& tip = {}) {
    ElidedLabel* value = form.fact({id, label}, [text] { return text; });
    if (!tip.isEmpty()) {
      value->setToolTip(tip);
    }
  };
  fixedFact("name", Text::tr("Name"), shown(run.name));
  fixedFact("state", Text::tr("State"), result.partial ? Text::tr("partial: it was cancelled") : Text::tr("complete"));
  std::vector<std::string> sources;
  for (const analysis::ShotSource& source : result.sources) {
    sources.push_back(
        Text::tr("%1, %2 shots per trial").arg(shown(source.source.name), models::grouped(source.shots)).toStdString());
  }
  form.note({"sources", Text::tr("Sources")}, [text = joined(sources)] { return text; });
  form.note({"poses", Text::tr("Poses")}, [text = joined(result.poses)] { return text; });
  form.note({"systems", Text::tr("Armor")}, [text = joined(result.systems)] { return text; });
  std::vector<std::string> organModels;
  for (const study::OrganModel model : result.models) {
    organModels.push_back(viscera::name(model));
  }
  form.note({"models", Text::tr("Organ models")}, [text = joined(organModels)] { return text; });
  fixedFact("trials", Text::tr("Trials"),
            Text::tr("%1 of %2 finished")
                .arg(models::grouped(finished), models::grouped(std::uint64_t{result.trials} * result.results.size())));
  fixedFact("seed", Text::tr("Seed"), QString::number(result.seed));
  form.section(Text::tr("Rays"));
  fixedFact("rays", Text::tr("Traced"), models::grouped(counts.rays));
  fixedFact("retraced", Text::tr("Traced again"), models::grouped(counts.retraced),
            Text::tr("Crossings of a closed surface did not add up at first."));
  fixedFact("unresolved", Text::tr("Unresolved"), models::grouped(counts.unresolved),
            Text::tr("Crossings of a closed surface did not add up even then."));
  fixedFact("near_open", Text::tr("Near open edges"), models::grouped(counts.nearOpenEdge),
            Text::tr("Passed an open edge so closely that rounding may decide."));
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
