// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace vegetation_sim {

/// Instruction sets that the batched kernels can use here, best first ("AVX3", "AVX2", ...).
std::vector<std::string> instructionSets();
/// Restricts the batched kernels to one of them; empty: free choice. For tests and benches.
/// @throws InvalidInput for one that is not offered here.
void forceInstructionSet(const std::string& name);
/// The one that kernels are compiled for which a call reaches now.
std::string chosenInstructionSet();

}  // namespace vegetation_sim
