#include "console.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>

#include "lorica/base/readable.h"

namespace lorica::cli {

namespace {

std::atomic<base::Task*> runningTask{nullptr};
std::atomic<bool> interrupted{false};

void onInterrupt(int) {
  interrupted.store(true);
  if (base::Task* task = runningTask.load()) {
    task->cancel();
  }
}

}  // namespace

void catchInterrupts() {
  std::signal(SIGINT, onInterrupt);
  std::signal(SIGTERM, onInterrupt);
}

Stage::Stage(std::string label, bool quiet) : label_(std::move(label)) {
  runningTask.store(&task_);
  if (interrupted.load()) {
    task_.cancel();
  }
  if (!quiet && ::isatty(STDERR_FILENO) != 0) {
    display_ = std::thread([this] { show(); });
  }
}

Stage::~Stage() {
  runningTask.store(nullptr);
  if (display_.joinable()) {
    {
      const std::lock_guard lock(mutex_);
      stop_ = true;
    }
    ended_.notify_all();
    display_.join();
  }
}

void Stage::show() {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  std::unique_lock lock(mutex_);
  // The first half second shows nothing: short work needs no progress line.
  while (!ended_.wait_for(lock, std::chrono::milliseconds(500), [this] { return stop_; })) {
    const double elapsed = std::chrono::duration<double>(Clock::now() - start).count();
    const double share = task_.progress();
    std::string line = fmt::format("\r\033[K{}: {:3.0f} %", label_, 100.0 * share);
    if (task_.cancelled()) {
      line += ", stopping";
    } else if (share > 0.02) {
      line += fmt::format(", {} left", base::readableTime(elapsed * (1.0 - share) / share));
    }
    fmt::print(stderr, "{}", line);
    std::fflush(stderr);
  }
  fmt::print(stderr, "\r\033[K");
  std::fflush(stderr);
}

void printIssues(const base::Issues& issues, bool withNotes) {
  for (const base::Issue& issue : issues) {
    if (withNotes || issue.severity != base::Severity::note) {
      fmt::print(stderr, "{}\n", issue.line());
    }
  }
}

}  // namespace lorica::cli
