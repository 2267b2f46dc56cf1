/// \file
/// Takes the user guide's pictures of the built-in human: all sizes, every motion's extreme, organs from three sides,
/// armor from front and back. usage: lorica_human_pictures OUT_FOLDER

#include <QApplication>
#include <QDir>
#include <QPainter>
#include <QTest>
#include <cstdio>
#include <functional>

#include "look.h"
#include "lorica/manikin/body.h"
#include "lorica/study/study_file.h"
#include "main_window.h"

namespace {

using lorica::gui::MainWindow;
using lorica::human::Sex;
using lorica::study::Study;
using lorica::viewport::StandardView;

constexpr int patience = 120000;

Study sample() {
  return lorica::study::parseStudy(lorica::study::templateText("sample"), "sample");
}

void draw(Study& study, const std::string& structure, bool visible, std::optional<double> opacity) {
  study.displays.push_back({structure, visible, {}, opacity});
}

/// A view without a window's frames, tall enough for one person.
class Studio {
 public:
  explicit Studio(QString folder) : folder_(std::move(folder)) {
    QDir().mkpath(folder_);
    window_.resize(1500, 1300);
    window_.show();
  }

  void show(Study study) {
    study.sources.clear();  // their marks would cross the person
    const QString file = folder_ + "/shown.lorica.json";
    lorica::study::saveStudy(study, file.toStdString());
    window_.openFile(file);
    window_.document().showModels({lorica::viscera::OrganModel::dynamic});
    settle("rest");
  }
  void pose(const std::string& name) {
    window_.document().showPose(name);
    settle(name);
  }
  QImage from(StandardView side) {
    window_.view().lookFrom(side);
    window_.view().fit();
    QTest::qWait(600);
    const QImage whole = window_.view().picture();
    // The person stands in the middle; the sides are empty.
    const int width = std::min(whole.width(), whole.height());
    return whole.copy((whole.width() - width) / 2, 0, width, whole.height());
  }
  void save(const char* name, const std::vector<std::pair<QString, QImage>>& pictures, int columns) {
    constexpr int size = 420;
    constexpr int line = 26;
    const int rows = (static_cast<int>(pictures.size()) + columns - 1) / columns;
    QImage sheet(columns * size, rows * (size + line), QImage::Format_RGB32);
    sheet.fill(Qt::white);
    QPainter painter(&sheet);
    QFont font = painter.font();
    font.setPixelSize(15);
    painter.setFont(font);
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    for (int i = 0; i < static_cast<int>(pictures.size()); ++i) {
      const auto& [title, image] = pictures[static_cast<std::size_t>(i)];
      const int x = i % columns * size;
      const int y = i / columns * (size + line);
      painter.drawImage(QRect(x, y, size, size),
                        image.scaled(size, size, Qt::KeepAspectRatioByExpanding, Qt::SmoothTransformation));
      painter.drawText(QRect(x, y + size, size, line), Qt::AlignCenter, title);
    }
    painter.end();
    sheet.save(folder_ + "/" + name + ".png");
  }

 private:
  void settle(const std::string& pose) {
    const bool there = QTest::qWaitFor(
        [&] {
          const auto& frame = window_.view().frame();
          return window_.loader().isInStep() && frame != nullptr && frame->pose == pose && !window_.engine().isBusy();
        },
        patience);
    if (!there) {
      std::fprintf(stderr, "%s was not shown\n", pose.c_str());
    }
    QTest::qWait(300);
  }

