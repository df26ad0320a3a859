// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/grass/tread/tread_input.h"

namespace vegetation_sim::grass {
namespace {

constexpr Range PLACES{-1e7, 1e7}, SPEEDS{-1e4, 1e4};
constexpr std::size_t LONGEST_NAME = 200;

}  // namespace

void check(const TreadInput& input, const std::string& context, Faults& faults) {
  TreadInput copy = input;
  FieldChecker checker(context, faults);
  if (input.source.empty() || input.source.size() > LONGEST_NAME)
    faults.add(context + "source = " + inQuotes(input.source) + " has " +
               std::to_string(input.source.size()) + " letters, allowed are 1 to " +
               std::to_string(LONGEST_NAME));
  const int action = static_cast<int>(input.action);
  if (action < 0 || action > static_cast<int>(TreadAction::STROKE))
    faults.add(context + "action = " + std::to_string(action) + " is outside 0 to 3");
  if (input.action == TreadAction::LIFT) return;
  if (input.action == TreadAction::STROKE) checker.vector("start", copy.start, "m", PLACES);
  checker.vector("position", copy.position, "m", PLACES);
  checker.number("height_gate", copy.height_gate, "m", {0.0, 1000.0});
  if (copy.velocity) checker.vector("velocity", *copy.velocity, "m/s", SPEEDS);
  check(input.law, context, faults);
}

}  // namespace vegetation_sim::grass
