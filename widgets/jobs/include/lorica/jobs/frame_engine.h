#pragma once

/// \file
/// Poses the loaded study off the window's thread, as fast as frames are asked for: a request that comes while one is
/// computed replaces the one that waits. Frames are immutable once handed out; their buffers are reused when nobody
/// holds them any more, so that presenters can show them without a copy.

#include <QObject>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "lorica/analysis/posed_scene.h"
#include "lorica/analysis/shot_paths.h"
#include "lorica/jobs/organ_drivers.h"

namespace lorica::jobs {

/// Everything that is shown at one moment.
struct Frame {
  std::shared_ptr<const analysis::LoadedStudy> study;
  std::string pose;
  std::unique_ptr<analysis::PosedScene> scene;  ///< models as asked for, ready for rays
  using Normals = std::vector<geometry::Vec3f>;
  Normals skinNormals;
  std::vector<Normals> pieceNormals;
  std::vector<Normals> organNormals;  ///< model by model
  std::vector<analysis::ShotPath> shots;
  std::string shotsOf;                ///< the source of these shots; empty: there are none
  bool shotsOfRun = false;            ///< whether they are the shots of the same numbers of a run
  std::string driversOf;              ///< the organ whose drivers were asked for; empty: none, or no organ of the study
  std::vector<OrganDrivers> drivers;  ///< of that organ, one for each model; else empty
  double engineMs = 0.0;              ///< deforming everything and refitting the ray tracer, without the drawing
};

struct FrameRequest {
  std::string pose = "rest";
  std::vector<viscera::OrganModel> models{viscera::OrganModel::dynamic};
  /// Which shots to draw; none: no shots. Index into Study::sources.
  std::optional<std::size_t> shotSource;
  std::size_t shotLimit = 300;
  /// That source as a run over all its poses shoots from it; none: it bounds the skin of the pose alone.
  std::optional<analysis::ShotSource> planned;
  std::string driversOf;  ///< organ whose drivers are wanted; empty: none
};

class FrameEngine : public QObject {
  Q_OBJECT

 public:
  explicit FrameEngine(QObject* parent = nullptr);
  /// Waits for the frame being computed.
  ~FrameEngine() override;

  /// Null: nothing to show. Drops requests that wait.
  void setStudy(std::shared_ptr<const analysis::LoadedStudy> study);
  void request(FrameRequest request);
  /// Whether a frame is being computed or waits.
  bool isBusy() const;

 Q_SIGNALS:
  void frameReady(std::shared_ptr<const lorica::jobs::Frame> frame);
  /// The pose cannot be shown; one sentence.
  void failed(QString text);

 private:
  void work();
  std::shared_ptr<Frame> spareFrame(const std::shared_ptr<const analysis::LoadedStudy>& study,
                                    const FrameRequest& request);
  void fill(Frame& frame, const FrameRequest& request);
  void fillShots(Frame& frame, const FrameRequest& request);
  void fillDrivers(Frame& frame, const std::string& organ);

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::shared_ptr<const analysis::LoadedStudy> study_;
  std::optional<FrameRequest> waiting_;
  bool working_ = false;
  bool stop_ = false;
  // Touched by the worker alone.
  std::vector<std::shared_ptr<Frame>> pool_;
  std::shared_ptr<const analysis::LoadedOrgan> layoutsOf_;
  std::vector<std::shared_ptr<const DriverLayout>> layouts_;  ///< of that organ, for the models asked for so far
  std::thread thread_;
};

}  // namespace lorica::jobs
