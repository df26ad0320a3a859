// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/replicas/landscape_replica.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ros/conversions/crowd_conversions.h"
#include "ros/params/resources.h"
#include "ros/services/requests.h"
#include "vegetation_sim/ros/conversions/forest_conversions.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"
#include "vegetation_sim/ros/conversions/grass_conversions.h"
#include "vegetation_sim/ros/conversions/stamps.h"
#include "vegetation_sim/ros/conversions/wind_conversions.h"

namespace vegetation_sim {

LandscapeReplica::LandscapeReplica(std::string frame_id, Reject reject)
    : frame_id_(std::move(frame_id)), reject_(std::move(reject)) {}

void LandscapeReplica::listen(ros::NodeHandle handle) {
  subscribers_ = {handle.subscribe("wind", 10, &LandscapeReplica::onWind, this),
                  handle.subscribe("forest/layout", 1, &LandscapeReplica::onForestLayout, this),
                  handle.subscribe("forest/state", 100, &LandscapeReplica::onForestState, this),
                  handle.subscribe("grass/layout", 1, &LandscapeReplica::onGrassLayout, this),
                  handle.subscribe("grass/state", 100, &LandscapeReplica::onGrassState, this),
                  handle.subscribe("agents", 10, &LandscapeReplica::onPeople, this)};
}

void LandscapeReplica::guard(const char* what, const std::function<void()>& take) {
  try {
    take();
  } catch (const std::exception& error) {
    reject_(what, error.what());
  }
}

void LandscapeReplica::onWind(const WindField& message) {
  guard("wind", [&] {
    checkFrame(message.header.frame_id, frame_id_);
    wind_ = fromMsg(message);
    forest_.setWind(wind_);
  });
}

void LandscapeReplica::onForestLayout(const ForestLayout& message) {
  guard("forest/layout", [&] {
    checkFrame(message.header.frame_id, frame_id_);
    auto terrain = loadTerrain(message.terrain);
    forest_.setLayout(fromMsg(message), terrain);
    forest_ground_ = std::move(terrain);
  });
}

void LandscapeReplica::onForestState(const ForestState& message) {
  guard("forest/state", [&] {
    forest::StateUpdate update = fromMsg(message);
    const Nanoseconds stamp = update.stamp;
    forest_ahead_.add(stamp, std::move(update));
  });
}

void LandscapeReplica::onGrassLayout(const GrassLayout& message) {
  guard("grass/layout", [&] {
    checkFrame(message.header.frame_id, frame_id_);
    meadow_ = MeadowReplica(message);
  });
}

void LandscapeReplica::onGrassState(const GrassState& message) {
  guard("grass/state", [&] {
    grass::TreadUpdate update = fromMsg(message);
    const Nanoseconds stamp = update.stamp;
    treads_ahead_.add(stamp, std::move(update));
  });
}

void LandscapeReplica::onPeople(const AgentStates& message) {
  guard("agents", [&] {
    checkFrame(message.header.frame_id, frame_id_);
    check(message);
    std::vector<crowd::Walker> people;
    for (const AgentState& agent : message.agents) people.push_back(fromMsg(agent));
    people_ahead_.add(fromMsg(message.header.stamp), std::move(people));
  });
}

void LandscapeReplica::follow(Nanoseconds stamp) {
  forest_ahead_.take(stamp, [this](Nanoseconds, const forest::StateUpdate& update) {
    guard("forest/state", [&] { forest_.apply(update); });
  });
  treads_ahead_.take(stamp, [this](Nanoseconds, const grass::TreadUpdate& update) {
    if (meadow_.ready() && update.layout_hash == meadow_.hash)
      meadow_.replica.apply(update, *meadow_.tread);
  });
  people_ahead_.take(stamp,
                     [this](Nanoseconds published, const std::vector<crowd::Walker>& people) {
                       people_ = people;
                       people_stamp_ = published;
                     });
  if (secondsBetween(people_stamp_, stamp) > LONGEST_SILENCE) people_.clear();
}

// One of after the jump that has come already is kept.
void LandscapeReplica::forgetLater(Nanoseconds now) {
  if (forest_.ready() && forest_.stamp() > now) {
    forest::ForestReplica fresh;
    fresh.setLayout(forest_.layout(), forest_ground_);
    fresh.setWind(wind_);
    forest_ = std::move(fresh);
  }
  meadow_.forgetLater(now);
  if (people_stamp_ > now) people_.clear();
  forest_ahead_.forgetLater(now);
  treads_ahead_.forgetLater(now);
  people_ahead_.forgetLater(now);
}

std::size_t LandscapeReplica::waiting() const {
  return forest_ahead_.size() + treads_ahead_.size() + people_ahead_.size();
}

std::uint64_t LandscapeReplica::lost() const {
  return forest_ahead_.lost() + treads_ahead_.lost() + people_ahead_.lost();
}

std::shared_ptr<const terrain::HeightMap> LandscapeReplica::ground() const {
  static const auto FLAT = std::make_shared<const terrain::HeightMap>();
  return meadow_.ready() ? meadow_.terrain : forest_ground_ ? forest_ground_ : FLAT;
}

void LandscapeReplica::show(const Vec3& centre, double radius, Nanoseconds stamp,
                            scan::Scene& scene) {
  scene.ground = ground();
  if (forest_.ready()) scene.trees.update(forest_, centre, radius, stamp);
  if (meadow_.ready()) {
    meadow_.tread->prune(stamp);
    scene.grass.update(meadow_.layout, *meadow_.tread, meadow_.terrain, wind_, centre, radius,
                       stamp);
  }
  scene.people.set(peopleAt(stamp));
}

// A sweep is between two ticks of the crowd: since the one before, all go on as they went.
std::vector<scan::People::Person> LandscapeReplica::peopleAt(Nanoseconds stamp) const {
  const double since = std::clamp(secondsBetween(people_stamp_, stamp), 0.0, LONGEST_GUESS);
  const auto terrain = ground();
  std::vector<scan::People::Person> out;
  for (crowd::Walker walker : people_) {
    walker.position = walker.position + since * walker.velocity;
    crowd::advanceGait(since * crowd::speedOf(walker), walker);
    out.push_back({walker.id, crowd::skeletonOf(walker, *terrain)});
  }
  return out;
}

std::string LandscapeReplica::waitsFor() const {
  std::string out;
  if (forest_.ready() && !forest_.why().empty()) out = "forest: " + forest_.why();
  if (meadow_.ready() && !meadow_.replica.why().empty())
    out += (out.empty() ? "" : "; ") + ("grass: " + meadow_.replica.why());
  return out;
}

}  // namespace vegetation_sim
