// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "scenes/canopy/canopy_scene.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::canopy {

/// Makes a shrub in a gusty wind from the side, with layers of equal thickness.
inline Layout lonelyShrub(int leaves, int layers) {
  Layout out = shrubScene(64);
  out.plants.resize(1);
  out.kinds[0].leaves = leaves;
  Motion& motion = out.motion;
  motion.sources.sides[0] = {5.0, 0.45};
  motion.sources.turbulence = 0.3;
  motion.cuts.near_layers = layers;
  motion.cuts.mid_layers = motion.cuts.far_layers = 0;
  motion.layers.spread = 0.0;
  motion.warp.depth_loss = 0.0;
  motion.warp.reference_time = 0.02;  // small motion, which needs no limit against folding
  return out;
}

/// Air in the plane of a layout, tick by tick, computed once for all comparisons.
class AirRecord {
 public:
  AirRecord(const Layout& layout, int ticks) : rate_(layout.motion.rate) {
    Fluid fluid(fluidOf(layout.motion), layout.motion.sources, layout.seed);
    for (int tick = 0; tick < ticks; ++tick) {
      fluid.advance(static_cast<double>(tick) / rate_, 1.0 / rate_);
      frames_.push_back(fluid.state().flow);
    }
  }
  /// Returns the air at a place in cells, linear between ticks; at rest before the first one.
  PlaneVector at(const PlaneVector& cell, double time) const {
    const double tick = time * rate_ - 1.0;
    if (tick < 0.0) return {};
    const auto early = std::min(frames_.size() - 2, static_cast<std::size_t>(tick));
    const double q = std::min(1.0, tick - static_cast<double>(early));
    const PlaneVector a = bilinear(frames_[early], cell.u, cell.v);
    const PlaneVector b = bilinear(frames_[early + 1], cell.u, cell.v);
    return {(1.0 - q) * a.u + q * b.u, (1.0 - q) * a.v + q * b.v};
  }
  const PlaneField& frame(int tick) const { return frames_[static_cast<std::size_t>(tick)]; }

 private:
  double rate_;
  std::vector<PlaneField> frames_;
};

/// Every leaf of a plant on its own: an oscillator at its place in space with its own frequency,
/// driven by the air that has reached its depth at V_D, and coupled to its six nearest neighbours
/// in three dimensions. There are no plane, layers or cells.
class LeafTruth {
 public:
  static constexpr int NEIGHBOURS = 6, SUBSTEPS = 8;

  /// @param variety largest relative difference of a leaf's frequency. @param origin depth whose
  /// air is that of the plane [m].
  LeafTruth(const Layout& layout, const AirRecord& air, double variety, const LayerCut& cut,
            double origin)
      : motion_(layout.motion), air_(air) {
    const GrownPlant grown = grow(layout.kinds[0], layout.plants[0]);
    const Plane plane(motion_.plane);
    const Random random(layout.seed);
    for (const Leaf& leaf : grown.leaves) {
      One one;
      one.place = leaf.anchor;
      one.cell = plane.cellAt(leaf.anchor, motion_.fluid.cells);
      one.delay = (cut.depthOf(leaf.anchor) - origin) / motion_.layers.delay_speed;
      one.omega = 2.0 * PI * motion_.oscillator.frequency *
                  (1.0 + variety * random.uniform(leaves_.size(), -1.0, 1.0));
      leaves_.push_back(one);
    }
    for (std::size_t i = 0; i < leaves_.size(); ++i) join(i);
  }

  std::size_t size() const { return leaves_.size(); }
  const Vec3& place(std::size_t leaf) const { return leaves_[leaf].place; }
  PlaneVector motion(std::size_t leaf) const { return leaves_[leaf].amplitude; }

  /// Advances by a tick that ends at `time`, by semi-implicit steps of an eighth of it.
  void advance(double time) {
    const double dt = 1.0 / (motion_.rate * SUBSTEPS);
    for (int i = SUBSTEPS - 1; i >= 0; --i) step(time - i * dt, dt);
  }

 private:
  struct One {
    Vec3 place;
    PlaneVector cell, amplitude, rate;
    double delay{0.0}, omega{1.0}, pull{0.0};
    std::array<std::size_t, NEIGHBOURS> near{};
  };

