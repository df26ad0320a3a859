// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace vegetation_sim {

/// Returns the instruction sets that the batched kernels can use here, best first ("AVX3", "AVX2").
std::vector<std::string> instructionSets();
/// Restricts the batched kernels to one instruction set; an empty name restores the free choice.
/// For tests and benches.
/// @throws InvalidInput for an instruction set that is not offered here.
void forceInstructionSet(const std::string& name);
/// Returns the instruction set of the kernels that a call runs now.
std::string chosenInstructionSet();

}  // namespace vegetation_sim
