// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/agents/crowd.h"

#include <algorithm>

#include "crowd/agents/crowd_owners.h"
#include "crowd/body/gait.h"
#include "vegetation_sim/core/math/hash.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::crowd {
namespace {

// Widest walker, with clearance, that ways around walls are made for [m]
constexpr double WIDEST = 0.3;
constexpr double FARTHEST = 1e5;

void add(Hash& hash, const Point& p) {
  hash.add(p.x);
  hash.add(p.y);
}

void add(Hash& hash, const Walker& w) {
  hash.add(std::uint64_t{w.id});
  hash.add(w.key);
  add(hash, w.position);
  add(hash, w.velocity);
  for (const double value : {w.heading, w.turn_rate, w.radius, w.height, w.speed, w.side_left,
                             w.nearest_goal, w.no_progress, w.held_up, w.gait})
    hash.add(value);
  hash.add(std::uint64_t{w.has_goal} | std::uint64_t{w.wanders} << 1 |
           std::uint64_t{w.arrived} << 2 | std::uint64_t{w.detours} << 3 |
           static_cast<std::uint64_t>(w.side + 1) << 4 | std::uint64_t{w.goals} << 8);
  add(hash, w.goal);
  for (const Foot& foot : w.feet) {
    add(hash, foot.planted);
    add(hash, foot.offset);
    hash.add(std::uint64_t{foot.stands});
  }
}

void add(Hash& hash, const Robot& r) {
  hash.add(r.id);
  for (const Point& corner : r.outline) add(hash, corner);
  add(hash, r.position);
  add(hash, r.velocity);
  hash.add(r.radius);
  hash.add(r.yaw);
}

template <class T>
void checkFields(const char* context, T value) {
  Faults faults;
  FieldChecker checker(context, faults);
  describe(checker, value);
  faults.throwIfAny();
}

void checkPlace(const char* context, const Point& place) {
  Faults faults;
  FieldChecker checker(context, faults);
  Point p = place;
  checker.number("x", p.x, "m", {-FARTHEST, FARTHEST});
  checker.number("y", p.y, "m", {-FARTHEST, FARTHEST});
  faults.throwIfAny();
}

// States without noise of the speed have the hashes of recordings from before there was any.
class SettingsHasher : public FieldHasher {
 public:
  using FieldHasher::FieldHasher;
  void number(const char* name, double& value, const char* unit, Range range) override {
    if (value != 0.0 || std::string(name) != "noise_speed")
      FieldHasher::number(name, value, unit, range);
  }
};

}  // namespace

void describe(FieldVisitor& v, Area& a) {
  v.number("min_x", a.min_x, "m", {-FARTHEST, FARTHEST});
  v.number("max_x", a.max_x, "m", {-FARTHEST, FARTHEST});
  v.number("min_y", a.min_y, "m", {-FARTHEST, FARTHEST});
  v.number("max_y", a.max_y, "m", {-FARTHEST, FARTHEST});
}

std::uint64_t CrowdSnapshot::hash() const {
  Hash hash;
  hash.add(static_cast<std::uint64_t>(stamp));
  hash.add(std::uint64_t{begun});
  hash.add(seed);
  SettingsHasher hasher(hash);
  CrowdSettings s = settings;
  Area a = area;
  describe(hasher, s);
  describe(hasher, a);
  for (const Walker& w : walkers) add(hash, w);
  for (const auto& entry : robots) add(hash, entry.second);
  hash.add(std::uint64_t{next_id});
  return hash.value();
}

std::uint64_t CrowdSnapshot::walkersHash() const {
  std::uint64_t out = 0;
  for (const Walker& walker : walkers) {
    Hash hash;
    add(hash, walker);
    out += hash.value();
  }
  return out;
}

Crowd::Crowd(std::uint64_t seed, const CrowdSettings& settings, const Area& area,
             std::shared_ptr<const terrain::HeightMap> terrain)
    : terrain_(std::move(terrain)) {
  checkFields("crowd: ", settings);
  checkFields("area: ", area);
  if (!(area.min_x <= area.max_x && area.min_y <= area.max_y))
    throw InvalidInput("area: min_x = " + std::to_string(area.min_x) + " to max_x = " +
                       std::to_string(area.max_x) + ", min_y = " + std::to_string(area.min_y) +
                       " to max_y = " + std::to_string(area.max_y) + " m holds no place");
  memory_.seed = seed;
  memory_.settings = settings;
  memory_.area = area;
  setObstacles({});
}

void Crowd::setObstacles(std::vector<Obstacle> obstacles) {
  still_ = ObstacleGrid(std::move(obstacles), memory_.settings.sensor_range);
  ways_.setObstacles(still_, WIDEST, memory_.settings.field_cell);
  memory_.ways.clear();
}

void Crowd::setSettings(const CrowdSettings& settings) {
  checkFields("crowd: ", settings);
  const bool same = settings.sensor_range == memory_.settings.sensor_range &&
                    settings.field_cell == memory_.settings.field_cell;
  memory_.settings = settings;
  if (!same) setObstacles(still_.obstacles());
}

void Crowd::checkRoom(const char* context, std::uint32_t id) const {
  if (memory_.walkers.size() >= MOST_WALKERS)
    throw InvalidInput(std::string(context) + "walkers = " + std::to_string(MOST_WALKERS) +
                           " are there, which is the most allowed",
                       FaultCode::NO_ROOM);
  if (id > LARGEST_ID)
    throw InvalidInput(std::string(context) + "id = " + std::to_string(id) + " is outside 0 to " +
                           std::to_string(LARGEST_ID),
                       FaultCode::NO_ROOM);
  if (find(id)) throw InvalidInput(context + ("walker " + std::to_string(id)) + " exists already");
}

