// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/wind/primitive.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "scenes/wind/wind_examples.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/wind/source.h"
#include "wind/limits.h"

namespace vegetation_sim::wind {
namespace {

constexpr double NAN_VALUE = std::numeric_limits<double>::quiet_NaN();
constexpr double INF_VALUE = std::numeric_limits<double>::infinity();

std::string faultsOf(const Primitive& p) {
  Faults faults;
  check(p, faults);
  return faults.text();
}

struct NumberCase {
  std::string name;
  Kind kind;
  std::function<double&(Primitive&)> field;
  double low, high;
};

void PrintTo(const NumberCase& number, std::ostream* out) {
  *out << number.name;
}

const std::vector<NumberCase> NUMBERS = {
    {"fade_in", Kind::DISK, [](Primitive& p) -> double& { return p.fade_in; }, 0.0, 600.0},
    {"fade_out", Kind::BREEZE, [](Primitive& p) -> double& { return p.fade_out; }, 0.0, 600.0},
    {"orbit_radius", Kind::GUST, [](Primitive& p) -> double& { return p.orbit_radius; }, 0.0, 1e5},
    {"orbit_period", Kind::BLAST, [](Primitive& p) -> double& { return p.orbit_period; }, 0.0, 1e6},
    {"velocity.x", Kind::DISK, [](Primitive& p) -> double& { return p.velocity.x(); }, -200.0,
     200.0},
    {"velocity.y", Kind::BREEZE, [](Primitive& p) -> double& { return p.velocity.y(); }, -200.0,
     200.0},
    {"velocity.z", Kind::GUST, [](Primitive& p) -> double& { return p.velocity.z(); }, -200.0,
     200.0},
    {"radius", Kind::DISK, [](Primitive& p) -> double& { return p.radius; }, 0.01, 1e5},
    {"radius", Kind::GUST, [](Primitive& p) -> double& { return p.radius; }, 0.01, 1e5},
    {"radius", Kind::TORNADO, [](Primitive& p) -> double& { return p.radius; }, 0.01, 1e5},
    {"radius", Kind::BLAST, [](Primitive& p) -> double& { return p.radius; }, 0.01, 1e5},
    {"omega", Kind::DISK, [](Primitive& p) -> double& { return p.omega; }, 0.0, 100.0},
    {"phase", Kind::DISK, [](Primitive& p) -> double& { return p.phase; }, -100.0, 100.0},
    {"turbulence", Kind::BREEZE, [](Primitive& p) -> double& { return p.turbulence; }, 0.0, 1.0},
    {"length_scale", Kind::BREEZE, [](Primitive& p) -> double& { return p.length_scale; }, 1.0,
     1000.0},
    {"front_speed", Kind::GUST, [](Primitive& p) -> double& { return p.front_speed; }, 0.0, 200.0},
    {"rise_length", Kind::GUST, [](Primitive& p) -> double& { return p.rise_length; }, 0.01, 1e4},
    {"plateau_length", Kind::GUST, [](Primitive& p) -> double& { return p.plateau_length; }, 0.0,
     1e4},
    {"decay_length", Kind::GUST, [](Primitive& p) -> double& { return p.decay_length; }, 0.01, 1e4},
    {"repeat", Kind::GUST, [](Primitive& p) -> double& { return p.repeat; }, 0.0, 1e6},
    {"speed", Kind::TORNADO, [](Primitive& p) -> double& { return p.speed; }, -200.0, 200.0},
    {"speed", Kind::BLAST, [](Primitive& p) -> double& { return p.speed; }, -200.0, 200.0},
    {"core_radius", Kind::TORNADO, [](Primitive& p) -> double& { return p.core_radius; }, 0.01,
     1e4},
    {"inflow", Kind::TORNADO, [](Primitive& p) -> double& { return p.inflow; }, -2.0, 2.0},
    {"inflow", Kind::WAKE, [](Primitive& p) -> double& { return p.inflow; }, -2.0, 2.0},
    {"radius", Kind::WAKE, [](Primitive& p) -> double& { return p.radius; }, 0.01, 1e5},
    {"plateau_length", Kind::WAKE, [](Primitive& p) -> double& { return p.plateau_length; }, 0.0,
     1e4},
    {"decay_length", Kind::WAKE, [](Primitive& p) -> double& { return p.decay_length; }, 0.01, 1e4},
    {"turbulence", Kind::GAUSS_MARKOV, [](Primitive& p) -> double& { return p.turbulence; }, 0.0,
     1.0},
    {"time_scale", Kind::GAUSS_MARKOV, [](Primitive& p) -> double& { return p.time_scale; }, 0.1,
     600.0},
    {"updraft", Kind::TORNADO, [](Primitive& p) -> double& { return p.updraft; }, -2.0, 2.0}};

class EveryNumber : public testing::TestWithParam<NumberCase> {};

TEST_P(EveryNumber, IsRejectedWithItsNameOutsideItsRange) {  // N2
  const NumberCase& number = GetParam();
  const double wide = 1.0 + std::fabs(number.high);
  for (const double bad : {NAN_VALUE, INF_VALUE, -INF_VALUE, number.low - 0.001, number.high * 1.1,
                           -wide, 10.0 * wide}) {
    Primitive p = example(number.kind);
    number.field(p) = bad;
    const std::string fault = faultsOf(p);
    EXPECT_NE(fault.find("'source': " + number.name + " = "), fault.npos) << bad << ": " << fault;
    EXPECT_EQ(fault.find('\n'), fault.npos) << fault;
  }
}

TEST_P(EveryNumber, IsTakenAtBothEndsOfItsRange) {
  const NumberCase& number = GetParam();
  for (const double good : {number.low, number.high}) {
    Primitive p = example(number.kind);
    p.velocity.y() = 1.0;
    number.field(p) = good;
    EXPECT_EQ(faultsOf(p), "");
    EXPECT_NO_THROW(Field{{p}});
  }
}

INSTANTIATE_TEST_SUITE_P(Primitive, EveryNumber, testing::ValuesIn(NUMBERS));

TEST(Check, TakesOneOfEach) {
  for (const Primitive& p : oneOfEach()) EXPECT_EQ(faultsOf(p), "");
}

TEST(Check, AllowsOddNumbersOnlyWhereTheKindDoesNotUseThem) {
  Primitive p = example(Kind::BREEZE);
  p.core_radius = 0.0;  // as in a message that a user left blank
  EXPECT_EQ(faultsOf(p), "");
  p.core_radius = NAN_VALUE;
  EXPECT_NE(faultsOf(p).find("core_radius = nan"), std::string::npos) << faultsOf(p);
}

TEST(Check, RefusesAnUnknownKind) {
  Primitive p = example(Kind::DISK);
  p.kind = static_cast<Kind>(7);
  EXPECT_EQ(
      faultsOf(p),
      "primitive 'source': kind = 7 is none of 0 (disk), 1 (breeze), 2 (gust), 3 (tornado), 4 "
      "(blast), 5 (wake), 6 (gauss_markov)");
}

TEST(Check, RefusesAnUnknownEnvelope) {
  Primitive p = example(Kind::DISK);
  p.envelope = static_cast<Envelope>(7);
  EXPECT_EQ(faultsOf(p), "primitive 'source': envelope = 7 is none of 0 (smooth), 1 (paper)");
}

TEST(Check, RefusesNamesThatAreEmptyOrEndless) {
  Primitive p = example(Kind::DISK, "");
  EXPECT_EQ(faultsOf(p), "primitive 1: name is empty");
  p.name = std::string(MAX_NAME + 1, 'x');
  EXPECT_EQ(faultsOf(p), "primitive 1: name has 129 characters, allowed are 128");
}

TEST(Check, RefusesAnEndThatIsNotAfterTheStart) {
  Primitive p = example(Kind::DISK);
  p.t_on = at(5.0);
  p.t_off = at(5.0);
  EXPECT_EQ(faultsOf(p), "primitive 'source': t_off = 5.000000 s is not after t_on = 5.000000 s");
}

TEST(Check, RefusesStampsThatRosTimeCannotHold) {
  for (Nanoseconds Primitive::*stamp : {&Primitive::epoch, &Primitive::t_on, &Primitive::t_off}) {
    for (const Nanoseconds bad : {Nanoseconds{-1}, LAST_STAMP + 1}) {
      Primitive p = example(Kind::DISK);
      p.*stamp = bad;
      EXPECT_NE(faultsOf(p).find("is outside 0 to 4294967295"), std::string::npos) << faultsOf(p);
    }
  }
}

TEST(Check, RefusesWayPointsOutOfOrderOrOutOfTheWorld) {
  Primitive p = example(Kind::DISK);
  p.trajectory = {{at(2.0), Vec3::Zero()}, {at(2.0), Vec3(0.0, NAN_VALUE, 2e6)}};
  const std::string faults = faultsOf(p);
  EXPECT_NE(faults.find("trajectory[1].stamp = 2.000000 s is not after"), faults.npos) << faults;
  EXPECT_NE(faults.find("trajectory[1].position.y = nan m is not finite"), faults.npos) << faults;
  EXPECT_NE(faults.find("trajectory[1].position.z = 2e+06 m is outside"), faults.npos) << faults;
}

TEST(Check, RefusesMoreWayPointsThanAllowed) {
  Primitive p = example(Kind::DISK);
  p.trajectory.resize(MAX_WAYPOINTS + 1);
  EXPECT_EQ(faultsOf(p), "primitive 'source': trajectory has 4097 way points, allowed are 4096");
}

TEST(Check, WantsAPeriodOnlyOfASourceThatOrbits) {
  Primitive p = example(Kind::DISK);
  p.orbit_period = 0.0;  // as in a message that a user left blank
  EXPECT_EQ(faultsOf(p), "");
  p.orbit_radius = 1.0;
  EXPECT_EQ(faultsOf(p), "primitive 'source': orbit_period = 0 s is outside 0.1 to 1e+06 s");
}

TEST(Check, RefusesAGustWithoutDirection) {
  Primitive p = example(Kind::GUST);
  p.velocity = Vec3(0.0, 0.0, 5.0);
  EXPECT_NE(faultsOf(p).find("velocity has no horizontal part"), std::string::npos);
}

TEST(CheckSource, RefusesAFrameTogetherWithWhatItReplaces) {
  Source source{example(Kind::BREEZE), "/drone"};
  source.primitive.trajectory = {{0, Vec3::Zero()}};
  Faults faults;
  check(source, faults);
  EXPECT_EQ(faults.list().size(), 3u) << faults.text();
  source = {example(Kind::BLAST), "drone"};
  Faults none;
  check(source, none);
  EXPECT_TRUE(none.empty()) << none.text();
}

TEST(CheckSource, RefusesAWakeWhoseCentreNeverMoves) {  // N11
  const auto faultsOfWake = [](const std::function<void(Source&)>& change) {
    Source source{example(Kind::WAKE), ""};
    source.primitive.trajectory = {{0, Vec3::Zero()}};
    change(source);
    Faults faults;
    check(source, faults);
    return faults.text();
  };
  EXPECT_EQ(faultsOfWake([](Source&) {}),
            "primitive 'source': attached_frame, orbit_radius and a trajectory of two way points "
            "are missing, so the centre never moves and has no wake");
  EXPECT_EQ(faultsOfWake([](Source& s) { s.primitive.orbit_radius = 3.0; }), "");
  EXPECT_EQ(faultsOfWake([](Source& s) {
              s.primitive.trajectory.push_back({at(1.0), Vec3::UnitX()});
            }),
            "");
  EXPECT_EQ(faultsOfWake([](Source& s) {
              s.primitive.trajectory.clear();
              s.attached_frame = "car";
            }),
            "");
}

TEST(StartedAt, ShiftsEveryStampButForEver) {
  Source source{oneOfEach()[0], ""};
  const Primitive moved = startedAt(source, at(100.0)).primitive;
  EXPECT_EQ(moved.epoch, at(100.5));
  EXPECT_EQ(moved.t_on, at(101.0));
  EXPECT_EQ(moved.t_off, at(140.0));
  EXPECT_EQ(moved.trajectory[1].stamp, at(108.0));
  source.primitive.t_off = 0;
  EXPECT_EQ(startedAt(source, at(100.0)).primitive.t_off, 0);
}

TEST(PrimitiveCheck, RejectsAWakeOfABodyThatIsTooFast) {
  Primitive p = example(Kind::WAKE);
  p.trajectory = {{at(1.0), Vec3(0.0, 0.0, 0.0)},
                  {at(2.0), Vec3(200.0, 0.0, 900.0)},
                  {at(3.0), Vec3(200.0, 201.0, 0.0)}};
  p.orbit_radius = 100.0;
  p.orbit_period = 2.0 * PI;
  EXPECT_EQ(faultsOf(p),
            "primitive 'source': speed to trajectory[2] = 201 m/s is outside 0 to 200 m/s");
  p.trajectory.pop_back();
  EXPECT_EQ(faultsOf(p), "");
  p.orbit_radius = 202.0;
  EXPECT_EQ(faultsOf(p),
            "primitive 'source': speed on the orbit = 202 m/s is outside 0 to 200 m/s");
  p.kind = Kind::BLAST;
  EXPECT_EQ(faultsOf(p), "");
}

}  // namespace
}  // namespace vegetation_sim::wind
