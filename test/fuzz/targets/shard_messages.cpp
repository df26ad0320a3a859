// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// What the processes of shards send to each other.
#include <ros/names.h>

#include <set>

#include "crowd/agents/crowd_shard.h"
#include "fuzz/targets/decoding.h"
#include "fuzz/targets/target_lists.h"
#include "fuzz/targets/usage.h"
#include "nodes/crowd/shards/part_join.h"
#include "nodes/crowd/shards/waiting_borders.h"
#include "nodes/shard_requests/shard_registry.h"
#include "ros/conversions/crowd_conversions.h"
#include "scenes/crowd/crowd_scenes.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim::fuzz {
namespace {

// Borders of a crowd.

enum BorderPiece { BYTES, MESSAGE, TICK, BORDER_PIECES };
constexpr int MOST_TICKS = 6;  // of an input
constexpr Nanoseconds PERIOD = NANOSECONDS_PER_SECOND / 30;

/// Shard 0 of two, which hears the other one.
class BorderRig {
 public:
  BorderRig() {
    for (const double x : {2.0, 6.0}) {
      crowd::Spawn spawn;
      spawn.position = {x, 3.0};
      crowd_.spawn(spawn);
    }
    shard_.begin(crowd::CrowdShard::Start::RESET);
  }
  void hear(std::string bytes) { shard_.hear(1, crowd::readBorder(std::move(bytes))); }
  void receive(const CrowdBorder& message) {
    waiting_.beginTick(stamp_, stamp_ + PERIOD);
    waiting_.add(message);
    for (const CrowdBorder& border : waiting_.take())
      hear({border.border.begin(), border.border.end()});
  }
  void tick() {
    if (ticks_++ >= MOST_TICKS) return;
    stamp_ += PERIOD;
    shard_.spawnMissing({});
    shard_.beginTick();
    crowd_.advance(stamp_);
    crowd::readBorder(archiveBorder(shard_.endTick()));
    for (const crowd::Walker& walker : crowd_.walkers())
      requireFinite(Vec3(walker.position.x, walker.position.y, walker.heading), "walker");
  }
  /// Whatever other shards have sent, a checkpoint can be read.
  void checkState() {
    crowd::Crowd::readArchived(crowd_.archived());
    Archive written;
    shard_.archive(written);
    Archive read = Archive::reading(written.takeBytes());
    crowd::CrowdShard copy = shard_;
    copy.archive(read);
    read.finish();
  }

