#include <gtest/gtest.h>

#include <random>

#include "lorica/commands/shot_edits.h"
#include "lorica/document/appearance.h"
#include "lorica/study/study_file.h"
#include "two_systems.h"

namespace lorica::commands {
namespace {

using document::ItemKind;

/// Edits at random, the same for the same seed on every machine.
class RandomEditor {
 public:
  RandomEditor(StudyDocument& document, std::uint64_t seed) : document_(document), numbers_(seed) {}

  void step() {
    switch (below(26)) {
      case 0:
        return setStudyName(document_, name());
      case 1:
        return setStudyDescription(document_, name());
      case 2:
        return setModels(document_, below(2) == 0
                                        ? std::vector{viscera::OrganModel::dynamic}
                                        : std::vector{viscera::OrganModel::staticSkin, viscera::OrganModel::dynamic});
      case 3:
        return setTrials(document_, static_cast<std::uint32_t>(1 + below(20)));
      case 4:
        return setSeed(document_, numbers_());
      case 5:
        return setRunPoses(document_, runPoses());
      case 6:
      case 7:
        return setVisible(document_, structure(), below(2) == 0);
      case 8:
        return setAllVisible(document_, document::drawnStructures(study()), below(2) == 0, "all");
      case 9:
        return setColour(document_, structure(), colour());
      case 10:
      case 11:
        return setOpacity(document_, structure(), below(4) == 0 ? std::nullopt : std::optional(fraction()));
      case 12:
        return addOrgan();
      case 13:
        return addSystem();
      case 14: {
        addSource(document_);
        return;
      }
      case 15:
        return addAnyPose();
      case 16:
      case 17:
        return rename();
      case 18:
        return remove();
      case 19:
        return editOrgan();
      case 20:
        return editPiece();
      case 21:
      case 22:
        return editSource();
      case 23:
        return editRun();
      case 24:
        if (!study().sources.empty()) {
          duplicateSource(document_, study().sources[below(study().sources.size())].name);
        }
        return;
      default:
        if (below(2) == 0) {
          document_.undoStack().undo();
        } else {
          document_.undoStack().redo();
        }
    }
  }

 private:
  const study::Study& study() const { return document_.study(); }
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(numbers_() % count); }
  /// Sixteenths, and now and then any number.
  double fraction() {
    return below(4) == 0 ? static_cast<double>(numbers_() >> 11U) * 0x1p-53 : static_cast<double>(below(17)) / 16.0;
  }
  double coordinate() { return 20.0 * fraction() - 10.0; }
  template <class Items>
  auto& oneOf(Items& items) {
    return items[below(items.size())];
  }
  std::string structure() {
    const std::vector<std::string> drawn = document::drawnStructures(study());
    return oneOf(drawn);
  }
  std::string name() {
    static const std::vector<std::string> names{"heart", "liver", "left lung", "a",    "b",           "c",      "ä",
                                                "front", "back",  "plate",     "rest", "toe_touch@2", "walk@1", "body"};
    return oneOf(names);
  }
  std::optional<std::array<std::uint8_t, 3>> colour() {
    if (below(3) == 0) {
      return std::nullopt;
    }
    return std::array<std::uint8_t, 3>{static_cast<std::uint8_t>(below(3)), 20, 30};
  }
  std::vector<std::string> runPoses() {
    std::vector<std::string> poses;
    for (const study::Pose& pose : study().poses) {
      if (below(2) == 0) {
        poses.push_back(pose.name);
      }
    }
    if (below(2) == 0) {
      poses.emplace_back("rest");
      poses.emplace_back("toe_touch@2");
    }
    return poses;
  }
  std::vector<ItemRef> items() const {
    std::vector<ItemRef> all;
    for (const study::Organ& organ : study().organs) {
      all.push_back({ItemKind::organ, organ.name});
    }
    for (const study::ArmorSystem& system : study().systems) {
      all.push_back({ItemKind::system, system.name});
      for (const study::ArmorPiece& piece : system.pieces) {
        all.push_back({ItemKind::piece, piece.name});
      }
    }
    for (const study::Pose& pose : study().poses) {
      all.push_back({ItemKind::pose, pose.name});
    }
    for (const study::Source& source : study().sources) {
      all.push_back({ItemKind::source, source.name});
    }
    return all;
  }
  std::string fresh(const std::string& stem) { return stem + std::to_string(++made_); }

