// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace vegetation_sim {

/// Returns the bytes of a regular file; devices and pipes, which may never end, are rejected.
/// @param largest size [bytes] that is read. @throws InvalidInput naming the file.
std::string readFile(const std::string& file, std::uintmax_t largest);

}  // namespace vegetation_sim
