// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "vegetation_sim/canopy/plane/plane_field.h"
#include "vegetation_sim/core/math/hash.h"

namespace vegetation_sim::canopy {

/// IEEE half precision, rounded to nearest; what is larger than 65504 becomes that.
std::uint16_t toHalf(double value);
double fromHalf(std::uint16_t half);

/// The motion in the plane at one tick, as it is kept and sent: half precision.
struct MotionFrame {
  std::vector<std::uint16_t> u, v;  ///< cell after cell, as in PlaneField [m/s]
  std::uint16_t depth{0};           ///< along the plane's normal [m/s]
};
MotionFrame toFrame(const PlaneField& motion, double depth);

/// A motion in the plane and along its normal.
struct PlaneMotion {
  double u{0.0}, v{0.0}, depth{0.0};  ///< [m/s]
};

/// The last frames of the first layer, from which the layers behind it take theirs (S3-18). Who
/// holds the same frames computes the same layers, to the bit.
class History {
 public:
  /// @param size field size. @param frames at least 2 that are kept. All are at rest at first.
  History(int size, int frames);

  int size() const { return size_; }
  int frames() const { return static_cast<int>(ring_.size()); }
  std::size_t bytes() const;

  /// @throws InvalidInput for a frame of another size.
  void push(const MotionFrame& frame);
  void clear();
  /// The frame of `age` ticks ago.
  const MotionFrame& frame(int age) const;

  /// At a cell, `age` ticks ago: linear between ticks (S3-20), the oldest frame beyond them.
  PlaneMotion at(std::size_t cell, double age) const;
  /// Bilinear in the newest frame at (x, y), in cells.
  PlaneMotion newestAt(double x, double y) const;

  /// Of all frames since clear(), those that are no longer kept included.
  std::uint64_t hash() const { return chain_; }

 private:
  int size_;
  std::vector<MotionFrame> ring_;
  std::size_t newest_{0};
  std::uint64_t chain_{0};
};

}  // namespace vegetation_sim::canopy
