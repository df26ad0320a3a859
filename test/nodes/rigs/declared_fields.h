// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <dynamic_reconfigure/Config.h>
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "vegetation_sim/core/config/fields.h"

namespace vegetation_sim {

using Values = std::map<std::string, double>;

/// Collects ranges and values of a described structure of numbers.
struct Declared : FieldVisitor {
  Values defaults, low, high;

  void number(const char* name, double& value, const char*, Range range) override {
    defaults[name] = value;
    low[name] = range.low;
    high[name] = range.high;
  }
  void integer(const char* name, int& value, const char* unit, Range range) override {
    double number_value = value;
    number(name, number_value, unit, range);
  }
  void vector(const char* name, Vec3&, const char*, Range) override { ADD_FAILURE() << name; }
  void choice(const char* name, int&, const std::vector<std::string>&) override {
    ADD_FAILURE() << name;
  }
};

/// Returns the ranges and values of dynamic_reconfigure for each name. @tparam Config is a
/// generated class.
template <class Config>
Values offered(const Config& config) {
  dynamic_reconfigure::Config message;
  config.__toMessage__(message);
  Values out;
  for (const auto& field : message.ints) out[field.name] = field.value;
  for (const auto& field : message.doubles) out[field.name] = field.value;
  return out;
}

}  // namespace vegetation_sim
