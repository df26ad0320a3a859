// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/dynamics/modes/modal_motion.h"

#include <gtest/gtest.h>

#include "scenes/dynamics/chain_fixture.h"

namespace vegetation_sim::physics {
namespace {

Modes oscillator(double frequency, double damping) {
  Modes out;
  out.length = 2;
  out.frequency = {frequency};
  out.damping = {damping};
  out.shape = {1.0, 0.0};
  return out;
}

// Closed form of a free oscillator, by the complex roots.
double freeAmplitude(double w, double c, double a, double b, double t) {
  const double d = w * w - 0.25 * c * c;
  if (d > 0.0) {
    const double v = std::sqrt(d);
    return std::exp(-0.5 * c * t) * (a * std::cos(v * t) + (b + 0.5 * c * a) / v * std::sin(v * t));
  }
  const double v = std::sqrt(-d), p = -0.5 * c + v, q = -0.5 * c - v;
  return ((b - q * a) * std::exp(p * t) - (b - p * a) * std::exp(q * t)) / (p - q);
}

// N13: exact for any step: slow and fast, light and over-damped, short and long steps.
TEST(ModalStepper, IsExactForAnyStep) {
  for (const double w : {0.5, 10.0, 900.0})
    for (const double ratio : {0.0, 0.05, 0.7, 3.0})
      for (const double h : {1e-4, 1.0 / 60.0, 0.3}) {
        ModalStepper stepper(oscillator(w, 2.0 * ratio * w));
        ModalState state{{0.3}, {1.7}};
        const std::vector<double> none{0.0};
        for (int i = 1; i <= 40; ++i) {
          stepper.step(none, none, h, state);
          const double exact = freeAmplitude(w, 2.0 * ratio * w, 0.3, 1.7, i * h);
          // Each of 40 steps squares up to 13 times: 40 * 2^13 roundings at most, usually none.
          ASSERT_NEAR(state.amplitude[0], exact, 1e-9 * (0.3 + 1.7 / w)) << w << " " << ratio;
        }
      }
}

// Loads that change linearly are integrated exactly, so one long step equals many short ones.
TEST(ModalStepper, TakesLinearLoadsInOneStep) {
  for (const double w : {3.0, 40.0}) {
    ModalStepper coarse(oscillator(w, 0.4 * w)), fine(oscillator(w, 0.4 * w));
    ModalState one{{0.1}, {-0.2}}, many = one;
    const double before = 2.0, after = 5.0, h = 0.4;
    coarse.step({before}, {after}, h, one);
    for (int i = 0; i < 1000; ++i)
      fine.step({before + (after - before) * i / 1000.0},
                {before + (after - before) * (i + 1) / 1000.0}, h / 1000.0, many);
    EXPECT_NEAR(one.amplitude[0], many.amplitude[0], 1e-12);
    EXPECT_NEAR(one.rate[0], many.rate[0], 1e-11);
  }
}

TEST(ModalStepper, SettlesWhereTheSteadyLoadHasIt) {
  ModalStepper stepper(oscillator(5.0, 1.0));
  ModalState state = stepper.atRest();
  for (int i = 0; i < 100; ++i) stepper.step({50.0}, {50.0}, 1.0, state);
  EXPECT_NEAR(state.amplitude[0], 2.0, 1e-12);
  EXPECT_NEAR(state.rate[0], 0.0, 1e-12);
  std::vector<double> acceleration;
  stepper.accelerations(state, {50.0}, acceleration);
  EXPECT_NEAR(acceleration[0], 0.0, 1e-10);
}

/// A crown in a push of a second, as full chain and in modes.
class ModalCrown {
 public:
  explicit ModalCrown(double strength)
      : strength_(strength), links_(crown(120, 0.05)), chain_(links_) {
    std::vector<Wrench> wrenches(links_.size());
    for (std::size_t i = 0; i < links_.size(); ++i)
      wrenches[i].force = strength * links_[i].length * Vec3(1.0, 0.3, 0.0);
    load_ = chain_.torquesOf(wrenches);
    Simulation full{links_};
    rest_ = full.tips();
    const Surroundings around = gust(links_, strength);
    for (int i = 0; i < 4 * STEPS; ++i) {
      full.step(around, 0.25 * H * i, 0.25 * H);
      if (i % 4 == 3) reference_.push_back(full.tips());
    }
  }

