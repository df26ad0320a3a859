// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/crowd/crowd_options.h"

#include <set>

#include "nodes/crowd/crowd_motions.h"
#include "ros/services/frame_lookup.h"

namespace vegetation_sim {
namespace {

constexpr Range CORNERS{-20.0, 20.0};

crowd::Robot readRobot(YamlSection& section) {
  crowd::Robot out;
  section.text("frame", out.id);
  if (out.id.empty()) section.fault("needs a frame");
  if (!out.id.empty() && out.id[0] == '/')
    section.fault("frame", "= " + inQuotes(out.id) + " begins with '/'");
  section.number("radius", out.radius, "m", {0.01, 20.0});
  for (YamlSection& corner : section.sections("outline")) {
    crowd::Point p{};
    for (const char* key : {"x", "y"})
      if (!corner.has(key)) corner.fault(key, "is missing in a corner");
    corner.number("x", p.x, "m", CORNERS);
    corner.number("y", p.y, "m", CORNERS);
    corner.finish();
    out.outline.push_back(p);
  }
  Faults faults;
  crowd::check(out, faults);
  for (const std::string& fault : faults.list()) section.fault(fault);
  section.finish();
  return out;
}

std::vector<crowd::Robot> readRobots(YamlSection& section) {
  std::vector<crowd::Robot> out;
  std::set<std::string> names;
  for (YamlSection& entry : section.sections("robots")) {
    out.push_back(readRobot(entry));
    if (!names.insert(out.back().id).second)
      section.fault("robots", "names " + inQuotes(out.back().id) + " twice");
  }
  if (out.size() > crowd::MOST_ROBOTS)
    section.fault("robots", "are " + std::to_string(out.size()) + ", allowed are " +
                                std::to_string(crowd::MOST_ROBOTS));
  return out;
}

}  // namespace

void describe(FieldVisitor& v, CrowdOptions& o) {
  v.integer("state_rate", o.state_rate, "Hz", {1, 240});
  v.integer("marker_points", o.marker_points, "", {3000, 3000000});
  v.number("tolerance", o.tolerance, "pixel", {0.01, 1000.0});
  v.number("frame_wait", o.frame_wait, "s", {0.0, FrameLookup::LONGEST_WAIT});
  v.number("tf_rate", o.tf_rate, "Hz", {0.1, 240.0});
  v.integer("tf_budget", o.tf_budget, "", {0, 10000});
  v.choice("tread", o.tread, {"none", "body", "feet"});
  v.number("tread_radius", o.tread_radius, "m", {0.0, 2.0});
  v.number("cover_rate", o.cover_rate, "Hz", {0.0, 60.0});
  v.integer("tread_ahead", o.tread_ahead, "", {0, 60});
  v.choice("trunks", o.trunks, {"round", "box"});
  v.integer("most_trunks", o.most_trunks, "", {0, 1000000});
  v.integer("most_walkers", o.most_walkers, "", {0, static_cast<double>(crowd::MOST_WALKERS)});
  v.integer("threads", o.threads, "", {1, 64});
  v.number("view_range", o.view_range, "m", {0.0, 100000.0});
  describe(v, o.tuning);
}

CrowdScene loadCrowdScene(const std::string& name) {
  CrowdScene out;
  if (name.empty()) return out;
  SceneFile file(name, out);
  if (file.has("crowd")) {
    YamlSection section = file.section("crowd");
    out.crowd = crowd::readScene(section, out.seed, file.faults());
    out.robots = readRobots(section);
    out.motions = readMotions(section);
    section.finish();
  }
  file.loadTerrain();
  file.finish();
  return out;
}

CrowdOptions loadCrowdOptions(const ros::NodeHandle& private_handle) {
  CrowdOptions out;
  Parameters parameters(private_handle);
  readScenario(parameters, out, loadCrowdScene);
  out.tuning = out.scene.crowd.settings;
  out.robots = out.scene.robots;
  out.motions = out.scene.motions;
  parameters.frame("frame_prefix", out.frame_prefix, true);
  describe(parameters, out);
  readShard(private_handle, parameters, out);
  YAML::Node list;
  if (parameters.list("robots", list)) {
    YamlSection section(list, private_handle.getNamespace(), parameters.faults());
    out.robots = readRobots(section);
  }
  if (parameters.list("motions", list)) {
    YamlSection section(list, private_handle.getNamespace(), parameters.faults());
    out.motions = readMotions(section);
  }
  if (out.scene.crowd.spawns.size() > static_cast<std::size_t>(out.most_walkers))
    parameters.fault("most_walkers", "= " + std::to_string(out.most_walkers) +
                                         " is below the scenario's " +
                                         std::to_string(out.scene.crowd.spawns.size()));
  parameters.finish();
  return out;
}

void toConfig(const crowd::CrowdSettings& s, AgentCrowdConfig& c) {
  c.sensor_range = s.sensor_range;
  c.neighbours = s.neighbours;
  c.noise_heading = s.noise_heading;
  c.noise_speed = s.noise_speed;
  c.commitment = s.commitment;
  c.handedness = s.handedness;
  c.slowest = s.slowest;
  c.arrival = s.arrival;
  c.field_cell = s.field_cell;
  c.turn_rate = s.turn_rate;
  c.acceleration = s.acceleration;
  c.reaction = s.reaction;
  c.clearance = s.clearance;
  c.push_speed = s.push_speed;
  c.grass_drag = s.grass_drag;
  c.pace = s.pace;
}

crowd::CrowdSettings fromConfig(const AgentCrowdConfig& c, const crowd::CrowdSettings& other) {
  crowd::CrowdSettings s = other;
  s.sensor_range = c.sensor_range;
  s.neighbours = c.neighbours;
  s.noise_heading = c.noise_heading;
  s.noise_speed = c.noise_speed;
  s.commitment = c.commitment;
  s.handedness = c.handedness;
  s.slowest = c.slowest;
  s.arrival = c.arrival;
  s.field_cell = c.field_cell;
  s.turn_rate = c.turn_rate;
  s.acceleration = c.acceleration;
  s.reaction = c.reaction;
  s.clearance = c.clearance;
  s.push_speed = c.push_speed;
  s.grass_drag = c.grass_drag;
  s.pace = c.pace;
  return s;
}

}  // namespace vegetation_sim
