// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "processor_time.h"

namespace vegetation_sim::bench {

/// Processor time of one frame, part by part in order.
class Laps {
 public:
  Laps() : last_(processorTime()) {}
  /// Assigns the time since the last lap to a part.
  double lap(const std::string& part) {
    const double now = processorTime(), spent = now - last_;
    parts_.emplace_back(part, spent);
    last_ = now;
    return spent;
  }
  /// Does the same, minus the time that is known to belong to another part.
  void lapWithout(double seconds, const std::string& part) {
    lap(part);
    parts_.back().second = std::max(0.0, parts_.back().second - seconds);
  }
  const std::vector<std::pair<std::string, double>>& parts() const { return parts_; }
  double sum() const {
    double out = 0.0;
    for (const auto& part : parts_) out += part.second;
    return out;
  }

 private:
  std::vector<std::pair<std::string, double>> parts_;
  double last_;
};

}  // namespace vegetation_sim::bench
