#include "lorica/jobs/job.h"

#include <gtest/gtest.h>

#include <QSignalSpy>
#include <QTest>
#include <atomic>
#include <chrono>

#include "lorica/base/error.h"

namespace lorica::jobs {
namespace {

/// Counts how a job ended.
struct Ending {
  explicit Ending(Job& job)
      : finished(&job, &Job::finished),
        cancelled(&job, &Job::cancelled),
        failed(&job, &Job::failed),
        ended(&job, &Job::ended) {}
  bool wait() { return ended.count() > 0 || ended.wait(20000); }
  QSignalSpy finished;
  QSignalSpy cancelled;
  QSignalSpy failed;
  QSignalSpy ended;
};

void untilCancelled(const base::Progress& progress) {
  for (;;) {
    progress.check();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

TEST(Job, WorksOffTheWindowsThreadAndTellsOnIt) {
  std::thread::id worker;
  Job job("work", [&](const base::Progress&) { worker = std::this_thread::get_id(); });
  Ending ending(job);
  std::thread::id told;
  QObject::connect(&job, &Job::finished, &job, [&] { told = std::this_thread::get_id(); });
  job.start();
  ASSERT_TRUE(ending.wait());
  EXPECT_EQ(ending.finished.count(), 1);
  EXPECT_EQ(told, std::this_thread::get_id());
  EXPECT_NE(worker, told);
  EXPECT_FALSE(job.isRunning());
}

TEST(Job, CancelEndsWorkThatLooksAtItsToken) {
  Job job("work", untilCancelled);
  Ending ending(job);
  job.start();
  job.cancel();
  ASSERT_TRUE(ending.wait());
  EXPECT_EQ(ending.cancelled.count(), 1);
  EXPECT_EQ(ending.finished.count() + ending.failed.count(), 0);
}

TEST(Job, WhatTheWorkThrowsBecomesOneSentence) {
  Job job("work", [](const base::Progress&) { throw base::InputError("a.glb", "node 3", "has no mesh"); });
  Ending ending(job);
  job.start();
  ASSERT_TRUE(ending.wait());
  ASSERT_EQ(ending.failed.count(), 1);
  EXPECT_EQ(ending.failed[0][0].toString(), "a.glb: node 3: has no mesh");
}

TEST(Job, TellsProgressAndTheTimeLeft) {
  std::atomic<bool> go{false};
  Job job("work", [&](const base::Progress& progress) {
    progress.report(0.5);
    while (!go) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  });
  Ending ending(job);
  QSignalSpy progressed(&job, &Job::progressed);
  job.start();
  ASSERT_TRUE(QTest::qWaitFor([&] { return !job.timeLeft().isEmpty(); }, 20000));
  EXPECT_EQ(job.progress(), 0.5);
  EXPECT_GT(progressed.count(), 0);
  go = true;
  ASSERT_TRUE(ending.wait());
  EXPECT_TRUE(job.timeLeft().isEmpty());
}

TEST(Job, IsCancelledAndWaitedForWhenItGoes) {
  std::atomic<bool> ended{false};
  {
    Job job("work", [&](const base::Progress& progress) {
      try {
        untilCancelled(progress);
      } catch (const base::Cancelled&) {
        ended = true;
        throw;
      }
    });
    job.start();
  }
  EXPECT_TRUE(ended);
}

}  // namespace
}  // namespace lorica::jobs
