// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "vegetation_sim/canopy/plane/plane_field.h"
#include "vegetation_sim/core/math/hash.h"

namespace vegetation_sim {
class Archive;
}

namespace vegetation_sim::canopy {

/// Converts to IEEE half precision, rounded to nearest; larger values become 65504.
std::uint16_t toHalf(double value);
double fromHalf(std::uint16_t half);

/// The motion in the plane at one tick in half precision, as it is stored and sent.
struct MotionFrame {
  std::vector<std::uint16_t> u, v;  ///< velocities, cell after cell as in PlaneField [m/s]
  std::uint16_t depth{0};           ///< along the plane's normal [m/s]
};
MotionFrame toFrame(const PlaneField& motion, double depth);

/// A motion in the plane and along its normal.
struct PlaneMotion {
  double u{0.0}, v{0.0}, depth{0.0};  ///< [m/s]
};

/// The last frames of the first layer, from which the layers behind it are computed (S3-18).
/// Processes with the same frames compute the same bits.
class History {
 public:
  /// @param size size of the field. @param frames number of frames kept, at least 2. All are at
  /// rest at first.
  History(int size, int frames);

  int size() const { return size_; }
  int frames() const { return static_cast<int>(ring_.size()); }
  std::size_t bytes() const;

  /// @throws InvalidInput for a frame of another size.
  void push(const MotionFrame& frame);
  void clear();
  /// Returns the frame of `age` ticks ago.
  const MotionFrame& frame(int age) const;

  /// Returns the motion of a cell `age` ticks ago: linear between ticks (S3-20), and the oldest
  /// frame for a larger age.
  PlaneMotion at(std::size_t cell, double age) const;
  /// Interpolates the newest frame bilinearly at (x, y), in cells.
  PlaneMotion newestAt(double x, double y) const;

  /// Returns a hash of all frames since clear(), including those that are no longer kept.
  std::uint64_t hash() const { return chain_; }
  /// Writes or reads all frames; their number and size stay as they are.
  void archive(Archive& a);

 private:
  int size_;
  std::vector<MotionFrame> ring_;
  std::size_t newest_{0};
  std::uint64_t chain_{0};
};

}  // namespace vegetation_sim::canopy
