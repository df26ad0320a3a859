// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/common/instruction_set.h"

// The same choice as in the kernels: vectors without arithmetic operators are left out.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#include <hwy/targets.h>

namespace vegetation_sim {

std::vector<std::string> instructionSets() {
  std::vector<std::string> out;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
    out.emplace_back(hwy::TargetName(target));
  return out;
}

void forceInstructionSet(const std::string& name) {
  hwy::SetSupportedTargetsForTest(0);  // 0: whatever the processor has
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
    if (name == hwy::TargetName(target)) {
      hwy::SetSupportedTargetsForTest(target);
      break;
    }
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace vegetation_sim
