// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "vegetation_sim/dynamics/modes/modes.h"

namespace vegetation_sim::physics {

/// Bends of many joints, structure of arrays [rad]; entries beyond the joints are scratch.
struct BatchBends {
  std::vector<float> first, second;
  std::vector<float> amplitude;  ///< scratch
};

/// Modes in single precision, in the order in which they are read: computes the bends of all joints
/// from a few amplitudes, in the widest instruction set of the processor. The bits are the same on
/// each of them: products are added mode by mode, and nothing is fused.
class BatchModes {
 public:
  explicit BatchModes(const Modes& modes);

  std::size_t size() const { return modes_; }
  std::size_t bytes() const { return sizeof(Line) * lines_.size(); }
  /// @param[in] amplitude [modes]
  /// @param[out] out [joints and PADDING more], keeps its memory.
  void bends(const std::vector<double>& amplitude, BatchBends& out) const;

  /// number of joints per block: two of the widest vectors
  static constexpr std::size_t BLOCK = 32;
  static constexpr std::size_t PADDING = 32;

 private:
  static constexpr std::size_t LINE = 16;
  struct alignas(LINE * sizeof(float)) Line {  // a cache line
    float lane[LINE] = {};
  };

  std::size_t joints_, modes_;
  std::vector<Line> lines_;  // [blocks][modes][2][BLOCK] floats
};

}  // namespace vegetation_sim::physics
