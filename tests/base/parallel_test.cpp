#include "lorica/base/parallel.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "lorica/base/error.h"

namespace lorica::base {
namespace {

/// How many bodies are at work, and how many were at most.
class Crowd {
 public:
  class Member {
   public:
    explicit Member(Crowd& crowd) : crowd_(crowd) {
      const int now = ++crowd_.now_;
      int most = crowd_.most_;
      while (now > most && !crowd_.most_.compare_exchange_weak(most, now)) {
      }
    }
    ~Member() { --crowd_.now_; }
    Member(const Member&) = delete;
    Member& operator=(const Member&) = delete;

   private:
    Crowd& crowd_;
  };
  int now() const { return now_; }
  int most() const { return most_; }

 private:
  std::atomic<int> now_{0};
  std::atomic<int> most_{0};
};

/// Visits of every index; ranges that are empty, too long or outside are counted as misfits.
struct Visits {
  explicit Visits(std::size_t count) : perIndex(count) {}
  std::vector<std::atomic<int>> perIndex;
  std::atomic<int> misfits{0};

  void record(std::size_t begin, std::size_t end, std::size_t grain) {
    if (begin >= end || end > perIndex.size() || end - begin > grain) {
      ++misfits;
      return;
    }
    for (std::size_t i = begin; i < end; ++i) {
      ++perIndex[i];
    }
  }
  bool everyIndexOnce() const {
    for (const std::atomic<int>& visits : perIndex) {
      if (visits != 1) {
        return false;
      }
    }
    return misfits == 0;
  }
};

bool coversOnce(std::size_t count, std::size_t grain, int threads) {
  Visits visits(count);
  parallelFor(count, grain, Threads{threads},
              [&](std::size_t begin, std::size_t end) { visits.record(begin, end, grain); });
  return visits.everyIndexOnce();
}

TEST(ParallelFor, CoversEveryIndexOnceAtTheEdgesOfItsRanges) {
  for (const std::size_t count : {0U, 1U, 2U, 7U, 8U, 9U, 63U, 64U, 65U, 1000U}) {
    for (const std::size_t grain : {1U, 2U, 7U, 8U, 9U, 64U, 999U, 1000U, 1001U}) {
      for (const int threads : {0, 1, 2, 3, 8}) {
        EXPECT_TRUE(coversOnce(count, grain, threads)) << count << " by " << grain << " on " << threads;
      }
    }
  }
}

RC_GTEST_PROP(ParallelFor, CoversEveryIndexOnceInRangesNoLongerThanTheGrain, ()) {
  const auto count = *rc::gen::inRange<std::size_t>(0, 5000);
  const auto grain = *rc::gen::inRange<std::size_t>(1, 300);
  const auto threads = *rc::gen::inRange(0, 9);
  RC_ASSERT(coversOnce(count, grain, threads));
}

TEST(ParallelFor, TakesAGrainLargerThanAnyCount) {
  EXPECT_TRUE(coversOnce(5, std::numeric_limits<std::size_t>::max(), 4));
}

TEST(ParallelFor, CallsNobodyForNothing) {
  parallelFor(0, 1, Threads{4}, [](std::size_t, std::size_t) { FAIL() << "there are no indices"; });
}

TEST(ParallelFor, RefusesAGrainOfZero) {
  EXPECT_THROW(parallelFor(1, 0, Threads{1}, [](std::size_t, std::size_t) {}), CallerError);
}

TEST(ParallelFor, UsesNoMoreThreadsThanAllowed) {
  for (const int threads : {1, 2, 3}) {
    Crowd crowd;
    parallelFor(60, 1, Threads{threads}, [&](std::size_t, std::size_t) {
      const Crowd::Member member(crowd);
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    });
    EXPECT_LE(crowd.most(), threads);
  }
}

TEST(ParallelFor, StaysOnTheCallersThreadWhenOneIsAllowed) {
  parallelFor(100, 3, Threads{1}, [caller = std::this_thread::get_id()](std::size_t, std::size_t) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
  });
}

TEST(ParallelFor, RethrowsAfterTheOthersEnded) {
  for (const int threads : {1, 2, 4}) {
    for (const std::size_t bad : {0U, 1U, 50U, 199U}) {
      Crowd crowd;
      try {
        parallelFor(200, 1, Threads{threads}, [&](std::size_t begin, std::size_t) {
          const Crowd::Member member(crowd);
          if (begin == bad) {
            throw std::range_error("index " + std::to_string(begin));
          }
          std::this_thread::sleep_for(std::chrono::microseconds(50));
        });
        ADD_FAILURE() << "no exception from " << bad << " on " << threads;
      } catch (const std::range_error& error) {
        EXPECT_EQ(error.what(), "index " + std::to_string(bad));
      }
      EXPECT_EQ(crowd.now(), 0);
    }
  }
}

TEST(ParallelFor, RethrowsOneOfManyExceptionsAndWorksAgain) {
  for (int round = 0; round < 20; ++round) {
    EXPECT_THROW(parallelFor(100, 1, Threads{4}, [](std::size_t, std::size_t) { throw Cancelled(); }), Cancelled);
    EXPECT_TRUE(coversOnce(100, 1, 4));
  }
}

TEST(ParallelFor, CoversEveryPairWhenNested) {
  constexpr std::size_t rows = 40;
  constexpr std::size_t columns = 50;
  for (const int outer : {0, 1, 3}) {
    for (const int inner : {0, 1, 2, 3}) {
      Visits visits(rows * columns);
      parallelFor(rows, 1, Threads{outer}, [&](std::size_t firstRow, std::size_t endRow) {
        for (std::size_t row = firstRow; row < endRow; ++row) {
          parallelFor(columns, 4, Threads{inner}, [&](std::size_t begin, std::size_t end) {
            visits.record(row * columns + begin, row * columns + end, 4);
          });
        }
      });
      EXPECT_TRUE(visits.everyIndexOnce()) << outer << " over " << inner;
    }
  }
}

TEST(ParallelFor, LetsExceptionsOutOfNestedLoops) {
  const auto inner = [](std::size_t begin, std::size_t) {
    if (begin == 13) {
      throw std::range_error("thirteen");
    }
  };
  EXPECT_THROW(parallelFor(8, 1, Threads{3}, [&](std::size_t, std::size_t) { parallelFor(20, 1, Threads{2}, inner); }),
               std::range_error);
}

TEST(WithThreads, CallsItsWorkOnceBeforeItReturns) {
  for (const int threads : {0, 1, 3}) {
    int calls = 0;
    withThreads(Threads{threads}, [&] { ++calls; });
    EXPECT_EQ(calls, 1);
  }
}

TEST(WithThreads, LoopsWithinCoverEveryIndexOnceOnNoMoreThreads) {
  for (const int threads : {1, 2, 3}) {
    Crowd crowd;
    Visits visits(60);
    withThreads(Threads{threads}, [&] {
      for (int loop = 0; loop < 3; ++loop) {
        parallelFor(20, 1, Threads{threads}, [&](std::size_t begin, std::size_t end) {
          const Crowd::Member member(crowd);
          const std::size_t first = 20 * static_cast<std::size_t>(loop);
          visits.record(first + begin, first + end, 1);
          std::this_thread::sleep_for(std::chrono::microseconds(200));
        });
      }
    });
    EXPECT_LE(crowd.most(), threads);
    EXPECT_TRUE(visits.everyIndexOnce());
  }
}

TEST(WithThreads, LetsExceptionsOut) {
  EXPECT_THROW(withThreads(Threads{2}, [] { throw std::range_error("out"); }), std::range_error);
}

TEST(ParallelFor, CanBeUsedFromManyThreadsAtOnce) {
  std::atomic<int> failures{0};
  std::vector<std::thread> callers;
  for (int caller = 0; caller < 4; ++caller) {
    callers.emplace_back([&failures] {
      for (int round = 0; round < 20; ++round) {
        failures += coversOnce(500, 7, 3) ? 0 : 1;
      }
    });
  }
  for (std::thread& caller : callers) {
    caller.join();
  }
  EXPECT_EQ(failures, 0);
}

TEST(MachineThreads, AreAtLeastOne) {
  EXPECT_GE(machineThreads(), 1);
}

}  // namespace
}  // namespace lorica::base
