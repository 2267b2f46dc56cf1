#pragma once

#include <QTimer>
#include <QWidget>
#include <array>
#include <memory>
#include <optional>

#include "lorica/human/person.h"
#include "lorica/jobs/job.h"

class QLabel;
class QProgressBar;

namespace lorica::viewport {
class PersonView;
}

namespace lorica::dialogs {

/// A person's picture and measures, made beside the window a moment after they were asked for. What was shown before
/// stays, paled, until the new picture is there; what is no longer asked for is dropped.
class HumanPreview : public QWidget {
  Q_OBJECT

 public:
  explicit HumanPreview(QWidget* parent = nullptr);
  /// Waits for nothing: what is being made is dropped.
  ~HumanPreview() override;

  /// \pre manikin::checkPerson() has no objection
  void ask(const human::Person& person);
  /// Makes nothing more until the next ask().
  void stop();
  /// Whose picture is shown.
  const std::optional<human::Person>& shown() const { return shown_; }
  /// Whether a picture that is asked for is not there yet.
  bool isBusy() const { return delay_.isActive() || again_ || (job_ != nullptr && !job_->isCancelled()); }

 Q_SIGNALS:
  void arrived();

 private:
  struct Made;
  QWidget* makeFacts();
  void start();
  void take(const Made& made);
  void abandon();
  void showState();

  human::Person wanted_;
  std::optional<human::Person> shown_;
  QTimer delay_;
  std::unique_ptr<jobs::Job> job_;
  QString failure_;
  bool again_ = false;  ///< another person was asked for while one is made

  viewport::PersonView* view_;
  QProgressBar* progress_;
  QLabel* state_;
  QWidget* facts_;
  struct FactRow {
    QLabel* survey;
    QLabel* made;
  };
  std::array<FactRow, 5> rows_{};
};

}  // namespace lorica::dialogs
