#include "lorica/document/inspection.h"

#include <gtest/gtest.h>

#include <QSignalSpy>
#include <QUndoStack>

#include "lorica/base/error.h"
#include "lorica/commands/edits.h"
#include "lorica/document/study_document.h"
#include "lorica/study/study_file.h"

namespace lorica::document {
namespace {

class InspectionTest : public testing::Test {
 protected:
  InspectionTest() {
    document_.setStudy(study::parseStudy(study::templateText("sample"), "sample"), "sample.lorica.json");
  }

  StudyDocument document_;
};

TEST_F(InspectionTest, IsToldWhenItChangesAndOnlyThen) {
  QSignalSpy told(&document_, &StudyDocument::inspectionChanged);
  document_.inspect({"liver", Driver::lattice | Driver::rays, Colouring::own});
  document_.inspect({"liver", Driver::lattice | Driver::rays, Colouring::own});
  EXPECT_EQ(told.count(), 1);
  EXPECT_TRUE(document_.inspection().showsDrivers());
  document_.inspect({"liver", {}, Colouring::strain});
  EXPECT_EQ(told.count(), 2);
  EXPECT_FALSE(document_.inspection().showsDrivers());
}

TEST_F(InspectionTest, IsNoEditAndNotKeptInTheStudy) {
  const study::Study before = document_.study();
  document_.inspect({"liver", Driver::sites, Colouring::protrusion});
  EXPECT_EQ(document_.study(), before);
  EXPECT_EQ(document_.undoStack().count(), 0);
}

TEST_F(InspectionTest, RefusesAnOrganTheStudyDoesNotHave) {
  EXPECT_THROW(document_.inspect({"tail", Driver::lattice, Colouring::own}), base::CallerError);
}

TEST_F(InspectionTest, AnotherStudyIsLookedAtFromOutside) {
  document_.inspect({"liver", Driver::lattice, Colouring::strain});
  document_.setStudy(document_.study(), "sample.lorica.json");
  EXPECT_EQ(document_.inspection(), Inspection());
}

TEST_F(InspectionTest, AnOrganThatGoesIsLookedIntoNoMore) {
  document_.inspect({"liver", Driver::lattice, Colouring::strain});
  QSignalSpy told(&document_, &StudyDocument::inspectionChanged);
  commands::removeItem(document_, {ItemKind::organ, "heart"});
  EXPECT_EQ(told.count(), 0);
  commands::removeItem(document_, {ItemKind::organ, "liver"});
  EXPECT_EQ(told.count(), 1);
  EXPECT_FALSE(document_.inspection().showsDrivers());
  EXPECT_EQ(document_.inspection().colouring, Colouring::strain);
}

TEST_F(InspectionTest, AnOrganThatIsRenamedIsLookedIntoByItsNewName) {
  const Inspection before{"liver", Driver::lattice, Colouring::own};
  document_.inspect(before);
  QSignalSpy told(&document_, &StudyDocument::inspectionChanged);
  commands::renameItem(document_, {ItemKind::organ, "liver"}, "hepar");
  EXPECT_EQ(document_.inspection(), (Inspection{"hepar", Driver::lattice, Colouring::own}));
  EXPECT_EQ(told.count(), 1);
  document_.undoStack().undo();
  EXPECT_EQ(document_.inspection(), before);
  document_.undoStack().redo();
  EXPECT_EQ(document_.inspection().organ, "hepar");
}

TEST_F(InspectionTest, WhatIsAroundTheDriversIsSeeThroughAndTheirOrganIsVisible) {
  commands::setVisible(document_, "liver", false);
  commands::setOpacity(document_, "heart", 0.01);
  document_.inspect({"liver", Driver::lattice, Colouring::own});
  EXPECT_TRUE(drawnAppearance(document_, "liver").visible);
  for (const std::string& structure : drawnStructures(document_.study())) {
    const Appearance usual = appearanceOf(document_.study(), structure);
    const Appearance drawn = drawnAppearance(document_, structure);
    EXPECT_LE(drawn.opacity, structure == "liver" ? 0.5 : 0.15) << structure;
    EXPECT_LE(drawn.opacity, usual.opacity) << structure;
    EXPECT_EQ(drawn.colour, usual.colour);
    if (structure != "liver") {
      EXPECT_EQ(drawn.visible, usual.visible) << structure;
    }
  }
  EXPECT_EQ(drawnAppearance(document_, "heart").opacity, 0.01) << "more see-through already";
}

TEST_F(InspectionTest, ColoursAreNotHiddenByTheSkinAndOrgansStaySolid) {
  document_.inspect({"", {}, Colouring::protrusion});
  EXPECT_LE(drawnAppearance(document_, "body").opacity, 0.15);
  EXPECT_LE(drawnAppearance(document_, "plate_front").opacity, 0.15);
  EXPECT_EQ(drawnAppearance(document_, "liver").opacity, 1.0);
}

}  // namespace
}  // namespace lorica::document
