// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/agents/crowd_shard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "core/error_text.h"
#include "scenes/crowd/crowd_scenes.h"

namespace vegetation_sim::crowd {
namespace {

constexpr double PERIOD = 1.0 / 30.0;  // of ticks [s]

std::unique_ptr<Crowd> copyOf(const Crowd& crowd) {
  const CrowdSnapshot& state = crowd.snapshot();
  auto out = std::make_unique<Crowd>(state.seed, state.settings, state.area, flatGround());
  out->setObstacles(crowd.obstacles().obstacles());
  out->restore(state);
  return out;
}

/// Shards of a crowd in one process, which tell each other their borders after each tick.
class ShardedCrowd {
 public:
  ShardedCrowd(const Crowd& whole, std::uint32_t count) {
    for (std::uint32_t i = 0; i < count; ++i) {
      crowds_.push_back(copyOf(whole));
      shards_.push_back(std::make_unique<CrowdShard>(*crowds_.back(), Shard{i, count}));
      borders_.push_back(shards_.back()->begin(CrowdShard::Start::FRESH));
    }
  }
  void advance(Nanoseconds stamp) {
    for (std::size_t i = 0; i < shards_.size(); ++i) {
      for (std::size_t j = 0; j < shards_.size(); ++j)
        if (j != i)
          shards_[i]->hear(static_cast<std::uint32_t>(j), readBorder(archiveBorder(borders_[j])));
      shards_[i]->beginTick();
    }
    for (std::size_t i = 0; i < shards_.size(); ++i) {
      crowds_[i]->advance(stamp);
      hash_ += (i == 0 ? -hash_ : 0) + crowds_[i]->snapshot().walkersHash();
      borders_[i] = shards_[i]->endTick();
      for (const CrowdBorder::Handed& handed : borders_[i].handed)
        crossed_.insert(handed.walker.id);
    }
  }
  std::uint64_t hash() const { return hash_; }
  const std::set<std::uint32_t>& crossed() const { return crossed_; }
  std::size_t people(std::size_t shard) const { return crowds_[shard]->walkers().size(); }
  std::vector<Walker> all() const {
    std::vector<Walker> out;
    for (std::size_t i = 0; i < crowds_.size(); ++i) {
      out.insert(out.end(), crowds_[i]->walkers().begin(), crowds_[i]->walkers().end());
      for (const CrowdBorder::Handed& handed : borders_[i].handed)
        if (handed.stamp == borders_[i].stamp) out.push_back(handed.walker);
    }
    std::sort(out.begin(), out.end(), [](const Walker& a, const Walker& b) { return a.id < b.id; });
    return out;
  }

