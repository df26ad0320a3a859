// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/conversions/recorded_message.h"

#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim {

void checkRecorded(const topic_tools::ShapeShifter& recorded, const std::string& type,
                   const std::string& md5) {
  if (recorded.getDataType() == type && recorded.getMD5Sum() == md5) return;
  throw InvalidInput("recorded with another version of vegetation_sim, as " +
                     recorded.getDataType() + " of MD5 sum " + recorded.getMD5Sum() +
                     "; this version reads " + type + " of MD5 sum " + md5);
}

}  // namespace vegetation_sim