  void addOrgan() {
    study::Study after = study();
    after.organs.push_back({fresh("organ "), {study::Builtin{"human/heart"}, {}}, "", {}, {}, {}});
    replaceStudy(document_, after, "Add organ");
  }
  void addSystem() {
    study::Study after = study();
    after.systems.push_back({fresh("system "), {}, {}});
    for (std::size_t i = below(3); i > 0; --i) {
      study::ArmorPiece piece;
      piece.name = fresh("piece ");
      piece.mesh.from = study::Builtin{"front_plate"};
      after.systems.back().pieces.push_back(piece);
    }
    replaceStudy(document_, after, "Add system");
  }
  void addAnyPose() {
    const double seconds = static_cast<double>(below(8)) / 4.0;
    const bool turned = below(3) == 0;
    study::Pose pose;
    pose.name = turned ? fresh("pose ") : "toe_touch@" + std::to_string(seconds);
    if (turned) {
      pose.what = study::TurnedPose{{{"neck", {coordinate(), 0, 0}}}, {0, coordinate(), 0}};
    } else {
      pose.what = study::ClipPose{"toe_touch", seconds};
    }
    addPose(document_, pose);
  }
  void rename() {
    const std::vector<ItemRef> all = items();
    const std::string wanted = name();
    if (!all.empty()) {
      const ItemRef item = oneOf(all);
      if (renameTrouble(document_, item, wanted).isEmpty()) {
        renameItem(document_, item, wanted);
      }
    }
  }
  void remove() {
    const std::vector<ItemRef> all = items();
    if (!all.empty()) {
      removeItem(document_, oneOf(all));
    }
  }
  void editOrgan() {
    if (study().organs.empty()) {
      return;
    }
    const std::string organ = oneOf(study().organs).name;
    study::LatticeSettings lattice;
    using Layout = study::LatticeSettings::Layout;
    switch (below(4)) {
      case 0:
        return setInjuryClass(document_, organ, below(2) == 0 ? "essential" : "");
      case 1:
        return setJoint(document_, organ, below(2) == 0 ? std::nullopt : std::optional<std::string>("neck"));
      case 2:
        lattice.cellMetres = 0.001 + fraction();
        return setLattice(document_, organ, lattice);
      default:
        lattice.layout = below(2) == 0 ? Layout::perAxis : Layout::uniform;
        lattice.cells = {1, 2, static_cast<int>(1 + below(5))};
        lattice.prune = below(2) == 0;
        return setLattice(document_, organ, lattice);
    }
  }
  void editPiece() {
    for (const study::ArmorSystem& system : study().systems) {
      if (!system.pieces.empty() && below(2) == 0) {
        const std::string piece = oneOf(system.pieces).name;
        if (below(3) == 0) {
          return below(2) == 0
                     ? setMaterial(document_, piece, name())
                     : setArealDensity(
                           document_, piece,
                           below(2) == 0 ? std::nullopt : std::optional(0.5 * static_cast<double>(1 + below(60))));
        }
        if (below(2) == 0) {
          return setCarriage(document_, piece, below(2) == 0 ? study::Carriage::rigid : study::Carriage::skinned);
        }
        return setNonProtecting(document_, piece, below(2) == 0 ? std::vector<std::string>{} : std::vector{name()});
      }
    }
  }
  void editSource() {
    if (study().sources.empty()) {
      return;
    }
    const std::string source = oneOf(study().sources).name;
    switch (below(4)) {
      case 0:
        return setSourcePosition(document_, source, {coordinate(), coordinate(), -0.0});
      case 1:
        return setSourceTarget(
            document_, source,
            below(2) == 0 ? std::nullopt : std::optional(geometry::Vec3d(coordinate(), 1, coordinate())));
      case 2:
        return editSourceType(source);
      default:
        return setSourceShots(document_, source, 1 + below(1000));
    }
  }
  void editSourceType(const std::string& name) {
    study::Source source = oneOf(study().sources);
    source = asType(source, study::SourceType(below(5)));
    source.sampler = study::Sampler(below(4));
    source.sequence = study::Sequence(below(3));
    source.width = source.height = source.radius = source.cell = 0.001 * static_cast<double>(below(1000));
    source.azimuth = {coordinate(), coordinate()};
    source.elevation = {coordinate(), coordinate()};
    source.list.path = below(2) == 0 ? "shots.csv" : "";
    source.targetStructure = below(2) == 0 ? structure() : "";
    if (sourceTroubles(asWritten(source)).empty()) {
      setSource(document_, name, source, "type", "any", below(2) == 0 ? Merge::yes : Merge::no);
    }
  }
  void editRun() {
    study::StopRule stop;
    for (const study::Organ& organ : study().organs) {
      if (below(2) == 0) {
        stop.structures.push_back(organ.name);
      }
    }
    stop.halfWidth = fraction();
    switch (below(3)) {
      case 0:
        return setStop(document_, stopTroubles(stop).empty() ? std::optional(stop) : std::nullopt);
      case 1:
        return setOverlap(document_, {shotline::OverlapPolicy(below(3)), stop.structures});
      default: {
        study::Analyses analyses;
        analyses.compare = below(2) == 0;
        if (below(2) == 0) {
          analyses.directions = study::DirectionGrid{15.0, 1 + below(1000)};
        }
        if (below(2) == 0) {
          analyses.motion = study::MotionSettings{"walk", static_cast<std::uint32_t>(1 + below(9)), 25.0};
        }
        return setAnalyses(document_, analyses);
      }
    }
  }

  StudyDocument& document_;
  std::mt19937_64 numbers_;
  int made_ = 0;
};

class ManyEdits : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(ManyEdits, ReadBackAfterEachAndAreUndoneAndRedoneToTheByte) {
  StudyDocument document;
  document.setStudy(test::twoSystems(), "/studies/two.lorica.json");
  const std::string first = study::studyText(document.study());
  RandomEditor editor(document, GetParam());
  for (int i = 0; i < 1000; ++i) {
    editor.step();
    const study::Study read = study::parseStudy(study::studyText(document.study()), "s");
    ASSERT_EQ(read, document.study()) << "after edit " << i << ": " << document.undoStack().undoText().toStdString();
    ASSERT_TRUE(!document.selection() || document::exists(document, *document.selection()));
  }
  QUndoStack& stack = document.undoStack();
  ASSERT_GT(stack.count(), 300);
  stack.setIndex(stack.count());
  const std::string last = study::studyText(document.study());
  EXPECT_NE(last, first);
  for (int round = 0; round < 2; ++round) {
    stack.setIndex(0);
    EXPECT_EQ(study::studyText(document.study()), first);
    stack.setIndex(stack.count());
    EXPECT_EQ(study::studyText(document.study()), last);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, ManyEdits, ::testing::Values(1, 2, 3));

}  // namespace
}  // namespace lorica::commands
