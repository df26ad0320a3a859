// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// All processes compute the same wind (N2): this process receives the field of wind_broadcaster,
// which is another process.
#include <gtest/gtest.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <vegetation_sim/GetWindField.h>
#include <vegetation_sim/RemoveWindPrimitive.h>
#include <vegetation_sim/SampleWind.h>
#include <vegetation_sim/SetWindPrimitive.h>

#include <optional>

#include "vegetation_sim/core/math/random.h"
#include "vegetation_sim/ros/conversions/stamps.h"
#include "vegetation_sim/ros/conversions/wind_conversions.h"

namespace vegetation_sim {
namespace {

constexpr double DEADLINE = 30.0;  // [s] of wall time; only a test that fails waits that long

/// Receives the latched field like any other node.
class Listener {
 public:
  Listener() {
    const boost::function<void(const WindField&)> receive = [this](const WindField& message) {
      field_ = fromMsg(message);
    };
    subscriber_ = ros::NodeHandle().subscribe<WindField>("wind", 10, receive);
  }

  /// Spins until a field with this hash has arrived; 0 stands for any field.
  wind::Field wait(std::uint64_t hash) {
    const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(DEADLINE);
    while (!field_ || (hash != 0 && field_->hash() != hash)) {
      if (ros::WallTime::now() > end) throw std::runtime_error("no field in time");
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.05));
    }
    return *field_;
  }

 private:
  std::optional<wind::Field> field_;
  ros::Subscriber subscriber_;
};

template <class Service>
typename Service::Response call(const std::string& name, const typename Service::Request& request) {
  Service service;
  service.request = request;
  const std::string full = "wind_broadcaster/" + name;
  if (!ros::service::waitForService(full, ros::Duration(DEADLINE)) ||
      !ros::service::call(full, service))
    throw std::runtime_error(full + " did not answer");
  return service.response;
}

std::uint64_t hashOfBroadcaster() {
  return call<GetWindField>("get_field", {}).field.hash;
}

/// Times near the start of ROS time, about now, and in the far future.
Nanoseconds randomStamp(const Random& random, std::uint64_t i) {
  const Nanoseconds now = fromMsg(ros::Time::now());
  const Nanoseconds near = now + fromSeconds(random.uniform(4 * i, -5.0, 60.0));
  if (i % 4 == 0) return fromSeconds(random.uniform(4 * i, 0.001, 100.0));
  if (i % 4 == 1) return fromSeconds(random.uniform(4 * i, 2.0e9, 4.0e9));
  return near;
}

SampleWind::Request manySamples() {
  SampleWind::Request request;
  const Random random(11);
  for (std::uint64_t i = 0; i < 10000; ++i) {
    geometry_msgs::Point point;
    point.x = random.uniform(4 * i + 1, -50.0, 50.0);
    point.y = random.uniform(4 * i + 2, -50.0, 50.0);
    point.z = random.uniform(4 * i + 3, 0.0, 20.0);
    request.positions.push_back(point);
    request.stamps.push_back(toStamp(randomStamp(random, i)));
  }
  return request;
}

void expectSameLaw(const wind::Field& field) {
  const SampleWind::Request request = manySamples();
  const SampleWind::Response response = call<SampleWind>("sample", request);
  ASSERT_TRUE(response.success) << response.message;
  ASSERT_EQ(response.velocities.size(), request.positions.size());
  double fastest = 0.0;
  for (std::size_t i = 0; i < request.positions.size(); ++i) {
    const auto& at = request.positions[i];
    const auto& there = response.velocities[i];
    const Vec3 here = field.velocity(Vec3(at.x, at.y, at.z), fromMsg(request.stamps[i]));
    const Vec3 difference = here - Vec3(there.x, there.y, there.z);
    ASSERT_LE(length(difference), 1e-12) << "sample " << i;
    fastest = std::max(fastest, length(here));
  }
  EXPECT_GT(fastest, 5.0);  // There is wind.
}

