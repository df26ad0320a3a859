// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "fuzz/fuzz_target.h"

namespace vegetation_sim::fuzz {

std::vector<Target> forestMessageTargets();
std::vector<Target> meadowMessageTargets();
std::vector<Target> canopyMessageTargets();
std::vector<Target> worldMessageTargets();
std::vector<Target> shardMessageTargets();
std::vector<Target> requestTargets();
std::vector<Target> snapshotTargets();
std::vector<Target> eventTargets();
std::vector<Target> textTargets();
std::vector<Target> pictureTargets();
std::vector<Target> plantFileTargets();

}  // namespace vegetation_sim::fuzz
