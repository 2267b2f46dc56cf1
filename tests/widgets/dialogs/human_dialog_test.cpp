#include "lorica/dialogs/human_dialog.h"

#include <gtest/gtest.h>

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QElapsedTimer>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QRadioButton>
#include <QSignalSpy>
#include <QSlider>
#include <QSpinBox>
#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <memory>

#include "lorica/base/error.h"
#include "lorica/geometry/measures.h"
#include "lorica/manikin/body.h"
#include "lorica/study/study_file.h"
#include "lorica/viewport/person_view.h"

namespace lorica::dialogs {
namespace {

using human::Person;
using human::Sex;
using Purpose = HumanDialog::Purpose;

constexpr int patience = 240000;

class HumanSizes : public testing::Test {
 protected:
  // Nobody was made before.
  HumanSizes() { qputenv("LORICA_CACHE", cache_.path().toUtf8()); }
  ~HumanSizes() override { qunsetenv("LORICA_CACHE"); }
  template <class Widget>
  Widget* part(const char* name) const {
    auto* found = dialog_->findChild<Widget*>(QString::fromLatin1(name));
    EXPECT_NE(found, nullptr) << name;
    return found;
  }
  void make(Purpose purpose, const Person& person = {}) { dialog_ = std::make_unique<HumanDialog>(purpose, person); }
  const viewport::PersonView& view() const { return *part<viewport::PersonView>("person_view"); }
  /// Of the skin that is shown.
  double height() const { return geometry::bounds(view().skin()->positions).sizes().y(); }
  /// The picture of the person that is chosen is there, and nothing more is made.
  bool waitForPicture() const {
    return QTest::qWaitFor([this] { return dialog_->shownPerson() == dialog_->person(); }, patience);
  }

