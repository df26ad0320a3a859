// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/landscape/landscape_replica.h"

#include <map>
#include <utility>

namespace vegetation_sim {
namespace {

ReplicaOptions delayed(ReplicaOptions options) {
  options.delayed = true;
  return options;
}

}  // namespace

LandscapeReplica::LandscapeReplica(ReplicaOptions options)
    : forest_(delayed(options)),
      meadow_(delayed(options)),
      near_meadow_(delayed(options)),
      canopy_(delayed(options), SubscribedCanopy::Forest::GIVEN),
      crowd_(delayed(options)),
      near_crowd_(delayed(options)) {}

void LandscapeReplica::subscribe(ros::NodeHandle handle) {
  forest_.subscribe(handle, {});
  SubscribedMeadow::Topics topics;
  topics.wind.clear();  // that of the forest
  meadow_.subscribe(handle, topics);
  topics.state.clear();
  topics.near = "grass/near";
  near_meadow_.subscribe(handle, topics);
  canopy_.subscribe(handle, {});
  crowd_.subscribe(handle, "agents");
  near_crowd_.subscribe(handle, "agents/near");
}

void LandscapeReplica::advance(Nanoseconds stamp) {
  forest_.advance(stamp);
  meadow_.advance(stamp);
  near_meadow_.advance(stamp);
  canopy_.advance(stamp);
  crowd_.advance(stamp);
  near_crowd_.advance(stamp);
  crowd_.forgetSilent(stamp);
  near_crowd_.forgetSilent(stamp);
}

void LandscapeReplica::forgetLater(Nanoseconds now) {
  forest_.forgetLater(now);
  meadow_.forgetLater(now);
  near_meadow_.forgetLater(now);
  tracks_.reset();
  canopy_.forgetLater(now);
  crowd_.forgetLater(now);
  near_crowd_.forgetLater(now);
  people_.reset();
}

std::size_t LandscapeReplica::waiting() const {
  return forest_.waiting() + meadow_.waiting() + near_meadow_.waiting() + canopy_.waiting() +
         crowd_.waiting() + near_crowd_.waiting();
}

std::uint64_t LandscapeReplica::lost() const {
  return forest_.lost() + meadow_.lost() + near_meadow_.lost() + canopy_.lost() + crowd_.lost() +
         near_crowd_.lost();
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
    near_meadow_.prune(stamp);
    chooseTracks(centre, radius, stamp);
    scene.grass.update(meadow_.layout(), tracks().tread(), meadow_.terrain(), forest.wind(), centre,
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
  choosePeople(centre, radius, stamp);
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

void LandscapeReplica::chooseTracks(const Vec3& centre, double radius, Nanoseconds stamp) {
  tracks_.choose(near_meadow_.covers(centre, radius, stamp), near_meadow_.stamp(), meadow_.stamp(),
                 stamp);
  incomplete_ += !tracks_.isComplete();
  meadow_.listen(tracks_.needsWhole(stamp));
}

// Without a publisher of the people near sensors, as in recordings, all people are received.
void LandscapeReplica::choosePeople(const Vec3& centre, double radius, Nanoseconds stamp) {
  people_.choose(near_crowd_.covers(centre, radius, stamp), near_crowd_.stamp(), crowd_.stamp(),
                 stamp);
  incomplete_ += !people_.isComplete();
  crowd_.listen(people_.needsWhole(stamp));
}

// A sweep lies between two ticks of the crowd.
std::vector<scan::People::Person> LandscapeReplica::peopleAt(Nanoseconds stamp) const {
  const Nanoseconds seen = people_.isNear() ? near_crowd_.stamp() : crowd_.stamp();
  const auto terrain = ground();
  std::vector<scan::People::Person> out;
  for (const WalkerView& person : nearest()) {
    const crowd::Walker walker = walkOn(person.walker, secondsBetween(seen, stamp));
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
  if (meadow_.ready() && !tracks().why().empty())
    out += (out.empty() ? "" : "; ") + ("grass: " + tracks().why());
  return out;
}

std::string LandscapeReplica::rejectedLayout() const {
  const auto why = [](const char* topic, bool ready, const InputStatus& status) {
    return !ready && status.rejected ? topic + (": " + status.text) : std::string();
  };
  for (const std::string& text :
       {why("forest/layout", forest_.replica().ready(), forest_.layoutStatus()),
        why("grass/layout", meadow_.ready(), meadow_.layoutStatus()),
        why("canopy/layout", canopy_.replica() != nullptr, canopy_.layoutStatus())})
    if (!text.empty()) return text;
  return {};
}

std::string LandscapeReplica::rivals() const {
  return joinRivals({forest_.rivals(), meadow_.rivals(), near_meadow_.rivalsOfNear(),
                     canopy_.rivals(), crowd_.rivals(), near_crowd_.rivals()});
}

}  // namespace vegetation_sim
