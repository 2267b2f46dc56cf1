#pragma once

/// \file
/// What a terminal sees: the progress line, Ctrl-C, and findings.

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "lorica/base/issue.h"
#include "lorica/base/progress.h"

namespace lorica::cli {

/// Exit codes, promised to scripts.
enum ExitCode : int { done = 0, wrongUsage = 2, badInput = 3, cancelled = 4, ourFault = 5 };

/// Turns Ctrl-C and a request to terminate into a wish to cancel the stage that runs.
void catchInterrupts();

/// One stage of work: a task that Ctrl-C cancels, shown as a line on stderr when that is a terminal.
class Stage {
 public:
  Stage(std::string label, bool quiet);
  ~Stage();
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  base::Progress progress() { return base::Progress(task_); }

 private:
  void show();

  std::string label_;
  base::Task task_;
  std::mutex mutex_;
  std::condition_variable ended_;
  bool stop_ = false;
  std::thread display_;
};

/// Writes issues to stderr, a line each; notes only when asked for.
void printIssues(const base::Issues& issues, bool withNotes);

}  // namespace lorica::cli
