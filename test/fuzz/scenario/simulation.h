// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include "fuzz/scenario/draw.h"
#include "vegetation_sim/core/math/hash.h"
#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim::fuzz {

/// A simulation diverged, or a replica or a replay differs from it.
struct Divergence : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// @throws Divergence unless the value is within +- `limit`; NaN is not.
void requireWithin(double value, double limit, const char* what);

/// One part of a random world, and a replica that follows it by updates of which some are lost.
class Simulation {
 public:
  virtual ~Simulation() = default;
  virtual void setWind(const wind::Field& wind) = 0;
  /// Makes a random request, which may be rejected by InvalidInput.
  virtual void act(Draw& draw, Nanoseconds stamp) = 0;
  /// @param lost the update does not reach the replica.
  virtual void advance(Nanoseconds stamp, bool key_frame, bool lost) = 0;
  /// The clock has jumped back.
  virtual void restart() = 0;
  /// @throws Divergence
  virtual void verify() = 0;
  virtual std::uint64_t hash() const = 0;
};

std::unique_ptr<Simulation> makeForest(Draw& draw, int threads);
std::unique_ptr<Simulation> makeMeadow(Draw& draw);
std::unique_ptr<Simulation> makeCanopy(Draw& draw);
std::unique_ptr<Simulation> makeCrowd(Draw& draw, int threads);

}  // namespace vegetation_sim::fuzz
