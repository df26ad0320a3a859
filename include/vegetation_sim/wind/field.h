// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "vegetation_sim/wind/breeze.h"
#include "vegetation_sim/wind/primitive.h"

namespace vegetation_sim::wind {

/// The wind law: velocity(x, t) as a pure function of primitives and seed. Immutable: all processes
/// that hold the same primitives and seed compute the same velocities, to the bit.
class Field {
 public:
  Field();
  /// @throws InvalidInput listing all faults of all primitives (and equal ids).
  explicit Field(std::vector<Primitive> primitives, std::uint64_t seed = 0);
  ~Field();

  const std::vector<Primitive>& primitives() const { return primitives_; }
  std::uint64_t seed() const { return seed_; }

  /// Returns the wind velocity [m/s], world, at a position [m] and stamp.
  Vec3 velocity(const Vec3& position, Nanoseconds stamp) const {
    return at(stamp).velocity(position);
  }

  /// Returns the field at one stamp: what many positions share is computed once.
  Instant at(Nanoseconds stamp) const;
  /// Does the same into `out`, whose memory is kept from call to call.
  void at(Nanoseconds stamp, Instant& out) const;

  /// Computes what the primitive of that index adds to Instant::terms. Returns false if it adds
  /// nothing or adds modes.
  bool termAt(std::size_t index, Nanoseconds stamp, Term& out) const;
  /// Returns the waves of the primitive of that index; only a breeze has any.
  const Breeze& breezeOf(std::size_t index) const;

  std::uint64_t hash() const;

 private:
  struct Compiled;
  std::vector<Primitive> primitives_;
  std::uint64_t seed_{0};
  // shared, so copies of a field are cheap
  std::vector<std::shared_ptr<const Compiled>> compiled_;
};

}  // namespace vegetation_sim::wind
