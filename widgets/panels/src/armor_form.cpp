#include <QDoubleSpinBox>
#include <QLineEdit>
#include <QPlainTextEdit>

#include "item_form_parts.h"
#include "item_forms.h"
#include "lorica/commands/edits.h"
#include "lorica/geometry/measures.h"

namespace lorica::panels {

using document::ItemKind;
using document::StudyDocument;

namespace {

const study::ArmorPiece& pieceNamed(const study::Study& study, const std::string& name) {
  static const study::ArmorPiece none;
  for (const study::ArmorSystem& system : study.systems) {
    if (const study::ArmorPiece* piece = findNamed(system.pieces, name)) {
      return *piece;
    }
  }
  return none;
}

}  // namespace

void fillSystem(PropertyForm& form, const std::string& name) {
  StudyDocument& document = form.document();
  const auto system = [&document, name]() -> const study::ArmorSystem& {
    return namedOrNone(document.study().systems, name);
  };
  form.section(Text::tr("Armor system"));
  addNameRow(form, {ItemKind::system, name});
  addDescriptionRow(form, {ItemKind::system, name}, [system] { return system().description; });
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
  const FindMesh mesh = [&document, name]() -> std::pair<const geometry::TriangleMesh*, const raycast::MeshTopology*> {
    const analysis::LoadedPiece* loaded =
        document.loaded() == nullptr ? nullptr : findNamed(document.loaded()->pieces, name);
    return loaded == nullptr ? std::pair<const geometry::TriangleMesh*, const raycast::MeshTopology*>{}
                             : std::pair{&loaded->rig.rest, loaded->topology.get()};
  };
  form.section(Text::tr("Armor piece"));
  addNameRow(form, {ItemKind::piece, name});
  addDescriptionRow(form, {ItemKind::piece, name}, [piece] { return piece().description; });
  form.fact({"file", Text::tr("File")}, [piece] { return sourceText(piece().mesh); });
  QLineEdit* material = form.line(
      {"material", Text::tr("Material"), Text::tr("For the record; changes no result")},
      [piece] { return shown(piece().material); },
      [&document, &form, name](const QString& text) {
        commands::setMaterial(document, name, text.simplified().toStdString());
        form.refresh();
      });
  material->setPlaceholderText(Text::tr("not given"));
  QDoubleSpinBox* density = form.number(
      {"density", Text::tr("Areal density"), Text::tr("For the record; changes no result")},
      {0.0, commands::densest, 1.0, 3, Text::tr(" kg/m²")}, [piece] { return piece().arealDensity.value_or(0.0); },
      [&document, name](double wanted) {
        commands::setArealDensity(document, name, wanted > 0.0 ? std::optional(wanted) : std::nullopt);
      });
  density->setSpecialValueText(Text::tr("not given"));
  addMeshRows(form, mesh);
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

}  // namespace lorica::panels
