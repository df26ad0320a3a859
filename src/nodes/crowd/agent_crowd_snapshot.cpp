// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Writes and reads the parts of a snapshot that are specific to the node. SavedNode keeps the
// events that wait.
#include "core/archive/archive.h"
#include "nodes/crowd/agent_crowd.h"
#include "vegetation_sim/core/math/hash.h"

namespace vegetation_sim {
namespace {

constexpr std::size_t LARGEST_INPUT = 1u << 30;
constexpr std::size_t TRODDEN_BYTES = 23;

/// A message in force with its hash. Without bytes there is none.
template <class Message>
void archiveInput(Archive& a, const char* name, const HashedCache<Message>& known,
                  std::uint64_t& hash, std::string& bytes) {
  if (const Message* found = a.reads() ? nullptr : known.find(hash)) bytes = bytesOf(*found);
  a.key(hash);
  a.text(name, bytes, LARGEST_INPUT);
}

}  // namespace

void AgentCrowd::archive(Archive& a, Walked& walked) {
  a.map(
      "trodden", walked, crowd::MOST_WALKERS, TRODDEN_BYTES,
      [&a](std::uint32_t& id) { a.integer("walker", id); },
      [&a](std::uint32_t, Trodden& last) {
        a.number("trodden x", last.place.x, {-1.1e5, 1.1e5});
        a.number("trodden y", last.place.y, {-1.1e5, 1.1e5});
        a.flag("foot stood", last.stood[0]);
        a.flag("foot stood", last.stood[1]);
        a.flag("seen", last.seen);
      });
}

void AgentCrowd::archive(Archive& a, SentBorder& border) {
  a.stamp("border stamp", border.stamp);
  a.text("border", border.bytes, LARGEST_SNAPSHOT);
}

std::uint64_t AgentCrowd::sceneHash() const {
  Hash hash;
  const std::uint64_t whole = scenarioHash();
  if (!options_.shard) return whole;
  for (const std::uint64_t part :
       {whole, std::uint64_t{options_.shard->index}, std::uint64_t{options_.shard->count}})
    hash.add(part);
  return hash.value();
}

std::uint64_t AgentCrowd::scenarioHash() const {
  const CrowdScene& scene = options_.scene;
  Hash hash;
  hash.add(scene.seed);
  hash.add(scene.terrain->hash());
  FieldHasher fields(hash);
  crowd::Area area = scene.crowd.area;
  describe(fields, area);
  for (const crowd::Wall& wall : scene.crowd.walls)
    for (const double value : {wall.from.x, wall.from.y, wall.to.x, wall.to.y, wall.thickness})
      hash.add(value);
  for (const int value : {static_cast<int>(options_.trunks), options_.most_trunks})
    hash.add(static_cast<std::uint64_t>(value));
  return hash.value();
}

std::uint64_t AgentCrowd::peopleHash() const {
  Hash hash;
  hash.add(scenarioHash());
  FieldHasher fields(hash);
  for (crowd::Spawn spawn : options_.scene.crowd.spawns) {
    describe(fields, spawn);
    hash.add(std::uint64_t{spawn.wanders} | std::uint64_t{spawn.has_goal} << 1);
    hash.add(spawn.goal.x);
    hash.add(spawn.goal.y);
  }
  return hash.value();
}

void AgentCrowd::writeState(Archive& a) const {
  std::string state = crowd_.archived(), layout, cover;
  std::uint64_t trunks_hash = trunks_hash_, cover_hash = cover_hash_;
  a.text("crowd", state, LARGEST_SNAPSHOT);
  archiveInput(a, "forest layout", layouts_, trunks_hash, layout);
  archiveInput(a, "cover", covers_, cover_hash, cover);
  Walked walked = trodden_;
  archive(a, walked);
  CrowdRobots::Seen robots = robots_.seen();
  CrowdRobots::archive(a, robots);
  if (!shard_) return;
  crowd::CrowdShard shard = *shard_;
  shard.archive(a);
  for (SentBorder border : {border_, previous_border_}) archive(a, border);
}

CheckedState AgentCrowd::readState(Archive& a) {
  std::string state, layout, cover;
  std::uint64_t trunks_hash = 0, cover_hash = 0;
  a.text("crowd", state, LARGEST_SNAPSHOT);
  archiveInput(a, "forest layout", layouts_, trunks_hash, layout);
  archiveInput(a, "cover", covers_, cover_hash, cover);
  Walked walked;
  archive(a, walked);
  CrowdRobots::Seen robots;
  CrowdRobots::archive(a, robots);
  std::optional<crowd::CrowdShard> shard = shard_;
  SentBorder border, previous_border;
  if (shard) {
    shard->archive(a);
    // A loaded state is of the present run; one of a checkpoint, of its own.
    if (clock_.hasBegun()) shard->setRun(shard_->run());
    archive(a, border);
    archive(a, previous_border);
  }
  const crowd::CrowdSnapshot read = crowd::Crowd::readArchived(std::move(state), a.shift());
  std::optional<ForestLayout> trees;
  if (!layout.empty()) trees = messageOf<ForestLayout>(layout);
  std::optional<nav_msgs::OccupancyGrid> grass;
  if (!cover.empty()) grass = messageOf<nav_msgs::OccupancyGrid>(cover);
  const Surroundings around = surroundingsOf(trees ? &*trees : nullptr, grass ? &*grass : nullptr);
  return {read.hash(), [=] {
            if (trees) layouts_.keep(trunks_hash, *trees);
            if (grass) covers_.keep(cover_hash, *grass);
            trunks_hash_ = trees ? trunks_hash : 0;
            cover_hash_ = grass ? cover_hash : 0;
            surround(around);
            crowd_.restore(read);
            trodden_ = walked;
            robots_.restore(robots);
            shard_ = shard;
            border_ = border;
            previous_border_ = previous_border;
            publishBorder();
            options_.tuning = read.settings;
            begun_ = true;
            cover_wait_.onLoaded(read.stamp);
            updateNextId();
            queueNewerInputs();
            // Subscribers that take people of the tick before need them.
            if (!isPart()) publishAgents(read.stamp);
          }};
}

// Queues the layout and the cover that other nodes publish now, so that they stay in force.
void AgentCrowd::queueNewerInputs() {
  CrowdEvent event;
  event.kind = CrowdEvent::TRUNKS;
  event.input_hash = heard_layout_;
  if (heard_layout_ != 0 && heard_layout_ != trunks_hash_) inputs_.add(event);
  if (awaitsMeadow()) {  // the meadow has loaded the state that fits this cover
    heard_cover_ = 0;
    return;
  }
  event.kind = CrowdEvent::COVER;
  event.input_hash = heard_cover_;
  if (heard_cover_ != 0 && heard_cover_ != cover_hash_) inputs_.add(event);
}

// A map of the last tick waits in the queue, which is saved.
void AgentCrowd::awaitInputsToSave() {
  if (awaitsMeadow() && clock_.hasBegun())
    awaitInputs(options_.frame_wait, [this] { return hasCoverOf(clock_.stamp()); });
}

std::string AgentCrowd::inputOf(const CrowdEvent& event) const {
  if (event.kind == CrowdEvent::TRUNKS)
    if (const ForestLayout* found = layouts_.find(event.input_hash)) return bytesOf(*found);
  if (event.kind == CrowdEvent::COVER)
    if (const auto* found = covers_.find(event.input_hash)) return bytesOf(*found);
  if (event.kind == BORDER)
    if (const CrowdBorder* found = borders_.find(event.input_hash)) return bytesOf(*found);
  return {};
}

std::function<void()> AgentCrowd::readInput(CrowdEvent& event, const std::string& bytes,
                                            Nanoseconds /*shift*/) {
  const std::uint64_t hash = event.input_hash;
  if (event.kind == CrowdEvent::TRUNKS)
    return [this, hash, layout = messageOf<ForestLayout>(bytes)] { layouts_.keep(hash, layout); };
  if (event.kind == CrowdEvent::COVER)
    return [this, hash, cover = messageOf<nav_msgs::OccupancyGrid>(bytes)] {
      covers_.keep(hash, cover);
    };
  if (event.kind == BORDER)
    return [this, hash, border = messageOf<CrowdBorder>(bytes)] { borders_.keep(hash, border); };
  return [] {};
}

}  // namespace vegetation_sim
