#pragma once

#include <vtkRenderer.h>

#include <memory>

#include "lorica/document/study_document.h"
#include "lorica/jobs/organ_colours.h"

namespace lorica::viewport {

class CoarseMeshes;
struct ColourScale;

/// Shows one kind of data in one pane. Owns its actors; the frame it shows last stays alive until the next one.
class Presenter {
 public:
  explicit Presenter(vtkRenderer* renderer) : renderer_(renderer) {}
  virtual ~Presenter() = default;
  Presenter(const Presenter&) = delete;
  Presenter& operator=(const Presenter&) = delete;

  /// Another moment, or nothing at all (null).
  virtual void showFrame(const std::shared_ptr<const jobs::Frame>& frame) = 0;
  /// Colours, visibility, selection changed.
  virtual void restyle(const document::StudyDocument& document) = 0;
  /// Draws less, as far as there are coarse meshes; null: all there is.
  virtual void drawCoarsely(const CoarseMeshes* /*meshes*/) {}
  /// How the organs of the frame that is shown fare; null: not known (any more). \pre of this frame
  virtual void showColours(const jobs::OrganColours* /*colours*/, const ColourScale& /*scale*/) {}

 protected:
  vtkRenderer* renderer() const { return renderer_; }

 private:
  vtkRenderer* renderer_;
};

}  // namespace lorica::viewport
