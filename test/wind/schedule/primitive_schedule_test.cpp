// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "wind/schedule/primitive_schedule.h"

#include <gtest/gtest.h>

#include "core/archive/archive.h"
#include "scenes/wind/wind_examples.h"
#include "vegetation_sim/core/math/random.h"
#include "wind/fade.h"
#include "wind/limits.h"

namespace vegetation_sim::wind {
namespace {

Primitive fading(Kind kind, const std::string& name) {
  Primitive p = example(kind, name);
  p.fade_in = p.fade_out = 1.0;
  return p;
}

/// A schedule with a disk and a breeze that have blown for a long time.
PrimitiveSchedule blowing() {
  PrimitiveSchedule schedule(5);
  schedule.start({fading(Kind::DISK, "disk"), fading(Kind::BREEZE, "breeze")});
  return schedule;
}

Vec3 airOf(const PrimitiveSchedule& schedule, double t) {
  return schedule.field().velocity(Vec3(2.0, 1.0, 3.0), at(t));
}

double weightOf(const PrimitiveSchedule& schedule, const std::string& name, double t) {
  double sum = 0.0;
  for (const Primitive& p : schedule.field().primitives())
    if (p.name == name) sum += fade(p, at(t));
  return sum;
}

TEST(PrimitiveSchedule, EditChangesNothingBeforeItTakesEffect) {  // N2
  const PrimitiveSchedule before = blowing();
  PrimitiveSchedule after = before;
  Primitive stronger = fading(Kind::BREEZE, "breeze");
  stronger.velocity = Vec3(0.0, 11.0, 0.0);
  const Primitive published = after.set(stronger, at(50.2));
  EXPECT_EQ(published.t_on, at(50.2));
  for (double t = 0.0; t <= 50.2; t += 0.1) EXPECT_EQ(airOf(before, t), airOf(after, t)) << t;
  EXPECT_NE(airOf(before, 50.8), airOf(after, 50.8));
}

TEST(PrimitiveSchedule, EditStepsNothing) {  // N2
  PrimitiveSchedule schedule = blowing();
  Primitive stronger = fading(Kind::BREEZE, "breeze");
  stronger.velocity = Vec3(0.0, 11.0, 0.0);
  schedule.set(stronger, at(50.2));
  const double h = 1e-4;  // the fade's steepest slope, 1.9 / s, times 13 m/s, and turbulence
  for (double t = 50.0; t < 51.5; t += h)
    EXPECT_LT(length(airOf(schedule, t + h) - airOf(schedule, t)), h * 60.0) << t;
}

TEST(PrimitiveSchedule, EditThatChangesNothingChangesNothing) {  // N2
  const PrimitiveSchedule before = blowing();
  PrimitiveSchedule after = before;
  after.set(fading(Kind::BREEZE, "breeze"), at(50.2));
  after.set(fading(Kind::DISK, "disk"), at(50.7));
  for (double t = 40.0; t < 60.0; t += 0.013)
    EXPECT_LT(length(airOf(before, t) - airOf(after, t)), 1e-13) << t;
}

TEST(PrimitiveSchedule, FadesOverTheLongerOfBothTimes) {
  PrimitiveSchedule schedule = blowing();
  Primitive slow = fading(Kind::DISK, "disk");
  slow.fade_in = 4.0;
  EXPECT_EQ(schedule.set(slow, at(50.0)).fade_in, 4.0);
  EXPECT_EQ(schedule.field().primitives()[0].fade_out, 4.0);
  EXPECT_EQ(schedule.field().primitives()[0].t_off, at(54.0));
}

TEST(PrimitiveSchedule, ManyQuickEditsNeverAddUpToMoreThanOneSource) {  // N2
  PrimitiveSchedule schedule = blowing();
  const Random random(1);
  for (std::uint64_t i = 0; i < 200; ++i) {  // a slider that is dragged at 20 Hz
    Primitive p = fading(Kind::BREEZE, "breeze");
    p.velocity = Vec3(random.uniform(i, 1.0, 9.0), 0.0, 0.0);
    schedule.set(p, at(50.2 + 0.05 * static_cast<double>(i)));
  }
  for (double t = 45.0; t < 70.0; t += 0.01)
    EXPECT_NEAR(weightOf(schedule, "breeze", t), 1.0, 1e-12);
  EXPECT_EQ(schedule.find("breeze", at(70.0))->velocity.x(), random.uniform(199, 1.0, 9.0));
  EXPECT_LT(schedule.field().primitives().size(), 20u);
}

// An edit waits for the fade-in before it, reports that by its t_on, and never waits long.
TEST(PrimitiveSchedule, EditWaitsForTheChangeBeforeItWithinALimit) {  // N2
  PrimitiveSchedule schedule = blowing();
  Primitive slow = fading(Kind::DISK, "disk");
  slow.fade_in = 100.0;
  EXPECT_EQ(schedule.set(slow, at(50.0)).t_on, at(50.0));
  const std::uint64_t hash = schedule.field().hash();
  try {
    schedule.set(fading(Kind::DISK, "disk"), at(119.9));
    FAIL() << "took it";
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(
        error.what(),
        "primitive 'disk' is still fading in until 150.000000 s; an edit waits for that at "
        "most 30.000000 s");
  }
  EXPECT_EQ(schedule.field().hash(), hash);
  EXPECT_EQ(schedule.set(fading(Kind::DISK, "disk"), at(120.0)).t_on, at(150.0));
  EXPECT_EQ(schedule.set(fading(Kind::DISK, "disk"), at(150.0)).t_on, at(150.0));
  for (double t = 45.0; t < 170.0; t += 0.1) EXPECT_NEAR(weightOf(schedule, "disk", t), 1.0, 1e-12);
}

// A source that is fading in can be ended at once.
TEST(PrimitiveSchedule, RemovingNeverWaits) {
  PrimitiveSchedule schedule = blowing();
  Primitive slow = fading(Kind::DISK, "slow");
  slow.fade_in = 100.0;
  schedule.set(slow, at(50.0));
  schedule.remove("slow", at(60.0));
  EXPECT_EQ(weightOf(schedule, "slow", 61.0), 0.0);
}

TEST(PrimitiveSchedule, LaterEditReplacesOneThatHasNotBegun) {
  PrimitiveSchedule schedule = blowing();
  Primitive planned = fading(Kind::DISK, "disk");
  planned.t_on = at(100.0);
  schedule.set(planned, at(50.0));
  schedule.set(fading(Kind::DISK, "disk"), at(60.0));
  EXPECT_EQ(schedule.field().primitives().size(), 3u);
  for (double t = 45.0; t < 120.0; t += 0.1) EXPECT_NEAR(weightOf(schedule, "disk", t), 1.0, 1e-12);
}

TEST(PrimitiveSchedule, GivesEpochOfTheReplacedSourceOfTheSameKind) {
  PrimitiveSchedule schedule = blowing();
  Primitive first = fading(Kind::DISK, "late");
  EXPECT_EQ(schedule.set(first, at(50.0)).epoch, at(50.0));
  EXPECT_EQ(schedule.set(first, at(60.0)).epoch, at(50.0));
  EXPECT_EQ(schedule.set(fading(Kind::BLAST, "late"), at(70.0)).epoch, at(70.0));
  first.epoch = at(3.0);
  EXPECT_EQ(schedule.set(first, at(80.0)).epoch, at(3.0));
}

TEST(PrimitiveSchedule, LeavesASourceThatIsFadingOutAlone) {
  PrimitiveSchedule schedule;
  Primitive ending = fading(Kind::DISK, "disk");
  ending.t_off = at(50.5);
  schedule.start({ending});
  const PrimitiveSchedule before = schedule;
  schedule.set(fading(Kind::DISK, "disk"), at(50.0));
  EXPECT_EQ(schedule.field().primitives()[0].t_off, at(50.5));
  for (double t = 45.0; t < 50.0; t += 0.1) EXPECT_EQ(airOf(before, t), airOf(schedule, t));
}

TEST(PrimitiveSchedule, RemovesSmoothlyAndNotBeforeTheStamp) {
  const PrimitiveSchedule before = blowing();
  PrimitiveSchedule after = before;
  after.remove("breeze", at(50.2));
  for (double t = 45.0; t <= 50.2; t += 0.1) EXPECT_EQ(airOf(before, t), airOf(after, t));
  EXPECT_EQ(weightOf(after, "breeze", 51.3), 0.0);
  EXPECT_EQ(after.names(at(51.3)), std::vector<std::string>{"disk"});
}

TEST(PrimitiveSchedule, RemovesWhatHasNotBegunAltogether) {
  PrimitiveSchedule schedule = blowing();
  Primitive planned = fading(Kind::DISK, "planned");
  planned.t_on = at(100.0);
  schedule.set(planned, at(50.0));
  schedule.remove("planned", at(60.0));
  EXPECT_EQ(schedule.field().primitives().size(), 2u);
}

TEST(PrimitiveSchedule, RefusesToRemoveWhatIsNotThere) {
  PrimitiveSchedule schedule = blowing();
  const std::uint64_t hash = schedule.field().hash();
  try {
    schedule.remove("brezee", at(50.0));
    FAIL() << "removed it";
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(error.what(), "no source is named 'brezee'; known sources: disk, breeze");
  }
  EXPECT_EQ(schedule.field().hash(), hash);
}

TEST(PrimitiveSchedule, RefusesToChangeThePast) {  // N2
  PrimitiveSchedule schedule = blowing();
  const std::uint64_t hash = schedule.field().hash();
  Primitive p = fading(Kind::DISK, "disk");
  p.t_on = at(49.0);
  p.radius = -1.0;
  try {
    schedule.set(p, at(50.0));
    FAIL() << "took it";
  } catch (const InvalidInput& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("t_on = 49.000000 s is before 50.000000 s"), text.npos) << text;
    EXPECT_NE(text.find("radius = -1 m"), text.npos) << text;
  }
  EXPECT_EQ(schedule.field().hash(), hash);
}

TEST(PrimitiveSchedule, RefusesTwoSourcesOfOneNameAtTheStart) {
  PrimitiveSchedule schedule = blowing();
  EXPECT_THROW(schedule.start({fading(Kind::GUST, "disk")}), InvalidInput);
  EXPECT_EQ(schedule.field().primitives().size(), 2u);
}

TEST(PrimitiveSchedule, RefusesMoreThanAFieldHoldsAndChangesNothing) {
  PrimitiveSchedule schedule;
  for (std::size_t i = 0; i < MAX_PRIMITIVES; ++i)
    schedule.set(fading(Kind::DISK, "disk_" + std::to_string(i)), at(1.0));
  const std::uint64_t hash = schedule.field().hash();
  EXPECT_THROW(schedule.set(fading(Kind::DISK, "one_more"), at(1.0)), InvalidInput);
  EXPECT_THROW(schedule.set(fading(Kind::DISK, "disk_7"), at(9.0)), InvalidInput);
  EXPECT_EQ(schedule.field().hash(), hash);
}

TEST(PrimitiveSchedule, ForgetsWhatEndedHalfAMinuteAgo) {
  PrimitiveSchedule schedule = blowing();
  schedule.remove("disk", at(50.0));
  EXPECT_FALSE(schedule.prune(at(81.0)));
  EXPECT_TRUE(schedule.prune(at(81.1)));
  EXPECT_EQ(schedule.field().primitives().size(), 1u);
  EXPECT_FALSE(schedule.prune(at(1e6)));
}

TEST(PrimitiveSchedule, NeverGivesAnIdTwice) {
  PrimitiveSchedule schedule = blowing();
  const std::uint32_t first = schedule.set(fading(Kind::DISK, "a"), at(50.0)).id;
  schedule.remove("a", at(60.0));
  schedule.prune(at(1000.0));
  EXPECT_GT(schedule.set(fading(Kind::DISK, "a"), at(1000.0)).id, first);
}

PrimitiveSchedule read(const std::string& bytes, Nanoseconds shift = 0) {
  Archive input = Archive::reading(bytes, shift);
  PrimitiveSchedule out;
  out.archive(input);
  input.finish();
  return out;
}

TEST(PrimitiveSchedule, ContinuesFromItsBytesWithTheSameIds) {
  PrimitiveSchedule schedule = blowing();
  schedule.set(fading(Kind::GUST, "gust"), at(20.0));
  Archive a;
  schedule.archive(a);
  PrimitiveSchedule other = read(a.bytes());
  EXPECT_EQ(other.field().hash(), schedule.field().hash());
  for (PrimitiveSchedule* each : {&schedule, &other}) {
    each->remove("gust", at(30.0));
    each->set(fading(Kind::DISK, "disk"), at(30.0));
    EXPECT_EQ(each->field().primitives().back().id, 4u);
    each->prune(at(65.0));
  }
  EXPECT_EQ(other.field().hash(), schedule.field().hash());
  for (std::size_t size = 0; size < a.bytes().size(); ++size)
    EXPECT_THROW(read(a.bytes().substr(0, size)), InvalidInput) << size;
}

// A disk with an epoch moves and fades by its own stamps; a breeze is a function of the clock.
TEST(PrimitiveSchedule, DiskBlowsTheSameAtAnotherTime) {
  PrimitiveSchedule schedule(5);
  Primitive disk = fading(Kind::DISK, "disk");
  disk.epoch = disk.t_on = at(0.5);
  schedule.start({disk});
  PrimitiveSchedule copy = schedule;
  Archive a;
  copy.archive(a);
  const PrimitiveSchedule later = read(a.bytes(), at(7.0) - at(0.0));
  for (const double t : {1.0, 20.5})
    EXPECT_LT(length(airOf(later, t + 7.0) - airOf(schedule, t)), 1e-9) << t;
  EXPECT_GT(length(airOf(schedule, 20.5)), 0.0);
}

}  // namespace
}  // namespace vegetation_sim::wind
