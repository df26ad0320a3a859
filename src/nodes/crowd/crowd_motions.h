// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "crowd/body/motion_style.h"
#include "vegetation_sim/core/config/yaml.h"

namespace vegetation_sim {

/// Reads the list `motions` of a section: styles by `name`, with the files `walk`, `stand` and
/// `turn` of motion data (BVH), named as messages may name files. Clips without a file are those of
/// the first own style. Adds a fault for each file that cannot be read.
crowd::MotionStyles readMotions(YamlSection& section);

}  // namespace vegetation_sim
