// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "crowd/geometry/convex.h"

namespace vegetation_sim::crowd::bench {

/// A distance function of another library: shapes are prepared once, then queried by number.
struct PeerDistance {
  const char* name;
  std::function<double(std::size_t)> distance;  ///< [m]
};

#ifdef WITH_FCL
/// Returns FCL with both of its solvers, for boxes, and for capsules where a box is a segment with
/// a radius.
std::vector<PeerDistance> fclDistances(const std::vector<Box>& first,
                                       const std::vector<Box>& second);
#endif

}  // namespace vegetation_sim::crowd::bench
