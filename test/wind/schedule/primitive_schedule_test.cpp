// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "wind/schedule/primitive_schedule.h"

#include <gtest/gtest.h>

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

/// A ledger with a disk and a breeze that have blown for long.
Ledger blowing() {
  Ledger ledger(5);
  ledger.start({fading(Kind::DISK, "disk"), fading(Kind::BREEZE, "breeze")});
  return ledger;
}

Vec3 airOf(const Ledger& ledger, double t) {
  return ledger.field().velocity(Vec3(2.0, 1.0, 3.0), at(t));
}

double weightOf(const Ledger& ledger, const std::string& name, double t) {
  double sum = 0.0;
  for (const Primitive& p : ledger.field().primitives())
    if (p.name == name) sum += fade(p, at(t));
  return sum;
}

TEST(Ledger, EditChangesNothingBeforeItTakesEffect) {  // N2
  const Ledger before = blowing();
  Ledger after = before;
  Primitive stronger = fading(Kind::BREEZE, "breeze");
  stronger.velocity = Vec3(0.0, 11.0, 0.0);
  const Primitive published = after.set(stronger, at(50.2));
  EXPECT_EQ(published.t_on, at(50.2));
  for (double t = 0.0; t <= 50.2; t += 0.1) EXPECT_EQ(airOf(before, t), airOf(after, t)) << t;
  EXPECT_NE(airOf(before, 50.8), airOf(after, 50.8));
}

TEST(Ledger, EditStepsNothing) {  // N2
  Ledger ledger = blowing();
  Primitive stronger = fading(Kind::BREEZE, "breeze");
  stronger.velocity = Vec3(0.0, 11.0, 0.0);
  ledger.set(stronger, at(50.2));
  const double h = 1e-4;  // the fade's steepest slope, 1.9 / s, times 13 m/s, and turbulence
  for (double t = 50.0; t < 51.5; t += h)
    EXPECT_LT(length(airOf(ledger, t + h) - airOf(ledger, t)), h * 60.0) << t;
}

TEST(Ledger, EditThatChangesNothingChangesNothing) {  // N2
  const Ledger before = blowing();
  Ledger after = before;
  after.set(fading(Kind::BREEZE, "breeze"), at(50.2));
  after.set(fading(Kind::DISK, "disk"), at(50.7));
  for (double t = 40.0; t < 60.0; t += 0.013)
    EXPECT_LT(length(airOf(before, t) - airOf(after, t)), 1e-13) << t;
}

TEST(Ledger, FadesOverTheLongerOfBothTimes) {
  Ledger ledger = blowing();
  Primitive slow = fading(Kind::DISK, "disk");
  slow.fade_in = 4.0;
  EXPECT_EQ(ledger.set(slow, at(50.0)).fade_in, 4.0);
  EXPECT_EQ(ledger.field().primitives()[0].fade_out, 4.0);
  EXPECT_EQ(ledger.field().primitives()[0].t_off, at(54.0));
}

TEST(Ledger, ManyQuickEditsNeverAddUpToMoreThanOneSource) {  // N2
  Ledger ledger = blowing();
  const Random random(1);
  for (std::uint64_t i = 0; i < 200; ++i) {  // a slider that is dragged at 20 Hz
    Primitive p = fading(Kind::BREEZE, "breeze");
    p.velocity = Vec3(random.uniform(i, 1.0, 9.0), 0.0, 0.0);
    ledger.set(p, at(50.2 + 0.05 * static_cast<double>(i)));
  }
  for (double t = 45.0; t < 70.0; t += 0.01) EXPECT_NEAR(weightOf(ledger, "breeze", t), 1.0, 1e-12);
  EXPECT_EQ(ledger.find("breeze", at(70.0))->velocity.x(), random.uniform(199, 1.0, 9.0));
  EXPECT_LT(ledger.field().primitives().size(), 20u);
}

// An edit waits for the fade-in before it, says so by its t_on, and never for long.
TEST(Ledger, EditWaitsForTheChangeBeforeItWithinALimit) {  // N2
  Ledger ledger = blowing();
  Primitive slow = fading(Kind::DISK, "disk");
  slow.fade_in = 100.0;
  EXPECT_EQ(ledger.set(slow, at(50.0)).t_on, at(50.0));
  const std::uint64_t hash = ledger.field().hash();
  try {
    ledger.set(fading(Kind::DISK, "disk"), at(119.9));
    FAIL() << "took it";
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(
        error.what(),
        "primitive 'disk' is still fading in until 150.000000 s; an edit waits for that at "
        "most 30.000000 s");
  }
  EXPECT_EQ(ledger.field().hash(), hash);
  EXPECT_EQ(ledger.set(fading(Kind::DISK, "disk"), at(120.0)).t_on, at(150.0));
  EXPECT_EQ(ledger.set(fading(Kind::DISK, "disk"), at(150.0)).t_on, at(150.0));
  for (double t = 45.0; t < 170.0; t += 0.1) EXPECT_NEAR(weightOf(ledger, "disk", t), 1.0, 1e-12);
}

// What is fading in can be ended at once.
TEST(Ledger, RemovingNeverWaits) {
  Ledger ledger = blowing();
  Primitive slow = fading(Kind::DISK, "slow");
  slow.fade_in = 100.0;
  ledger.set(slow, at(50.0));
  ledger.remove("slow", at(60.0));
  EXPECT_EQ(weightOf(ledger, "slow", 61.0), 0.0);
}

