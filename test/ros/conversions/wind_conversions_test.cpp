// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/ros/conversions/wind_conversions.h"

#include <gtest/gtest.h>

#include "scenes/wind/wind_examples.h"

namespace vegetation_sim {
namespace {

TEST(WindConversions, ReturnEveryFieldToTheBit) {  // N2
  std::vector<wind::Primitive> sources = wind::oneOfEach();
  double value = 0.1;  // All values differ, so that no two fields can be swapped.
  for (wind::Primitive& p : sources)
    for (double* number :
         {&p.fade_in, &p.fade_out, &p.orbit_radius, &p.orbit_period, &p.repeat, &p.radius, &p.omega,
          &p.phase, &p.turbulence, &p.front_speed, &p.rise_length, &p.plateau_length,
          &p.decay_length, &p.speed, &p.core_radius, &p.inflow, &p.updraft, &p.time_scale})
      *number = (value += 0.005);
  sources[0].envelope = wind::Envelope::PAPER;
  const wind::Field field(sources, 18446744073709551615ULL);
  const WindField message = toMsg(field, "odom", wind::at(17.25));
  EXPECT_EQ(message.header.frame_id, "odom");
  EXPECT_EQ(message.header.stamp, ros::Time(17, 250000000));
  EXPECT_EQ(message.hash, field.hash());
  EXPECT_EQ(fromMsg(message).hash(), field.hash());  // the hash covers every field
}

TEST(WindConversions, RefuseAFieldThatTheSenderComputesDifferently) {  // N2
  WindField message = toMsg(wind::Field(wind::oneOfEach(), 3), "map", 5);
  message.primitives[2].radius += 1.0;
  EXPECT_THROW(fromMsg(message), InvalidInput);
}

TEST(WindConversions, RejectAnInvalidField) {  // N2
  WindField message = toMsg(wind::Field(wind::oneOfEach(), 3), "map", 5);
  message.primitives[0].radius = -1.0;
  EXPECT_THROW(fromMsg(message), InvalidInput);
}

TEST(WindConversions, RefuseWayPointsOfAnotherFrame) {
  WindPrimitive message = toMsg(wind::oneOfEach()[0]);
  Faults none, faults;
  message.trajectory[0].header.frame_id = "map";
  message.attached_frame = "drone";
  EXPECT_EQ(sourceFromMsg(message, "map", none).attached_frame, "drone");
  EXPECT_TRUE(none.empty()) << none.text();
  message.trajectory[1].header.frame_id = "odom";
  sourceFromMsg(message, "map", faults);
  EXPECT_EQ(faults.text(),
            "primitive 'disk': trajectory[1].header.frame_id = 'odom' is not 'map' or empty");
}

}  // namespace
}  // namespace vegetation_sim