  QTemporaryDir cache_;
  std::unique_ptr<HumanDialog> dialog_ = std::make_unique<HumanDialog>(Purpose::newStudy);
};

TEST_F(HumanSizes, StartWithTheMedianMan) {
  EXPECT_EQ(dialog_->person(), Person());
  EXPECT_TRUE(part<QRadioButton>("male")->isChecked());
  EXPECT_TRUE(part<QRadioButton>("by_percentile")->isChecked());
  EXPECT_EQ(part<QSpinBox>("percentile")->value(), 50);
  EXPECT_EQ(part<QDoubleSpinBox>("stature")->value(), 175.5);
  EXPECT_EQ(part<QDoubleSpinBox>("mass")->value(), 84.6);
  EXPECT_EQ(part<QLabel>("bmi")->text(), "27.5 kg/m²");
}

TEST_F(HumanSizes, FollowThePercentileOfTheirOwnSexAndCanAllBeMade) {
  for (const Sex sex : {Sex::male, Sex::female}) {
    dialog_->setSex(sex);
    Person last{sex, 0.0, 0.0};
    for (int percentile = 1; percentile <= 99; ++percentile) {
      dialog_->setPercentile(percentile);
      const Person& person = dialog_->person();
      const Person exact = manikin::personAtPercentile(sex, percentile);
      EXPECT_EQ(person.sex, sex);
      EXPECT_NEAR(person.stature, exact.stature, 0.0005 + 1e-9);
      EXPECT_NEAR(person.mass, exact.mass, 0.05 + 1e-9);
      EXPECT_GE(person.stature, last.stature);
      EXPECT_GE(person.mass, last.mass);
      EXPECT_NO_THROW(manikin::checkPerson(person)) << percentile;
      EXPECT_NEAR(part<QDoubleSpinBox>("stature")->value(), 100.0 * person.stature, 1e-6);
      EXPECT_NEAR(part<QDoubleSpinBox>("mass")->value(), person.mass, 1e-6);
      EXPECT_EQ(part<QSlider>("percentile_slider")->value(), percentile);
      last = person;
    }
  }
}

TEST_F(HumanSizes, ThatWereAPercentileAreFoundAgainAsOne) {
  dialog_->setSex(Sex::female);
  dialog_->setPercentile(83);
  const Person chosen = dialog_->person();
  make(Purpose::changePerson, chosen);
  EXPECT_EQ(dialog_->person(), chosen);
  EXPECT_TRUE(part<QRadioButton>("female")->isChecked());
  EXPECT_TRUE(part<QRadioButton>("by_percentile")->isChecked());
  EXPECT_EQ(part<QSpinBox>("percentile")->value(), 83);
}

TEST_F(HumanSizes, StayWhenTheWayToChooseThemChangesToStatureAndMass) {
  dialog_->setPercentile(20);
  const Person before = dialog_->person();
  EXPECT_FALSE(part<QDoubleSpinBox>("stature")->isEnabled());
  part<QRadioButton>("by_sizes")->setChecked(true);
  EXPECT_EQ(dialog_->person(), before);
  EXPECT_TRUE(part<QDoubleSpinBox>("stature")->isEnabled());
  EXPECT_FALSE(part<QSlider>("percentile_slider")->isEnabled());
  part<QDoubleSpinBox>("mass")->setValue(90.0);
  EXPECT_EQ(dialog_->person(), (Person{Sex::male, before.stature, 90.0}));
}

TEST_F(HumanSizes, KeepToTheLimitsWhichAreSaid) {
  for (const double stature : {1.40, 1.555, 1.752, 2.10}) {
    dialog_->setSizes(stature, 70.0);
    const auto* mass = part<QDoubleSpinBox>("mass");
    const double least = mass->minimum();
    const double greatest = mass->maximum();
    EXPECT_NO_THROW(manikin::checkPerson({Sex::male, stature, least})) << stature;
    EXPECT_NO_THROW(manikin::checkPerson({Sex::male, stature, greatest})) << stature;
    EXPECT_THROW(manikin::checkPerson({Sex::male, stature, least - 0.1}), base::InputError) << stature;
    EXPECT_THROW(manikin::checkPerson({Sex::male, stature, greatest + 0.2}), base::InputError) << stature;
    const QString said = part<QLabel>("mass_limits")->text();
    EXPECT_TRUE(said.contains(QString::number(least, 'f', 1))) << said.toStdString();
    EXPECT_TRUE(said.contains(QString::number(greatest, 'f', 1))) << said.toStdString();
  }
  EXPECT_EQ(part<QLabel>("stature_limits")->text(), "140 to 210 cm");
  dialog_->setSizes(9.0, 1.0);
  EXPECT_EQ(dialog_->person().stature, 2.1);
  EXPECT_NO_THROW(manikin::checkPerson(dialog_->person()));
  dialog_->setSizes(1.5, 100.0);
  dialog_->setSizes(1.4, 100.0);
  EXPECT_LT(dialog_->person().mass, 100.0) << "a smaller person cannot stay as heavy";
  EXPECT_NO_THROW(manikin::checkPerson(dialog_->person()));
}

TEST_F(HumanSizes, FinerThanTheFieldsStayUntilTheyAreChanged) {
  const Person fine{Sex::female, 1.62345, 63.789};
  make(Purpose::changePerson, fine);
  EXPECT_EQ(dialog_->person(), fine);
  EXPECT_TRUE(part<QRadioButton>("by_sizes")->isChecked());
  part<QDoubleSpinBox>("mass")->setValue(64.0);
  EXPECT_EQ(dialog_->person(), (Person{Sex::female, 1.623, 64.0}));
}

TEST_F(HumanSizes, BeyondTheLimitsAreBroughtWithinThem) {
  make(Purpose::changePerson, {Sex::male, 1.2, 20.0});
  EXPECT_EQ(dialog_->person().stature, 1.4);
  EXPECT_NO_THROW(manikin::checkPerson(dialog_->person()));
}

TEST_F(HumanSizes, MakeAStudyWithTheChosenSystemsAndOrgans) {
  dialog_->setSex(Sex::female);
  dialog_->setPercentile(5);
  part<QCheckBox>("full_torso")->setChecked(false);
  part<QCheckBox>("plate_carrier_helmet")->setChecked(true);
  part<QComboBox>("organs")->setCurrentIndex(1);
  const study::Study study = dialog_->study();
  EXPECT_EQ(study.person, dialog_->person());
  ASSERT_EQ(study.systems.size(), 2U);
  EXPECT_EQ(study.systems[0].name, "plate_carrier");
  EXPECT_EQ(study.systems[1].name, "plate_carrier_helmet");
  EXPECT_TRUE(std::none_of(study.organs.begin(), study.organs.end(), [](const auto& o) { return o.name == "brain"; }));
  EXPECT_TRUE(std::any_of(study.organs.begin(), study.organs.end(), [](const auto& o) { return o.name == "liver"; }));
  EXPECT_EQ(study::parseStudy(study::studyText(study), "s"), study);
}

TEST_F(HumanSizes, OfAnotherPersonAskForNothingElse) {
  make(Purpose::changePerson);
  EXPECT_EQ(dialog_->findChild<QComboBox*>("organs"), nullptr);
  EXPECT_EQ(dialog_->findChild<QCheckBox*>("full_torso"), nullptr);
  EXPECT_THROW((void)dialog_->study(), base::CallerError);
}

TEST_F(HumanSizes, AreSeenAndMeasuredOnThePerson) {
  dialog_->show();
  EXPECT_EQ(view().skin(), nullptr);
  EXPECT_TRUE(part<QProgressBar>("preview_progress")->isVisible());
  ASSERT_TRUE(waitForPicture());
  ASSERT_NE(view().skin(), nullptr);
  EXPECT_FALSE(view().isDimmed());
  EXPECT_FALSE(part<QProgressBar>("preview_progress")->isVisible());
  EXPECT_NEAR(height(), 1.755, 0.002);
  EXPECT_EQ(part<QLabel>("wanted_stature")->text(), "175.5 cm");
  for (const char* id : {"stature", "mass", "chest_girth", "waist_girth", "hip_girth"}) {
    const auto number = [&](const std::string& name) {
      return part<QLabel>(name.c_str())->text().section(' ', 0, 0).toDouble();
    };
    const double wanted = number(std::string("wanted_") + id);
    EXPECT_GT(wanted, 50.0) << id;
    EXPECT_NEAR(number(std::string("measured_") + id), wanted, 0.03 * wanted) << id;
  }
}

TEST_F(HumanSizes, ThatChangeWhileAPersonIsMadeDropThatOne) {
  dialog_->show();
  ASSERT_TRUE(waitForPicture());
  const auto median = view().skin();
  QSignalSpy arrived(dialog_.get(), &HumanDialog::previewArrived);
  dialog_->setSizes(1.95, 110.0);
  EXPECT_TRUE(view().isDimmed());
  EXPECT_EQ(view().skin(), median) << "the old picture stays";
  QTest::qWait(600);  // it is being made now
  dialog_->setSizes(1.60, 55.0);
  ASSERT_TRUE(waitForPicture());
  EXPECT_EQ(arrived.count(), 1) << "nobody saw the tall man";
  EXPECT_NEAR(height(), 1.60, 0.002);
  EXPECT_FALSE(view().isDimmed());
}

TEST_F(HumanSizes, ThatComeBackToWhatIsShownNeedNoMaking) {
  dialog_->show();
  ASSERT_TRUE(waitForPicture());
  QSignalSpy arrived(dialog_.get(), &HumanDialog::previewArrived);
  dialog_->setPercentile(70);
  EXPECT_TRUE(view().isDimmed());
  dialog_->setPercentile(50);
  EXPECT_FALSE(view().isDimmed());
  QTest::qWait(800);
  EXPECT_EQ(arrived.count(), 0);
  EXPECT_FALSE(part<QProgressBar>("preview_progress")->isVisible());
}

TEST_F(HumanSizes, ManyChangesInARowMakeOnePerson) {
  dialog_->show();
  ASSERT_TRUE(waitForPicture());
  QSignalSpy arrived(dialog_.get(), &HumanDialog::previewArrived);
  for (int percentile = 51; percentile <= 60; ++percentile) {
    dialog_->setPercentile(percentile);
    QTest::qWait(20);
  }
  ASSERT_TRUE(waitForPicture());
  QTest::qWait(800);
  EXPECT_EQ(arrived.count(), 1);
}

TEST_F(HumanSizes, TheDialogNeverWaitsForAPerson) {
  dialog_->show();
  dialog_->setPercentile(90);
  QSignalSpy arrived(dialog_.get(), &HumanDialog::previewArrived);
  QTest::qWait(600);  // it is being made now
  ASSERT_NE(dialog_->shownPerson(), dialog_->person());
  QElapsedTimer clock;
  clock.start();
  dialog_->reject();
  dialog_.reset();
  EXPECT_LT(clock.elapsed(), 1000);
  QTest::qWait(3000);
  EXPECT_EQ(arrived.count(), 0);
}

}  // namespace
}  // namespace lorica::dialogs