  /// Returns the relative error of all tips over two seconds; records the result of the limit.
  double error(int count, int depth) {
    const Modes modes = find(count, depth);
    const RotationProbe probe(chain_, modes);
    ModalStepper stepper(modes);
    ModalState state = stepper.atRest();
    double off = 0.0, size = 0.0;
    held_ = true;
    for (int i = 0; i < STEPS; ++i) {
      stepper.step(loadAt(modes, H * i), loadAt(modes, H * (i + 1)), H, state);
      held_ = held_ && probe.holds(state);
      const std::vector<Vec3> tips = tipsOf(modes, state);
      for (std::size_t t = 0; t < tips.size(); ++t) {
        off += (tips[t] - reference_[i][t]).squaredNorm();
        size += (rest_[t] - reference_[i][t]).squaredNorm();
      }
    }
    return std::sqrt(off / size);
  }
  bool held() const { return held_; }

  /// Returns the largest motion of a tip in a frame of a load that acts from the start [m].
  double firstFrame(int count, int depth) {
    const Modes modes = find(count, depth);
    ModalStepper stepper(modes);
    ModalState state = stepper.atRest();
    const std::vector<double> load = loadAt(modes, 0.5);
    stepper.step(load, load, FRAME, state);
    return farthest(tipsOf(modes, state));
  }
  double firstFrameOfTheFullChain() { return farthest(fullAfterAFrame()); }
  /// Returns the largest distance of a tip from the full chain then [m], with a quick vector or one
  /// more of the others.
  double offInFirstFrame(int count, int depth, bool quick) {
    Modes modes = slowestModes(chain_, count);
    LoadShape shape{load_, depth + (quick ? 0 : 1)};
    if (quick) shape.quick = quickResponse(links_, load_, 0.5 * FRAME);
    addLoadVectors(chain_, {shape}, modes);
    ModalStepper stepper(modes);
    ModalState state = stepper.atRest();
    const std::vector<double> load = loadAt(modes, 0.5);
    stepper.step(load, load, FRAME, state);
    const std::vector<Vec3> tips = tipsOf(modes, state), full = fullAfterAFrame();
    double out = 0.0;
    for (std::size_t i = 0; i < tips.size(); ++i) out = std::max(out, length(tips[i] - full[i]));
    return out;
  }

 private:
  static constexpr int STEPS = 240;
  static constexpr double H = 1.0 / 120.0, FRAME = 1.0 / 60.0;
  std::vector<Vec3> fullAfterAFrame() const {
    Simulation full{links_};
    Surroundings steady;  // half a second into the gust
    const Surroundings gusty = gust(links_, strength_);
    steady.loads = [&](const Kinematics& k, double, Loads& loads) { gusty.loads(k, 0.5, loads); };
    for (int i = 0; i < 20; ++i) full.step(steady, 0.0, FRAME / 20);
    return full.tips();
  }
  Modes find(int count, int depth) {
    Modes out = slowestModes(chain_, count);
    if (depth > 0) addLoadVectors(chain_, {{load_, depth}}, out);
    return out;
  }
  double farthest(const std::vector<Vec3>& tips) const {
    double out = 0.0;
    for (std::size_t i = 0; i < tips.size(); ++i) out = std::max(out, length(tips[i] - rest_[i]));
    return out;
  }
  std::vector<double> loadAt(const Modes& modes, double t) const {
    const double s = t < 1.0 ? std::sin(M_PI * t) : 0.0;
    std::vector<double> out;
    for (std::size_t i = 0; i < modes.size(); ++i) {
      double sum = 0.0;
      for (std::size_t k = 0; k < load_.size(); ++k) sum += modes.shapeOf(i)[k] * load_[k];
      out.push_back(s * s * sum);
    }
    return out;
  }
  std::vector<Vec3> tipsOf(const Modes& modes, const ModalState& state) const {
    Simulation out{links_};
    for (std::size_t m = 0; m < modes.size(); ++m)
      for (std::size_t i = 0; i < links_.size(); ++i)
        out.state.q[i] +=
            state.amplitude[m] * Vec2(modes.shapeOf(m)[2 * i], modes.shapeOf(m)[2 * i + 1]);
    return out.tips();
  }

