#include "lorica/jobs/frame_engine.h"

#include <algorithm>
#include <chrono>

#include "lorica/geometry/measures.h"
#include "lorica/jobs/job.h"

namespace lorica::jobs {

namespace {

using geometry::Positions;
using geometry::Triangle;

/// A mesh whose normals are wanted, and where they go.
struct NormalTask {
  const Positions* positions;
  const std::vector<Triangle>* triangles;
  Frame::Normals* normals;
};

void computeNormals(Frame& frame) {
  const analysis::LoadedStudy& study = *frame.study;
  const analysis::PosedScene& scene = *frame.scene;
  std::vector<NormalTask> tasks{{&scene.body().skin, &study.body->body().skin.triangles, &frame.skinNormals}};
  frame.pieceNormals.resize(study.pieces.size());
  for (std::size_t p = 0; p < study.pieces.size(); ++p) {
    tasks.push_back({&scene.piece(p), &study.pieces[p]->rig.rest.triangles, &frame.pieceNormals[p]});
  }
  frame.organNormals.resize(study.organs.size() * scene.models().size());
  for (std::size_t slot = 0; slot < frame.organNormals.size(); ++slot) {
    const std::size_t organ = slot % study.organs.size();
    tasks.push_back({&scene.organ(organ, slot / study.organs.size()), &study.organs[organ]->rig.rest.triangles,
                     &frame.organNormals[slot]});
  }
  base::parallelFor(tasks.size(), 1, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      *tasks[t].normals = geometry::vertexNormals(*tasks[t].positions, *tasks[t].triangles);
    }
  });
}

}  // namespace

FrameEngine::FrameEngine(QObject* parent) : QObject(parent) {
  qRegisterMetaType<std::shared_ptr<const lorica::jobs::Frame>>();
  thread_ = std::thread([this] { work(); });
}

FrameEngine::~FrameEngine() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void FrameEngine::setStudy(std::shared_ptr<const analysis::LoadedStudy> study) {
  const std::lock_guard lock(mutex_);
  study_ = std::move(study);
  waiting_.reset();
}

void FrameEngine::request(FrameRequest request) {
  {
    const std::lock_guard lock(mutex_);
    waiting_ = std::move(request);
  }
  wake_.notify_all();
}

bool FrameEngine::isBusy() const {
  const std::lock_guard lock(mutex_);
  return working_ || waiting_.has_value();
}

void FrameEngine::work() {
  for (;;) {
    FrameRequest request;
    std::shared_ptr<const analysis::LoadedStudy> study;
    {
      std::unique_lock lock(mutex_);
      working_ = false;
      wake_.wait(lock, [this] { return stop_ || (waiting_ && study_); });
      if (stop_) {
        return;
      }
      request = *std::exchange(waiting_, std::nullopt);
      study = study_;
      working_ = true;
    }
    try {
      std::shared_ptr<Frame> frame = spareFrame(study, request);
      fill(*frame, request);
      Q_EMIT frameReady(std::move(frame));
    } catch (...) {
      Q_EMIT failed(sentenceOf(std::current_exception()));
    }
  }
}

std::shared_ptr<Frame> FrameEngine::spareFrame(const std::shared_ptr<const analysis::LoadedStudy>& study,
                                               const FrameRequest& request) {
  const auto fits = [&](const std::shared_ptr<Frame>& frame) {
    return frame->study == study && frame->scene != nullptr && frame->scene->models() == request.models;
  };
  std::erase_if(pool_, [&](const std::shared_ptr<Frame>& frame) { return !fits(frame); });
  for (const std::shared_ptr<Frame>& frame : pool_) {
    if (frame.use_count() == 1) {
      return frame;
    }
  }
  auto frame = std::make_shared<Frame>();
  frame->study = study;
  pool_.push_back(frame);
  return frame;
}

void FrameEngine::fill(Frame& frame, const FrameRequest& request) {
  const analysis::LoadedStudy& study = *frame.study;
  const analysis::NamedPose pose = analysis::resolvePose(study, request.pose);
  if (frame.scene == nullptr) {
    frame.scene = std::make_unique<analysis::PosedScene>(study, request.models, std::nullopt,
                                                         raycast::SceneUse::manyFrames, base::Threads{});
  }
  const auto start = std::chrono::steady_clock::now();
  frame.scene->move(pose.pose, base::Threads{});
  frame.engineMs = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  frame.pose = request.pose;
  computeNormals(frame);
  fillDrivers(frame, request.driversOf);
  fillShots(frame, request);
}

void FrameEngine::fillShots(Frame& frame, const FrameRequest& request) {
  const study::Study& study = frame.study->study;
  frame.shots.clear();
  frame.shotsOf.clear();
  if (!request.shotSource || *request.shotSource >= study.sources.size()) {
    return;
  }
  const analysis::ShotSource source =
      request.planned ? *request.planned : analysis::shotSourceFor(*frame.study, *request.shotSource, *frame.scene);
  frame.shots = analysis::shotPaths(*frame.scene, source, study.seed, request.shotLimit);
  frame.shotsOf = source.source.name;
  frame.shotsOfRun = request.planned.has_value();
}

void FrameEngine::fillDrivers(Frame& frame, const std::string& organ) {
  frame.driversOf.clear();
  frame.drivers.clear();
  const auto& organs = frame.study->organs;
  const auto found = std::find_if(organs.begin(), organs.end(), [&](const auto& one) { return one->name == organ; });
  if (organ.empty() || found == organs.end()) {
    return;
  }
  const auto index = static_cast<std::size_t>(found - organs.begin());
  if (layoutsOf_ != *found) {
    layoutsOf_ = *found;
    layouts_.clear();
  }
  for (const viscera::OrganModel model : frame.scene->models()) {
    auto layout = std::find_if(layouts_.begin(), layouts_.end(), [&](const auto& one) { return one->model == model; });
    if (layout == layouts_.end()) {
      layouts_.push_back(std::make_shared<const DriverLayout>(driverLayout(*frame.study, index, model)));
      layout = std::prev(layouts_.end());
    }
    frame.drivers.push_back(poseDrivers(*frame.study, index, *layout, *frame.scene, base::Threads{}));
  }
  frame.driversOf = organ;
}

}  // namespace lorica::jobs