 private:
  std::vector<std::unique_ptr<Crowd>> crowds_;
  std::vector<std::unique_ptr<CrowdShard>> shards_;
  std::vector<CrowdBorder> borders_;
  std::set<std::uint32_t> crossed_;
  std::uint64_t hash_{0};
};

Crowd wanderers(int count, double side, std::uint64_t seed) {
  Crowd out(seed, CrowdSettings(), {0.0, side, 0.0, side}, flatGround());
  const Random random(seed);
  for (int i = 0; i < count; ++i) {
    const auto k = static_cast<std::uint64_t>(3 * i);
    Spawn spawn;
    spawn.position = {random.uniform(k, 0.0, side), random.uniform(k + 1, 0.0, side)};
    spawn.radius = 0.2 + 0.1 * random.uniform(k + 2);
    out.spawn(spawn);
  }
  Robot robot;
  robot.id = "robot";
  robot.position = {0.5 * side, 0.5 * side};
  out.setRobot(robot);
  return out;
}

TEST(CrowdShard, AllShardsTogetherAreOneCrowd) {
  for (const std::uint32_t count : {1u, 2u, 4u}) {
    Crowd whole = wanderers(150, 24.0, 7);
    ShardedCrowd shards(whole, count);
    Nanoseconds stamp = NANOSECONDS_PER_SECOND;
    for (int tick = 0; tick < 1800; ++tick, stamp += fromSeconds(PERIOD)) {
      whole.advance(stamp);
      shards.advance(stamp);
      ASSERT_EQ(shards.hash(), whole.snapshot().walkersHash()) << count << " " << tick;
    }
    if (count == 1) continue;
    EXPECT_GT(shards.crossed().size(), 100u);
    for (std::size_t i = 0; i < count; ++i) EXPECT_GT(shards.people(i), 150u / count / 2u);
  }
}

// Without the people beyond the border, those of two shards meet without seeing each other.
TEST(CrowdShard, PeopleAvoidThoseBeyondTheBorder) {
  Crowd whole = wanderers(150, 24.0, 7);
  std::vector<std::unique_ptr<Crowd>> blind;
  for (const std::uint32_t i : {0u, 1u}) {
    blind.push_back(copyOf(whole));
    blind.back()->takeOutside(CrowdOwners(whole.snapshot().area, {i, 2}));
  }
  run(whole, 5.0, PERIOD, [](const Crowd&) {});
  std::uint64_t sum = 0;
  for (const auto& crowd : blind) {
    run(*crowd, 5.0, PERIOD, [](const Crowd&) {});
    sum += crowd->snapshot().walkersHash();
  }
  EXPECT_NE(sum, whole.snapshot().walkersHash());
}

// Searches for ways begin where the first of a shard asks, so that ways of equal length may differ.
TEST(CrowdShard, WaysAroundWallsAreAsGood) {
  Crowd whole = houseOfRooms(100, 60.0, 3);
  ShardedCrowd shards(whole, 4);
  Nanoseconds stamp = NANOSECONDS_PER_SECOND;
  double way[2] = {0.0, 0.0};
  for (int tick = 0; tick < 1200; ++tick, stamp += fromSeconds(PERIOD)) {
    whole.advance(stamp);
    shards.advance(stamp);
    for (const Walker& walker : whole.walkers()) way[0] += PERIOD * length(walker.velocity);
    for (const Walker& walker : shards.all()) way[1] += PERIOD * length(walker.velocity);
  }
  ASSERT_EQ(shards.all().size(), 100u);
  std::size_t apart = 0;
  for (std::size_t i = 0; i < 100; ++i) {
    EXPECT_EQ(shards.all()[i].id, i);
    apart += length(shards.all()[i].position - whole.walkers()[i].position) > 1.0;
  }
  RecordProperty("people_elsewhere", static_cast<int>(apart));
  std::printf("%zu of 100 people are more than 1 m from where one crowd has them\n", apart);
  EXPECT_NEAR(way[1] / way[0], 1.0, 0.05);
}

// A shard that is silent misses nobody: those who come to it wait.
TEST(CrowdShard, PeopleWaitForASilentShard) {
  Crowd whole(1, CrowdSettings(), {0.0, 20.0, 0.0, 20.0}, flatGround());
  const CrowdOwners owners(whole.snapshot().area, {0, 2});
  const Point from{5.0, 5.0}, to{15.0, 15.0};
  const std::uint32_t first = owners.ownerAt(from), second = owners.ownerAt(to);
  ASSERT_NE(first, second);
  spawnAt(whole, from, to);
  const auto here = copyOf(whole), there = copyOf(whole);
  there->takeOutside(CrowdOwners(whole.snapshot().area, {second, 2}));
  CrowdShard sender(*here, {first, 2}), receiver(*there, {second, 2});
  CrowdBorder border = sender.endTick();
  for (Nanoseconds tick = 1; sender.handed().empty() && tick < 600; ++tick) {
    sender.beginTick();
    here->advance(tick * fromSeconds(PERIOD));
    border = sender.endTick();
  }
  ASSERT_EQ(sender.handed().size(), 1u);
  EXPECT_TRUE(sender.waiting().empty());
  sender.beginTick();
  // They stand at the border meanwhile.
  ASSERT_EQ(sender.waiting().size(), 1u);
  EXPECT_EQ(length(sender.waiting().front().velocity), 0.0);
  EXPECT_EQ(owners.ownerAt(sender.waiting().front().position), second);
  here->advance(border.stamp + fromSeconds(PERIOD));
  border = sender.endTick();
  EXPECT_EQ(here->walkers().size(), 0u);
  ASSERT_EQ(border.handed.size(), 1u);
  receiver.hear(first, border);
  receiver.hear(first, border);
  ASSERT_EQ(there->walkers().size(), 1u);
  EXPECT_EQ(there->walkers().front().id, 0u);
  there->advance(border.stamp);
  const CrowdBorder answer = receiver.endTick();
  // The same from the receiver's saved state.
  Archive saved;
  receiver.archive(saved);
  CrowdShard again(*there, {second, 2});
  Archive read = Archive::reading(saved.bytes());
  again.archive(read);
  read.finish();
  CrowdBorder loaded = again.endTick();
  EXPECT_EQ(loaded.begun, 0);
  loaded.begun = answer.begun;
  EXPECT_EQ(archiveBorder(loaded), archiveBorder(answer));
  sender.hear(second, answer);
  EXPECT_TRUE(sender.handed().empty());
  EXPECT_EQ(errorOf([&] { sender.hear(first, answer); }),
            "border: shard = " + std::to_string(first) +
                " is no other shard of the 2 than this one, " + std::to_string(first));
  EXPECT_NE(errorOf([] { readBorder("no border"); }), "");
}

// Who crosses the border is shown by the sender too, since the receiver may be late; but not once
// the receiver removes this person.
TEST(CrowdShard, WhoIsRemovedIsNotShownOnTheWay) {
  Crowd whole(1, CrowdSettings(), {0.0, 20.0, 0.0, 20.0}, flatGround());
  const CrowdOwners owners(whole.snapshot().area, {0, 2});
  const Point from{5.0, 5.0}, to{15.0, 15.0};
  const std::uint32_t first = owners.ownerAt(from), second = owners.ownerAt(to);
  spawnAt(whole, from, to);
  const auto here = copyOf(whole), there = copyOf(whole);
  there->takeOutside(CrowdOwners(whole.snapshot().area, {second, 2}));
  CrowdShard sender(*here, {first, 2}), receiver(*there, {second, 2});
  for (Nanoseconds tick = 1; sender.handed().empty() && tick < 600; ++tick) {
    sender.beginTick();
    here->advance(tick * fromSeconds(PERIOD));
    there->advance(tick * fromSeconds(PERIOD));
    sender.endTick();
    sender.hear(second, receiver.endTick());
  }
  ASSERT_EQ(sender.standing().size(), 1u);
  EXPECT_EQ(length(sender.standing().front().velocity), 0.0);
  sender.removeHanded(0);
  sender.beginTick();
  EXPECT_TRUE(sender.waiting().empty());
  EXPECT_TRUE(sender.standing().empty());
  EXPECT_EQ(sender.endTick().handed.size(), 1u);
}

// All people at their starts, as those of a scenario.
std::vector<Spawn> startsOf(const Crowd& crowd) {
  std::vector<Spawn> out;
  for (const Walker& walker : crowd.walkers()) {
    Spawn spawn;
    spawn.position = walker.position;
    spawn.radius = walker.radius;
    out.push_back(spawn);
  }
  return out;
}

void repopulate(Crowd& crowd, const std::vector<Spawn>& starts) {
  crowd.clear();
  for (std::size_t i = 0; i < starts.size(); ++i)
    crowd.spawn(starts[i], static_cast<std::uint32_t>(i));
}

/// Shards that can be late, reset and killed, and whose links can fail.
struct SomeShards {
  explicit SomeShards(Crowd& whole, std::uint32_t count = 2)
      : starts(startsOf(whole)), crowds(count), shards(count), borders(count), runs(count, true) {
    for (std::uint32_t i = 0; i < count; ++i) start(i, whole);
  }
  std::uint32_t count() const { return static_cast<std::uint32_t>(crowds.size()); }
  void start(std::uint32_t i, const Crowd& whole) {
    crowds[i] = copyOf(whole);
    repopulate(*crowds[i], starts);
    shards[i] = std::make_unique<CrowdShard>(*crowds[i], Shard{i, count()});
    borders[i] = shards[i]->begin(CrowdShard::Start::FRESH);
    runs[i] = true;
  }
  void reset(std::uint32_t i, std::uint32_t run) {
    shards[i]->setRun(run);
    repopulate(*crowds[i], starts);
    shards[i]->begin(CrowdShard::Start::RESET);
  }
  void hear(std::uint32_t i) {
    for (std::uint32_t from = 0; from < count(); ++from) {
      if (from == i || !runs[from] || cut.count({from, i}) > 0) continue;
      const CrowdBorder border = readBorder(archiveBorder(borders[from]));
      if (shards[i]->isResetBy(border)) reset(i, border.run);
      shards[i]->hear(from, border);
    }
  }
  /// All links, or those to and from one shard, fail or work again.
  void cutLinks(bool are_cut, std::optional<std::uint32_t> of = {}) {
    for (std::uint32_t from = 0; from < count(); ++from)
      for (std::uint32_t to = 0; to < count(); ++to) {
        if (of && from != *of && to != *of) continue;
        if (are_cut)
          cut.insert({from, to});
        else
          cut.erase({from, to});
      }
  }
  void step(std::uint32_t i, Nanoseconds stamp) {
    if (const auto missing = shards[i]->spawnMissing(starts)) spawned = *missing;
    shards[i]->beginTick();
    crowds[i]->advance(stamp);
  }
  /// Runs all for a tick, and notes whom they have published in it.
  void advance(Nanoseconds stamp) {
    for (std::uint32_t i = 0; i < count(); ++i)
      if (runs[i]) hear(i);
    ids.clear();
    hash = 0;
    for (std::uint32_t i = 0; i < count(); ++i) {
      if (!runs[i]) continue;
      step(i, stamp);
      for (const Walker& walker : crowds[i]->walkers()) ids.push_back(walker.id);
      for (const Walker& walker : shards[i]->waiting()) ids.push_back(walker.id);
      hash += crowds[i]->snapshot().walkersHash();
    }
    std::sort(ids.begin(), ids.end());
    for (std::uint32_t i = 0; i < count(); ++i)
      if (runs[i]) borders[i] = shards[i]->endTick();
  }
  /// Continues from a checkpoint, as a node that has started again.
  void continueFrom(std::uint32_t i, const std::string& saved, const CrowdSnapshot& state,
                    const Crowd& whole) {
    start(i, whole);
    crowds[i]->restore(state);
    Archive read = Archive::reading(saved);
    shards[i]->archive(read);
    read.finish();
  }

