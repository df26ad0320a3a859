// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

namespace vegetation_sim {

// Numbers of `count` generators at once, with the bits of Random, in the widest instruction set of
// the processor.

/// Sets out[i] to Random(keys[i]).bits(index).
void drawBits(const std::uint64_t* keys, std::size_t count, std::uint64_t index,
              std::uint64_t* out);

/// Sets out[i] to Random(keys[i]).child(indices[i]).key().
void drawChildren(const std::uint64_t* keys, const std::uint64_t* indices, std::size_t count,
                  std::uint64_t* out);

}  // namespace vegetation_sim
