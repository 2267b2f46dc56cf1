#pragma once

/// \file
/// Long work on a thread of its own, with progress, an estimate of the time left, and a way to cancel. Signals come on
/// the window's thread.

#include <QElapsedTimer>
#include <QObject>
#include <QString>
#include <QTimer>
#include <exception>
#include <functional>
#include <memory>
#include <thread>

#include "lorica/base/progress.h"

namespace lorica::jobs {

class Job : public QObject {
  Q_OBJECT

 public:
  /// The work runs on another thread: it must not touch widgets or the document. What it finds it leaves in something
  /// shared with whoever waits for finished(); it may throw.
  using Work = std::function<void(const base::Progress&)>;

  Job(QString title, Work work, QObject* parent = nullptr);
  /// Cancels and waits for the work to end; no signal follows.
  ~Job() override;

  const QString& title() const { return title_; }
  void start();
  /// Asks the work to stop. It may still finish with a partial result.
  void cancel();
  bool isRunning() const { return thread_.joinable(); }
  bool isCancelled() const { return task_.cancelled(); }
  /// 0 to 1.
  double progress() const { return task_.progress(); }
  /// "12 s left", "about 3 min left" or empty while it is too early to tell.
  QString timeLeft() const;

 Q_SIGNALS:
  /// About ten times a second while it runs.
  void progressed(double fraction);
  /// The work returned; also after cancel() when it returned what it had.
  void finished();
  /// The work gave up because it was cancelled.
  void cancelled();
  /// The work threw; one readable sentence.
  void failed(QString text);
  /// After any of the three: nothing runs any more.
  void ended();

 private:
  void conclude();

  QString title_;
  Work work_;
  base::Task task_;
  std::thread thread_;
  std::exception_ptr error_;
  QTimer timer_;
  QElapsedTimer clock_;
};

/// Gives a job up without waiting for it: it is cancelled, tells `keeper` nothing more, and belongs to it until it
/// ends. Does nothing when there is none.
void abandon(std::unique_ptr<Job>& job, QObject* keeper);

/// "7 s", "2 min 05 s", "1 h 03 min".
QString readableTime(double seconds);

/// One readable sentence for any exception.
QString sentenceOf(const std::exception_ptr& error);

}  // namespace lorica::jobs