  // Approximates the Laplace operator from neighbours: six times the mean difference over the mean
  // square distance.
  void join(std::size_t index) {
    std::vector<std::pair<double, std::size_t>> others;
    for (std::size_t j = 0; j < leaves_.size(); ++j)
      if (j != index) {
        const Vec3 way = leaves_[j].place - leaves_[index].place;
        others.emplace_back(dot(way, way), j);
      }
    std::partial_sort(others.begin(), others.begin() + NEIGHBOURS, others.end());
    double squares = 0.0;
    for (std::size_t k = 0; k < NEIGHBOURS; ++k) {
      leaves_[index].near[k] = others[k].second;
      squares += others[k].first / NEIGHBOURS;
    }
    const double speed = motion_.oscillator.speed;
    // Limits the coupling of close neighbours, which the step could not resolve.
    leaves_[index].pull = std::min(6.0 * speed * speed / squares, STIFFEST) / NEIGHBOURS;
  }

  void step(double time, double dt) {
    for (One& one : leaves_) {
      const PlaneVector u = air_.at(one.cell, time - one.delay);
      const double speed = std::sqrt(u.u * u.u + u.v * u.v);
      const double share = 1.0 / (1.0 + speed / motion_.oscillator.limit);
      PlaneVector around;
      for (const std::size_t j : one.near) {
        around.u += leaves_[j].amplitude.u - one.amplitude.u;
        around.v += leaves_[j].amplitude.v - one.amplitude.v;
      }
      const double square = one.omega * one.omega,
                   drag = 2.0 * motion_.oscillator.damping * one.omega;
      const double keep = 1.0 / (1.0 + dt * drag);
      one.rate.u = keep * (one.rate.u +
                           dt * (square * (share * u.u - one.amplitude.u) + one.pull * around.u));
      one.rate.v = keep * (one.rate.v +
                           dt * (square * (share * u.v - one.amplitude.v) + one.pull * around.v));
    }
    for (One& one : leaves_) {
      one.amplitude.u += dt * one.rate.u;
      one.amplitude.v += dt * one.rate.v;
    }
  }

  static constexpr double STIFFEST = 2000.0;  // [1/s^2]
  Motion motion_;
  const AirRecord& air_;
  std::vector<One> leaves_;
};

/// Difference between the leaves of the layers and those that move on their own.
struct TruthError {
  double error{0.0};  ///< rms of the difference / rms of the motion about the mean
  double model{0.0};  ///< processor time of a tick of the plane, its layers and all leaves [s]
  double truth{0.0};  ///< processor time of a tick of every leaf on its own [s]
};

/// @param clock returns the processor time [s]. @param from, to range of ticks that count.
template <class Clock>
TruthError compareWithTruth(int leaves, int layers, double variety, int from, int to,
                            const AirRecord& air, Clock clock) {
  const Layout layout = lonelyShrub(leaves, layers);
  Foliage foliage(layout);
  const Motion& motion = layout.motion;
  const CutView view{motion.plane.camera, orientationOf(motion.plane)};
  const LayerCut cut = foliage.cutFor(view);
  LeafTruth truth(layout, air, variety, cut, cut.middle(0));
  Oscillator plane(motion.oscillator, motion.fluid.cells, Plane(motion.plane).width);
  History history(motion.fluid.cells, historyFrames(motion));
  std::vector<PlaneVector> sum(truth.size());
  double square = 0.0, difference = 0.0;
  TruthError out;
  for (int tick = 0; tick < to; ++tick) {
    const double start = clock();
    plane.advance(1.0 / motion.rate, air.frame(tick), 0.0);
    history.push(toFrame(plane.motion(), 0.0));
    foliage.update(history, 1.0, {view, view, 0}, tickStamp(tick));
    const double middle = clock();
    truth.advance((tick + 1.0) / motion.rate);
    out.model += (middle - start) / to;
    out.truth += (clock() - middle) / to;
    if (tick < from) continue;
    const double before = clock();
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const Vec3 got = foliage.motion(truth.place(i), truth.place(i));
      const PlaneVector want = truth.motion(i);
      const double u = got.x() - want.u, v = got.y() - want.v;
      difference += u * u + v * v;
      square += want.u * want.u + want.v * want.v;
      sum[i].u += want.u;
      sum[i].v += want.v;
    }
    out.model += (clock() - before) / (to - from);
  }
  for (const PlaneVector& all : sum) square -= (all.u * all.u + all.v * all.v) / (to - from);
  out.error = std::sqrt(difference / square);
  return out;
}

}  // namespace vegetation_sim::canopy
