// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// What of a field is checked, kept and hashed.

#include "grass/tread_simulation.h"
#include "vegetation_sim/core/math/hash.h"

namespace vegetation_sim::grass {
TreadSnapshot TreadSimulation::snapshot() const {
  return {stamp_, next_id_, sources_, tread_.state()};
}

void TreadSimulation::restore(TreadSnapshot memory) {
  reset();
  stamp_ = published_ = memory.stamp;
  next_id_ = memory.next_id;
  sources_ = std::move(memory.sources);
  tread_.restore(std::move(memory.tread));
}

std::uint64_t TreadSnapshot::hash() const {
  Hash hash;
  const auto add = [&](auto value) { hash.add(static_cast<std::uint64_t>(value)); };
  add(stamp);
  add(next_id);
  for (const auto& [name, s] : sources) {
    hash.add(name);
    for (const auto value : {s.heard, s.pressed, s.before_stamp}) add(value);
    add(s.id);
    for (const int value : {s.last.action, s.column, s.row, static_cast<int>(s.down)}) add(value);
    for (const Vec3& v : {s.last.start, s.last.position, s.last.velocity, s.velocity, s.before})
      hash.add(v);
    hash.add(s.last.height_gate);
    hash.add(s.last.body_frame);
    FieldHasher hasher(hash);
    TreadLaw law = s.last.law;
    describe(hasher, law);
  }
  add(tread.hash());
  return hash.value();
}

}  // namespace vegetation_sim::grass
