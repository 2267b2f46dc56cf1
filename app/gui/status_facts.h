#pragma once

/// \file
/// What the status bar says of the view: pose, drawn shots, selection. How long posing and drawing took stands in its
/// tooltip.

#include <QWidget>

#include "lorica/document/study_document.h"
#include "lorica/jobs/frame_engine.h"

class QLabel;

namespace lorica::gui {

class StatusFacts : public QWidget {
  Q_OBJECT

 public:
  /// \pre the document outlives it
  explicit StatusFacts(document::StudyDocument& document, QWidget* parent = nullptr);

  /// What is drawn; null: nothing.
  void setFrame(const std::shared_ptr<const jobs::Frame>& frame);
  /// \param drawMs of the last drawing
  void setDrawingTime(double drawMs);

 private:
  void refresh();

  document::StudyDocument& document_;
  QLabel* pose_;
  QLabel* shots_;
  QLabel* selection_;
  QString shotsText_;
  double poseMs_ = 0.0;
};

/// A pose in words: its name, or the clip with the time in it. \param clips of the body
QString poseText(const std::string& pose, const std::vector<human::Clip>& clips);
/// What is selected, in words; empty: nothing worth a word.
QString selectionText(const std::optional<document::ItemRef>& item);

}  // namespace lorica::gui