  QString folder_;
  MainWindow window_;
};

void hideArmor(Study& study) {
  study.systems.clear();
}

void takeSizes(Studio& studio) {
  std::vector<std::pair<QString, QImage>> pictures;
  for (const Sex sex : {Sex::male, Sex::female}) {
    for (const double percentile : {5.0, 50.0, 95.0}) {
      Study study = lorica::study::parseStudy(lorica::study::templateText("minimal"), "minimal");
      study.person = lorica::manikin::personAtPercentile(sex, percentile);
      draw(study, "body", true, 1.0);
      studio.show(study);
      pictures.emplace_back(QStringLiteral("%1, %2th percentile: %3 m, %4 kg")
                                .arg(sex == Sex::male ? "man" : "woman")
                                .arg(percentile)
                                .arg(study.person.stature, 0, 'f', 2)
                                .arg(study.person.mass, 0, 'f', 1),
                            studio.from(StandardView::front));
    }
  }
  studio.save("human_sizes", pictures, 3);
}

void takeMotions(Studio& studio) {
  Study study = sample();
  hideArmor(study);
  draw(study, "body", true, 1.0);
  studio.show(study);
  std::vector<std::pair<QString, QImage>> pictures;
  const std::vector<std::pair<std::string, StandardView>> extremes{{"toe_touch@2", StandardView::left},
                                                                   {"belly_twist@1", StandardView::front},
                                                                   {"lateral_twist@1", StandardView::front},
                                                                   {"squat@1.75", StandardView::left},
                                                                   {"kneel_aim@2.5", StandardView::left},
                                                                   {"prone_aim@3.5", StandardView::left},
                                                                   {"arm_raise@1.75", StandardView::front},
                                                                   {"walk@0.3", StandardView::left},
                                                                   {"sit@2", StandardView::left}};
  for (const auto& [pose, side] : extremes) {
    studio.pose(pose);
    pictures.emplace_back(QString::fromStdString(pose), studio.from(side));
  }
  studio.save("human_motions", pictures, 3);
}

void takeOrgans(Studio& studio) {
  Study study = sample();
  hideArmor(study);
  draw(study, "body", true, 0.14);
  for (const char* vessel : {"arteries", "veins"}) {
    draw(study, vessel, false, {});
  }
  studio.show(study);
  std::vector<std::pair<QString, QImage>> pictures;
  const std::vector<std::pair<QString, StandardView>> sides{
      {"organs, front", StandardView::front}, {"left", StandardView::left}, {"back", StandardView::back}};
  for (const auto& [title, side] : sides) {
    pictures.emplace_back(title, studio.from(side));
  }
  for (auto& display : study.displays) {
    display.visible = display.structure == "body" || display.structure == "arteries" || display.structure == "veins";
  }
  for (const auto& organ : study.organs) {
    if (organ.name != "arteries" && organ.name != "veins" && organ.name != "heart") {
      draw(study, organ.name, false, {});
    }
  }
  studio.show(study);
  pictures.emplace_back(QStringLiteral("heart and vessels, front"), studio.from(StandardView::front));
  pictures.emplace_back(QStringLiteral("left"), studio.from(StandardView::left));
  studio.pose("toe_touch@2");
  pictures.emplace_back(QStringLiteral("in the toe-touch"), studio.from(StandardView::left));
  studio.save("human_organs", pictures, 3);
}

void takeArmor(Studio& studio) {
  const Study all = lorica::study::parseStudy(lorica::study::templateText("vest_against_carrier"), "armor");
  std::vector<std::pair<QString, QImage>> pictures;
  for (std::size_t s = 0; s < all.systems.size(); ++s) {
    Study study = all;
    study.organs.clear();
    study.systems = {all.systems[s]};
    draw(study, "body", true, 1.0);
    studio.show(study);
    const QString name = QString::fromStdString(all.systems[s].name);
    pictures.emplace_back(name, studio.from(StandardView::front));
    pictures.emplace_back(QStringLiteral("back"), studio.from(StandardView::back));
    studio.pose("kneel_aim@2.5");
    pictures.emplace_back(QStringLiteral("kneel_aim"), studio.from(StandardView::left));
  }
  studio.save("human_armor", pictures, 3);
}

}  // namespace

int main(int argc, char** argv) {
  QApplication application(argc, argv);
  lorica::gui::useOwnLook();
  if (argc != 2) {
    std::fprintf(stderr, "usage: lorica_human_pictures OUT_FOLDER\n");
    return 2;
  }
  Studio studio(argv[1]);
  takeOrgans(studio);
  takeArmor(studio);
  takeMotions(studio);
  takeSizes(studio);
  return 0;
}
