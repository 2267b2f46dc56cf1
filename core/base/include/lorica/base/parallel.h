#pragma once

/// \file
/// Data-parallel loops. Results must not depend on how the range is cut: a body writes only to places that belong to
/// its own indices, and sums are merged by the caller in index order.

#include <cstddef>
#include <functional>

namespace lorica::base {

/// How many threads a piece of work may use; 0 means all of the machine's.
struct Threads {
  int count = 0;
};

/// Number of threads the machine offers, at least 1.
int machineThreads();

/// Calls `body(begin, end)` for disjoint ranges that cover [0, count), each of at most `grain` indices, on up to
/// `threads` threads; returns when all are done. An exception of one call is rethrown here after the others ended.
/// \pre grain > 0
void parallelFor(std::size_t count, std::size_t grain, Threads threads,
                 const std::function<void(std::size_t begin, std::size_t end)>& body);

/// Calls `work` where loops of this thread, and those of libraries that use TBB too, take up to `threads` threads.
/// Several loops one after the other find their threads still there: it saves what it takes to fetch them for each.
void withThreads(Threads threads, const std::function<void()>& work);

}  // namespace lorica::base
