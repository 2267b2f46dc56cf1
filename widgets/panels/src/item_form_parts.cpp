#include "item_form_parts.h"

#include <QLabel>
#include <QLineEdit>
#include <array>
#include <cmath>

#include "lorica/commands/edits.h"
#include "lorica/document/appearance.h"
#include "lorica/geometry/measures.h"
#include "lorica/models/numbers.h"

namespace lorica::panels {

using document::ItemRef;
using document::StudyDocument;

namespace {

/// Three digits or more.
QString amount(double value) {
  return std::abs(value) < 100.0 ? readable(value, 1) : models::grouped(static_cast<std::uint64_t>(std::lround(value)));
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

/// Facts that are computed once for every mesh, not for every refresh.
class FactsCache {
 public:
  explicit FactsCache(FindMesh find) : find_(std::move(find)) {}
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
  FindMesh find_;
  MeshFacts facts_;
};

}  // namespace

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
QString areaText(double squareMetres) {
  return Text::tr("%1 cm²").arg(amount(squareMetres * 1e4));
}

void addMeshRows(PropertyForm& form, FindMesh find) {
  const auto facts = std::make_shared<FactsCache>(std::move(find));
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

void addDescriptionRow(PropertyForm& form, const ItemRef& item, const std::function<std::string()>& get) {
  StudyDocument& document = form.document();
  form.paragraph(
      {"description", Text::tr("Description")}, [get] { return shown(get()); },
      [&document, item](const QString& text) {
        // The focus may leave because the thing has gone.
        if (document::exists(document, item)) {
          commands::setDescription(document, item, text.toStdString());
        }
      });
}

}  // namespace lorica::panels
