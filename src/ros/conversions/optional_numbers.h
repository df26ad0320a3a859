// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>

#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim {

/// Reads the optional numbers of a message. Each has a flag `has_<name>`: with the flag the number
/// counts, even if it is 0; without it the default stays, and a number other than 0 is a fault.
class OptionalNumbers {
 public:
  /// @param context begins the text of each fault.
  OptionalNumbers(std::string context, Faults& faults)
      : context_(std::move(context)), faults_(faults) {}

  /// Writes the number into `value` if it is given. @return whether it is.
  bool read(const char* name, bool given, double number, double& value);

 private:
  std::string context_;
  Faults& faults_;
};

}  // namespace vegetation_sim
