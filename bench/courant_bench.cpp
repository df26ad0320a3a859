// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Measures where the waves of a leaf field become unstable: growth per step of the shortest wave
// over Courant's number and the leaves' own frequency, beside the boundary in docs/canopy.md.
// usage: courant_bench [--quick | --full] --csv FILE

#include <array>
#include <cmath>
#include <cstdio>

#include "options.h"
#include "table.h"
#include "vegetation_sim/canopy/flow/wave_steps.h"

namespace vegetation_sim::canopy {
namespace {

constexpr int SIZE = 16;  // cells along a side of 1 m each; steps are of 1 s

/// Effect of a step on a small amplitude and rate: [[a a, a r], [r a, r r]].
struct StepMatrix {
  double aa, ar, ra, rr;
  /// Returns the largest |eigenvalue|.
  double radius() const {
    const double half = 0.5 * (aa + rr), det = aa * rr - ar * ra, root = half * half - det;
    return root < 0.0 ? std::sqrt(det) : std::fabs(half) + std::sqrt(root);
  }
};

WaveLaw lawOf(double courant, double own, double damping) {
  return {own, damping, courant, static_cast<double>(SIZE)};
}

/// Returns black and white cells: the shortest wave, the first to become unstable.
PlaneField chequered(double value) {
  PlaneField out(SIZE);
  for (int y = 0; y < SIZE; ++y)
    for (int x = 0; x < SIZE; ++x)
      out.u[static_cast<std::size_t>(y * SIZE + x)] = (x + y) % 2 ? -value : value;
  return out;
}

double growthOfVerlet(double courant, double own, double damping) {
  const auto after = [&](double amplitude, double rate) {
    VerletStep verlet(lawOf(courant, own, damping), SIZE);
    PlaneField a = chequered(amplitude), r = chequered(rate);
    verlet.step(1.0, PlaneField(SIZE), a, r);
    return std::array<double, 2>{a.u[0], r.u[0]};
  };
  const auto bent = after(1.0, 0.0), moving = after(0.0, 1.0);
  return StepMatrix{bent[0], moving[0], bent[1], moving[1]}.radius();
}

/// Returns the growth of the same wave by the exact step; its wave number is pi in both directions.
double growthOfModes(double courant, double own, double damping) {
  const double wave = M_PI * courant;
  const ModeStep step = modeStep(damping * own, own * own + 2.0 * wave * wave, 1.0);
  return StepMatrix{step.keep, step.from_rate, step.to_rate, step.keep_rate}.radius();
}

/// Returns the largest Courant number that does not grow, by bisection.
double edgeOfVerlet(double own, double damping) {
  double low = 0.0, high = 2.0;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (growthOfVerlet(middle, own, damping) <= 1.0 + 1e-9 ? low : high) = middle;
  }
  return low;
}

void run(const bench::Options& options) {
  bench::Table table(options.csv, "map,method,x,y,value,theory");
  const int count = options.quick ? 30 : 60;
  const struct {
    const char* name;
    double damping;
  } verlets[] = {{"Verlet, no damping", 0.0}, {"Verlet, damping ratio 0.15", 0.15}};
  for (int i = 0; i < count; ++i) {
    const double own = 2.2 * i / (count - 1) + 1e-6;  // times the step
    const double theory = std::sqrt(std::max(0.0, (4.0 - own * own) / 8.0));
    for (const auto& verlet : verlets)
      table.row("edge", verlet.name, own, edgeOfVerlet(own, verlet.damping), 1.0, theory);
    for (int j = 0; j < count; ++j) {
      const double courant = 1.2 * j / (count - 1) + 1e-6;
      for (const auto& verlet : verlets)
        table.row("growth", verlet.name, own, courant, growthOfVerlet(courant, own, verlet.damping),
                  0.0);
      table.row("growth", "exact, mode by mode (default)", own, courant,
                growthOfModes(courant, own, 0.15), 0.0);
    }
  }
}

}  // namespace
}  // namespace vegetation_sim::canopy

int main(int argc, char** argv) {
  try {
    using namespace vegetation_sim;
    canopy::run(bench::readOptions(argc, argv, {}));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "courant_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
