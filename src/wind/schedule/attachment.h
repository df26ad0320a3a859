// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>

#include "vegetation_sim/wind/source.h"

namespace vegetation_sim::wind {

/// Turns samples of a moving frame into primitives that others can evaluate alone: each piece runs
/// through the last samples and straight on, and fades out at a horizon unless a later piece takes
/// over, so that a frame that is lost, or a broadcaster that died, leaves no wind behind.
class Attachment {
 public:
  /// @param period of the pieces [s].
  /// @param horizon how long a piece lasts beyond its last sample, at least 4 periods [s].
  Attachment(const Source& source, double period, double horizon);

  const Source& source() const { return source_; }
  /// Takes a sample; one that is not newer than the last is ignored. After a gap longer than the
  /// horizon the source starts anew.
  void add(const Waypoint& sample);
  /// Whether a piece was made since the source began, so that the next one takes over from it.
  bool started() const { return started_; }
  /// The next piece, to take effect at `earliest`; none before two samples, outside the time of the
  /// source, or if it would begin in the last half of the horizon.
  std::optional<Primitive> piece(Nanoseconds earliest);

 private:
  Source source_;
  double period_, horizon_;
  bool started_{false};
  std::deque<Waypoint> samples_;
};

}  // namespace vegetation_sim::wind
