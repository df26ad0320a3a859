// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "grass/tread_simulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error_text.h"
#include "scenes/grass/tread_simulation_fixture.h"

namespace vegetation_sim::grass {
namespace {

constexpr double RISEN = 0.005;  // of 1.5 rad, in the first 2 s of 60 s

// N4: a track as wide as the source, above the gate none.
TEST_F(FieldTest, ATrackIsAsWideAsItsSource) {
  drive("wheel", 5.0, 10.0, 1.0, 90);
  EXPECT_NEAR(map_.at({6.5, 10.1}, now()).tilt, 1.5, RISEN);
  EXPECT_GT(map_.at({6.5, 10.0}, now()).tilt, 1.4f);
  EXPECT_LT(map_.at({6.5, 10.3}, now()).tilt, 0.3f);
  EXPECT_EQ(map_.at({6.5, 10.4}, now()).tilt, 0.f);
}

// N4, N11: what hovers above its gate leaves no track.
TEST_F(FieldTest, AHoveringSourceLeavesNoTrack) {
  drive("drone", 5.0, 10.0, 1.0, 60, 0.35);
  EXPECT_TRUE(map_.state().blocks.empty());
  drive("drone", 7.0, 10.0, 1.0, 30, 0.25);  // it comes down below 0.3 m
  EXPECT_EQ(map_.at({6.0, 10.0}, now()).tilt, 0.f);
  EXPECT_NEAR(map_.at({7.5, 10.0}, now()).tilt, 1.5, RISEN);
  // The pass ends where it lifts: no track from there to where it lands again.
  drive("drone", 8.0, 10.0, 1.0, 30, 1.0);
  drive("drone", 9.0, 10.0, 1.0, 30, 0.0);
  EXPECT_EQ(map_.at({8.5, 10.0}, now()).tilt, 0.f);
  EXPECT_NEAR(map_.at({9.5, 10.0}, now()).tilt, 1.5, RISEN);
}

// S2-28: grass stays down below a standing source, also if it would recover sooner.
TEST_F(FieldTest, GrassStaysDownUnderAStandingFoot) {
  TreadInput foot = input("foot", 10.0, 10.0);
  foot.law.recovery = 2.0;
  for (int i = 0; i < 300; ++i) {
    ++tick_;
    if (i % 60 == 0) field_.apply(foot, now());
    field_.advance(now());
    ASSERT_GT(map_.at({10.0, 10.0}, now()).tilt, 1.4f) << i;
  }
  tick_ += 150;  // no input for 5 s, longer than its lease
  field_.advance(now());
  EXPECT_TRUE(field_.sources().empty());
  EXPECT_EQ(map_.at({10.0, 10.0}, now()).tilt, 0.f);
}

TEST_F(FieldTest, AStrokeIsOneWholePassHoweverLong) {  // S2-22: longer than longest_stroke
  TreadInput stroke = input("path", 18.0, 10.0, 0.0, TreadAction::STROKE);
  stroke.start = Vec3(2.0, 10.0, 0.0);
  EXPECT_EQ(field_.apply(stroke, now()), "");
  for (double x = 2.0; x <= 18.0; x += 0.5)
    EXPECT_NEAR(map_.at({x, 10.0}, now()).tilt, 1.5, RISEN) << x;
  EXPECT_TRUE(field_.sources().empty());
  EXPECT_EQ(map_.state().counts.jumps, 0u);
}

// One message must not stop the node: presses that cannot reach the map are skipped.
TEST_F(FieldTest, AStrokeCostsWhatItPressesOnTheMap) {
  TreadInput stroke = input("path", 9e6, 10.0, 0.0, TreadAction::STROKE);
  stroke.start = Vec3(-9e6, 10.0, 0.0);
  stroke.law.reach = 10.0;
  EXPECT_EQ(field_.apply(stroke, now()), "");
  EXPECT_LT(map_.state().counts.strokes + map_.state().counts.outside, 40u);
  EXPECT_NEAR(map_.at({10.0, 10.0}, now()).tilt, 1.5, RISEN);
  EXPECT_EQ(map_.state().counts.jumps, 0u);
  stroke.start = Vec3(-9e6, 2000.0, 0.0);  // it passes the map
  stroke.position.y() = 2000.0;
  const std::uint64_t before = map_.state().counts.outside;
  EXPECT_EQ(field_.apply(stroke, now()), "");
  EXPECT_EQ(map_.state().counts.outside, before);
}

TEST_F(FieldTest, AStrokeOfTooMuchWorkIsRejected) {
  TreadSettings settings;
  settings.longest_stroke = 0.01;
  TreadSimulation field(field_.layout(), std::make_shared<const terrain::HeightMap>(), settings,
                        map_);
  TreadInput stroke = input("path", 18.0, 10.0, 0.0, TreadAction::STROKE);
  stroke.start = Vec3(2.0, 10.0, 0.0);
  EXPECT_EQ(errorOf([&] { field.checkStroke(stroke); }), "");
  stroke.law.reach = 10.0;
  EXPECT_EQ(errorOf([&] { field.apply(stroke, now()); }),
            "stroke of source 'path': 520162618 nodes to press, more than the 50000000 allowed");
  EXPECT_TRUE(field.sources().empty());
}

// The work of a stroke and of a step is not less than the nodes that they press.
TEST_F(FieldTest, WorkIsAnUpperBoundOfThePressedNodes) {
  for (const double reach : {0.2, 1.0, 5.0})
    for (const double way : {0.0, 0.5, 3.0, 4.9, 12.0}) {
      TreadInput stroke =
          input("path", 10.0 + 0.6 * way, 9.0 + 0.8 * way, 0.0, TreadAction::STROKE);
      stroke.start = Vec3(10.0, 9.0, 0.0);
      stroke.law.radius = 0.1;
      stroke.law.reach = reach;
      const double pieces = 1.0 + std::floor(way / 2.5);
      TreadMap map = makeMap();
      double pressed = 0.0;
      for (double i = 0.0; i <= pieces; ++i) {
        const Vec3 to = stroke.start + (i / pieces) * (stroke.position - stroke.start);
        pressed += map.tread(1, stroke.law, {to.x(), to.y()}, now());
      }
      EXPECT_LE(pressed, field_.workOf(stroke)) << reach << " " << way;
      EXPECT_GT(pressed, 0.1 * field_.workOf(stroke)) << reach << " " << way;
      if (way >= 5.0) continue;
      TreadMap other = makeMap();
      stroke.action = TreadAction::PLACE;
      EXPECT_LE(other.tread(1, stroke.law, {10.0, 9.0}, now()), field_.workOf(stroke)) << reach;
      stroke.action = TreadAction::MOVE;
      EXPECT_LE(other.tread(1, stroke.law, {stroke.position.x(), stroke.position.y()}, now()),
                field_.workOf(stroke))
          << reach << " " << way;
    }
  EXPECT_EQ(field_.workOf(input("a", 0.0, 0.0, 0.0, TreadAction::LIFT)), 0.0);
}

TEST_F(FieldTest, ADiscOutOfRangeClearsNothing) {
  drive("a", 3.0, 5.0, 1.0, 20);
  const auto blocks = map_.state().blocks.size();
  for (const double radius : {std::nan(""), -1.0, 1e9})
    EXPECT_NE(errorOf([&] { field_.raise({3.0, 5.0}, radius); }), "") << radius;
  EXPECT_NE(errorOf([&] { field_.raise({std::nan(""), 5.0}, 1.0); }), "");
  EXPECT_EQ(map_.state().blocks.size(), blocks);
}

// S2-27, N4: a teleporting source leaves no track between, and it is said by name.
TEST_F(FieldTest, AJumpLeavesNoTrackAndIsNamed) {
  drive("robot", 3.0, 10.0, 1.0, 30);
  ++tick_;
  const std::string problem = field_.apply(input("robot", 15.0, 10.0), now());
  field_.advance(now());
  EXPECT_NE(problem.find("source 'robot' jumped by 11.03"), std::string::npos) << problem;
  EXPECT_NE(problem.find("longest_stroke = 5.0"), std::string::npos) << problem;
  EXPECT_EQ(map_.at({9.0, 10.0}, now()).tilt, 0.f);
  EXPECT_NEAR(map_.at({15.0, 10.0}, now()).tilt, 1.5, RISEN);
  EXPECT_EQ(field_.drags()[0].force, Vec3::Zero());
}

TEST_F(FieldTest, ReportsWhichSourceEnteredWhichTile) {
  field_.advance(now());
  std::vector<Entering> entered;
  const auto take = [&] {
    ++tick_;
    for (Entering& e : field_.advance(now())) entered.push_back(std::move(e));
  };
  for (const double x : {1.0, 1.5, 3.0, 8.0, -1.0, 0.5}) {
    field_.apply(input("mower", x, 5.0), now());
    take();
  }
  std::vector<int> columns;
  for (const Entering& e : entered) {
    EXPECT_EQ(e.source, "mower");
    EXPECT_EQ(e.row, 2);
    columns.push_back(e.column);
  }
  // Through 1 to 4 at one stroke of 5 m; a jump of 9 m comes from nowhere; off the map and on
  // again.
  EXPECT_EQ(columns, (std::vector<int>{0, 1, 2, 3, 4, 0}));
}

// N3: grows with density and speed; zero off the map, above the gate, where it stands.
TEST_F(FieldTest, DragGrowsWithDensityAndSpeed) {
  const auto drag = [&](double density, double speed, double z, double y) {
    MapInput map_input;
    map_input.law = mapLaw();
    map_input.density.value = density;
    Layout layout = layout_;
    layout.map = std::make_shared<const FeatureMap>(map_input);
    TreadMap map = makeMap();
    TreadSimulation field(layout, std::make_shared<const terrain::HeightMap>(), TreadSettings(),
                          map);
    for (int i = 0; i < 10; ++i)
      field.apply(input("wheel", 5.0 + speed * i / 30.0, y, z),
                  START + i * NANOSECONDS_PER_SECOND / 30);
    field.advance(START + 9 * NANOSECONDS_PER_SECOND / 30);
    EXPECT_EQ(field.drags().size(), 1u);
    EXPECT_EQ(field.drags()[0].body_frame, "wheel_link");
    return field.drags()[0].force;
  };
  // 2 * 0.12 m wide, 0.2 N s/m * 400 / m^2 * 0.3 m, 1 m/s.
  EXPECT_NEAR(drag(400.0, 1.0, 0.0, 10.0).x(), -0.24 * 0.2 * 400.0 * 0.3, 1e-4);
  EXPECT_NEAR(drag(800.0, 1.0, 0.0, 10.0).x(), 2.0 * drag(400.0, 1.0, 0.0, 10.0).x(), 1e-4);
  EXPECT_NEAR(drag(400.0, 2.0, 0.0, 10.0).x(), 2.0 * drag(400.0, 1.0, 0.0, 10.0).x(), 1e-4);
  EXPECT_EQ(drag(400.0, 1.0, 0.0, 10.0).y(), 0.0);
  for (const Vec3& none : {drag(400.0, 0.0, 0.0, 10.0), drag(0.0, 1.0, 0.0, 10.0),
                           drag(400.0, 1.0, 0.5, 10.0), drag(400.0, 1.0, 0.0, 25.0)})
    EXPECT_EQ(none, Vec3::Zero());
}

TEST_F(FieldTest, TroddenGrassResistsLess) {  // N3, N5
  const double fresh = field_.resistanceAt({7.0, 10.0}, now());
  EXPECT_NEAR(fresh, 0.2 * 400.0 * 0.3, 1e-9);
  drive("wheel", 5.0, 10.0, 1.0, 90);
  EXPECT_LT(field_.resistanceAt({7.0, 10.0}, now()), 0.01 * fresh);
  EXPECT_EQ(field_.resistanceAt({7.0, 25.0}, now()), 0.0);
}

TEST_F(FieldTest, SavedStateGoesOnAlike) {  // N6
  drive("a", 3.0, 5.0, 1.0, 40);
  const TreadSnapshot saved = field_.snapshot();
  TreadMap other_map = makeMap();
  TreadSimulation other = makeField(other_map);
  other.restore(saved);
  EXPECT_EQ(other.snapshot().hash(), saved.hash());
  for (int i = 0; i < 40; ++i) {
    ++tick_;
    for (TreadSimulation* field : {&field_, &other}) {
      field->apply(input("a", 4.3 + i / 30.0, 5.0), now());
      field->apply(input("b", 8.0, 8.0 + i / 20.0), now());
      field->advance(now());
    }
  }
  EXPECT_NE(field_.snapshot().hash(), saved.hash());
  EXPECT_EQ(other.snapshot().hash(), field_.snapshot().hash());
}

TEST_F(FieldTest, ADiscOrAllIsRaised) {
  drive("a", 3.0, 5.0, 2.0, 90);
  field_.raise({5.0, 5.0}, 0.5);
  EXPECT_EQ(map_.at({5.4, 5.0}, now()).tilt, 0.f);
  EXPECT_NEAR(map_.at({5.6, 5.0}, now()).tilt, 1.5, RISEN);
  field_.raiseAll();
  EXPECT_EQ(map_.at({5.6, 5.0}, now()).tilt, 0.f);
  EXPECT_TRUE(map_.state().blocks.empty());
}

TEST_F(FieldTest, RejectsOneSourceTooMany) {
  for (std::size_t i = 0; i < TreadSimulation::MOST_SOURCES; ++i)
    field_.apply(input("s" + std::to_string(i), 10.0, 10.0, 1.0), now());
  EXPECT_EQ(errorOf([&] { field_.apply(input("x", 1.0, 1.0), now()); }),
            "source 'x' is one more than the 4096 allowed at once");
}

TEST(TreadInputTest, EveryFaultIsNamed) {
  TreadInput bad;
  bad.action = static_cast<TreadAction>(7);
  bad.position = Vec3(std::nan(""), 0.0, 2e7);
  bad.velocity = Vec3(std::numeric_limits<double>::infinity(), 0.0, 0.0);
  bad.law.radius = -1.0;
  bad.height_gate = -0.1;
  Faults faults;
  check(bad, "tread: ", faults);
  for (const char* part : {"tread: source = '' has 0 letters", "action = 7 is outside 0 to 3",
                           "position.x = nan", "position.z = ", "velocity.x = inf", "radius = -1 m",
                           "height_gate = -0.1 m is outside 0 to 1000 m"})
    EXPECT_NE(faults.text().find(part), std::string::npos) << part << " in " << faults.text();
}

}  // namespace
}  // namespace vegetation_sim::grass
