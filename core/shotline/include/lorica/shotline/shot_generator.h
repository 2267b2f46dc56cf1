#pragma once

/// \file
/// Shots by their numbers. A shot is a function of (seed, source, trial, shot) and of nothing else: every model, pose
/// and armor system is met by the same shots.

#include <memory>
#include <span>

#include "lorica/shotline/source.h"
#include "lorica/stats/philox.h"

namespace lorica::shotline {

/// Turns shot numbers into rays. Immutable, thread-safe; copies are cheap.
class ShotGenerator {
 public:
  /// \pre a point is not its own target; radii, widths and heights are positive; a grid belongs to a parallel beam and
  ///      Sobol points to anything but Eq 15 and lists
  ShotGenerator(const Source& source, std::uint64_t seed, std::uint32_t trial);

  raycast::Ray shot(std::uint64_t number) const;
  /// Shots `first` and those after it. Faster than one by one.
  void shots(std::uint64_t first, std::span<raycast::Ray> rays) const;
  /// What each of `count` shots of a trial stands for, in sr or m2; 0 where shots stand for themselves.
  double weight(std::uint64_t count) const;

  struct Maker {
    virtual ~Maker() = default;
    virtual void make(std::uint64_t first, std::span<raycast::Ray> rays) const = 0;
  };

 private:
  std::shared_ptr<const Maker> maker_;
  Measure measure_;
};

}  // namespace lorica::shotline
