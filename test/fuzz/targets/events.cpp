// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <vegetation_sim/CanopyEvent.h>
#include <vegetation_sim/CrowdEvent.h>
#include <vegetation_sim/GrassEvent.h>

#include <cmath>

#include "core/config/field_values.h"
#include "crowd/agents/crowd.h"
#include "forest/forest.h"
#include "fuzz/targets/decoding.h"
#include "fuzz/targets/target_lists.h"
#include "fuzz/targets/two_bushes.h"
#include "fuzz/targets/usage.h"
#include "grass/tread_simulation.h"
#include "nodes/canopy/canopy_options.h"
#include "nodes/crowd/crowd_events.h"
#include "nodes/forest/forest_inputs.h"
#include "nodes/grass/grass_events.h"
#include "ros/conversions/crowd_conversions.h"
#include "ros/conversions/grab_conversions.h"
#include "scenes/crowd/crowd_scenes.h"
#include "scenes/forest/forest_fixture.h"
#include "vegetation_sim/canopy/canopy.h"
#include "vegetation_sim/ros/conversions/canopy_conversions.h"
#include "vegetation_sim/ros/conversions/grass_conversions.h"

namespace vegetation_sim::fuzz {
namespace {

/// Pieces of all targets of this file: an event, or a number of ticks.
enum PieceKind { EVENT, TICKS, KINDS };
constexpr int MOST_TICKS = 8;  // of an input

/// Applies the events of an input to a simulation and advances it by its ticks. `Rig` has apply(),
/// which may throw InvalidInput, and advance().
template <class Event, class Rig>
void play(std::string_view input, Rig& rig) {
  int ticks = 0;
  Nanoseconds stamp = START;
  const auto advance = [&](int tenths) {
    stamp += (1 + tenths) * NANOSECONDS_PER_SECOND / 60;
    rig.advance(stamp);
    ++ticks;
  };
  advance(0);
  for (const Piece& piece : splitPieces(input)) {
    if (piece.kind % KINDS == TICKS) {
      if (ticks < MOST_TICKS) advance(Numbers(piece.bytes).byte());
      continue;
    }
    Event event;
    if (!decode(piece.bytes, event)) continue;
    event.header.stamp = toStamp(stamp);
    try {
      rig.apply(event, stamp);
    } catch (const InvalidInput&) {
    }
  }
  advance(0);
}

template <class Event>
std::string eventPiece(Event event, std::uint8_t kind) {
  event.kind = kind;
  return pieceOf(EVENT, encode(event)) + pieceOf(TICKS, std::string(1, '\0'));
}

template <class Event, class Tuning>
std::string settingsPiece(const Tuning& tuning) {
  const NamedValues named = namedValues(tuning);
  Event event;
  event.names = named.names;
  event.values = named.values;
  return eventPiece(event, Event::SETTINGS);
}

class ForestRig {
 public:
  ForestRig() : forest_(twoBushes(), forest::flatTerrain(), {}) {}

  void advance(Nanoseconds stamp) {
    forest_.advance(stamp);
    for (std::uint32_t tree : forest_.physicalTrees())
      for (const forest::PromotedBranch& branch : forest_.promoted(tree).branches)
        requireFinite(Vec3(branch.q.first, branch.q.second, branch.rate.first),
                      "angle of a branch");
    for (const forest::Reaction& reaction : forest_.reactions())
      requireFinite(reaction.force, "force on a body");
    forest_.update(true);
  }
  void apply(const ForestEvent& event, Nanoseconds stamp) {
    ForestInput input = eventFromMsg(event);
    input.stamp = stamp;
    switch (input.kind) {
      case ForestInput::SENSOR:
        input.sensor.stamp = stamp;
        forest_.setSensor(input.sensor);
        break;
      case ForestInput::SETTINGS:
        forest_.setSettings(tuningOf(input).settings);
        break;
      case ForestInput::RESET:
        forest_.reset();
        break;
      default:
        applyInteraction(input, forest_);
    }
  }