 private:
  crowd::Crowd crowd_{1, crowd::CrowdSettings(), {0.0, 20.0, 0.0, 20.0}, crowd::flatGround()};
  crowd::CrowdShard shard_{crowd_, {0, 2}};
  WaitingBorders waiting_{{0, 2}};
  Nanoseconds stamp_{START};
  int ticks_{0};
};

void runBorders(std::string_view input) {
  BorderRig rig;
  rig.tick();
  for (const Piece& piece : splitPieces(input)) {
    if (piece.kind % BORDER_PIECES == TICK) {
      rig.tick();
      continue;
    }
    try {
      if (piece.kind % BORDER_PIECES == BYTES) rig.hear(std::string(piece.bytes));
      if (CrowdBorder message;
          piece.kind % BORDER_PIECES == MESSAGE && decode(piece.bytes, message))
        rig.receive(message);
    } catch (const InvalidInput&) {
    }
  }
  rig.tick();
  try {
    rig.checkState();
  } catch (const InvalidInput& error) {
    throw BrokenPromise(std::string("a state that cannot be read: ") + error.what());
  }
}

std::vector<std::string> borderSeeds() {
  crowd::CrowdBorder border;
  border.stamp = START + PERIOD;
  border.begun = START;
  border.lists = true;
  border.heard[0] = START;
  for (std::uint32_t id = 7; id < 10; ++id) {
    crowd::Walker walker;
    walker.id = id;
    walker.position = {1.0 * id, 1.0};
    if (id == 7)
      border.near.push_back(walker);
    else
      border.handed.push_back({0, border.stamp, walker});
    border.ids.push_back(id);
  }
  const std::string bytes = archiveBorder(border);
  CrowdBorder message;
  message.header.stamp = toStamp(border.stamp);
  message.shard = 1;
  message.shards = 2;
  message.border.assign(bytes.begin(), bytes.end());
  message.previous_stamp = toStamp(START);
  border.stamp = START;
  const std::string before = archiveBorder(border);
  message.previous_border.assign(before.begin(), before.end());
  crowd::CrowdBorder reset = border;
  reset.stamp = START + 2 * PERIOD;
  reset.run = 1;
  reset.starts = true;
  const std::string tick = pieceOf(TICK, "");
  return {pieceOf(BYTES, bytes) + tick,
          pieceOf(BYTES, before) + tick + pieceOf(BYTES, bytes) + tick + tick,
          pieceOf(BYTES, bytes) + pieceOf(BYTES, archiveBorder(reset)) + tick,
          pieceOf(MESSAGE, encode(message)) + tick};
}

// Announcements.

ShardNode announcement(std::uint32_t shard) {
  ShardNode out;
  out.header.stamp = out.started = toStamp(START);
  out.header.frame_id = "map";
  out.shard = shard;
  out.shards = 3;
  out.node = "/shard_" + std::to_string(shard);
  out.open = true;
  out.messages = "1a 2b";
  out.layout_hash = out.terrain_hash = 7;
  out.rate = 30;
  return out;
}

/// Asks as ShardRequests does: roscpp throws for names that are none.
void useNodes(const ShardRegistry& registry) {
  for (std::uint32_t shard = 0; shard < 3; ++shard)
    if (registry.isOpen(shard)) ros::names::resolve(registry.find(shard)->node + "/owned/grab");
  registry.describeMissing();
  registry.describeSilent(ShardRegistry::SteadyTime(std::chrono::hours(1)));
}

void runShardNodes(std::string_view input) {
  const ShardNode own = announcement(0);
  ShardRegistry registry(own);
  for (const Piece& piece : splitPieces(input)) try {
      ShardNode message;
      if (!decode(piece.bytes, message)) continue;
      registry.isEarlier(message);
      // A forged announcement has these numbers of a true one, which no fuzzer guesses.
      message.layout_hash = message.terrain_hash = own.layout_hash;
      registry.hear(message, message.header.frame_id, ShardRegistry::SteadyTime());
      registry.checkSender(message.shard, "/manager");
    } catch (const InvalidInput& error) {
      if (std::string(error.what()).size() > LONGEST_ERROR + 3)
        throw BrokenPromise("an error is too long");
    }
  useNodes(registry);
}

std::vector<std::string> shardNodeSeeds() {
  const std::string first = pieceOf(0, encode(announcement(1)));
  ShardNode bad = announcement(2);
  bad.node = "/bad name";
  return {first, first + pieceOf(0, encode(announcement(2))), first + pieceOf(0, encode(bad))};
}

// The people of all shards of a crowd.

enum PartPiece { PART, TIME, JUMP, PART_PIECES };

void checkJoined(const JoinedPeople& joined) {
  std::set<std::uint32_t> ids;
  for (const AgentState& agent : joined.agents) {
    if (!ids.insert(agent.id).second) throw BrokenPromise("a person is there twice");
    const crowd::Walker walker = fromMsg(agent);
    requireFinite(Vec3(walker.position.x, walker.position.y, walker.heading), "person");
  }
}

void runCrowdParts(std::string_view input) {
  PartJoin join(3, 0);
  join.setTime(START);
  for (const Piece& piece : splitPieces(input)) try {
      if (piece.kind % PART_PIECES == JUMP) join.jumpBack();
      if (piece.kind % PART_PIECES == TIME)
        join.setTime(START + Numbers(piece.bytes).byte() * PERIOD);
      if (CrowdPart part; piece.kind % PART_PIECES == PART && decode(piece.bytes, part)) {
        check(part, 3);
        join.add(part);
      }
      while (const std::optional<JoinedPeople> people = join.take()) checkJoined(*people);
    } catch (const InvalidInput&) {
    }
  join.setTime(START + 1000 * NANOSECONDS_PER_SECOND);
  while (const std::optional<JoinedPeople> people = join.take()) checkJoined(*people);
}

std::vector<std::string> crowdPartSeeds() {
  std::vector<std::string> out;
  std::string all;
  for (std::uint32_t shard = 1; shard < 3; ++shard) {
    CrowdPart part;
    part.shard = shard;
    part.heard = {0, 3 - shard};
    part.people.header.stamp = toStamp(START + shard * PERIOD);
    for (std::uint32_t id = 0; id < 2; ++id) {
      crowd::Walker walker;
      walker.id = id + shard;
      part.people.agents.push_back(toMsg(walker, terrain::HeightMap()));
    }
    part.waiting = part.people.agents;
    part.starts = shard == 2;
    out.push_back(pieceOf(PART, encode(part)));
    all += out.back() + pieceOf(TIME, "\x02");
  }
  out.push_back(all);
  out.push_back(all + pieceOf(JUMP, "") + all);
  return out;
}

}  // namespace

std::vector<Target> shardMessageTargets() {
  return {{"borders", "CrowdBorder; ticks of a shard, and its state", runBorders, borderSeeds},
          {"shard_nodes", "ShardNode; names of services", runShardNodes, shardNodeSeeds},
          {"crowd_parts", "CrowdPart; the people of all shards", runCrowdParts, crowdPartSeeds}};
}

}  // namespace vegetation_sim::fuzz
