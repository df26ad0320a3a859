// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tf2_ros/buffer.h>
#include <vegetation_sim/WindSamples.h>

#include <string>
#include <vector>

#include "ros/services/missing_inputs.h"
#include "vegetation_sim/wind/field.h"

namespace vegetation_sim {

/// Samples the wind at the origins of tf frames.
class WindProbes {
 public:
  static constexpr std::size_t MOST_FRAMES = 256;
  static constexpr double STALE = 0.5;  ///< age from which a transform is reported as missing [s]

  WindProbes(const tf2_ros::Buffer& buffer, std::string frame_id, std::vector<std::string> frames)
      : buffer_(buffer), frame_id_(std::move(frame_id)), frames_(std::move(frames)) {}

  /// Returns the wind at `stamp`, at the latest transform of each frame that has one.
  WindSamples sample(const wind::Field& field, Nanoseconds stamp);
  /// Transforms that the last sample missed, or that were stale.
  MissingInputs& missing() { return missing_; }
  bool empty() const { return frames_.empty(); }

 private:
  const tf2_ros::Buffer& buffer_;
  std::string frame_id_;
  std::vector<std::string> frames_;
  MissingInputs missing_;
};

}  // namespace vegetation_sim