 private:
  forest::Forest forest_;
};

void runForestEvents(std::string_view input) {
  ForestRig rig;
  play<ForestEvent>(input, rig);
}

std::vector<std::string> forestSeeds() {
  ForestEvent event;
  event.grab.id = 1;
  event.grab.along = 0.1;
  event.grab.target.x = 0.2;
  event.grab.target.z = 1.0;
  event.grab.stiffness = 500.0;
  event.grab.damping = 10.0;
  event.grab.force_limit = 50.0;
  event.grab.holder.orientation.w = event.grab.direction.z = 1.0;
  event.grab.jaw_length = 0.05;
  event.force.along = 0.1;
  event.force.force.x = 5.0;
  event.force.duration = 0.5;
  event.cut.branch = 1;
  event.sensor.id = "lidar";
  event.sensor.range = 10.0;
  event.sensor.tolerance = 0.01;
  event.body.id = "arm";
  event.body.size.x = event.body.size.y = event.body.size.z = 0.1;
  event.body.offset.orientation.w = event.body.pose.orientation.w = 1.0;
  event.body.pose.position.z = 0.5;
  event.body.stamp = toStamp(START);
  std::string all = settingsPiece<ForestEvent>(ForestTuning());
  std::vector<std::string> out{all};
  for (const std::uint8_t kind :
       {ForestEvent::SENSOR, ForestEvent::GRAB, ForestEvent::MOVE, ForestEvent::RENEW,
        ForestEvent::FORCE, ForestEvent::BODY, ForestEvent::REMOVE_BODY, ForestEvent::RELEASE,
        ForestEvent::CUT, ForestEvent::RESET}) {
    out.push_back(eventPiece(event, kind));
    all += out.back();
  }
  for (const std::uint8_t shape : {ForestBody::CAPSULE, ForestBody::BOX}) {
    event.body.shape = shape;
    out.push_back(eventPiece(event, ForestEvent::BODY) + eventPiece(event, ForestEvent::GRAB));
  }
  out.push_back(all);
  return out;
}

class GrassRig {
 public:
  GrassRig() : map_(layout().map->law(), {}), grass_(layout(), ground(), {}, map_) {}

  void advance(Nanoseconds stamp) {
    grass_.advance(stamp);
    for (const grass::Drag& drag : grass_.drags()) requireFinite(drag.force, "drag of grass");
    if (!(grass_.resistanceAt({1.0, 1.0}, stamp) >= 0.0))
      throw BrokenPromise("the resistance of grass is below 0");
    if (!std::isfinite(grass::averageColour(0.5, colours_.at(stamp), 1.0, 1.0)))
      throw BrokenPromise("a colour is not finite");
    grass_.update(true);
  }
  void apply(const GrassEvent& event, Nanoseconds stamp) {
    switch (event.kind) {
      case GrassEvent::SETTINGS: {
        const auto tuning = fromNamedValues<GrassTuning>({event.names, event.values});
        check(tuning);
        tuning_ = tuning;
        grass_.setDrag(tuning.drag);
        grass_.setTreadLaw(tuning.tread);
        break;
      }
      case GrassEvent::RESET:
        grass_.reset();
        break;
      case GrassEvent::COLOURS:
        colours_ = masksOf(event.colours, stamp);
        break;
      default:
        applyToGrass(event, tuning_, grass_);
    }
  }