std::uint32_t Crowd::spawn(const Spawn& spawn, std::uint32_t id) {
  checkFields("spawn: ", spawn);
  if (spawn.has_goal) checkPlace("spawn: goal ", spawn.goal);
  checkRoom("spawn: ", id);
  memory_.next_id = std::max(memory_.next_id, id + 1);
  Walker w;
  w.id = id;
  w.key = Random(memory_.seed).child(w.id).key();
  w.position = spawn.position;
  w.heading = spawn.heading;
  w.radius = spawn.radius;
  w.height = spawn.height;
  w.speed = spawn.speed;
  w.wanders = spawn.wanders;
  w.has_goal = spawn.has_goal;
  w.goal = spawn.goal;
  w.gait = Random(w.key).uniform(0);
  advanceGait(0.0, w);
  for (int i = 0; i < 2; ++i) {
    const double side = i == 0 ? 1.0 : -1.0;
    const SinCos turn = sinCos(w.heading);
    const double off = side * Proportions::HIP_HALF * w.height;
    w.feet[static_cast<std::size_t>(i)].planted =
        w.position + Point{-turn.sin * off, turn.cos * off};
  }
  const auto place = memory_.walkers.begin() + static_cast<std::ptrdiff_t>(indexOf(id));
  memory_.walkers.insert(place, w);
  return w.id;
}

// Returns the index of the first walker with this id or a larger one.
std::size_t Crowd::indexOf(std::uint32_t id) const {
  const auto& all = memory_.walkers;
  const auto found = std::lower_bound(all.begin(), all.end(), id,
                                      [](const Walker& w, std::uint32_t i) { return w.id < i; });
  return static_cast<std::size_t>(found - all.begin());
}

const Walker* Crowd::find(std::uint32_t id) const {
  const std::size_t index = indexOf(id);
  const auto& all = memory_.walkers;
  return index < all.size() && all[index].id == id ? &all[index] : nullptr;
}

Walker& Crowd::at(std::uint32_t id) {
  if (!find(id))
    throw InvalidInput("walker " + std::to_string(id) + " is unknown", FaultCode::UNKNOWN);
  return memory_.walkers[indexOf(id)];
}

void Crowd::remove(std::uint32_t id) {
  memory_.walkers.erase(memory_.walkers.begin() + (&at(id) - memory_.walkers.data()));
}

std::vector<Walker> Crowd::takeOutside(const CrowdOwners& owners) {
  std::vector<Walker>& all = memory_.walkers;
  const auto first = std::stable_partition(
      all.begin(), all.end(), [&](const Walker& w) { return owners.owns(w.position); });
  std::vector<Walker> out(first, all.end());
  all.erase(first, all.end());
  return out;
}

void Crowd::takeIn(const Walker& walker) {
  checkRoom("", walker.id);
  const std::size_t index = indexOf(walker.id);
  memory_.next_id = std::max(memory_.next_id, walker.id + 1);
  memory_.walkers.insert(memory_.walkers.begin() + static_cast<std::ptrdiff_t>(index), walker);
}

void Crowd::checkGoal(std::uint32_t id, const Point& goal) {
  checkPlace("goal: ", goal);
  const Walker& w = at(id);
  const PlanRaster& raster = ways_.raster();
  if (!raster.isClear(w.position, goal, false) && !ways_.isReachable(w.position, goal))
    throw InvalidInput("goal = (" + std::to_string(goal.x) + ", " + std::to_string(goal.y) +
                       ") m: no way leads there from walker " + std::to_string(id));
}

void Crowd::setGoal(std::uint32_t id, const Point& goal) {
  checkGoal(id, goal);
  Walker& w = at(id);
  w.goal = goal;
  w.has_goal = true;
  w.wanders = w.arrived = w.detours = false;
  w.nearest_goal = 1e9;
  w.no_progress = 0.0;
  ++w.goals;
}

void Crowd::setWandering(std::uint32_t id) {
  Walker& w = at(id);
  w.wanders = true;
  w.has_goal = w.arrived = false;
}

void Crowd::setRobot(const Robot& robot) {
  Faults faults;
  check(robot, faults);
  faults.throwIfAny();
  if (memory_.robots.size() >= MOST_ROBOTS && !memory_.robots.count(robot.id))
    throw InvalidInput("robot " + inQuotes(robot.id) + " is one more than the " +
                       std::to_string(MOST_ROBOTS) + " allowed");
  memory_.robots[robot.id] = robot;
}

void Crowd::removeRobot(const std::string& id) {
  if (!memory_.robots.erase(id))
    throw InvalidInput("robot " + inQuotes(id) + " is unknown", FaultCode::UNKNOWN);
}

void Crowd::clear() {
  memory_.walkers.clear();
  memory_.robots.clear();
  memory_.next_id = 0;
  memory_.stamp = 0;
  memory_.begun = false;
  memory_.ways.clear();
  ways_.resume({});
}

void Crowd::restore(CrowdSnapshot memory) {
  const std::vector<WayProgress> ways = std::move(memory.ways);
  memory_ = std::move(memory);
  setObstacles(still_.obstacles());
  ways_.resume(ways);
  memory_.ways = ways_.progress();
}

}  // namespace vegetation_sim::crowd