  double strength_;
  std::vector<Link> links_;
  LinearChain chain_;
  std::vector<double> load_;
  std::vector<Vec3> rest_;
  std::vector<std::vector<Vec3>> reference_;
  bool held_{true};
};

// N13: the error against the full chain falls with the number of modes, and with the vectors of the
// load. Measured: 0.134, 0.088, 0.052; 0.052 with the load's own vector, which is the error of
// loads taken at rest.
TEST(ModalMotion, ComesNearerToTheFullChainWithEveryMode) {
  ModalCrown scene(1.5);
  const double one = scene.error(1, 0), five = scene.error(5, 0), many = scene.error(40, 0);
  EXPECT_LT(five, 0.8 * one);
  EXPECT_LT(many, 0.7 * five);
  EXPECT_LT(scene.error(5, 1), 0.06);
  EXPECT_LT(scene.error(20, 1), 0.06);
}

// N13: both sides of the stated limit. This crown leans, so that loads taken at rest are 5 % off at
// 0.14 rad already; measured 9.8 % at 0.29 rad, 27 % at 1.54 rad.
TEST(ModalMotion, SaysWhereItCeasesToHold) {
  ModalCrown within(3.0), beyond(16.0);
  EXPECT_LT(within.error(5, 1), 0.12);
  EXPECT_TRUE(within.held());
  EXPECT_GT(beyond.error(5, 1), 0.2);
  EXPECT_FALSE(beyond.held());
}

// N13: a sudden load causes no jump: no tip moves 2 mm farther in a frame than the full chain's.
TEST(ModalMotion, DoesNotJumpWhereTheLoadSteps) {
  ModalCrown scene(1.5);
  const double full = scene.firstFrameOfTheFullChain();
  for (const int count : {0, 1, 5, 20})
    for (const int depth : {1, 5})
      EXPECT_LT(scene.firstFrame(count, depth), full + 0.002) << count << " + " << depth;
}

// N13: with a quick vector no tip is 2 mm off in the first frame, however few the others are; as
// many without one are farther off.
TEST(ModalMotion, GivesWayAtOnceAsTheFullChainDoes) {
  ModalCrown scene(1.5);
  for (const int count : {0, 5, 20})
    for (const int depth : {1, 4}) {
      const double with = scene.offInFirstFrame(count, depth, true);
      const double without = scene.offInFirstFrame(count, depth, false);
      std::printf("%d + %d: %.2f mm, without %.2f mm\n", count, depth, 1e3 * with, 1e3 * without);
      EXPECT_LT(with, 0.002) << count << " + " << depth;
      EXPECT_LT(with, 0.8 * without) << count << " + " << depth;
    }
}

// N13: two quick vectors of the sudden load itself keep a pull at one branch within 2 mm of the
// full chain in the first frame; as many of slow motion are twice as far off.
TEST(ModalMotion, GivesWayAtOnceToAPull) {
  constexpr double FRAME = 1.0 / 60.0;
  constexpr std::size_t HELD = 60;
  const std::vector<Link> links = crown(120, 0.05);
  LinearChain chain(links);
  const Vec3 force(12.0, 8.0, 0.0);
  std::vector<Wrench> wrenches(links.size());
  wrenches[HELD].force = force;
  const std::vector<double> torque = chain.torquesOf(wrenches);
  Simulation full{links};
  const std::vector<Vec3> rest = full.tips();
  Surroundings around;
  around.loads = [&](const Kinematics&, double, Loads& loads) { loads.wrench[HELD].force = force; };
  for (int i = 0; i < 40; ++i) full.step(around, 0.0, FRAME / 40);
  const std::vector<Vec3> right = full.tips();
  double way = 0.0, off[2] = {0.0, 0.0};
  for (const bool quick : {false, true}) {
    Modes modes = slowestModes(chain, 8);
    std::vector<LoadShape> shapes{{torque, quick ? 4 : 6}};
    for (const double part : {0.25, 0.5})
      if (quick) shapes.push_back({torque, 0, quickResponse(links, torque, part * FRAME)});
    addLoadVectors(chain, shapes, modes);
    ModalStepper stepper(modes);
    ModalState state = stepper.atRest();
    std::vector<double> load(modes.size(), 0.0);
    for (std::size_t m = 0; m < load.size(); ++m)
      for (std::size_t k = 0; k < torque.size(); ++k) load[m] += modes.shapeOf(m)[k] * torque[k];
    stepper.step(load, load, FRAME, state);
    Simulation shown{links};
    for (std::size_t m = 0; m < load.size(); ++m)
      for (std::size_t i = 0; i < links.size(); ++i)
        shown.state.q[i] +=
            state.amplitude[m] * Vec2(modes.shapeOf(m)[2 * i], modes.shapeOf(m)[2 * i + 1]);
    const std::vector<Vec3> tips = shown.tips();
    for (std::size_t i = 0; i < tips.size(); ++i) {
      off[quick] = std::max(off[quick], length(tips[i] - right[i]));
      way = std::max(way, length(right[i] - rest[i]));
    }
  }
  std::printf("of %.1f mm: off %.2f mm, %.2f without\n", 1e3 * way, 1e3 * off[1], 1e3 * off[0]);
  EXPECT_GT(way, 0.004);
  EXPECT_LT(off[1], 0.002);
  EXPECT_LT(off[1], 0.7 * off[0]);
}

// N13: at first only inertia resists a load, in the end only springs.
TEST(QuickResponse, GoesFromInertiaToSprings) {
  const std::vector<Link> links = crown(200, 0.05);
  LinearChain chain(links);
  const Random random(6);
  std::vector<double> load(chain.size()), felt(chain.size());
  for (std::size_t k = 0; k < load.size(); ++k) load[k] = random.uniform(k, -1.0, 1.0);
  chain.timesMass(quickResponse(links, load, 1e-10).data(), felt.data());
  for (std::size_t k = 0; k < load.size(); ++k) EXPECT_NEAR(felt[k], load[k], 1e-5) << k;
  const double h = 1e6;
  const std::vector<double> slow = quickResponse(links, load, h);
  for (std::size_t k = 0; k < load.size(); ++k)
    EXPECT_NEAR(h * h * chain.stiffness()[k] * slow[k], load[k], 1e-5) << k;
}

// N13: a few links give the largest turn.
TEST(RotationProbe, FindsTheLargestTurnOfAnyLink) {
  LinearChain chain(crown(300, 0.05));
  const Modes modes = slowestModes(chain, 12);
  const RotationProbe probe(chain, modes);
  EXPECT_LE(probe.links.size(), modes.size());
  const Random random(8);
  for (std::uint64_t round = 0; round < 20; ++round) {
    ModalState state{std::vector<double>(modes.size()), {}};
    std::vector<double> q(chain.size(), 0.0);
    for (std::size_t m = 0; m < modes.size(); ++m) {
      state.amplitude[m] = random.uniform(100 * round + m, -1.0, 1.0);
      for (std::size_t k = 0; k < q.size(); ++k) q[k] += state.amplitude[m] * modes.shapeOf(m)[k];
    }
    std::vector<SmallMotion> motion;
    chain.motionOf(q.data(), motion);
    double most = 0.0;
    for (const SmallMotion& each : motion) most = std::max(most, length(each.turn));
    EXPECT_LE(probe.largestTurn(state.amplitude), most * (1.0 + 1e-12));
    EXPECT_GT(probe.largestTurn(state.amplitude), 0.6 * most);
  }
}

}  // namespace
}  // namespace vegetation_sim::physics
