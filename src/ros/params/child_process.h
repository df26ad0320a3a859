// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace vegetation_sim {

/// What a child process may take.
struct ChildLimits {
  const char* name;        ///< of the work, with which errors begin: "the reader of meshes"
  double seconds;          ///< of waiting, and of processor time
  std::size_t memory;      ///< beyond that of this process [B]; sanitizers need more: no limit
  std::size_t most_bytes;  ///< of the result
};

/// Returns the bytes that `work` returns in a copy of this process, so that no crash, endless loop
/// or memory of libraries that it calls reaches this one. The copy has the calling thread alone,
/// and of the open files only 0 to 2: locks that other threads hold stay locked, so `work` calls
/// neither ROS nor what other threads use. May be called by several threads at once.
/// @throws InvalidInput that `work` throws, with its code; or if it throws something else, is ended
/// by a signal or exceeds a limit.
std::string runInChild(const std::function<std::string()>& work, const ChildLimits& limits);

}  // namespace vegetation_sim
