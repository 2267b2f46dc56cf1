#include "lorica/base/parallel.h"

#include <algorithm>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "lorica/base/error.h"

#ifndef LORICA_PLAIN_THREADS
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

namespace lorica::base {

int machineThreads() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

#ifdef LORICA_PLAIN_THREADS

namespace {

// Blocks are dealt in turn, so that every thread takes part in the shortest loop. Threads that fetch their blocks from
// a shared counter would leave short loops to the first of them, and the sanitizer would take the counter for an order
// between the blocks: it would miss races.
void spread(std::size_t count, std::size_t grain, int threads,
            const std::function<void(std::size_t, std::size_t)>& body) {
  const std::size_t round = grain * static_cast<std::size_t>(threads);
  std::exception_ptr failure;
  std::mutex failureMutex;
  const auto work = [&](std::size_t first) {
    for (std::size_t begin = first; begin < count; begin += round) {
      try {
        body(begin, std::min(begin + grain, count));
      } catch (...) {
        const std::lock_guard lock(failureMutex);
        failure = failure ? failure : std::current_exception();
      }
    }
  };
  std::vector<std::thread> crew;
  for (std::size_t first = grain; first < std::min(round, count); first += grain) {
    crew.emplace_back(work, first);
  }
  work(0);
  for (std::thread& member : crew) {
    member.join();
  }
  if (failure) {
    std::rethrow_exception(failure);
  }
}

void keepThreads(int, const std::function<void()>& work) {
  work();
}

}  // namespace

#else

namespace {

/// An arena keeps to the promised number of threads. Making one takes longer than many a loop, so they are kept.
tbb::task_arena& arenaOf(int threads) {
  static std::mutex mutex;
  static std::unique_ptr<tbb::global_control> allowance;
  static int allowed = machineThreads();
  static std::map<int, tbb::task_arena> arenas;
  const std::lock_guard lock(mutex);
  if (threads > allowed) {
    // TBB hands out no more threads than the machine has cores, and says so on stderr, unless it is told otherwise.
    allowance = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                      static_cast<std::size_t>(threads));
    allowed = threads;
  }
  return arenas.try_emplace(threads, threads).first->second;
}

void spread(std::size_t count, std::size_t grain, int threads,
            const std::function<void(std::size_t, std::size_t)>& body) {
  const auto loop = [&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, count, grain),
        [&](const tbb::blocked_range<std::size_t>& range) {
          for (std::size_t begin = range.begin(); begin < range.end(); begin += grain) {
            body(begin, std::min(begin + grain, range.end()));
          }
        },
        tbb::simple_partitioner());
  };
  arenaOf(threads).execute(loop);
}

void keepThreads(int threads, const std::function<void()>& work) {
  arenaOf(threads).execute(work);
}

}  // namespace

#endif

namespace {

int wantedOf(Threads threads) {
  return threads.count > 0 ? threads.count : machineThreads();
}

}  // namespace

void withThreads(Threads threads, const std::function<void()>& work) {
  keepThreads(wantedOf(threads), work);
}

void parallelFor(std::size_t count, std::size_t grain, Threads threads,
                 const std::function<void(std::size_t begin, std::size_t end)>& body) {
  LORICA_CHECK(grain > 0, "a range needs at least one index");
  const int wanted = wantedOf(threads);
  if (wanted == 1 || count <= grain) {
    for (std::size_t begin = 0; begin < count; begin += grain) {
      body(begin, std::min(begin + grain, count));
    }
    return;
  }
  spread(count, grain, wanted, body);
}

}  // namespace lorica::base
