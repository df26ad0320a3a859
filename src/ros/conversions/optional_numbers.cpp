// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/conversions/optional_numbers.h"

#include <sstream>

namespace vegetation_sim {

bool OptionalNumbers::read(const char* name, bool given, double number, double& value) {
  if (given) value = number;
  if (given || number == 0.0) return given;
  std::ostringstream fault;
  fault << context_ << name << " = " << number << " needs has_" << name << " = true";
  faults_.add(fault.str());
  return false;
}

}  // namespace vegetation_sim