TEST(Ledger, LaterEditReplacesOneThatHasNotBegun) {
  Ledger ledger = blowing();
  Primitive planned = fading(Kind::DISK, "disk");
  planned.t_on = at(100.0);
  ledger.set(planned, at(50.0));
  ledger.set(fading(Kind::DISK, "disk"), at(60.0));
  EXPECT_EQ(ledger.field().primitives().size(), 3u);
  for (double t = 45.0; t < 120.0; t += 0.1) EXPECT_NEAR(weightOf(ledger, "disk", t), 1.0, 1e-12);
}

TEST(Ledger, GivesEpochOfTheReplacedSourceOfTheSameKind) {
  Ledger ledger = blowing();
  Primitive first = fading(Kind::DISK, "late");
  EXPECT_EQ(ledger.set(first, at(50.0)).epoch, at(50.0));
  EXPECT_EQ(ledger.set(first, at(60.0)).epoch, at(50.0));
  EXPECT_EQ(ledger.set(fading(Kind::BLAST, "late"), at(70.0)).epoch, at(70.0));
  first.epoch = at(3.0);
  EXPECT_EQ(ledger.set(first, at(80.0)).epoch, at(3.0));
}

TEST(Ledger, LeavesASourceThatIsFadingOutAlone) {
  Ledger ledger;
  Primitive ending = fading(Kind::DISK, "disk");
  ending.t_off = at(50.5);
  ledger.start({ending});
  const Ledger before = ledger;
  ledger.set(fading(Kind::DISK, "disk"), at(50.0));
  EXPECT_EQ(ledger.field().primitives()[0].t_off, at(50.5));
  for (double t = 45.0; t < 50.0; t += 0.1) EXPECT_EQ(airOf(before, t), airOf(ledger, t));
}

TEST(Ledger, RemovesSmoothlyAndNotBeforeTheStamp) {
  const Ledger before = blowing();
  Ledger after = before;
  after.remove("breeze", at(50.2));
  for (double t = 45.0; t <= 50.2; t += 0.1) EXPECT_EQ(airOf(before, t), airOf(after, t));
  EXPECT_EQ(weightOf(after, "breeze", 51.3), 0.0);
  EXPECT_EQ(after.names(at(51.3)), std::vector<std::string>{"disk"});
}

TEST(Ledger, RemovesWhatHasNotBegunAltogether) {
  Ledger ledger = blowing();
  Primitive planned = fading(Kind::DISK, "planned");
  planned.t_on = at(100.0);
  ledger.set(planned, at(50.0));
  ledger.remove("planned", at(60.0));
  EXPECT_EQ(ledger.field().primitives().size(), 2u);
}

TEST(Ledger, RefusesToRemoveWhatIsNotThere) {
  Ledger ledger = blowing();
  const std::uint64_t hash = ledger.field().hash();
  try {
    ledger.remove("brezee", at(50.0));
    FAIL() << "removed it";
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(error.what(), "no source is named 'brezee'; there is disk, breeze");
  }
  EXPECT_EQ(ledger.field().hash(), hash);
}

TEST(Ledger, RefusesToChangeThePast) {  // N2
  Ledger ledger = blowing();
  const std::uint64_t hash = ledger.field().hash();
  Primitive p = fading(Kind::DISK, "disk");
  p.t_on = at(49.0);
  p.radius = -1.0;
  try {
    ledger.set(p, at(50.0));
    FAIL() << "took it";
  } catch (const InvalidInput& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("t_on = 49.000000 s is before 50.000000 s"), text.npos) << text;
    EXPECT_NE(text.find("radius = -1 m"), text.npos) << text;
  }
  EXPECT_EQ(ledger.field().hash(), hash);
}

TEST(Ledger, RefusesTwoSourcesOfOneNameAtTheStart) {
  Ledger ledger = blowing();
  EXPECT_THROW(ledger.start({fading(Kind::GUST, "disk")}), InvalidInput);
  EXPECT_EQ(ledger.field().primitives().size(), 2u);
}

TEST(Ledger, RefusesMoreThanAFieldHoldsAndChangesNothing) {
  Ledger ledger;
  for (std::size_t i = 0; i < MAX_PRIMITIVES; ++i)
    ledger.set(fading(Kind::DISK, "disk_" + std::to_string(i)), at(1.0));
  const std::uint64_t hash = ledger.field().hash();
  EXPECT_THROW(ledger.set(fading(Kind::DISK, "one_more"), at(1.0)), InvalidInput);
  EXPECT_THROW(ledger.set(fading(Kind::DISK, "disk_7"), at(9.0)), InvalidInput);
  EXPECT_EQ(ledger.field().hash(), hash);
}

TEST(Ledger, ForgetsWhatEndedHalfAMinuteAgo) {
  Ledger ledger = blowing();
  ledger.remove("disk", at(50.0));
  EXPECT_FALSE(ledger.prune(at(81.0)));
  EXPECT_TRUE(ledger.prune(at(81.1)));
  EXPECT_EQ(ledger.field().primitives().size(), 1u);
  EXPECT_FALSE(ledger.prune(at(1e6)));
}

TEST(Ledger, NeverGivesAnIdTwice) {
  Ledger ledger = blowing();
  const std::uint32_t first = ledger.set(fading(Kind::DISK, "a"), at(50.0)).id;
  ledger.remove("a", at(60.0));
  ledger.prune(at(1000.0));
  EXPECT_GT(ledger.set(fading(Kind::DISK, "a"), at(1000.0)).id, first);
}

}  // namespace
}  // namespace vegetation_sim::wind
