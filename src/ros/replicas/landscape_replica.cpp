// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/replicas/landscape_replica.h"

#include <algorithm>
#include <map>
#include <utility>

namespace vegetation_sim {
namespace {

constexpr double LONGEST_EXTRAPOLATION = 0.25;  // [s] for which people go on as they went

ReplicaOptions delayed(ReplicaOptions options) {
  options.delayed = true;
  return options;
}

}  // namespace

LandscapeReplica::LandscapeReplica(ReplicaOptions options)
    : forest_(delayed(options)),
      meadow_(delayed(options)),
      canopy_(delayed(options), SubscribedCanopy::Forest::GIVEN),
      crowd_(delayed(options)) {}

void LandscapeReplica::subscribe(ros::NodeHandle handle) {
  forest_.subscribe(handle, {});
  meadow_.subscribe(handle, {"grass/layout", "", "grass/state"});  // in the wind of the forest
  canopy_.subscribe(handle, {});
  crowd_.subscribe(handle, "agents");
}

void LandscapeReplica::advance(Nanoseconds stamp) {
  forest_.advance(stamp);
  meadow_.advance(stamp);
  canopy_.advance(stamp);
  crowd_.advance(stamp);
  crowd_.forgetSilent(stamp);
}

void LandscapeReplica::forgetLater(Nanoseconds now) {
  forest_.forgetLater(now);
  meadow_.forgetLater(now);
  canopy_.forgetLater(now);
  crowd_.forgetLater(now);
}

std::size_t LandscapeReplica::waiting() const {
  return forest_.waiting() + meadow_.waiting() + canopy_.waiting() + crowd_.waiting();
}

std::uint64_t LandscapeReplica::lost() const {
  return forest_.lost() + meadow_.lost() + canopy_.lost() + crowd_.lost();
}

std::shared_ptr<const terrain::HeightMap> LandscapeReplica::ground() const {
  static const auto FLAT = std::make_shared<const terrain::HeightMap>();
  if (meadow_.ready()) return meadow_.terrain();
  return forest_.replica().ready() ? forest_.replica().terrainPtr() : FLAT;
}

void LandscapeReplica::update(const Vec3& centre, double radius, Nanoseconds stamp,
                              scan::Scene& scene, ThreadPool& threads) {
  const forest::ForestReplica& forest = forest_.replica();
  scene.ground = ground();
  if (forest.ready()) scene.trees.update(forest, centre, radius, stamp, threads);
  if (meadow_.ready()) {
    meadow_.prune(stamp);
    scene.grass.update(meadow_.layout(), meadow_.tread(), meadow_.terrain(), forest.wind(), centre,
                       radius, stamp);
    scene.grass.setColours(meadow_.colours().at(stamp));
  }
  if (canopy::Replica* plants = canopy_.replica()) {
    if (forest.ready()) canopy_.updateCrowns(forest_);
    scene.plants.update(plants->layout(), plants->layoutHash(), plants->foliageOfPlane(), centre,
                        radius, threads);
    scene.crowns.update(crownsOf(scene.trees, stamp), canopy_.layouts(), plants->foliageOfPlane(),
                        centre, threads);
  }
  scene.people.set(peopleAt(stamp));
}

// Returns the crowns of the trees around a sensor, which are the nearest first.
std::vector<scan::CrownSource> LandscapeReplica::crownsOf(const scan::Trees& trees,
                                                          Nanoseconds stamp) const {
  std::vector<scan::CrownSource> out;
  const std::vector<LeafedCrowns::Crown>& crowns = canopy_.crowns().crowns();
  std::multimap<std::uint32_t, std::size_t> by_tree;
  for (std::size_t i = 0; i < crowns.size(); ++i) by_tree.emplace(crowns[i].tree, i);
  for (const auto& tree : trees.all()) {
    const auto found = by_tree.equal_range(tree->id());
    for (auto each = found.first; each != found.second; ++each) {
      const std::size_t i = each->second;
      out.push_back({crowns[i].tree, &crowns[i].leaves, &crowns[i].rest, [this, i, stamp] {
                       return canopy_.crowns().wood(i, forest_.replica(), stamp);
                     }});
    }
  }
  return out;
}

// A sweep lies between two ticks of the crowd.
std::vector<scan::People::Person> LandscapeReplica::peopleAt(Nanoseconds stamp) const {
  const double since =
      std::clamp(secondsBetween(crowd_.stamp(), stamp), 0.0, LONGEST_EXTRAPOLATION);
  const auto terrain = ground();
  std::vector<scan::People::Person> out;
  for (const SubscribedCrowd::Person& person : crowd_.people()) {
    crowd::Walker walker = person.walker;
    walker.position = walker.position + since * walker.velocity;
    crowd::advanceGait(since * crowd::speedOf(walker), walker);
    out.push_back({walker.id, crowd::skeletonOf(walker, *terrain, crowd_.motions(),
                                                secondsBetween(0, stamp))});
  }
  return out;
}

std::string LandscapeReplica::why() const {
  std::string out;
  if (const forest::ForestReplica& forest = forest_.replica();
      forest.ready() && !forest.why().empty())
    out = "forest: " + forest.why();
  if (meadow_.ready() && !meadow_.why().empty())
    out += (out.empty() ? "" : "; ") + ("grass: " + meadow_.why());
  return out;
}

std::string LandscapeReplica::rivals() const {
  return forest_.rivals() + meadow_.rivals() + canopy_.rivals() + crowd_.rivals();
}

}  // namespace vegetation_sim
