#pragma once

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <string>

#include "presenter.h"
#include "shot_picking.h"

namespace lorica::viewport {

/// Shot lines, each in the colour of what it met: armor where armor came first, else the first organ, else the body;
/// grey where it missed. A line runs from its source through the last thing it crossed.
class ShotPresenter final : public Presenter {
 public:
  /// \param model of the frame's models whose organs count
  ShotPresenter(vtkRenderer* renderer, std::size_t model);
  ~ShotPresenter() override;
  void showFrame(const std::shared_ptr<const jobs::Frame>& frame) override;
  void restyle(const document::StudyDocument& document) override;
  /// Only shots that met this: "" all, "hits", "miss", "body", "armor", "organs" or the name of a structure.
  void setFilter(std::string met) { filter_ = std::move(met); }
  std::size_t shownShots() const { return drawn_.size(); }
  /// Those that are drawn, in the order of the frame.
  const std::vector<DrawnShot>& drawnShots() const { return drawn_; }

 private:
  std::size_t model_;
  std::string filter_;
  std::vector<DrawnShot> drawn_;
  std::shared_ptr<const jobs::Frame> frame_;
  vtkNew<vtkPolyData> data_;
  vtkNew<vtkActor> actor_;
};

/// What a shot met, as the lines are coloured and filtered.
struct ShotMeeting {
  enum class Kind { miss, body, armor, organ };
  Kind kind = Kind::miss;
  std::size_t index = 0;  ///< of the piece or organ
};
/// \param pieceShown which pieces count
ShotMeeting meetingOf(const analysis::ShotPath& shot, std::size_t model, const std::vector<bool>& pieceShown);

}  // namespace lorica::viewport
