#include "driver_presenter.h"

#include <gtest/gtest.h>

#include <QTest>

#include "legend.h"
#include "sample_document.h"

namespace lorica::viewport {
namespace {

using document::Colouring;
using document::Driver;
using viscera::OrganModel;

class DriverPresenterTest : public testing::Test {
 protected:
  DriverPresenterTest() { testsupport::openLoadedSample(document_); }

  std::shared_ptr<const jobs::Frame> frameOf(const std::string& organ, const std::string& pose = "toe_touch@2") {
    std::shared_ptr<const jobs::Frame> got;
    jobs::FrameEngine engine;
    engine.setStudy(testsupport::loadedSample());
    QObject::connect(
        &engine, &jobs::FrameEngine::frameReady, &engine,
        [&](std::shared_ptr<const jobs::Frame> frame) { got = std::move(frame); }, Qt::QueuedConnection);
    jobs::FrameRequest request;
    request.pose = pose;
    request.models = {OrganModel::staticJoint, OrganModel::dynamic};
    request.driversOf = organ;
    engine.request(request);
    EXPECT_TRUE(QTest::qWaitFor([&] { return got != nullptr; }, 20000));
    return got;
  }

  document::StudyDocument document_;
  vtkNew<vtkRenderer> renderer_;
};

TEST_F(DriverPresenterTest, DrawsWhatIsAskedForAndNothingElse) {
  DriverPresenter presenter(renderer_, 1);
  const auto frame = frameOf("liver");
  presenter.showFrame(frame);
  presenter.restyle(document_);
  const auto all = {Driver::lattice, Driver::controlPoints, Driver::sites, Driver::rays, Driver::frames};
  for (const Driver driver : all) {
    EXPECT_EQ(presenter.drawn(driver), 0);
  }
  const jobs::OrganDrivers& drivers = frame->drivers[1];
  const std::map<Driver, std::size_t> cells{{Driver::lattice, drivers.layout->edges.size()},
                                            {Driver::controlPoints, drivers.controlPoints.size()},
                                            {Driver::sites, drivers.sites.size() + drivers.otherSites.size()},
                                            {Driver::rays, 3 * drivers.sites.size()},
                                            {Driver::frames, 3 * drivers.sites.size()}};
  for (const Driver asked : all) {
    document_.inspect({"liver", asked, Colouring::own});
    presenter.restyle(document_);
    for (const Driver driver : all) {
      EXPECT_EQ(presenter.drawn(driver), driver == asked ? static_cast<vtkIdType>(cells.at(driver)) : 0);
    }
  }
}

TEST_F(DriverPresenterTest, ARigidOrganHasNoLatticeButTheFrameOfItsJoint) {
  DriverPresenter presenter(renderer_, 0);
  presenter.showFrame(frameOf("liver"));
  document_.inspect({"liver", Driver::lattice | Driver::frames, Colouring::own});
  presenter.restyle(document_);
  EXPECT_EQ(presenter.drawn(Driver::lattice), 0);
  EXPECT_EQ(presenter.drawn(Driver::frames), 3);
}

TEST_F(DriverPresenterTest, AFrameOfAnotherOrganIsNotTaken) {
  DriverPresenter presenter(renderer_, 1);
  presenter.showFrame(frameOf("heart"));
  document_.inspect({"liver", Driver::lattice, Colouring::own});
  presenter.restyle(document_);
  EXPECT_EQ(presenter.drawn(Driver::lattice), 0);
  presenter.showFrame(frameOf(""));
  presenter.restyle(document_);
  EXPECT_EQ(presenter.drawn(Driver::lattice), 0);
}

TEST_F(DriverPresenterTest, TheLegendNamesWhatIsDrawnAndWhatCarriesTheOrganInEachModel) {
  const auto frame = frameOf("liver");
  const ColourScale scale;
  EXPECT_TRUE(legendFor(document_, frame.get(), nullptr, scale).isEmpty());
  document_.inspect({"liver", Driver::lattice | Driver::rays, Colouring::own});
  const LegendText text = legendFor(document_, frame.get(), nullptr, scale);
  EXPECT_EQ(text.title, "liver");
  EXPECT_EQ(text.entries.size(), frame->drivers[1].sites.empty() ? 1U : 3U) << "what is not there has no entry";
  ASSERT_EQ(text.notes.size(), 2);
  EXPECT_TRUE(text.notes[0].contains(QString::fromStdString(frame->drivers[0].jointName)));
  EXPECT_TRUE(text.notes[1].contains(QString::number(frame->drivers[1].controlPoints.size())))
      << text.notes[1].toStdString();
}

TEST_F(DriverPresenterTest, TheLegendHasABarOnlyOnceTheColoursAreKnown) {
  const auto frame = frameOf("");
  document_.inspect({"", {}, Colouring::protrusion});
  const ColourScale scale{Colouring::protrusion, 0.02};
  LegendText text = legendFor(document_, frame.get(), nullptr, scale);
  EXPECT_FALSE(text.bar);
  EXPECT_EQ(text.notes.size(), 1);
  jobs::OrganColours colours{frame, Colouring::protrusion, {{0.0F, 0.0125F}}, {}};
  text = legendFor(document_, frame.get(), &colours, scale);
  ASSERT_TRUE(text.bar);
  EXPECT_TRUE(text.bar->note.contains("12.5 mm")) << text.bar->note.toStdString();
  EXPECT_DOUBLE_EQ(text.bar->unit * text.bar->scale.end, 20.0);
  colours.values.clear();
  colours.trouble = "The skin does not close.";
  text = legendFor(document_, frame.get(), &colours, scale);
  EXPECT_FALSE(text.bar);
  EXPECT_EQ(text.notes, QStringList(colours.trouble));
}

}  // namespace
}  // namespace lorica::viewport