 private:
  static grass::Layout layout() {
    grass::MapInput input;
    input.law.columns = input.law.rows = 4;
    grass::Layout out;
    out.map = std::make_shared<const grass::FeatureMap>(input);
    return out;
  }
  static std::shared_ptr<const terrain::HeightMap> ground() {
    return std::make_shared<const terrain::HeightMap>();
  }
  GrassTuning tuning_;
  grass::ColourMasks colours_;
  grass::TreadMap map_;
  grass::TreadSimulation grass_;
};

void runGrassEvents(std::string_view input) {
  GrassRig rig;
  play<GrassEvent>(input, rig);
}

std::vector<std::string> grassSeeds() {
  GrassEvent event;
  event.tread.source = "boot";
  event.tread.position.x = event.tread.position.y = 1.0;
  event.tread.body_frame = "boot_link";
  event.centre.x = event.centre.y = event.radius = 1.0;
  std::vector<std::string> out{settingsPiece<GrassEvent>(GrassTuning())};
  for (const std::uint8_t action :
       {TreadEvent::MOVE, TreadEvent::PLACE, TreadEvent::LIFT, TreadEvent::STROKE}) {
    event.tread.action = action;
    out.push_back(eventPiece(event, GrassEvent::TREAD));
    event.tread.position.x += 0.5;
    out.back() += eventPiece(event, GrassEvent::TREAD);
  }
  event.cut.height = 0.05;
  event.cut.outline.resize(4);
  event.cut.outline[1].x = event.cut.outline[2].x = 2.0;
  event.cut.outline[2].y = event.cut.outline[3].y = 2.0;
  out.push_back(eventPiece(event, GrassEvent::CUT));
  event.cut.swath = event.cut.outline;
  event.cut.outline.resize(1);
  event.cut.radius = 0.5;
  out.push_back(out.back() + eventPiece(event, GrassEvent::CUT));
  event.colours.resize(2);
  event.colours[0].radius = event.colours[0].weight = event.colours[1].radius = 1.0;
  event.colours[1].velocity_x = -2.0;
  for (const std::uint8_t kind : {GrassEvent::COLOURS, GrassEvent::CLEAR, GrassEvent::RESET})
    out.push_back(out.back() + eventPiece(event, kind));
  return out;
}

class CrowdRig {
 public:
  CrowdRig() : crowd_(1, {}, {-5.0, 5.0, -5.0, 5.0}, crowd::flatGround()) {
    crowd_.setObstacles(crowd::room(-5.0, -5.0, 5.0, 5.0));
    crowd::spawnAt(crowd_, {-2.0, 0.0}, {2.0, 0.0});
    crowd::spawnAt(crowd_, {2.0, 0.0}, {-2.0, 0.0});
  }

  void advance(Nanoseconds stamp) {
    crowd_.advance(stamp);
    for (const crowd::Walker& walker : crowd_.walkers())
      requireFinite(Vec3(walker.position.x, walker.position.y, walker.heading), "walker");
  }
  void apply(const CrowdEvent& event, Nanoseconds) {
    switch (event.kind) {
      case CrowdEvent::SETTINGS:
        crowd_.setSettings(fromNamedValues<crowd::CrowdSettings>({event.names, event.values}));
        break;
      case CrowdEvent::RESET:
        crowd_.clear();
        break;
      default:
        if (event.kind != CrowdEvent::SPAWN || crowd_.walkers().size() < MOST_WALKERS)
          applyToCrowd(event, crowd_);
    }
  }

 private:
  static constexpr std::size_t MOST_WALKERS = 20;
  crowd::Crowd crowd_;
};

void runCrowdEvents(std::string_view input) {
  CrowdRig rig;
  play<CrowdEvent>(input, rig);
}

std::vector<std::string> crowdSeeds() {
  CrowdEvent event;
  event.robot.id = "base";
  event.robot.outline.resize(3);
  event.robot.outline[1].x = event.robot.outline[2].y = 0.5;
  event.robot.position.x = 1.0;
  event.spawn.has_goal = true;
  event.spawn.goal.y = 3.0;
  std::vector<std::string> out{settingsPiece<CrowdEvent>(crowd::CrowdSettings())};
  std::string all;
  for (const std::uint8_t kind : {CrowdEvent::GOAL, CrowdEvent::ROBOT, CrowdEvent::REMOVE_ROBOT,
                                  CrowdEvent::REMOVE, CrowdEvent::SPAWN, CrowdEvent::RESET}) {
    out.push_back(eventPiece(event, kind));
    all += out.back();
  }
  out.push_back(all);
  return out;
}

class CanopyRig {
 public:
  CanopyRig() : canopy_(layout()) { canopy_.setWind(wind()); }

