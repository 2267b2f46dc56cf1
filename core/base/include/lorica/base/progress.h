#pragma once

/// \file
/// The token of long work. The one who starts the work owns a Task, may cancel it from any thread (or from a signal
/// handler) and reads its progress; the work gets a Progress, a view on one share of the Task, reports fractions to it
/// and asks it whether to go on. Work promises to ask at least every 0.2 s and to throw Cancelled or return what is
/// finished, as its own contract says.

#include <atomic>

#include "lorica/base/error.h"

namespace lorica::base {

/// Thread-safe; cancel() is also safe in a signal handler.
class Task {
 public:
  void cancel() noexcept { cancelled_.store(true, std::memory_order_relaxed); }
  bool cancelled() const noexcept { return cancelled_.load(std::memory_order_relaxed); }
  /// Share of the work that is done, 0 to 1, never falling.
  double progress() const noexcept { return progress_.load(std::memory_order_relaxed); }

 private:
  friend class Progress;
  void advanceTo(double fraction) noexcept {
    double seen = progress();
    while (fraction > seen && !progress_.compare_exchange_weak(seen, fraction, std::memory_order_relaxed)) {
    }
  }

  std::atomic<bool> cancelled_{false};
  std::atomic<double> progress_{0.0};
  static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<double>::is_always_lock_free);
};

/// A share [begin, end] of a Task's progress. Copyable, cheap; a default one reports to nobody and never cancels.
class Progress {
 public:
  Progress() = default;
  explicit Progress(Task& task) : task_(&task) {}

  /// The share of this share from `begin` to `end`, both 0 to 1.
  Progress part(double begin, double end) const {
    Progress share = *this;
    share.begin_ = begin_ + begin * (end_ - begin_);
    share.end_ = begin_ + end * (end_ - begin_);
    return share;
  }
  /// \param fraction of this share that is done, 0 to 1
  void report(double fraction) const noexcept {
    if (task_ != nullptr) {
      task_->advanceTo(begin_ + fraction * (end_ - begin_));
    }
  }
  bool cancelled() const noexcept { return task_ != nullptr && task_->cancelled(); }
  /// \throw Cancelled
  void check() const {
    if (cancelled()) {
      throw Cancelled();
    }
  }

 private:
  Task* task_ = nullptr;
  double begin_ = 0.0;
  double end_ = 1.0;
};

}  // namespace lorica::base
