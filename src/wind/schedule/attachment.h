// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>

#include "vegetation_sim/wind/source.h"

namespace vegetation_sim {
class Archive;
}

namespace vegetation_sim::wind {

/// Turns samples of a moving frame into primitives that others can evaluate alone. Each piece runs
/// through the last samples and straight on. It fades out at a horizon unless a later piece takes
/// over, so a frame that is lost or a broadcaster that died leaves no wind behind.
class Attachment {
 public:
  /// @param period of the pieces [s].
  /// @param horizon is the time that a piece lasts beyond its last sample, at least 4 periods [s].
  Attachment(const Source& source, double period, double horizon);

  const Source& source() const { return source_; }
  /// Adds a sample; one that is not newer than the last is ignored. After a gap longer than the
  /// horizon, or a jump, which is a step faster than BODY_SPEEDS, the source starts anew.
  /// @return the speed of a jump [m/s], if it was one.
  std::optional<double> add(const Waypoint& sample);
  /// Returns whether a piece was made since the source began, so that the next one replaces it.
  bool started() const { return started_; }
  /// Returns the next piece, which takes effect at `earliest`. There is none before two samples,
  /// outside the time of the source, or if it would begin in the last half of the horizon.
  std::optional<Primitive> piece(Nanoseconds earliest);

  /// Writes or reads source and samples. @throws InvalidInput when it reads.
  void archive(Archive& a);

 private:
  Source source_;
  double period_, horizon_;
  bool started_{false};
  std::deque<Waypoint> samples_;
};

}  // namespace vegetation_sim::wind