  void advance(Nanoseconds stamp) {
    canopy_.advance(stamp);
    const canopy::Foliage& foliage = canopy_.foliage();
    if (foliage.layers() > 0) requireFinite(foliage.sheet(0), "motion of a layer");
    requireFinite(foliage.bend(Vec3(0.1, 0.2, 1.0), 0), "bent stem");
    for (const canopy::PushForce& force : canopy_.pushForces()) {
      requireFinite(force.force, "force on a body");
      requireFinite(force.torque, "torque on a body");
    }
  }
  void apply(const CanopyEvent& event, Nanoseconds) {
    switch (event.kind) {
      case CanopyEvent::VIEWER:
        canopy_.setViewer(event.gone ? std::nullopt
                                     : std::optional<canopy::CutView>(eyeFromMsg(event.eye)));
        break;
      case CanopyEvent::SETTINGS:
        canopy_.setMotion(withTuning(canopy_.layout().motion,
                                     fromNamedValues<CanopyTuning>({event.names, event.values})));
        break;
      case CanopyEvent::BODY:
        canopy_.setBody(fromMsg(event.body));
        break;
      case CanopyEvent::REMOVE_BODY:
        canopy_.removeBody(event.body.id);
        break;
      case CanopyEvent::CUT:
        for (const canopy::CutPiece& piece : canopy_.cut(event.cut_plants, event.cut_height))
          if (!(piece.length > 0.0)) throw BrokenPromise("a piece of a plant has no length");
        break;
      default:
        canopy_.reset();
    }
  }

 private:
  static canopy::Layout layout() {
    canopy::Layout out;
    out.motion.fluid.cells = 16;
    out.kinds.resize(1);
    out.kinds[0].leaves = 20;
    out.plants.resize(1);
    return out;
  }
  static wind::Field wind() {
    wind::Primitive breeze = forest::makeBreeze(1, Vec3(4.0, 2.0, 0.0));
    breeze.epoch = START;
    return wind::Field({breeze}, 3);
  }
  canopy::Canopy canopy_;
};

void runCanopyEvents(std::string_view input) {
  CanopyRig rig;
  play<CanopyEvent>(input, rig);
}

// A box drives through the shrub.
std::string pushing() {
  CanopyEvent event;
  event.body.id = event.body.frame = "hull";
  event.body.shape = ForestBody::BOX;
  event.body.size.x = event.body.size.y = event.body.size.z = 0.5;
  event.body.pose.orientation.w = event.body.offset.orientation.w = 1.0;
  event.body.pose.position.z = 0.5;
  event.body.twist.linear.x = 1.0;
  std::string out;
  for (int i = 0; i < 6; ++i) {
    event.body.pose.position.x = 0.3 * i - 1.4;
    event.body.stamp = toStamp(START + i * NANOSECONDS_PER_SECOND / 60);
    out += eventPiece(event, CanopyEvent::BODY);
  }
  return out + eventPiece(event, CanopyEvent::REMOVE_BODY);
}

std::vector<std::string> canopySeeds() {
  CanopyEvent event;
  event.eye.orientation.w = 1.0;
  event.eye.position.x = -5.0;
  event.cut_plants = {0};
  event.cut_height = 0.4;
  event.cut_lengths = {1.2};
  const std::string cut = eventPiece(event, CanopyEvent::CUT);
  return {settingsPiece<CanopyEvent>(CanopyTuning()),
          eventPiece(event, CanopyEvent::VIEWER),
          eventPiece(event, CanopyEvent::RESET),
          pushing(),
          cut,
          cut + pushing() + eventPiece(event, CanopyEvent::RESET) + cut};
}

}  // namespace

std::vector<Target> eventTargets() {
  return {{"forest_events", "ForestEvent; a forest of two trees", runForestEvents, forestSeeds},
          {"grass_events", "GrassEvent; a meadow", runGrassEvents, grassSeeds},
          {"crowd_events", "CrowdEvent; two people in a room", runCrowdEvents, crowdSeeds},
          {"canopy_events", "CanopyEvent; a shrub in the wind", runCanopyEvents, canopySeeds}};
}

}  // namespace vegetation_sim::fuzz