  std::vector<std::uint32_t> ids;
  std::uint64_t hash{0};
  std::vector<Spawn> starts;
  std::vector<std::unique_ptr<Crowd>> crowds;
  std::vector<std::unique_ptr<CrowdShard>> shards;
  std::vector<CrowdBorder> borders;
  std::vector<bool> runs;
  std::set<std::pair<std::uint32_t, std::uint32_t>> cut;  // links on which no borders come
  std::size_t spawned{0};
};

std::vector<std::uint32_t> upTo(std::uint32_t count) {
  std::vector<std::uint32_t> out(count);
  std::iota(out.begin(), out.end(), 0U);
  return out;
}

// Borders of the tick before a reset come after it in the same tick.
TEST(CrowdShard, AResetOfBothIsThatOfOneCrowd) {
  Crowd whole = wanderers(150, 24.0, 7);
  whole.removeRobot("robot");
  SomeShards two(whole);
  repopulate(whole, two.starts);
  Nanoseconds stamp = NANOSECONDS_PER_SECOND;
  for (int tick = 0; tick < 900; ++tick, stamp += fromSeconds(PERIOD)) {
    if (tick == 600) {
      repopulate(whole, two.starts);
      for (const std::uint32_t i : {0u, 1u}) two.reset(i, 1);
    }
    whole.advance(stamp);
    two.advance(stamp);
    ASSERT_EQ(two.hash, whole.snapshot().walkersHash()) << tick;
  }
}

// The requests reach the shards at different ticks.
TEST(CrowdShard, AShardThatIsResetLaterDuplicatesNobody) {
  Crowd whole = wanderers(150, 24.0, 7);
  SomeShards two(whole);
  Nanoseconds stamp = NANOSECONDS_PER_SECOND;
  for (int tick = 0; tick < 900; ++tick, stamp += fromSeconds(PERIOD)) {
    if (tick == 600) two.reset(0, 1);
    two.advance(stamp);
    if (tick == 602) two.reset(1, two.shards[1]->run() + 1);
    const bool is_between = tick >= 600 && tick <= 605;
    ASSERT_TRUE(is_between || two.ids == upTo(150)) << tick;
  }
  EXPECT_EQ(two.shards[0]->run(), two.shards[1]->run());
}

// One that is killed and has no checkpoint: nobody is there twice, and those who were in it, from
// wherever they came, begin anew.
TEST(CrowdShard, AShardThatStartsAnewSpawnsTheMissing) {
  Crowd whole = wanderers(150, 24.0, 7);
  for (const bool is_late : {false, true}) {
    SomeShards two(whole);
    Nanoseconds stamp = NANOSECONDS_PER_SECOND;
    std::size_t lost = 0;
    for (int tick = 0; tick < 900; ++tick, stamp += fromSeconds(PERIOD)) {
      if (tick == 600) {
        lost = two.crowds[1]->walkers().size();
        if (is_late)
          for (int late = 0; late < 30; ++late, stamp += fromSeconds(PERIOD)) {
            two.step(0, stamp);
            two.borders[0] = two.shards[0]->endTick();
          }
        two.start(1, whole);
      }
      two.advance(stamp);
      const bool is_between = tick >= 600 && tick <= 604;
      ASSERT_TRUE(is_between || two.ids == upTo(150)) << tick << is_late;
    }
    EXPECT_GT(two.spawned, 0u);
    EXPECT_LE(two.spawned, lost);
  }
}

// The links of a shard that is started again come up later than its first tick.
TEST(CrowdShard, AShardThatHearsOthersLateSpawnsTheMissing) {
  Crowd whole = wanderers(150, 24.0, 7);
  for (const int deaf : {1, 5, 40, 150}) {
    SomeShards two(whole);
    Nanoseconds stamp = NANOSECONDS_PER_SECOND;
    for (int tick = 0; tick < 900; ++tick, stamp += fromSeconds(PERIOD)) {
      if (tick == 600) two.start(1, whole);
      two.cutLinks(tick >= 600 && tick < 600 + deaf);
      two.advance(stamp);
      const bool is_between = tick >= 600 && tick <= 604 + deaf;
      ASSERT_TRUE(is_between || two.ids == upTo(150)) << tick << " deaf " << deaf;
    }
  }
}

// One that knows of others before their borders waits for them without people.
TEST(CrowdShard, AShardThatStartsBesideOthersHasNoPeopleAtFirst) {
  Crowd whole = wanderers(150, 24.0, 7);
  SomeShards two(whole);
  Nanoseconds stamp = NANOSECONDS_PER_SECOND;
  for (int tick = 0; tick < 900; ++tick, stamp += fromSeconds(PERIOD)) {
    const bool is_between = tick >= 600 && tick <= 624, are_deaf = is_between && tick < 620;
    two.cutLinks(are_deaf);
    if (tick == 600) {
      two.start(1, whole);
      two.shards[1]->startBesideOthers();
    }
    two.advance(stamp);
    ASSERT_TRUE(!are_deaf || two.crowds[1]->walkers().empty()) << tick;
    ASSERT_TRUE(is_between || two.ids == upTo(150)) << tick;
  }
}

// Each of three shards has started at another tick, and any two are killed; they return together or
// one after the other.
TEST(CrowdShard, TwoOfThreeShardsThatStartAnewSpawnTheMissing) {
  Crowd whole = wanderers(150, 24.0, 7);
  for (const std::uint32_t survivor : {0u, 1u, 2u}) {
    for (const int later : {0, 1, 2, 3, 30}) {
      SomeShards three(whole, 3);
      const std::uint32_t first = survivor == 0 ? 1 : 0, second = 3 - survivor - first;
      Nanoseconds stamp = NANOSECONDS_PER_SECOND;
      for (int tick = 0; tick < 900; ++tick, stamp += fromSeconds(PERIOD)) {
        for (const std::uint32_t i : {1u, 2u})
          if (tick == static_cast<int>(100 * i)) three.start(i, whole);
        if (tick == 600) three.runs[first] = three.runs[second] = false;
        if (tick == 620) three.start(first, whole);
        if (tick == 620 + later) three.start(second, whole);
        three.advance(stamp);
        const bool is_between = tick % 100 <= 4 || (tick >= 600 && tick <= 626 + later);
        ASSERT_TRUE(is_between || three.ids == upTo(150))
            << tick << " survivor " << survivor << " later " << later;
      }
    }
  }
}

// One that continues from a checkpoint keeps its people, although it has started later than others.
TEST(CrowdShard, AShardWithACheckpointKeepsItsPeople) {
  Crowd whole = wanderers(150, 24.0, 7);
  SomeShards three(whole, 3);
  Nanoseconds stamp = NANOSECONDS_PER_SECOND;
  for (int tick = 0; tick < 900; ++tick, stamp += fromSeconds(PERIOD)) {
    if (tick == 100) three.start(1, whole);
    std::vector<std::uint32_t> before;
    if (tick == 600) {
      Archive saved;
      three.shards[1]->archive(saved);
      const CrowdSnapshot state = three.crowds[1]->snapshot();
      for (const Walker& walker : state.walkers) before.push_back(walker.id);
      three.continueFrom(1, saved.bytes(), state, whole);
    }
    three.spawned = 1000;
    three.advance(stamp);
    ASSERT_TRUE(tick < 600 || three.spawned == 1000u) << tick;
    const bool is_between = tick >= 100 && tick <= 104;
    ASSERT_TRUE(is_between || three.ids == upTo(150)) << tick;
  }
}

// The links of one of three shards fail in one direction, while people go round all three.
TEST(CrowdShard, NoPersonIsLostWhileALinkFails) {
  Crowd whole = wanderers(150, 12.0, 7);
  SomeShards three(whole, 3);
  Nanoseconds stamp = NANOSECONDS_PER_SECOND;
  for (int tick = 0; tick < 3000; ++tick, stamp += fromSeconds(PERIOD)) {
    const int phase = tick % 500;
    three.cut.clear();
    if (phase >= 100 && phase < 250) three.cut.insert({(tick / 500) % 3u, (tick / 500 + 1) % 3u});
    if (phase >= 300 && phase < 350) three.cutLinks(true, (tick / 500) % 3);
    three.advance(stamp);
    const bool is_between = phase >= 100 && phase <= 354;
    ASSERT_TRUE(is_between || three.ids == upTo(150)) << tick;
  }
}

// A reset that comes while a shard starts removes whom it has taken in before.
TEST(CrowdShard, AResetDuringAStartDuplicatesNoPerson) {
  Crowd whole = wanderers(150, 24.0, 7);
  for (const int at : {0, 1, 2, 3, 4}) {
    SomeShards two(whole);
    Nanoseconds stamp = NANOSECONDS_PER_SECOND;
    for (int tick = 0; tick < 900; ++tick, stamp += fromSeconds(PERIOD)) {
      if (tick == 600) two.runs[1] = false;
      if (tick == 620) two.start(1, whole);
      if (tick == 620 + at) two.reset(0, 1);
      two.advance(stamp);
      const bool is_between = tick >= 600 && tick <= 632;
      ASSERT_TRUE(is_between || two.ids == upTo(150)) << tick << " reset at " << at;
    }
  }
}

// A person who comes to a shard before it is reset is not sent to it again.
TEST(CrowdShard, ABorderFromBeforeAResetIsVoid) {
  Crowd whole = wanderers(20, 24.0, 7);
  SomeShards two(whole);
  CrowdBorder old = two.borders[0];
  old.stamp = NANOSECONDS_PER_SECOND;
  Walker stranger = two.crowds[0]->walkers().front();
  old.handed.push_back({1, old.stamp, stranger});
  two.shards[1]->beginTick();
  two.reset(1, 1);
  const std::size_t before = two.crowds[1]->walkers().size();
  two.shards[1]->hear(0, old);
  EXPECT_EQ(two.crowds[1]->walkers().size(), before);
  old.run = 1;
  two.shards[1]->hear(0, old);
  EXPECT_EQ(two.crowds[1]->walkers().size(), before + 1);
}

}  // namespace
}  // namespace vegetation_sim::crowd
