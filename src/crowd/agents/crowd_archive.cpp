// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// The snapshot of a crowd, and people, as bytes.
#include "core/archive/archive.h"
#include "crowd/agents/crowd_shard.h"

namespace vegetation_sim::crowd {
namespace {

constexpr std::size_t WALKER_BYTES = 218, ROBOT_BYTES = 60, LONGEST_NAME = 4096;
constexpr std::size_t WAY_BYTES = 12, BORDER_BYTES = 30;
constexpr std::size_t MOST_CORNERS = 4096;
// People are pushed a little beyond the places where they may be sent.
constexpr Range STATE_PLACES{-1.1e5, 1.1e5}, STATE_SPEEDS{-1e3, 1e3}, STATE_OFFSETS{-100.0, 100.0};
constexpr Range STATE_ANGLES{-1e3, 1e3}, STATE_TURN_RATES{-100.0, 100.0}, STATE_AMOUNTS{-1e9, 1e9};

void archive(Archive& a, const char* name, Point& point, Range range) {
  a.number(name, point.x, range);
  a.number(name, point.y, range);
}

void archiveId(Archive& a, const char* name, std::uint32_t& id) {
  a.integer<std::uint32_t>(name, id, 0, LARGEST_ID);
}

void archive(Archive& a, Foot& foot) {
  archive(a, "foot planted", foot.planted, STATE_PLACES);
  archive(a, "foot offset", foot.offset, STATE_OFFSETS);
  a.flag("foot stands", foot.stands);
}

void archive(Archive& a, Walker& w) {
  archiveId(a, "walker id", w.id);
  a.key(w.key);
  archive(a, "walker position", w.position, STATE_PLACES);
  archive(a, "walker velocity", w.velocity, STATE_SPEEDS);
  a.number("walker heading", w.heading, STATE_ANGLES);
  a.number("walker turn_rate", w.turn_rate, STATE_TURN_RATES);
  a.number("walker radius", w.radius, {0.01, 10.0});
  a.number("walker height", w.height, {0.01, 10.0});
  a.number("walker speed", w.speed, {0.0, 100.0});
  a.flag("walker has_goal", w.has_goal);
  a.flag("walker wanders", w.wanders);
  a.flag("walker arrived", w.arrived);
  archive(a, "walker goal", w.goal, STATE_PLACES);
  a.integer("walker goals", w.goals);
  a.integer("walker side", w.side, -1, 1);
  a.number("walker side_left", w.side_left, STATE_AMOUNTS);
  a.number("walker nearest_goal", w.nearest_goal, STATE_AMOUNTS);
  a.number("walker no_progress", w.no_progress, STATE_AMOUNTS);
  a.number("walker held_up", w.held_up, STATE_AMOUNTS);
  a.flag("walker detours", w.detours);
  a.number("walker gait", w.gait, STATE_AMOUNTS);
  for (Foot& foot : w.feet) archive(a, foot);
}

void archive(Archive& a, Robot& robot) {
  a.text("robot id", robot.id, LONGEST_NAME);
  a.list("robot outline", robot.outline, MOST_CORNERS, sizeof(Point),
         [&a](Point& corner) { archive(a, "robot corner", corner, STATE_PLACES); });
  a.number("robot radius", robot.radius);
  archive(a, "robot position", robot.position, STATE_PLACES);
  a.number("robot yaw", robot.yaw);
  archive(a, "robot velocity", robot.velocity, STATE_SPEEDS);
}

void archive(Archive& a, WayProgress& way) {
  a.integer("way goal", way.goal);
  a.integer("way origin", way.origin);
  a.integer("way closed", way.closed);
}

void checkRead(const CrowdSnapshot& snapshot) {
  for (std::size_t i = 0; i < snapshot.walkers.size(); ++i) {
    const std::uint32_t id = snapshot.walkers[i].id;
    if (i > 0 && id <= snapshot.walkers[i - 1].id) Archive::rejectOrder("walkers", i);
    if (id >= snapshot.next_id)
      Archive::reject("walker id = " + std::to_string(id),
                      "is not below the next id, " + std::to_string(snapshot.next_id));
  }
  Faults faults;
  for (const auto& [id, robot] : snapshot.robots) {
    if (robot.id != id) Archive::reject("robot id = " + inQuotes(robot.id), "is not its key");
    check(robot, faults);
  }
  faults.throwIfAny();
}

void archivePeople(Archive& a, std::vector<Walker>& people) {
  a.list("people", people, MOST_WALKERS, WALKER_BYTES,
         [&a](Walker& walker) { archive(a, walker); });
}

void archiveHanded(Archive& a, std::vector<CrowdBorder::Handed>& all) {
  a.list("people handed over", all, MOST_WALKERS, WALKER_BYTES + 12,
         [&a](CrowdBorder::Handed& handed) {
           a.integer("shard", handed.to);
           a.stamp("stamp of crossing", handed.stamp);
           archive(a, handed.walker);
         });
}

void archiveFields(Archive& a, CrowdBorder& border) {
  a.stamp("stamp of border", border.stamp);
  archivePeople(a, border.near);
  archiveHanded(a, border.handed);
  a.map(
      "heard", border.heard, MOST_SHARDS, 12,
      [&a](std::uint32_t& shard) { a.integer("shard", shard); },
      [&a](std::uint32_t, Nanoseconds& stamp) { a.stamp("stamp heard", stamp); });
  a.integer("run", border.run);
  a.integer("begun", border.begun);  // of a process: a load does not move it
  a.flag("starts", border.starts);
  a.flag("lists", border.lists);
  a.list("ids", border.ids, 2 * MOST_WALKERS, 4,
         [&a](std::uint32_t& id) { archiveId(a, "id", id); });
}

void archive(Archive& a, CrowdSnapshot& snapshot) {
  a.stamp("stamp", snapshot.stamp);
  a.flag("begun", snapshot.begun);
  a.key(snapshot.seed);
  a.fields("settings", snapshot.settings);
  a.fields("area", snapshot.area);
  a.list("walkers", snapshot.walkers, MOST_WALKERS, WALKER_BYTES,
         [&a](Walker& walker) { archive(a, walker); });
  a.map(
      "robots", snapshot.robots, MOST_ROBOTS, ROBOT_BYTES,
      [&a](std::string& id) { a.text("robot", id, LONGEST_NAME); },
      [&a](const std::string&, Robot& robot) { archive(a, robot); });
  a.integer<std::uint32_t>("next id", snapshot.next_id, 0, LARGEST_ID + 1);
  a.list("ways", snapshot.ways, MOST_WALKERS, WAY_BYTES,
         [&a](WayProgress& way) { archive(a, way); });
  if (a.reads()) checkRead(snapshot);
}

}  // namespace

void CrowdShard::archive(Archive& a) {
  a.map(
      "borders", borders_, MOST_SHARDS, BORDER_BYTES,
      [&a](std::uint32_t& shard) { a.integer("shard", shard); },
      [&a](std::uint32_t, CrowdBorder& border) { archiveFields(a, border); });
  archiveHanded(a, handed_);
  archivePeople(a, left_);
  a.stamp("stamp of the last tick", last_);
  a.integer("run", run_);
  a.flag("starts", starts_);
  if (!a.reads()) return;
  begun_ = 0;
  for (std::uint32_t i = 0; i < owners_.shard().count; ++i) known_.insert(i);
  asked_ = 0;
  fresh_ = false;
  start_.clear();
  waiting_.clear();
}

std::string archiveBorder(CrowdBorder border) {
  Archive a;
  archiveFields(a, border);
  return a.takeBytes();
}

CrowdBorder readBorder(std::string bytes) {
  Archive a = Archive::reading(std::move(bytes), 0);
  CrowdBorder out;
  archiveFields(a, out);
  a.finish();
  return out;
}

std::string Crowd::archived() const {
  Archive a;
  CrowdSnapshot copy = memory_;
  archive(a, copy);
  return a.takeBytes();
}

CrowdSnapshot Crowd::readArchived(std::string bytes, Nanoseconds shift) {
  Archive a = Archive::reading(std::move(bytes), shift);
  CrowdSnapshot out;
  archive(a, out);
  a.finish();
  return out;
}

}  // namespace vegetation_sim::crowd
