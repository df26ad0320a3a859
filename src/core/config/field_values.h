// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "vegetation_sim/core/config/fields.h"

namespace vegetation_sim {

/// The numbers of a described structure under their names, as events of settings carry them.
/// Vectors and choices are left out.
struct NamedValues {
  std::vector<std::string> names;
  std::vector<double> values;
};

/// Copies fields out under their names, or in from them.
class FieldCopier : public FieldVisitor {
 public:
  FieldCopier(std::map<std::string, double>& values, bool out) : values_(values), out_(out) {}
  void number(const char* name, double& value, const char* unit, Range range) override;
  void integer(const char* name, int& value, const char* unit, Range range) override;
  void vector(const char*, Vec3&, const char*, Range) override {}
  void choice(const char*, int&, const std::vector<std::string>&) override {}

 private:
  std::map<std::string, double>& values_;
  bool out_;
};

template <class T>
NamedValues namedValues(T fields) {
  std::map<std::string, double> values;
  FieldCopier copier(values, true);
  describe(copier, fields);
  NamedValues out;
  for (const auto& [name, value] : values) {
    out.names.push_back(name);
    out.values.push_back(value);
  }
  return out;
}

/// Adds the faults of names that are not in `known`, or of lists of unequal length.
void checkNames(const NamedValues& named, const std::map<std::string, double>& known,
                Faults& faults);

/// Returns the structure; fields that are not named are as in T(). @throws InvalidInput for an
/// unknown name or
/// a value out of range.
template <class T>
T fromNamedValues(const NamedValues& named) {
  T out;
  std::map<std::string, double> known, values;
  FieldCopier reader(known, true);
  describe(reader, out);
  Faults faults;
  checkNames(named, known, faults);
  faults.throwIfAny();
  for (std::size_t i = 0; i < named.names.size(); ++i) values[named.names[i]] = named.values[i];
  FieldCopier writer(values, false);
  describe(writer, out);
  FieldChecker checker("event: ", faults);
  describe(checker, out);
  faults.throwIfAny();
  return out;
}

}  // namespace vegetation_sim
