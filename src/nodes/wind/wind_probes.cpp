// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/wind/wind_probes.h"

#include <tf2/exceptions.h>

#include "vegetation_sim/ros/conversions/geometry_conversions.h"
#include "vegetation_sim/ros/conversions/stamps.h"
#include "wind/limits.h"

namespace vegetation_sim {

WindSamples WindProbes::sample(const wind::Field& field, Nanoseconds stamp) {
  WindSamples out;
  out.header.stamp = toStamp(stamp);
  out.header.frame_id = frame_id_;
  missing_.clear();
  const wind::Instant instant = field.at(stamp);
  for (const std::string& frame : frames_) {
    try {
      const auto found = buffer_.lookupTransform(frame_id_, frame, ros::Time(0));
      Vec3 position = fromMsg(found.transform).position;
      Faults faults;
      FieldChecker("", faults).vector("position", position, "m", wind::POSITIONS);
      faults.throwIfAny();
      WindSample sample;
      sample.frame = frame;
      sample.position = toPoint(position);
      sample.velocity = toVector(instant.velocity(position));
      out.samples.push_back(std::move(sample));
      const Nanoseconds seen = fromMsg(found.header.stamp);  // 0 of static frames
      if (seen != 0 && secondsBetween(seen, stamp) > STALE)
        missing_.add(describeMissingTransform(frame, frame_id_));
    } catch (const std::runtime_error&) {  // no transform, or a position that is not a number
      missing_.add(describeMissingTransform(frame, frame_id_));
    }
  }
  return out;
}

}  // namespace vegetation_sim
