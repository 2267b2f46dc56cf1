#include "lorica/commands/edits.h"

#include <QStringDecoder>
#include <functional>

#include "find.h"
#include "lorica/commands/shot_edits.h"
#include "lorica/document/appearance.h"
#include "lorica/study/study_file.h"

namespace lorica::commands {

using document::Change;

namespace {

bool isControl(char letter) {
  return static_cast<unsigned char>(letter) < 0x20U || letter == '\x7F';
}

bool isUtf8(const std::string& text) {
  QStringDecoder decoder(QStringDecoder::Utf8, QStringDecoder::Flag::Stateless);
  const QString decoded = decoder(QByteArrayView(text.data(), static_cast<qsizetype>(text.size())));
  return !decoder.hasError();
}

/// \pre UTF-8
std::string withoutControls(std::string text) {
  LORICA_CHECK(isUtf8(text), "names are UTF-8");
  std::replace_if(text.begin(), text.end(), isControl, ' ');
  return text;
}

template <class Value>
bool isWithin(Value value, Value low, Value high) {
  return value >= low && value <= high;
}

/// Each once, in the given order.
template <class Value>
std::vector<Value> once(const std::vector<Value>& values) {
  std::vector<Value> kept;
  for (const Value& value : values) {
    if (std::find(kept.begin(), kept.end(), value) == kept.end()) {
      kept.push_back(value);
    }
  }
  return kept;
}

/// A property that is a member of the study.
template <class Value>
Property<Value> ofStudy(const QString& id, Change what, Value study::Study::*member) {
  return {id, what, [member](const study::Study& study) { return study.*member; },
          [member](study::Study& study, const Value& value) { study.*member = value; }};
}

template <class Value>
Property<Value> ofOrgan(const QString& id, const std::string& organ, Value study::Organ::*member) {
  return {id + '/' + shown(organ), Change::organs,
          [organ, member](const study::Study& study) { return named(study.organs, organ).*member; },
          [organ, member](study::Study& study, const Value& value) { named(study.organs, organ).*member = value; }};
}

template <class Value>
Property<Value> ofPiece(const QString& id, const std::string& piece, Value study::ArmorPiece::*member) {
  return {id + '/' + shown(piece), Change::armor,
          [piece, member](const study::Study& study) { return named(systemWith(study, piece).pieces, piece).*member; },
          [piece, member](study::Study& study, const Value& value) {
            named(systemWith(study, piece).pieces, piece).*member = value;
          }};
}

/// The lattice as the study's file holds it.
study::LatticeSettings asWritten(const study::LatticeSettings& lattice) {
  using Layout = study::LatticeSettings::Layout;
  const study::LatticeSettings defaults;
  study::LatticeSettings kept = lattice;
  if (kept.layout == Layout::cellSize) {
    const double millimetres = kept.cellMetres * 1000.0;
    LORICA_CHECK(millimetres > 0.1 && millimetres <= 2000.0, "cells are above 0.1 mm, up to 2000 mm");
    kept.cellMetres = millimetres / 1000.0;
  } else {
    kept.cellMetres = defaults.cellMetres;
  }
  if (kept.layout == Layout::uniform || kept.layout == Layout::perAxis) {
    for (const int cells : kept.cells) {
      LORICA_CHECK(isWithin(cells, 1, 1000), "1 to 1000 cells along an axis");
    }
  } else {
    kept.cells = defaults.cells;
  }
  return kept;
}

bool isDrawn(const study::Study& study, const std::string& structure) {
  const std::vector<std::string> drawn = document::drawnStructures(study);
  return std::find(drawn.begin(), drawn.end(), structure) != drawn.end();
}

/// The displays with one structure's changed. \pre the structure is drawn
std::vector<study::Display> withDisplay(const study::Study& study, std::vector<study::Display> displays,
                                        const std::string& structure,
                                        const std::function<void(study::Display&)>& change) {
  LORICA_CHECK(isDrawn(study, structure), "the study draws nothing of this name");
  auto entry = std::find_if(displays.begin(), displays.end(),
                            [&](const study::Display& display) { return display.structure == structure; });
  if (entry == displays.end()) {
    displays.push_back({structure, document::defaultAppearance(study, structure).visible, {}, {}});
    entry = std::prev(displays.end());
  }
  change(*entry);
  return displays;
}

/// \param kind tells edits apart that must not merge
void changeDisplays(StudyDocument& document, const QString& kind, const std::vector<study::Display>& displays,
                    const QString& text, Merge merge = Merge::no) {
  change(document, ofStudy("display/" + kind, Change::display, &study::Study::displays),
         minimalDisplays(document.study(), displays), text, merge);
}

}  // namespace

bool isName(const std::string& text) {
  return !text.empty() && std::none_of(text.begin(), text.end(), isControl) && isUtf8(text);
}

std::vector<study::Display> minimalDisplays(const study::Study& study, std::vector<study::Display> displays) {
  const std::vector<std::string> drawn = document::drawnStructures(study);
  const auto place = [&](const study::Display& display) {
    return std::find(drawn.begin(), drawn.end(), display.structure);
  };
  std::erase_if(displays, [&](const study::Display& display) {
    return place(display) != drawn.end() && !display.colour && !display.opacity &&
           display.visible == document::defaultAppearance(study, display.structure).visible;
  });
  std::stable_sort(displays.begin(), displays.end(),
                   [&](const study::Display& a, const study::Display& b) { return place(a) < place(b); });
  return displays;
}

// --- the study and its runs -----------------------------------------------------------------------------------------

void setStudyName(StudyDocument& document, const std::string& name) {
  change(document, ofStudy("name", Change::general, &study::Study::name), withoutControls(name),
         Text::tr("Name of the study"));
}

void setStudyDescription(StudyDocument& document, const std::string& text) {
  LORICA_CHECK(isUtf8(text), "texts are UTF-8");
  change(document, ofStudy("description", Change::general, &study::Study::description), text,
         Text::tr("Description of the study"));
}

void setDeformer(StudyDocument& document, study::Deformer deformer) {
  change(document, ofStudy("deformer", Change::organs, &study::Study::deformer), deformer,
         Text::tr("How organs deform"));
}

void setModels(StudyDocument& document, const std::vector<viscera::OrganModel>& models) {
  change(document, ofStudy("models", Change::run, &study::Study::models), once(models), Text::tr("Organ models"));
}

void setTrials(StudyDocument& document, std::uint32_t trials) {
  LORICA_CHECK(isWithin(trials, 1U, 100000U), "1 to 100000 trials");
  change(document, ofStudy("trials", Change::run, &study::Study::trials), trials, Text::tr("Trials"));
}

void setSeed(StudyDocument& document, std::uint64_t seed) {
  change(document, ofStudy("seed", Change::run, &study::Study::seed), seed, Text::tr("Seed"));
}

void setRunPoses(StudyDocument& document, const std::vector<std::string>& poses) {
  for (const std::string& pose : poses) {
    LORICA_CHECK(isName(pose) && (pose == "rest" || hasNamed(document.study().poses, pose) ||
                                  study::clipPoseNamed(pose).has_value()),
                 "a run computes rest, poses of the study and clips at a time");
  }
  change(document, ofStudy("run poses", Change::poses, &study::Study::runPoses), once(poses), Text::tr("Poses to run"));
}

// --- how things are drawn -------------------------------------------------------------------------------------------

void setVisible(StudyDocument& document, const std::string& structure, bool visible) {
  setAllVisible(document, {structure}, visible,
                (visible ? Text::tr("Show %1") : Text::tr("Hide %1")).arg(shown(structure)));
}

void setAllVisible(StudyDocument& document, const std::vector<std::string>& structures, bool visible,
                   const QString& text) {
  const study::Study& study = document.study();
  std::vector<study::Display> displays = study.displays;
  bool differs = false;
  for (const std::string& structure : structures) {
    differs = differs || document::appearanceOf(study, structure).visible != visible;
    displays = withDisplay(study, std::move(displays), structure,
                           [visible](study::Display& display) { display.visible = visible; });
  }
  if (differs) {
    changeDisplays(document, "visible", displays, text);
  }
}

void setColour(StudyDocument& document, const std::string& structure,
               const std::optional<std::array<std::uint8_t, 3>>& colour) {
  const study::Study& study = document.study();
  const QColor usual = document::defaultAppearance(study, structure).colour;
  const QColor asked = colour ? QColor((*colour)[0], (*colour)[1], (*colour)[2]) : usual;
  const std::vector<study::Display> displays = withDisplay(
      study, study.displays, structure,
      [&](study::Display& display) { display.colour = asked.rgb() == usual.rgb() ? std::nullopt : colour; });
  if (document::appearanceOf(study, structure).colour.rgb() != asked.rgb()) {
    changeDisplays(document, "colour", displays, Text::tr("Colour of %1").arg(shown(structure)));
  }
}

void setOpacity(StudyDocument& document, const std::string& structure, std::optional<double> opacity) {
  LORICA_CHECK(!opacity || isWithin(*opacity, 0.0, 1.0), "opacity is 0 to 1");
  const study::Study& study = document.study();
  const double usual = document::defaultAppearance(study, structure).opacity;
  const double asked = opacity.value_or(usual);
  const std::vector<study::Display> displays =
      withDisplay(study, study.displays, structure,
                  [&](study::Display& display) { display.opacity = asked == usual ? std::nullopt : opacity; });
  if (document::appearanceOf(study, structure).opacity != asked) {
    changeDisplays(document, "opacity/" + shown(structure), displays, Text::tr("Opacity of %1").arg(shown(structure)),
                   Merge::yes);
  }
}

// --- organs and armor -----------------------------------------------------------------------------------------------

void setDescription(StudyDocument& document, const ItemRef& item, const std::string& text) {
  LORICA_CHECK(isUtf8(text), "texts are UTF-8");
  const auto of = [&](auto found, Change what) {
    change(document,
           Property<std::string>{
               QStringLiteral("description/%1").arg(shown(item.name)), what,
               [found](const study::Study& study) { return found(study).description; },
               [found](study::Study& study, const std::string& value) { found(study).description = value; }},
           text, Text::tr("Description of %1").arg(shown(item.name)));
  };
  switch (item.kind) {
    case document::ItemKind::organ:
      return of(
          [name = item.name](auto& study) -> auto& { return named(study.organs, name); }, Change::organs);
    case document::ItemKind::system:
      return of(
          [name = item.name](auto& study) -> auto& { return named(study.systems, name); }, Change::armor);
    case document::ItemKind::piece:
      return of(
          [name = item.name](auto& study) -> auto& { return named(systemWith(study, name).pieces, name); },
          Change::armor);
    case document::ItemKind::pose:
      return of(
          [name = item.name](auto& study) -> auto& { return named(study.poses, name); }, Change::poses);
    case document::ItemKind::source:
      return of(
          [name = item.name](auto& study) -> auto& { return named(study.sources, name); }, Change::sources);
    default:
      LORICA_CHECK(false, "a thing of the study that has a description");
  }
}

void setInjuryClass(StudyDocument& document, const std::string& organ, const std::string& injuryClass) {
  LORICA_CHECK(injuryClass.empty() || injuryClass == "essential" || injuryClass == "desirable",
               "the classes are essential and desirable");
  change(document, ofOrgan("class", organ, &study::Organ::injuryClass), injuryClass,
         Text::tr("Injury class of %1").arg(shown(organ)));
}

void setJoint(StudyDocument& document, const std::string& organ, const std::optional<std::string>& joint) {
  LORICA_CHECK(!joint || isName(*joint), "a joint has a name");
  change(document, ofOrgan("joint", organ, &study::Organ::joint), joint, Text::tr("Joint of %1").arg(shown(organ)));
}

void setLattice(StudyDocument& document, const std::string& organ, const study::LatticeSettings& lattice) {
  change(document, ofOrgan("lattice", organ, &study::Organ::lattice), asWritten(lattice),
         Text::tr("Lattice of %1").arg(shown(organ)));
}

void setCarriage(StudyDocument& document, const std::string& piece, study::Carriage carriage) {
  change(document, ofPiece("carriage", piece, &study::ArmorPiece::carriage), carriage,
         Text::tr("Carriage of %1").arg(shown(piece)));
}

void setMaterial(StudyDocument& document, const std::string& piece, const std::string& material) {
  change(document, ofPiece("material", piece, &study::ArmorPiece::material), withoutControls(material),
         Text::tr("Material of %1").arg(shown(piece)));
}

void setArealDensity(StudyDocument& document, const std::string& piece, std::optional<double> density) {
  LORICA_CHECK(!density || (*density > 0.0 && *density <= densest), "an areal density is above 0, up to 10000 kg/m2");
  change(document, ofPiece("areal density", piece, &study::ArmorPiece::arealDensity), density,
         Text::tr("Areal density of %1").arg(shown(piece)), Merge::yes);
}

void setNonProtecting(StudyDocument& document, const std::string& piece, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) {
    LORICA_CHECK(isName(part), "a part has a name");
  }
  change(document, ofPiece("non protecting", piece, &study::ArmorPiece::nonProtecting), once(parts),
         Text::tr("Parts of %1 that do not protect").arg(shown(piece)));
}

// --- sources --------------------------------------------------------------------------------------------------------

void setSourcePosition(StudyDocument& document, const std::string& source, const geometry::Vec3d& position) {
  study::Source wanted = named(document.study().sources, source);
  wanted.position = position;
  setSource(document, source, wanted, "position", Text::tr("Move source %1").arg(shown(source)), Merge::yes);
}

void setSourceTarget(StudyDocument& document, const std::string& source, const std::optional<geometry::Vec3d>& target) {
  study::Source wanted = named(document.study().sources, source);
  wanted.target = target;
  wanted.targetStructure.clear();
  setSource(document, source, wanted, "target", Text::tr("Target of source %1").arg(shown(source)), Merge::yes);
}

void setSourceShots(StudyDocument& document, const std::string& source, std::uint64_t shots) {
  study::Source wanted = named(document.study().sources, source);
  wanted.shots = shots;
  setSource(document, source, wanted, "shots", Text::tr("Shots of source %1").arg(shown(source)), Merge::no);
}

}  // namespace lorica::commands
