#include "lorica/jobs/job.h"

#include "lorica/base/error.h"
#include "lorica/base/readable.h"

namespace lorica::jobs {

QString readableTime(double seconds) {
  return QString::fromStdString(base::readableTime(seconds));
}

QString sentenceOf(const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const base::Error& known) {
    return QString::fromUtf8(known.what());
  } catch (const std::bad_alloc&) {
    return QObject::tr("There is not enough memory for this; close other programs or use a smaller model.");
  } catch (const std::exception& other) {
    return QObject::tr("Lorica made a mistake (%1); please report it.").arg(QString::fromUtf8(other.what()));
  }
}

void abandon(std::unique_ptr<Job>& job, QObject* keeper) {
  if (job == nullptr) {
    return;
  }
  // It ends when it next looks at its token.
  Job* given = job.release();
  given->disconnect(keeper);
  given->setParent(keeper);
  QObject::connect(given, &Job::ended, given, &QObject::deleteLater);
  given->cancel();
}

Job::Job(QString title, Work work, QObject* parent)
    : QObject(parent), title_(std::move(title)), work_(std::move(work)) {
  timer_.setInterval(100);
  connect(&timer_, &QTimer::timeout, this, [this] { Q_EMIT progressed(task_.progress()); });
}

Job::~Job() {
  task_.cancel();
  if (thread_.joinable()) {
    thread_.join();
  }
}

void Job::start() {
  clock_.start();
  timer_.start();
  thread_ = std::thread([this] {
    try {
      work_(base::Progress(task_));
    } catch (...) {
      error_ = std::current_exception();
    }
    // Queued: delivered on the window's thread, or dropped with this object.
    QMetaObject::invokeMethod(this, &Job::conclude, Qt::QueuedConnection);
  });
}

void Job::cancel() {
  task_.cancel();
}

QString Job::timeLeft() const {
  const double share = task_.progress();
  const double elapsed = static_cast<double>(clock_.elapsed()) / 1000.0;
  if (elapsed < 0.5 || share < 0.02 || !isRunning()) {
    return {};
  }
  return tr("%1 left").arg(readableTime(elapsed * (1.0 - share) / share));
}

void Job::conclude() {
  thread_.join();
  timer_.stop();
  // Whoever listens may delete the job at the last signal only.
  if (error_ == nullptr) {
    Q_EMIT progressed(1.0);
    Q_EMIT finished();
  } else {
    try {
      std::rethrow_exception(error_);
    } catch (const base::Cancelled&) {
      Q_EMIT cancelled();
    } catch (...) {
      Q_EMIT failed(sentenceOf(error_));
    }
  }
  Q_EMIT ended();
}

}  // namespace lorica::jobs
