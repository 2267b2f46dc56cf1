#pragma once

#include <QTimer>

#include "colour_scale.h"
#include "lorica/jobs/organ_colours.h"

namespace lorica::viewport {

/// The colours of organs for the frame that is shown: computed once nothing has moved for a while, forgotten as soon
/// as another frame comes.
class OrganColouring : public QObject {
  Q_OBJECT

 public:
  explicit OrganColouring(const document::StudyDocument& document, QObject* parent = nullptr);

  /// Another frame, or none, or other colours are wanted.
  void follow(const std::shared_ptr<const jobs::Frame>& frame);
  /// Of the frame; null while not known.
  const jobs::OrganColours* colours() const { return colours_.get(); }
  const ColourScale& scale() const { return scale_; }
  /// Fits the scale to the organs that are visible.
  void rescale();

 Q_SIGNALS:
  /// colours() are there.
  void found();

 private:
  const document::StudyDocument& document_;
  std::shared_ptr<const jobs::Frame> frame_;
  std::shared_ptr<const jobs::OrganColours> colours_;
  ColourScale scale_;
  jobs::OrganColourer colourer_;
  QTimer rest_;
};

}  // namespace lorica::viewport
