#include "lorica/panels/inspection_panel.h"

#include <gtest/gtest.h>

#include <QCheckBox>
#include <QComboBox>
#include <QMenu>
#include <QRadioButton>
#include <QTreeView>

#include "lorica/commands/edits.h"
#include "lorica/models/model_texts.h"
#include "lorica/panels/project_panel.h"
#include "sample_document.h"

namespace lorica::panels {
namespace {

using document::Colouring;
using document::Driver;
using document::ItemKind;
using document::ItemRef;

class InspectionPanelTest : public testing::Test {
 protected:
  InspectionPanelTest() { testsupport::openLoadedSample(document_); }

  QComboBox& organ() { return *panel_.findChild<QComboBox*>("inspected_organ"); }
  QCheckBox& box(Driver driver) {
    for (const models::DriverText& text : models::driverTexts()) {
      if (text.driver == driver) {
        for (QCheckBox* one : panel_.findChildren<QCheckBox*>()) {
          if (one->text() == text.label) {
            return *one;
          }
        }
      }
    }
    throw std::runtime_error("no such box");
  }

  document::StudyDocument document_;
  InspectionPanel panel_{document_};
};

TEST_F(InspectionPanelTest, ChoosingAnOrganShowsItsLattice) {
  EXPECT_EQ(organ().count(), static_cast<int>(document_.study().organs.size()) + 1);
  EXPECT_FALSE(box(Driver::lattice).isEnabled());
  organ().setCurrentIndex(organ().findData("liver"));
  EXPECT_EQ(document_.inspection(),
            (document::Inspection{"liver", Driver::lattice | Driver::controlPoints, Colouring::own}));
  box(Driver::lattice).setChecked(false);
  box(Driver::rays).setChecked(true);
  EXPECT_EQ(document_.inspection().drivers, Driver::controlPoints | Driver::rays);
  organ().setCurrentIndex(organ().findData("heart"));
  EXPECT_EQ(document_.inspection().organ, "heart");
  EXPECT_EQ(document_.inspection().drivers, Driver::controlPoints | Driver::rays) << "what was asked for stays";
  organ().setCurrentIndex(0);
  EXPECT_FALSE(document_.inspection().showsDrivers());
}

TEST_F(InspectionPanelTest, FollowsTheDocument) {
  document_.inspect({"heart", Driver::frames, Colouring::strain});
  EXPECT_EQ(organ().currentData().toString(), "heart");
  EXPECT_TRUE(box(Driver::frames).isChecked());
  EXPECT_FALSE(box(Driver::lattice).isChecked());
  QStringList checked;
  for (const QRadioButton* button : panel_.findChildren<QRadioButton*>()) {
    if (button->isChecked()) {
      checked << button->text();
    }
  }
  EXPECT_EQ(checked, QStringList("Edge stretch"));
  commands::removeItem(document_, {ItemKind::organ, "heart"});
  EXPECT_EQ(organ().currentIndex(), 0);
  EXPECT_EQ(organ().findData("heart"), -1);
  document_.close();
  EXPECT_FALSE(organ().isVisibleTo(&panel_));
}

TEST_F(InspectionPanelTest, ColoursAreChosenByThemselves) {
  for (QRadioButton* button : panel_.findChildren<QRadioButton*>()) {
    if (button->text() == "Depth beyond the skin") {
      button->click();
    }
  }
  EXPECT_EQ(document_.inspection(), (document::Inspection{"", {}, Colouring::protrusion}));
}

TEST_F(InspectionPanelTest, TheMenuOfAnOrganSwitchesEachOfItsDrivers) {
  ProjectPanel project(document_);
  document_.select(ItemRef{ItemKind::organ, "liver"});
  const auto trigger = [&](const QString& text) {
    QMenu menu;
    project.fillMenu(menu);
    for (QAction* action : menu.actions()) {
      if (action->menu() != nullptr) {
        for (QAction* one : action->menu()->actions()) {
          if (one->text() == text) {
            one->trigger();
            return;
          }
        }
      }
    }
    FAIL() << text.toStdString();
  };
  trigger("Lattice");
  trigger("Anchor rays");
  EXPECT_EQ(document_.inspection(), (document::Inspection{"liver", Driver::lattice | Driver::rays, Colouring::own}));
  trigger("Lattice");
  EXPECT_EQ(document_.inspection().drivers, document::Drivers(Driver::rays));
  document_.select(ItemRef{ItemKind::organ, "heart"});
  trigger("Control points");
  EXPECT_EQ(document_.inspection(), (document::Inspection{"heart", Driver::controlPoints, Colouring::own}));
  trigger("Nothing");
  EXPECT_FALSE(document_.inspection().showsDrivers());
}

}  // namespace
}  // namespace lorica::panels
