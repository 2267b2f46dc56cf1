#include "lorica/base/progress.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <thread>
#include <vector>

namespace lorica::base {
namespace {

double fraction() {
  return *rc::gen::inRange(0, 1001) / 1000.0;
}

TEST(Progress, OfTheWholeTaskIsItsProgress) {
  Task task;
  EXPECT_EQ(task.progress(), 0.0);
  const Progress progress(task);
  progress.report(0.25);
  EXPECT_DOUBLE_EQ(task.progress(), 0.25);
  progress.report(1.0);
  EXPECT_DOUBLE_EQ(task.progress(), 1.0);
}

TEST(Progress, OfAPartMapsToItsShare) {
  Task task;
  const Progress half = Progress(task).part(0.5, 1.0);
  half.report(0.0);
  EXPECT_DOUBLE_EQ(task.progress(), 0.5);
  half.report(0.5);
  EXPECT_DOUBLE_EQ(task.progress(), 0.75);
  half.part(0.5, 1.0).report(0.5);
  EXPECT_DOUBLE_EQ(task.progress(), 0.875);
}

RC_GTEST_PROP(Progress, OfNestedPartsComposes, ()) {
  Task task;
  Progress share(task);
  double begin = 0.0;
  double end = 1.0;
  const int depth = *rc::gen::inRange(0, 6);
  for (int i = 0; i < depth; ++i) {
    const auto [low, high] = std::minmax({fraction(), fraction()});
    share = share.part(low, high);
    const double length = end - begin;
    end = begin + high * length;
    begin += low * length;
  }
  const double done = fraction();
  share.report(done);
  RC_ASSERT(std::abs(task.progress() - (begin + done * (end - begin))) < 1e-12);
}

RC_GTEST_PROP(Progress, NeverFalls, ()) {
  Task task;
  const Progress progress(task);
  double highest = 0.0;
  const int reports = *rc::gen::inRange(1, 30);
  for (int i = 0; i < reports; ++i) {
    const double reported = fraction();
    progress.report(reported);
    highest = std::max(highest, reported);
    RC_ASSERT(task.progress() == highest);
  }
}

TEST(Progress, NeverFallsUnderReportsOfManyThreads) {
  Task task;
  const Progress progress(task);
  std::vector<std::thread> crew;
  for (int member = 0; member < 4; ++member) {
    crew.emplace_back([progress, member] {
      for (int i = 0; i <= 5000; ++i) {
        progress.report((i - 100.0 * member) / 5000.0);
      }
    });
  }
  double seen = 0.0;
  bool fell = false;
  for (int i = 0; i < 20000; ++i) {
    const double now = task.progress();
    fell = fell || now < seen;
    seen = now;
  }
  for (std::thread& member : crew) {
    member.join();
  }
  EXPECT_FALSE(fell);
  EXPECT_DOUBLE_EQ(task.progress(), 1.0);
}

TEST(Progress, SeesTheCancellationInCopiesAndParts) {
  Task task;
  const Progress progress(task);
  const Progress copy = progress;
  const Progress part = copy.part(0.2, 0.4).part(0.5, 0.6);
  for (const Progress& share : {progress, copy, part}) {
    EXPECT_FALSE(share.cancelled());
    EXPECT_NO_THROW(share.check());
  }
  task.cancel();
  EXPECT_TRUE(task.cancelled());
  for (const Progress& share : {progress, copy, part}) {
    EXPECT_TRUE(share.cancelled());
    EXPECT_THROW(share.check(), Cancelled);
  }
}

TEST(Progress, SeesTheCancellationOfAnotherThread) {
  Task task;
  std::thread([&task] { task.cancel(); }).join();
  EXPECT_THROW(Progress(task).check(), Cancelled);
}

TEST(Progress, OfNobodyNeverCancels) {
  const Progress nobody;
  nobody.report(0.5);
  nobody.part(0.0, 0.5).report(1.0);
  EXPECT_FALSE(nobody.cancelled());
  EXPECT_NO_THROW(nobody.part(0.5, 1.0).check());
}

}  // namespace
}  // namespace lorica::base
