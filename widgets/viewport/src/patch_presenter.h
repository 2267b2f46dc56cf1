#pragma once

#include "lorica/jobs/run_survey.h"
#include "mesh_actor.h"
#include "presenter.h"

namespace lorica::viewport {

/// A patch of the skin, in a colour of its own: a gap in the armor. It goes with the skin from pose to pose.
class PatchPresenter final : public Presenter {
 public:
  explicit PatchPresenter(vtkRenderer* renderer) : Presenter(renderer) {}
  ~PatchPresenter() override;
  void showFrame(const std::shared_ptr<const jobs::Frame>& frame) override;
  void restyle(const document::StudyDocument& document) override;
  /// Null: none. It is drawn on the body that it is of, and on no other.
  void mark(std::shared_ptr<const jobs::SkinPatch> patch) { patch_ = std::move(patch); }
  /// How many triangles are drawn.
  std::size_t shownTriangles() const { return actor_ == nullptr ? 0 : triangles_.size(); }

 private:
  void clear();

  std::shared_ptr<const jobs::Frame> frame_;
  std::shared_ptr<const jobs::SkinPatch> patch_;
  std::shared_ptr<const jobs::SkinPatch> drawn_;  ///< the actor's
  std::vector<geometry::Triangle> triangles_;     ///< the actor's
  std::unique_ptr<MeshActor> actor_;
};

}  // namespace lorica::viewport
