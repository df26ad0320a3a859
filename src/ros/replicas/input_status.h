// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/shards/shard_split.h"

namespace vegetation_sim {

/// Whether an input of a replica is in use, and why not, for users.
struct InputStatus {
  bool good{false};
  std::string text;
  bool rejected{false};  ///< the newest message was
};

/// An input that is silent for longer is reported, and people are removed.
constexpr Nanoseconds SILENCE = SHARD_SILENCE;

/// Returns the status at `now` of an input whose newest message has this stamp: a warning if it is
/// older than SILENCE.
inline InputStatus unlessSilent(const InputStatus& status, Nanoseconds stamp, Nanoseconds now) {
  if (!status.good || now - stamp <= SILENCE) return status;
  return {false, "No message for 3 s: drawn as it was then"};
}

}  // namespace vegetation_sim
