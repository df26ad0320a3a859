// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "wind/schedule/attachment.h"

#include <gtest/gtest.h>

#include "scenes/wind/wind_examples.h"
#include "vegetation_sim/core/math/math.h"
#include "wind/schedule/primitive_schedule.h"

namespace vegetation_sim::wind {
namespace {

constexpr double PERIOD = 0.2, HORIZON = 2.0, LEAD = 0.2;

/// A drone that circles at 5 m/s, 20 m from the origin.
Vec3 drone(double t) {
  const SinCos turn = sinCos(0.25 * t);
  return {20.0 * turn.cos, 20.0 * turn.sin, 6.0};
}

Source downwash() {
  Source source{example(Kind::BLAST, "downwash"), "drone"};
  source.primitive.fade_in = source.primitive.fade_out = 1.0;
  source.primitive.core_radius = 1.0;
  source.primitive.radius = 6.0;
  return source;
}

/// Follows the drone from one time to another as the broadcaster does.
void follow(Attachment& attachment, PrimitiveSchedule& schedule, double from, double to) {
  for (double t = from; t < to; t += PERIOD) {
    attachment.add({at(t), drone(t)});
    const bool goes_on = attachment.started();
    if (const auto piece = attachment.piece(at(t + LEAD)))
      goes_on ? schedule.follow(*piece, at(t + LEAD)) : schedule.set(*piece, at(t + LEAD));
    schedule.prune(at(t));
  }
}

TEST(Attachment, KeepsTheCentreOnTheFrame) {  // S1-W1, N12
  Attachment attachment(downwash(), PERIOD, HORIZON);
  PrimitiveSchedule schedule;
  for (double t = 0.0; t < 30.0; t += PERIOD) {
    follow(attachment, schedule, t, t + 0.5 * PERIOD);
    if (t < 3.0) continue;
    const Instant now = schedule.field().at(at(t + 0.1));
    ASSERT_GE(now.terms.size(), 1u);
    double weight = 0.0;
    Vec3 centre = Vec3::Zero();
    for (const Term& term : now.terms) {
      centre += term.centre * term.speed / 10.0;
      weight += term.speed / 10.0;
    }
    EXPECT_NEAR(weight, 1.0, 1e-7) << t;
    // Half the acceleration, 1.25 m/s^2, times the square of 0.6 s that a piece extrapolates.
    EXPECT_LT(length(centre / weight - drone(t + 0.1)), 0.3) << t;
  }
}

TEST(Attachment, BlowsSmoothlyThroughItsPieces) {  // E1
  Attachment attachment(downwash(), PERIOD, HORIZON);
  PrimitiveSchedule schedule;
  follow(attachment, schedule, 0.0, 4.5);
  const Vec3 position = drone(3.0) + Vec3(0.5, 0.5, -1.0);
  const double h = 1e-4;
  for (double t = 1.0; t < 4.0; t += h) {
    const Vec3 step =
        schedule.field().velocity(position, at(t + h)) - schedule.field().velocity(position, at(t));
    // 5 m/s through a slope of 20 (m/s)/m, and cross-fades of pieces 0.3 m apart
    ASSERT_LT(length(step), h * 300.0) << t;
  }
}

TEST(Attachment, FadesOutAfterTheFrameIsLost) {  // S1-W1
  Attachment attachment(downwash(), PERIOD, HORIZON);
  PrimitiveSchedule schedule;
  follow(attachment, schedule, 0.0, 9.9);  // last at 9.8 s
  EXPECT_FALSE(schedule.field().at(at(11.0)).terms.empty());
  EXPECT_TRUE(schedule.field().at(at(9.8 + HORIZON + 0.01)).terms.empty());
  EXPECT_FALSE(attachment.piece(at(11.5)));
}

TEST(Attachment, FadesInAnewWhenTheFrameComesBack) {
  Attachment attachment(downwash(), PERIOD, HORIZON);
  PrimitiveSchedule schedule;
  follow(attachment, schedule, 0.0, 9.9);  // last at 9.8 s
  attachment.add({at(20.0), drone(20.0)});
  EXPECT_FALSE(attachment.piece(at(20.2)));  // one sample has no velocity
  attachment.add({at(20.2), drone(20.2)});
  EXPECT_FALSE(attachment.started());
  EXPECT_EQ(attachment.piece(at(20.4))->fade_in, 1.0);
}

TEST(Attachment, StartsAnewAfterAStepThatIsFasterThanAnyBody) {
  Attachment attachment(downwash(), PERIOD, HORIZON);
  PrimitiveSchedule schedule;
  follow(attachment, schedule, 0.0, 3.1);  // last at 3.0 s
  const Vec3 far = drone(3.0) + Vec3(0.0, 41.0, 0.0);
  EXPECT_NEAR(attachment.add({at(3.2), far}).value_or(0.0), 205.0, 1e-6);
  EXPECT_FALSE(attachment.piece(at(3.4)));
  EXPECT_FALSE(attachment.add({at(3.4), far}));
  EXPECT_FALSE(attachment.started());
  const auto piece = attachment.piece(at(3.6));
  ASSERT_TRUE(piece);
  for (const Waypoint& point : piece->trajectory) EXPECT_EQ(point.position, far);
  EXPECT_FALSE(attachment.add({at(3.6), far + Vec3(39.0, 0.0, 0.0)}));
  EXPECT_FALSE(attachment.add({at(9.0), drone(9.0) - Vec3(9e5, 0.0, 0.0)}));  // a gap
}

/// A car that drives as the drone flies.
Source wake() {
  Source source{example(Kind::WAKE, "wake"), "car"};
  source.primitive.fade_in = source.primitive.fade_out = 1.0;
  source.primitive.radius = 0.8;
  source.primitive.inflow = 0.25;
  source.primitive.plateau_length = 12.0;
  source.primitive.decay_length = 6.0;
  return source;
}

// The bound knows no later piece, but that the frame turns.
TEST(Attachment, IsBoundedASecondAheadOnACircle) {  // S1-40
  Attachment attachment(wake(), PERIOD, HORIZON);
  PrimitiveSchedule schedule;
  follow(attachment, schedule, 0.0, 3.9);
  for (double t = 4.0; t < 12.0; t += PERIOD) {
    follow(attachment, schedule, t, t + 0.5 * PERIOD);
    const Instant now = schedule.field().at(at(t));
    PrimitiveSchedule later = schedule;
    Attachment on = attachment;
    follow(on, later, t + PERIOD, t + 1.0);
    for (double then = t; then <= t + 1.0; then += 0.05)
      for (double behind = 0.0; behind < 18.0; behind += 0.5)
        for (const double beside : {-1.5, 0.0, 1.5}) {
          const SinCos turn = sinCos(0.25 * then);
          const Vec3 n(-turn.sin, turn.cos, 0.0), side(turn.cos, turn.sin, 0.0);
          const Vec3 place = drone(then) - n * behind + side * beside;
          ASSERT_LE(length(later.field().velocity(place, at(then))), now.speedBound(place, 0.0))
              << "at " << t << " for " << then << ", " << behind << " m behind";
        }
  }
}

TEST(Attachment, IgnoresOldSamples) {
  Attachment attachment(downwash(), PERIOD, HORIZON);
  attachment.add({at(1.0), drone(1.0)});
  attachment.add({at(1.0), drone(1.0)});
  attachment.add({at(0.5), drone(0.5)});
  EXPECT_FALSE(attachment.piece(at(1.2)));
}

TEST(Attachment, KeepsTheTimesOfItsSource) {
  Source source = downwash();
  source.primitive.t_on = at(5.0);
  source.primitive.t_off = at(10.0);
  Attachment attachment(source, PERIOD, HORIZON);
  PrimitiveSchedule schedule;
  follow(attachment, schedule, 0.0, 12.0);
  EXPECT_TRUE(schedule.field().at(at(4.9)).terms.empty());
  EXPECT_FALSE(schedule.field().at(at(9.8)).terms.empty());
  EXPECT_TRUE(schedule.field().at(at(10.0)).terms.empty());
}

TEST(Attachment, NeedsFewPrimitivesHoweverLongItFlies) {
  Attachment attachment(downwash(), PERIOD, HORIZON);
  PrimitiveSchedule schedule;
  follow(attachment, schedule, 0.0, 100.0);
  EXPECT_LT(schedule.field().primitives().size(),
            35u);  // 5 s of pieces at 5 Hz and the active ones
}

}  // namespace
}  // namespace vegetation_sim::wind
