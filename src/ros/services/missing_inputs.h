// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <map>
#include <string>
#include <vector>

namespace vegetation_sim {

/// Returns "no transform from 'wheel' to 'map'".
std::string describeMissingTransform(const std::string& frame, const std::string& world);

/// Inputs that a node is configured to follow and that do not arrive. Each one is a warning on
/// /diagnostics while it is missing, and one line on the console with the third warning.
class MissingInputs {
 public:
  /// Begins a new list; the inputs that are not added again have arrived.
  void clear() { missing_.clear(); }
  /// Adds a sentence that names the missing input. Repetitions are ignored.
  void add(const std::string& sentence);

  const std::vector<std::string>& list() const { return missing_; }
  std::size_t size() const { return missing_.size(); }
  /// To be called about once per second.
  void warn(const std::string& node, diagnostic_updater::DiagnosticStatusWrapper& status);

 private:
  std::vector<std::string> missing_;
  std::map<std::string, int> warnings_;  // in a row, of each input of the last one
};

}  // namespace vegetation_sim
