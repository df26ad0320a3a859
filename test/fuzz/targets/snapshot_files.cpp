// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Snapshots and journals of nodes.
#include <memory>

#include "core/archive/snapshot_file.h"
#include "crowd/agents/crowd.h"
#include "forest/forest.h"
#include "fuzz/targets/target_lists.h"
#include "fuzz/targets/usage.h"
#include "grass/tread_simulation.h"
#include "nodes/snapshots/event_journal.h"
#include "scenes/crowd/crowd_scenes.h"
#include "scenes/forest/forest_fixture.h"
#include "vegetation_sim/canopy/canopy.h"
#include "vegetation_sim/core/math/hash.h"
#include "wind/schedule/primitive_schedule.h"

namespace vegetation_sim::fuzz {
namespace {

constexpr Nanoseconds SHIFT = 5 * NANOSECONDS_PER_SECOND;

std::string sumOf(std::string_view bytes) {
  Hash hash;
  hash.add(std::string(bytes));
  std::uint64_t sum = hash.value();
  Archive out;
  out.key(sum);
  return out.takeBytes();
}

// Snapshots: files, and the states of the simulations in them.

enum SnapshotPiece { FILE_BYTES, FOREST, GRASS, CROWD, CANOPY, WIND, SNAPSHOT_PIECES };

forest::Forest& smallForest() {
  static forest::Forest forest = [] {
    forest::Layout layout;
    layout.species.resize(1);
    layout.species[0].name = "bush";
    layout.species[0].height = 1.5;
    layout.trees.resize(2);
    layout.trees[1].position = Vec3(2.0, 0.0, 0.0);
    forest::Forest out(layout, forest::flatTerrain(), {});
    forest::Grab grab;
    grab.id = 1;
    grab.point = {0, 0, 0.1};
    grab.target = Vec3(0.3, 0.2, 1.0);
    out.addGrab(grab);
    for (int i = 0; i < 3; ++i) out.advance(START + i * NANOSECONDS_PER_SECOND / 60);
    return out;
  }();
  return forest;
}

/// A meadow with a track.
class Meadow {
 public:
  Meadow() {
    grass::TreadInput input;
    input.source = "boot";
    for (int i = 0; i < 3; ++i) {
      const Nanoseconds stamp = START + i * NANOSECONDS_PER_SECOND / 10;
      input.position = Vec3(1.0 + 0.2 * i, 1.0, 0.0);
      grass.apply(input, stamp);
      grass.advance(stamp);
    }
  }
  grass::Layout layout = [] {
    grass::MapInput input;
    input.law.columns = input.law.rows = 4;
    grass::Layout out;
    out.map = std::make_shared<const grass::FeatureMap>(input);
    return out;
  }();
  grass::TreadMap map{layout.map->law(), {}};
  grass::TreadSimulation grass{layout, std::make_shared<const terrain::HeightMap>(), {}, map};
};

Meadow& meadow() {
  static Meadow out;
  return out;
}

crowd::Crowd makeCrowd() {
  crowd::Crowd out(1, {}, {-5.0, 5.0, -5.0, 5.0}, crowd::flatGround());
  crowd::spawnAt(out, {-2.0, 0.0}, {2.0, 0.0});
  crowd::spawnAt(out, {2.0, 0.0}, {-2.0, 0.0});
  crowd::Robot robot;
  robot.id = "cart";
  out.setRobot(robot);
  out.advance(START);
  return out;
}

canopy::Canopy& shrub() {
  static const std::unique_ptr<canopy::Canopy> CANOPY = [] {
    canopy::Layout layout;
    layout.motion.fluid.cells = 16;
    layout.kinds.resize(1);
    layout.kinds[0].leaves = 20;
    layout.plants.resize(1);
    auto out = std::make_unique<canopy::Canopy>(layout);
    out->setWind(wind::Field({forest::makeBreeze(1, Vec3(4.0, 2.0, 0.0))}, 3));
    out->advance(START);
    return out;
  }();
  return *CANOPY;
}

wind::PrimitiveSchedule schedule() {
  wind::PrimitiveSchedule out;
  out.set(forest::makeBreeze(1, Vec3(4.0, 2.0, 0.0)), START);
  return out;
}

std::string archivedWind() {
  wind::PrimitiveSchedule written = schedule();
  Archive a;
  written.archive(a);
  return a.takeBytes();
}

void readFile(std::string_view piece) {
  std::string bytes(piece);
  const std::size_t sum = sizeof(std::uint64_t);
  if (bytes.size() > sum)
    bytes.replace(bytes.size() - sum, sum, sumOf(piece.substr(0, bytes.size() - sum)));
  decodeSnapshot("file", bytes, "agent_crowd");
}

/// The state goes on after a load.
void readCrowd(const std::string& bytes) {
  crowd::Crowd crowd = makeCrowd();
  const crowd::CrowdSnapshot state = crowd::Crowd::readArchived(bytes, SHIFT);
  if (state.walkers.size() > 20) return;
  crowd.restore(state);
  crowd.advance(state.stamp + NANOSECONDS_PER_SECOND / 30);
  crowd::Crowd::readArchived(crowd.archived());
}

void readState(const Piece& piece) {
  const std::string bytes(piece.bytes);
  switch (piece.kind % SNAPSHOT_PIECES) {
    case FILE_BYTES:
      return readFile(piece.bytes);
    case FOREST:
      return static_cast<void>(smallForest().readArchived(bytes, SHIFT));
    case GRASS:
      return static_cast<void>(meadow().grass.readArchived(bytes, SHIFT).hash());
    case CROWD:
      return readCrowd(bytes);
    case CANOPY:
      return static_cast<void>(shrub().readArchived(bytes, SHIFT));
    default: {
      Archive a = Archive::reading(bytes, SHIFT);
      wind::PrimitiveSchedule read;
      read.archive(a);
      a.finish();
      requireFinite(read.field().at(START).velocity(Vec3(1.0, 2.0, 3.0)), "wind");
    }
  }
}

void runSnapshots(std::string_view input) {
  for (const Piece& piece : splitPieces(input)) try {
      readState(piece);
    } catch (const InvalidInput&) {
    }
}

std::vector<std::string> snapshotSeeds() {
  SnapshotFile file;
  file.header = {"agent_crowd", 7, START, 8};
  file.payload = makeCrowd().archived();
  return {pieceOf(FILE_BYTES, encodeSnapshot(file)), pieceOf(FOREST, smallForest().archived()),
          pieceOf(GRASS, meadow().grass.archived()), pieceOf(CROWD, makeCrowd().archived()),
          pieceOf(CANOPY, shrub().archived()),       pieceOf(WIND, archivedWind())};
}

// Journals.

enum JournalPiece { RECORD, RAW, JOURNAL_PIECES };
constexpr std::uint64_t CHECKPOINT = 7;

std::string recordOf(std::string_view body) {
  Archive head;
  auto length = static_cast<std::uint32_t>(body.size());
  head.integer("length", length);
  return head.takeBytes().append(body) + sumOf(body);
}

void runJournals(std::string_view input) {
  std::uint64_t key = CHECKPOINT;
  Archive head;
  head.key(key);
  std::string bytes = head.takeBytes();
  for (const Piece& piece : splitPieces(input))
    bytes +=
        piece.kind % JOURNAL_PIECES == RECORD ? recordOf(piece.bytes) : std::string(piece.bytes);
  try {
    for (JournalRecord& record : readRecords(bytes, CHECKPOINT)) {
      Archive again;
      archive(again, record.events);
    }
  } catch (const InvalidInput&) {
  }
}

std::vector<std::string> journalSeeds() {
  Nanoseconds stamp = START;
  std::vector<StoredEvent> events{{"event", ""}, {"message", "wind"}};
  Archive body;
  body.stamp("tick", stamp);
  archive(body, events);
  const std::string record = body.takeBytes();
  return {pieceOf(RECORD, record), pieceOf(RECORD, record) + pieceOf(RAW, recordOf(record)),
          pieceOf(RECORD, record) + pieceOf(RAW, "\xff\xff\xff\xff")};
}

}  // namespace

std::vector<Target> snapshotTargets() {
  return {
      {"snapshots", "snapshot files, and states of all simulations", runSnapshots, snapshotSeeds},
      {"journals", "journals of inputs", runJournals, journalSeeds}};
}

}  // namespace vegetation_sim::fuzz
