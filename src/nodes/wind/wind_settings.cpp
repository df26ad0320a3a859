// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/wind/wind_settings.h"

#include <algorithm>

#include "nodes/wind/wind_probes.h"
#include "ros/params/scene_file.h"
#include "vegetation_sim/core/math/math.h"
#include "wind/limits.h"
#include "wind/wind_reader.h"

namespace vegetation_sim {
namespace {

wind::Source* findBreeze(std::vector<wind::Source>& sources) {
  for (wind::Source& source : sources)
    if (source.primitive.name == BreezeSettings::NAME) return &source;
  return nullptr;
}

void readScene(const std::string& name, WindSettings& settings) {
  SceneBase scene;
  SceneFile file(name, scene);
  if (!scene.frame_id.empty()) settings.frame_id = scene.frame_id;
  settings.seed = scene.seed;
  YamlSection section = file.section("wind");
  settings.sources = wind::readWind(section, settings.seed);
  file.finish();
}

void readNumbers(Parameters& parameters, WindSettings& settings) {
  parameters.frame("frame_id", settings.frame_id);
  parameters.seed("seed", settings.seed);
  parameters.number("lead", settings.lead, "s", {0.0, 10.0});
  parameters.number("attach_rate", settings.attach_rate, "Hz", {0.5, 10.0});
  parameters.number("attach_horizon", settings.attach_horizon, "s", {0.5, 30.0});
  parameters.number("markers_rate", settings.markers_rate, "Hz", {0.1, 60.0});
  parameters.number("sample_rate", settings.sample_rate, "Hz", {0.1, 240.0});
  parameters.frames("sample_frames", settings.sample_frames, WindProbes::MOST_FRAMES);
  describe(parameters, settings.breeze);
  readSnapshotOptions(parameters, settings.snapshots);
  const double least = 4.0 * std::max(settings.lead, 1.0 / settings.attach_rate);
  if (settings.attach_horizon < least)
    parameters.fault("attach_horizon", "= " + std::to_string(settings.attach_horizon) +
                                           " s is less than 4 lead and 4 / attach_rate = " +
                                           std::to_string(least) + " s");
}

void addBreeze(WindSettings& settings) {
  if (const wind::Source* own = findBreeze(settings.sources)) {
    settings.breeze = BreezeSettings::of(own->primitive, settings.breeze.direction);
  } else if (settings.breeze.speed > 0.0) {
    wind::Primitive base;
    base.velocity = Vec3::Zero();
    settings.sources.push_back({settings.breeze.applyTo(base), ""});
  }
}

void checkTogether(const WindSettings& settings, Faults& faults) {
  std::size_t followed = 0;
  for (const wind::Source& source : settings.sources) followed += !source.attached_frame.empty();
  if (followed > WindSettings::MAX_FOLLOWED)
    faults.add("scenario: " + std::to_string(followed) + " sources follow a frame, allowed are " +
               std::to_string(WindSettings::MAX_FOLLOWED));
  if (!faults.empty()) return;
  try {
    initialSchedule(settings, NANOSECONDS_PER_SECOND);
  } catch (const InvalidInput& error) {
    faults.add(error.what());
  }
}

}  // namespace

void describe(FieldVisitor& visitor, BreezeSettings& breeze) {
  visitor.number("breeze_speed", breeze.speed, "m/s", {0.0, wind::SPEEDS.high});
  visitor.number("breeze_direction", breeze.direction, "rad", {-PI, PI});
  visitor.number("breeze_turbulence", breeze.turbulence, "", wind::TURBULENCE);
}

WindBroadcasterConfig toConfig(const BreezeSettings& breeze) {
  WindBroadcasterConfig config = WindBroadcasterConfig::__getDefault__();
  config.breeze_speed = breeze.speed;
  config.breeze_direction = breeze.direction;
  config.breeze_turbulence = breeze.turbulence;
  return config;
}

BreezeSettings fromConfig(const WindBroadcasterConfig& config) {
  return {config.breeze_speed, config.breeze_direction, config.breeze_turbulence};
}

wind::Primitive BreezeSettings::applyTo(wind::Primitive base) const {
  const SinCos heading = sinCos(direction);
  base.name = NAME;
  base.kind = wind::Kind::BREEZE;
  base.velocity.x() = speed * heading.cos;
  base.velocity.y() = speed * heading.sin;
  base.turbulence = turbulence;
  return base;
}

BreezeSettings BreezeSettings::of(const wind::Primitive& p, double direction_in_a_calm) {
  const double x = p.velocity.x(), y = p.velocity.y();
  const bool calm = x == 0.0 && y == 0.0;
  return {std::sqrt(x * x + y * y), calm ? direction_in_a_calm : arcTangent(y, x), p.turbulence};
}

wind::PrimitiveSchedule initialSchedule(const WindSettings& settings, Nanoseconds start) {
  wind::PrimitiveSchedule schedule(settings.seed);
  std::vector<wind::Primitive> primitives;
  for (const wind::Source& source : settings.sources)
    if (source.attached_frame.empty())
      primitives.push_back(wind::startedAt(source, start).primitive);
  schedule.start(primitives);
  return schedule;
}

WindSettings readWindSettings(const ros::NodeHandle& private_nh) {
  WindSettings settings;
  Parameters parameters(private_nh);
  std::string scenario;
  parameters.text("scenario", scenario);
  if (!scenario.empty()) {
    try {
      readScene(scenario, settings);
    } catch (const InvalidInput& error) {
      parameters.faults().add(error.what());
    }
  }
  readNumbers(parameters, settings);
  addBreeze(settings);
  checkTogether(settings, parameters.faults());
  parameters.finish();
  return settings;
}

}  // namespace vegetation_sim
