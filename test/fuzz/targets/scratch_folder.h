// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace vegetation_sim::fuzz {

/// Folder of this process for the files of one input; it is deleted when the process ends.
class ScratchFolder {
 public:
  static ScratchFolder& instance();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  /// Writes a file and returns its path.
  std::string write(const std::string& name, std::string_view bytes) const;
  /// Deletes a file if there is one.
  void remove(const std::string& name) const;

 private:
  ScratchFolder();
  std::string folder_;
};

}  // namespace vegetation_sim::fuzz
