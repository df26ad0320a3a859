// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/core/config/instruction_set.h"

#include <cstdint>

#include "vegetation_sim/core/config/faults.h"

// This choice is the same as in the kernels: vectors without arithmetic operators are left out.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/config/instruction_set.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace vegetation_sim::HWY_NAMESPACE {

// This function is compiled once for each instruction set, as kernels are.
const char* ownName() {
  return hwy::TargetName(HWY_TARGET);
}

}  // namespace vegetation_sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vegetation_sim {

HWY_EXPORT(ownName);

std::vector<std::string> instructionSets() {
  std::vector<std::string> out;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
    out.emplace_back(hwy::TargetName(target));
  return out;
}

void forceInstructionSet(const std::string& name) {
  hwy::SetSupportedTargetsForTest(0);  // 0: any that the processor has
  bool found = name.empty();
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
    if (name == hwy::TargetName(target)) {
      hwy::SetSupportedTargetsForTest(target);
      found = true;
      break;
    }
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  if (!found) throw InvalidInput("instruction set " + inQuotes(name) + " is not offered here");
}

std::string chosenInstructionSet() {
  return HWY_DYNAMIC_DISPATCH(ownName)();
}

}  // namespace vegetation_sim
#endif
