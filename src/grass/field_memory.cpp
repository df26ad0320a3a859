// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// What of a field is checked, kept and hashed.

#include "vegetation_sim/common/hash.h"
#include "vegetation_sim/grass/field.h"

namespace vegetation_sim::grass {
namespace {

constexpr Range PLACES{-1e7, 1e7}, SPEEDS{-1e4, 1e4};
constexpr std::size_t LONGEST_NAME = 200;

}  // namespace

void check(const TreadInput& input, const std::string& context, Faults& faults) {
  TreadInput copy = input;
  FieldChecker checker(context, faults);
  if (input.source.empty() || input.source.size() > LONGEST_NAME)
    faults.add(context + "source = '" + input.source.substr(0, 40) + "' has " +
               std::to_string(input.source.size()) + " letters, allowed are 1 to " +
               std::to_string(LONGEST_NAME));
  if (input.action < 0 || input.action > static_cast<int>(TreadAction::STROKE))
    faults.add(context + "action = " + std::to_string(input.action) + " is outside 0 to 3");
  if (input.action == static_cast<int>(TreadAction::LIFT)) return;
  if (input.action == static_cast<int>(TreadAction::STROKE))
    checker.vector("start", copy.start, "m", PLACES);
  checker.vector("position", copy.position, "m", PLACES);
  checker.number("height_gate", copy.height_gate, "m", {0.0, 1000.0});
  checker.vector("velocity", copy.velocity, "m/s", SPEEDS);
  check(input.law, context, faults);
}

FieldMemory Field::memory() const {
  return {stamp_, next_id_, sources_, tread_.state()};
}

void Field::restore(FieldMemory memory) {
  reset();
  stamp_ = told_ = memory.stamp;
  next_id_ = memory.next_id;
  sources_ = std::move(memory.sources);
  tread_.restore(std::move(memory.tread));
}

std::uint64_t FieldMemory::hash() const {
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
