// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace vegetation_sim {

/// Instruction sets that the batched kernels can use here, best first ("AVX3", "AVX2", ...).
std::vector<std::string> instructionSets();
/// Restricts the batched kernels to one of them; empty: free choice. For tests and benches.
void forceInstructionSet(const std::string& name);

}  // namespace vegetation_sim
