// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/core/config/fields.h"

#include <cmath>
#include <sstream>

namespace vegetation_sim {

std::string rangeFault(const std::string& name, double value, const char* unit, Range range) {
  if (std::isfinite(value) && value >= range.low && value <= range.high) return {};
  const std::string suffix = *unit ? std::string(" ") + unit : "";
  std::ostringstream out;
  out << name << " = " << value << suffix << " is "
      << (std::isfinite(value) ? "outside " : "not finite, allowed is ") << range.low << " to "
      << range.high << suffix;
  return out.str();
}

void FieldChecker::number(const char* name, double& value, const char* unit, Range range) {
  const std::string fault = rangeFault(context_ + name, value, unit, range);
  if (!fault.empty()) faults_.add(fault);
}

void FieldChecker::integer(const char* name, int& value, const char* unit, Range range) {
  double number_value = value;
  number(name, number_value, unit, range);
}

void FieldChecker::vector(const char* name, Vec3& value, const char* unit, Range range) {
  const char* const axes[] = {".x", ".y", ".z"};
  for (int i = 0; i < 3; ++i) number((std::string(name) + axes[i]).c_str(), value[i], unit, range);
}

void FieldChecker::choice(const char* name, int& value, const std::vector<std::string>& names) {
  if (value >= 0 && value < static_cast<int>(names.size())) return;
  std::string fault = context_ + name + " = " + std::to_string(value) + " is none of";
  for (std::size_t i = 0; i < names.size(); ++i)
    fault += (i ? ", " : " ") + std::to_string(i) + " (" + names[i] + ")";
  faults_.add(fault);
}

void FieldHasher::integer(const char*, int& value, const char*, Range) {
  hash_.add(static_cast<std::uint64_t>(value));
}

void FieldHasher::choice(const char*, int& value, const std::vector<std::string>&) {
  hash_.add(static_cast<std::uint64_t>(value));
}

}  // namespace vegetation_sim
