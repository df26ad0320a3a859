// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::fuzz {

/// Longest mutated input [bytes].
constexpr std::size_t LONGEST_INPUT = 20000;

/// Returns one of the inputs with some random changes: bytes and numbers that are replaced, parts
/// that are deleted, repeated or taken from another input. It follows from the key alone.
std::string mutate(const std::vector<std::string>& inputs, const Random& random);

}  // namespace vegetation_sim::fuzz
