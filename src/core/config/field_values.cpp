// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/config/field_values.h"

#include <cmath>

namespace vegetation_sim {

void FieldCopier::number(const char* name, double& value, const char*, Range) {
  const auto found = values_.find(name);
  if (out_)
    values_[name] = value;
  else if (found != values_.end())
    value = found->second;
}

void FieldCopier::integer(const char* name, int& value, const char* unit, Range range) {
  double number_value = value;
  number(name, number_value, unit, range);
  const bool whole = std::fabs(number_value) < 1e9 && std::floor(number_value) == number_value;
  value = whole ? static_cast<int>(number_value) : -1;  // below every range
}

void checkNames(const NamedValues& named, const std::map<std::string, double>& known,
                Faults& faults) {
  if (named.names.size() != named.values.size())
    faults.add("event: " + std::to_string(named.names.size()) + " names for " +
               std::to_string(named.values.size()) + " values");
  for (const std::string& name : named.names)
    if (!known.count(name)) faults.add("event: " + shortened(name) + " is not known");
}

}  // namespace vegetation_sim