WindPrimitive disk(const std::string& name) {
  wind::Primitive p;
  p.name = name;
  p.velocity = Vec3(3.0, -2.0, 0.5);
  p.omega = 3.0;
  return toMsg(p);
}

TEST(WindLaw, IsTheSameInTwoProcesses) {  // N2
  Listener listener;
  expectSameLaw(listener.wait(hashOfBroadcaster()));
}

TEST(WindLaw, IsTheSameForALatecomer) {  // N2
  for (const char* name : {"late_1", "late_2", "disc"}) {
    SetWindPrimitive::Request request;
    request.primitive = disk(name);
    const auto response = call<SetWindPrimitive>("set_primitive", request);
    ASSERT_TRUE(response.success) << response.message;
    EXPECT_GT(response.id, 6u);
  }
  Listener latecomer;
  const wind::Field field = latecomer.wait(0);
  EXPECT_EQ(field.hash(), hashOfBroadcaster());
  EXPECT_EQ(field.primitives().size(), 9u);
  expectSameLaw(field);
}

TEST(WindLaw, EditsChangeTheFutureWithoutAStep) {  // N2
  Listener listener;
  const wind::Field before = listener.wait(hashOfBroadcaster());
  const Nanoseconds asked = fromMsg(ros::Time::now());
  SetWindPrimitive::Request request;
  request.primitive = toMsg(before.primitives().at(0));
  ASSERT_EQ(request.primitive.name, "breeze");
  request.primitive.epoch = request.primitive.t_on = ros::Time();
  request.primitive.velocity.y = 9.0;
  const auto response = call<SetWindPrimitive>("set_primitive", request);
  ASSERT_TRUE(response.success) << response.message;
  const wind::Field after = listener.wait(hashOfBroadcaster());
  const Nanoseconds begins = after.primitives().back().t_on;
  EXPECT_GE(begins, asked + fromSeconds(0.2));  // This is the lead of an edit.
  EXPECT_EQ(after.primitives().back().epoch, before.primitives().at(0).epoch);
  const Vec3 position(1.0, 2.0, 3.0);
  for (double t = -20.0; t <= 0.0; t += 0.01)
    ASSERT_EQ(before.velocity(position, begins + fromSeconds(t)),
              after.velocity(position, begins + fromSeconds(t)));
  // [s]; the limit is 8 m/s times the largest slope of the fade, 1.9 / s, plus turbulence and discs
  const double h = 1e-4;
  for (double t = -0.1; t < 1.5; t += h)
    ASSERT_LT(length(after.velocity(position, begins + fromSeconds(t + h)) -
                     after.velocity(position, begins + fromSeconds(t))),
              h * 80.0);
  EXPECT_GT(length(after.velocity(position, begins + fromSeconds(2.0)) -
                   before.velocity(position, begins + fromSeconds(2.0))),
            5.0);
}

TEST(WindLaw, RemovesWithoutAStep) {  // N2
  Listener listener;
  const wind::Field before = listener.wait(hashOfBroadcaster());
  RemoveWindPrimitive::Request request;
  request.name = "fan";
  ASSERT_TRUE(call<RemoveWindPrimitive>("remove_primitive", request).success);
  const wind::Field after = listener.wait(hashOfBroadcaster());
  Nanoseconds ends = 0;
  for (const wind::Primitive& p : after.primitives())
    if (p.name == "fan") ends = p.t_off;
  const Vec3 position(-9.0, 5.0, 4.0);
  for (double t = -10.0; t <= -1.0; t += 0.01)
    ASSERT_EQ(before.velocity(position, ends + fromSeconds(t)),
              after.velocity(position, ends + fromSeconds(t)));
  EXPECT_NE(before.velocity(position, ends), after.velocity(position, ends));
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "wind_law_test");
  ros::NodeHandle nh;
  return RUN_ALL_TESTS();
}
