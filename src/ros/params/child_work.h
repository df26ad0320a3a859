// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

#include "ros/params/child_process.h"
#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim {

enum class ChildOutcome : std::uint8_t { RESULT, REJECTED, NO_MEMORY, FAILED };

/// What a child sends before its bytes: the result, or the text of an error.
struct ChildHeader {
  std::uint64_t size{0};
  ChildOutcome outcome{ChildOutcome::RESULT};
  FaultCode code{FaultCode::NONE};
};

/// Returns the address space of this process [B], or 0 if the system does not say.
std::size_t addressSpace();

/// Leaves what ties a child to the program: its handlers of signals, open files and dumps of
/// memory. Sets the limits. @param present address space before the work [B]. @param in, out the
/// ends of the pipe.
void enterChild(const ChildLimits& limits, std::size_t present, pid_t parent, int in, int out);

/// Does the work and sends what comes of it. What escapes, such as a lack of memory for the text of
/// an error, ends the child here, and never reaches the copied stack of the caller.
[[noreturn]] void workAndExit(const std::function<std::string()>& work, int out) noexcept;

}  // namespace vegetation_sim
