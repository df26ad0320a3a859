// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <vegetation_sim/CutGrass.h>

#include "crowd/body/body_skeleton.h"
#include "fuzz/targets/decoding.h"
#include "fuzz/targets/target_lists.h"
#include "fuzz/targets/usage.h"
#include "nodes/canopy/plants_in_area.h"
#include "nodes/cutters/cut_request.h"
#include "ros/conversions/crowd_conversions.h"
#include "ros/conversions/grab_conversions.h"
#include "ros/images/image_conversions.h"
#include "ros/landscape/near_crowd.h"
#include "ros/replicas/subscribed_crowd.h"
#include "ros/replicas/subscribed_wind.h"
#include "scenes/wind/wind_examples.h"
#include "vegetation_sim/ros/conversions/forest_conversions.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"
#include "vegetation_sim/ros/conversions/grass_conversions.h"
#include "vegetation_sim/ros/conversions/wind_conversions.h"
#include "wind/schedule/primitive_schedule.h"

namespace vegetation_sim::fuzz {
namespace {

// Wind: published fields, and requests to change one.

enum WindPiece { FIELD, SET, REMOVE, WIND_PIECES };

void sample(const wind::Field& field) {
  for (const double second : {0.0, 1.5, 3600.0}) {
    const wind::Instant wind = field.at(START + fromSeconds(second));
    for (const Vec3& place : {Vec3(0.0, 0.0, 0.0), Vec3(3.0, -4.0, 2.0), Vec3(1e4, 1e4, 50.0)}) {
      requireFinite(wind.velocity(place), "wind");
      if (!(wind.speedBound(place, 1.0) >= 0.0)) throw BrokenPromise("a bound of speed is NaN");
    }
  }
}

// As in WindBroadcaster::apply().
void edit(const WindPrimitive& message, wind::PrimitiveSchedule& schedule) {
  Faults faults;
  const wind::Source source = sourceFromMsg(message, "map", faults);
  wind::checkFrame(source, faults);
  if (faults.empty()) schedule.set(source.primitive, START + NANOSECONDS_PER_SECOND);
}

void runWind(std::string_view input) {
  SubscribedWind received;
  wind::PrimitiveSchedule schedule;
  for (const Piece& piece : splitPieces(input)) try {
      switch (piece.kind % WIND_PIECES) {
        case FIELD:
          if (WindField field; decode(piece.bytes, field)) {
            repairHash(field);
            received.apply(field);
          }
          break;
        case SET:
          if (WindPrimitive primitive; decode(piece.bytes, primitive)) edit(primitive, schedule);
          break;
        default:
          schedule.remove(std::string(piece.bytes), START + 2 * NANOSECONDS_PER_SECOND);
      }
    } catch (const InvalidInput&) {
    }
  sample(received.field());
  sample(schedule.field());
  schedule.prune(START + 60 * NANOSECONDS_PER_SECOND);
}

std::vector<std::string> windSeeds() {
  std::vector<std::string> out;
  std::vector<wind::Primitive> all;
  for (wind::Primitive primitive : wind::oneOfEach()) {
    all.push_back(wind::later(primitive, START));
    all.back().repeat = 0.0;
    out.push_back(pieceOf(SET, encode(toMsg(all.back()))) + pieceOf(REMOVE, all.back().name));
    out.push_back(pieceOf(FIELD, encode(toMsg(wind::Field({all.back()}, 5), "map", START))));
  }
  out.push_back(pieceOf(FIELD, encode(toMsg(wind::Field(all, 5), "map", START))));
  return out;
}

// People.

enum AgentPiece { FULL, ROUNDED, NEAR, AGENT_PIECES };

void receive(const Piece& piece, SubscribedCrowd& crowd, NearCrowd& near) {
  switch (piece.kind % AGENT_PIECES) {
    case ROUNDED:
      if (CrowdView message; decode(piece.bytes, message)) crowd.apply(message);
      break;
    case NEAR:
      if (NearAgents message; decode(piece.bytes, message) && near.accepts(message))
        near.apply(message);
      break;
    default:
      if (AgentStates message; decode(piece.bytes, message)) crowd.apply(message);
  }
}

void runAgents(std::string_view input) {
  SubscribedCrowd crowd{ReplicaOptions()};
  NearCrowd near{ReplicaOptions()};
  for (const Piece& piece : splitPieces(input)) receive(piece, crowd, near);
  if (near.covers(SENSOR_PLACE, SENSOR_RANGE, START) && near.stamp() == 0)
    throw BrokenPromise("people near a place are known without a message");
  std::vector<SubscribedCrowd::Person> all = crowd.people();
  all.insert(all.end(), near.people().begin(), near.people().end());
  const terrain::HeightMap ground;
  std::vector<scan::People::Person> people;
  for (const SubscribedCrowd::Person& person : all) {
    crowd::Walker walker = person.walker;
    crowd::advanceGait(0.1, walker);
    people.push_back({walker.id, crowd::skeletonOf(walker, ground)});
    for (const crowd::Limb& limb : people.back().skeleton) {
      requireFinite(limb.from, "limb");
      requireFinite(limb.to, "limb");
    }
  }
  scan::Scene scene;
  scene.people.set(people);
  sweepOnce(scene);
  crowd.forgetSilent(START + 10 * NANOSECONDS_PER_SECOND);
}

std::vector<std::string> agentSeeds() {
  AgentStates message;
  message.header.stamp = toStamp(START);
  const terrain::HeightMap ground;
  std::vector<crowd::Walker> walkers;
  for (std::uint32_t id = 0; id < 3; ++id) {
    crowd::Walker walker;
    walker.id = id;
    walker.position = {1.0 * id, 2.0};
    walker.velocity = {1.0, 0.5};
    message.agents.push_back(toMsg(walker, ground));
    walkers.push_back(walker);
  }
  NearAgents near;
  near.header.stamp = message.header.stamp;
  near.agents = message.agents;
  near.discs.resize(1);
  near.discs[0].radius = 50.0F;
  const std::string full = pieceOf(FULL, encode(message));
  return {full, full + full, pieceOf(ROUNDED, encode(toView(walkers, ground))),
          pieceOf(NEAR, encode(near))};
}

// Inputs of nodes that need no state: viewers, sensors, lenses, treads, spawns, robots, grabs,
// covers, and requests to cut grass and plants.

enum InputPiece {
  VIEWER,
  SENSOR,
  TREAD,
  SPAWN,
  ROBOT,
  GRAB,
  FORCE,
  BODY,
  COVER,
  CUT,
  LENS,
  INPUT_PIECES
};

template <class Message, class Use>
void convert(std::string_view bytes, const Use& use) {
  if (Message message; decode(bytes, message)) use(message);
}

/// Finds plants in the area of a request, as the nodes do.
void cutArea(const GrassCut& message) {
  static const std::vector<canopy::Plant> PLANTS = [] {
    std::vector<canopy::Plant> out(100);
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i].position =
          Vec3(0.1 * static_cast<double>(i % 10), 0.1 * static_cast<double>(i / 10), 0);
    return out;
  }();
  const grass::CutArea area =
      areaOf(message, {Vec3(0.1, 0.2, 0.3), normalized({0.9, 0.0, 0.0, 0.4})});
  for (const std::uint32_t plant : plantsIn(PLANTS, area))
    if (plant >= PLANTS.size()) throw BrokenPromise("a plant in an area does not exist");
  toMsg(area);
}

void convertCrowdInput(const Piece& piece) {
  Faults faults;
  switch (piece.kind % INPUT_PIECES) {
    case SPAWN:
      return convert<AgentSpawn>(piece.bytes,
                                 [&](const AgentSpawn& m) { fromMsg(m, "spawn: ", faults); });
    case ROBOT:
      return convert<CrowdRobot>(piece.bytes, [&](const CrowdRobot& m) {
        const crowd::Robot robot = fromMsg(m);
        check(robot, faults);
        if (faults.empty()) crowd::obstacleOf(robot);
      });
    default:
      return convert<nav_msgs::OccupancyGrid>(piece.bytes, [](const nav_msgs::OccupancyGrid& m) {
        hashOf(m);
        const crowd::Resistance resistance = resistanceOf(m);
        for (const double x : {-1.0, 0.0, 0.3, 2.0, 1e9})
          if (!(resistance({x, x}) >= 0.0)) throw BrokenPromise("a resistance is below 0");
      });
  }
}

void convertInput(const Piece& piece) {
  switch (piece.kind % INPUT_PIECES) {
    case VIEWER:
      return convert<Viewer>(piece.bytes, [](const Viewer& m) {
        requireFinite(fromMsg(m).eye.forward, "direction of a viewer");
      });
    case SENSOR:
      return convert<SensorInterest>(piece.bytes, [](const SensorInterest& m) {
        requireFinite(fromMsg(m).position, "position of a sensor");
      });
    case TREAD:
      return convert<TreadEvent>(piece.bytes, [](const TreadEvent& m) {
        requireFinite(fromMsg(m, grass::TreadLaw(), 0.3).position, "position of a tread");
      });
    case GRAB:
      return convert<BranchGrab>(piece.bytes, [](const BranchGrab& m) {
        Faults faults;
        check(fromMsg(m), faults);
      });
    case FORCE:
      return convert<BranchForce>(piece.bytes, [](const BranchForce& m) {
        Faults faults;
        check(fromMsg(m), faults);
      });
    case CUT:  // CutGrass and CutPlants are the same request
      return convert<CutGrass::Request>(piece.bytes, [](const auto& m) { cutArea(m.cut); });
    case LENS:
      return convert<sensor_msgs::CameraInfo>(piece.bytes, [](const sensor_msgs::CameraInfo& m) {
        requireFinite(scan::directionOf(fromMsg(m, ""), {0.0, 0.0}), "ray of a lens");
      });
    case BODY:
      return convert<ForestBody>(piece.bytes, [](const ForestBody& m) { toMsg(fromMsg(m)); });
    default:
      return convertCrowdInput(piece);
  }
}

void runInputs(std::string_view input) {
  for (const Piece& piece : splitPieces(input)) try {
      convertInput(piece);
    } catch (const InvalidInput&) {
    }
}

std::vector<std::string> inputSeeds() {
  Viewer viewer;
  viewer.pose.orientation.w = 1.0;
  viewer.field_of_view = 0.8;
  viewer.height = 800;
  TreadEvent tread;
  tread.source = "boot";
  CrowdRobot robot;
  robot.id = "base";
  robot.outline.resize(3);
  robot.outline[1].x = robot.outline[2].y = 0.5;
  nav_msgs::OccupancyGrid cover;
  cover.info.width = cover.info.height = 2;
  cover.info.resolution = 0.5F;
  cover.data = {0, 50, 100, -1};
  ForestBody body;
  body.id = "arm";
  body.pose.orientation.w = body.offset.orientation.w = 1.0;
  body.size.x = 0.1;
  const sensor_msgs::CameraInfo lens = toMsg(scan::Lens());
  BranchForce force;
  force.duration = 1.0;
  CutGrass::Request cut;
  cut.header.frame_id = "map";
  cut.cut.height = 0.1;
  cut.cut.outline.resize(4);
  cut.cut.outline[1].x = cut.cut.outline[2].x = cut.cut.outline[2].y = cut.cut.outline[3].y = 0.7;
  CutGrass::Request strip = cut;
  strip.cut.swath = cut.cut.outline;
  strip.cut.outline.resize(2);
  strip.cut.radius = 0.2;
  return {pieceOf(CUT, encode(cut)),       pieceOf(CUT, encode(strip)),
          pieceOf(VIEWER, encode(viewer)), pieceOf(SENSOR, encode(toMsg(forest::Sensor()))),
          pieceOf(TREAD, encode(tread)),   pieceOf(SPAWN, encode(toMsg(crowd::Spawn()))),
          pieceOf(ROBOT, encode(robot)),   pieceOf(GRAB, encode(toMsg(forest::Grab()))),
          pieceOf(FORCE, encode(force)),   pieceOf(BODY, encode(body)),
          pieceOf(COVER, encode(cover)),   pieceOf(LENS, encode(lens))};
}

}  // namespace

std::vector<Target> worldMessageTargets() {
  return {
      {"wind", "WindField, WindPrimitive and edits of a field; samples", runWind, windSeeds},
      {"agents", "AgentStates, CrowdView, NearAgents; bodies and a sweep", runAgents, agentSeeds},
      {"inputs",
       "Viewer, SensorInterest, CameraInfo, TreadEvent, AgentSpawn, CrowdRobot, OccupancyGrid, "
       "requests to cut, and the parts of ForestEvent",
       runInputs, inputSeeds}};
}

}  // namespace vegetation_sim::fuzz
