#pragma once

/// \file
/// The 3-D view: the posed human with its organs and armor, one picture or two side by side that share a camera. It
/// shows frames and listens to the document for colours, visibility and selection. The one room that knows VTK's
/// rendering.
///
/// Where the document's inspection asks for it, what drives an organ is drawn around it, organs are coloured by how
/// they fare once the pose rests, and a legend says what is what.
///
/// However many things change at once, there is one drawing of the newest, as soon as nothing else waits to be done.
/// Where a drawing in full is too slow for that, as without a graphics card, coarse ones are drawn while something
/// moves, and what is shown is drawn in full when it has come to rest.

#include <QImage>
#include <QWidget>
#include <memory>
#include <optional>
#include <string>

#include "lorica/document/study_document.h"
#include "lorica/jobs/frame_engine.h"
#include "lorica/jobs/run_survey.h"
#include "lorica/jobs/shot_inspector.h"

namespace lorica::viewport {

enum class StandardView { front, back, left, right, top, bottom };

class SceneView : public QWidget {
  Q_OBJECT

 public:
  explicit SceneView(document::StudyDocument& document, QWidget* parent = nullptr);
  ~SceneView() override;

  /// The frame is kept until the next one; null clears the view. A new study is framed by the camera.
  void showFrame(std::shared_ptr<const jobs::Frame> frame);
  const std::shared_ptr<const jobs::Frame>& frame() const;
  /// Looks from a side of the body (its own left and right); keeps the distance.
  void lookFrom(StandardView view);
  /// Moves the camera so that the whole body is seen.
  void fit();
  /// The same for the organ or piece that is selected, with what is around it; the whole body where none is.
  void fitSelection();
  /// Which shots of the frames are drawn, by what they met: "" all, "hits", "miss", "body", "armor", "organs" or
  /// a structure.
  void setShotFilter(const std::string& met);
  /// Whether azimuth and elevation are drawn around the body while a source is selected; they are unless set.
  void showCompass(bool on);
  /// Marks a shot that is looked into; null: none.
  void markShot(std::shared_ptr<const jobs::ShotInspection> inspection);
  /// Marks a gap in the armor on the skin; null: none.
  void markPatch(std::shared_ptr<const jobs::SkinPatch> patch);
  /// Looks at a place from a direction, keeping the distance. \pre `towards` is not zero
  void lookAlong(const geometry::Vec3d& towards, const geometry::Vec3d& place);
  /// Another frame is on its way: until it is shown, or for a while, what is drawn counts as in motion.
  void expectFrame();
  /// The next click places a shot source: on the body, it is put towards the viewer, as far from the body's middle as
  /// `current` is; on the floor, above that place, as high as `current`;
  /// and picked() says where. None: no more.
  void pickSource(const std::optional<geometry::Vec3d>& current);
  bool isPicking() const;
  /// Where a place of the scene is seen in the first picture, in logical pixels of the view. \pre there is a frame, and
  /// the place lies before the camera
  QPointF placeOf(const geometry::Vec3d& place) const;
  /// What is on the screen, in full.
  QImage picture();
  /// Drawings that take longer than this in full are made coarse in motion, ms; 50 unless set.
  void setPatience(double ms);

 Q_SIGNALS:
  /// Something was drawn. \param ms how long it took \param coarse whether less was drawn than there is
  void drawn(double ms, bool coarse);
  void picked(Eigen::Vector3d position);
  void pickCancelled();
  /// A drawn shot was clicked that is one of a run's. \param name SOURCE:TRIAL:SHOT
  void shotClicked(QString name);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  struct Impl;
  void arrangePanes(std::size_t count);
  void restyle();
  void followColours();
  void showColours();
  void placeLegend();
  void fitTo(const geometry::Box3d& box);
  void click(const QPointF& place, bool throughShots);
  bool clickShot(std::size_t pane, double x, double y);
  void scheduleDrawing();
  void draw();
  void beginMotion(int restMs);
  void endMotion();

  document::StudyDocument& document_;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lorica::viewport
