// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Measures where methods become unstable: growth of one joint per step over damping and step, the
// largest stable step over stiffness, damping and size of a tree, each beside the bound in
// docs/physics.md, and the default in a storm beyond all of that.
// usage: stability_bench [--quick | --full] [--part growth,joints,trees,storms] [--csv FILE]

#include <cmath>
#include <cstdio>
#include <limits>

#include "dynamics/batch_step/batch_chain.h"
#include "options.h"
#include "scenes/dynamics/chain_scene.h"
#include "table.h"

namespace vegetation_sim::physics {
namespace {

using bench::Options;
using bench::Table;

struct Method {
  const char* name;
  Integrator integrator;
};
constexpr Method EXPLICIT[] = {{"explicit Euler", Integrator::EXPLICIT_EULER},
                               {"semi-implicit Euler", Integrator::SEMI_IMPLICIT_EULER},
                               {"Runge-Kutta 4", Integrator::RUNGE_KUTTA_4}};
constexpr Method IMPLICIT[] = {{"midpoint (default)", Integrator::MIDPOINT},
                               {"implicit Euler", Integrator::IMPLICIT_EULER}};
constexpr double SMALL = 1e-7;  ///< a bend at which a joint is linear [rad]

/// Effect of one step on a small bend and rate of one joint: [[q q, q r], [r q, r r]].
struct StepMatrix {
  double qq, qr, rq, rr;
  /// Returns the largest |eigenvalue|: growth per step.
  double radius() const {
    const double half = 0.5 * (qq + rr), det = qq * rr - qr * rq, root = half * half - det;
    return root < 0.0 ? std::sqrt(det) : std::fabs(half) + std::sqrt(root);
  }
};

StepMatrix stepMatrix(Integrator integrator, double w2, double c, double h) {
  Link link;
  link.stiffness = w2;
  link.damping = c;
  const auto after = [&](double q, double rate) {
    Simulation run{{link}, integrator};
    run.state.q[0].x() = SMALL * q;
    run.state.rate[0].x() = SMALL * rate;
    run.step({}, 0.0, h);
    return Vec2(run.state.q[0].x() / SMALL, run.state.rate[0].x() / SMALL);
  };
  const double w = std::sqrt(w2);  // a rate of w corresponds to a bend of 1
  const Vec2 bent = after(1.0, 0.0), moving = after(0.0, w);
  return {bent.x(), moving.x(), bent.y() / w, moving.y() / w};
}

/// Returns the largest step that `holds`, by bisection between `low`, which does, and `high`;
/// infinite if `high` does too.
template <class Holds>
double largestStep(const Holds& holds, double low, double high, int bisection) {
  if (holds(high)) return std::numeric_limits<double>::infinity();
  if (!holds(low)) return 0.0;
  for (int i = 0; i < bisection; ++i) {
    const double middle = std::sqrt(low * high);
    (holds(middle) ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

double jointStep(Integrator integrator, double w2, double c) {
  const auto holds = [&](double h) {
    return stepMatrix(integrator, w2, c, h).radius() <= 1.0 + 1e-9;
  };
  const double w = std::sqrt(w2);
  return largestStep(holds, 1e-4 / w, 1e3 / w, 40);
}

// Measures growth per step over damping ratio and h w, of one joint.
void mapGrowth(const Options& options, Table& table) {
  const int count = options.quick ? 40 : 80;
  for (const auto& methods : {std::vector<Method>(std::begin(EXPLICIT), std::end(EXPLICIT)),
                              std::vector<Method>(std::begin(IMPLICIT), std::end(IMPLICIT))})
    for (const Method& method : methods)
      for (int i = 0; i < count; ++i)
        for (int j = 0; j < count; ++j) {
          const double ratio = 0.01 * std::pow(500.0, double(i) / (count - 1));
          const double step = 0.05 * std::pow(400.0, double(j) / (count - 1));
          table.row("growth", method.name, ratio, step,
                    stepMatrix(method.integrator, 1.0, 2.0 * ratio, step).radius(), 0.0);
        }
}

// Measures the edge of that map.
void mapEdge(Table& table) {
  for (const Method& method : EXPLICIT)
    for (double ratio = 0.01; ratio < 5.01; ratio *= 1.0641) {
      const double found = jointStep(method.integrator, 1.0, 2.0 * ratio);
      table.row("edge", method.name, ratio, found, 1.0,
                jointLimit(method.integrator, 1.0, 2.0 * ratio));
    }
}

// Measures the largest stable step of one joint over stiffness, at a damping ratio of 0.1.
void sweepStiffness(Table& table) {
  for (double w2 = 1.0; w2 < 1.1e8; w2 *= 10.0)
    for (const Method& method : EXPLICIT) {
      const double c = 0.2 * std::sqrt(w2);
      table.row("stiffness", method.name, w2, jointStep(method.integrator, w2, c), 0.0,
                jointLimit(method.integrator, w2, c));
    }
}

/// Returns whether small motion of a tree stays small for `steps`.
bool treeHolds(Dynamics dynamics, Integrator integrator, const std::vector<Link>& links, double h,
               int steps) {
  Simulation run{links, integrator};
  run.stepper.setDynamics(dynamics);
  run.state = randomState(links.size(), 1e-6, 0.0, 3);
  for (int i = 0; i < steps; ++i) {
    run.step({}, 0.0, h);
    for (const Vec2& q : run.state.q)
      if (!(q.norm() < 1e-3)) return false;
  }
  return true;
}

// Measures the largest stable step of whole trees over their size, beside the proved guard and the
// estimate that the node uses.
void sweepTrees(const Options& options, Table& table) {
  const int largest = options.quick ? 64 : options.full ? 4096 : 1024;
  for (int count = 7; count < largest; count = 2 * count + 1) {
    const std::vector<Link> links = crown(static_cast<std::size_t>(count), 0.1);
    const ChainState rest = atRest(links.size());
    const ChainRates guard = guardRates(Dynamics::ARTICULATED, links, kinematicsAt(links, rest));
    const ChainRates both = tighter(guard, estimatedRates(links, {}, rest, {}));
    for (const Method& method : EXPLICIT) {
      const double estimate = guardLimit(method.integrator, both);
      const auto holds = [&](double h) {
        return treeHolds(Dynamics::ARTICULATED, method.integrator, links, h, 1500);
      };
      const double found = largestStep(holds, 0.5 * estimate, 10.0 * estimate, 9);
      table.row("trees", method.name, count, found, guardLimit(method.integrator, guard), estimate);
      std::printf("%5d links, %-20s stable to %.3g ms; estimate %.3g, guard %.3g\n", count,
                  method.name, 1e3 * found, 1e3 * estimate,
                  1e3 * guardLimit(method.integrator, guard));
    }
    const bool midpoint = treeHolds(Dynamics::ARTICULATED, Integrator::MIDPOINT, links, 0.5, 200);
    table.row("trees", IMPLICIT[0].name, count, midpoint ? 0.5 : 0.0, 0.0,
              std::numeric_limits<double>::infinity());
  }
}

// ---- storms ------------------------------------------------------------------------------------

/// Largest bend during a storm, and after its ring-down [rad]; infinite if it is not a number.
struct Storm {
  double worst{0.0}, last{0.0};

  void observe(const ChainState& state) {
    last = 0.0;
    for (const Vec2& q : state.q)
      last = std::isfinite(q.norm()) ? std::max(last, q.norm())
                                     : std::numeric_limits<double>::infinity();
    worst = std::max(worst, last);
  }
};

// The load is 30 times the gust for a second, then nothing for ten seconds or a hundred steps.
template <class Step, class State>
Storm stormOf(double h, const Step& step, const State& state) {
  Storm out;
  const int steps = static_cast<int>(std::max(11.0, 1.0 + 100.0 * h) / h);
  for (int i = 0; i < steps; ++i) {
    step(i * h);
    out.observe(state());
  }
  return out;
}

// Measures the default over step and spread of stiffness, in double and in float.
void sweepStorms(const Options& options, Table& table) {
  const double factor = options.quick ? 10.0 : 2.0;
  for (double apart = 1e2; apart < 1.1e12; apart *= options.quick ? 1e3 : 10.0) {
    std::vector<Link> links = crown(63, 0.1);
    spreadStiffness(links, apart);
    const Surroundings blow = gust(links, 30.0 * 20.0);
    for (double h = 1e-3; h < 1.1; h *= factor) {
      Simulation plain{links};
      BatchChain batch(links);
      const Storm slow = stormOf(
          h, [&](double time) { plain.step(blow, time, h); }, [&] { return plain.state; });
      const Storm fast = stormOf(
          h, [&](double time) { batch.step(blow, time, h); }, [&] { return batch.state(0); });
      table.row("storm", "double", apart, h, slow.last, slow.worst);
      table.row("storm", "float", apart, h, fast.last, fast.worst);
      std::printf(
          "%6.0e apart, step %7.4g s: worst bend %.3g rad, in the end %.2g; float %.3g, %.2g\n",
          apart, h, slow.worst, slow.last, fast.worst, fast.last);
    }
  }
}

void run(const Options& options) {
  Table table(options.csv, "map,method,x,y,value,theory");
  if (options.wants("growth")) {
    mapGrowth(options, table);
    mapEdge(table);
  }
  if (options.wants("joints")) sweepStiffness(table);
  if (options.wants("trees")) sweepTrees(options, table);
  if (options.wants("storms")) sweepStorms(options, table);
}

}  // namespace
}  // namespace vegetation_sim::physics

int main(int argc, char** argv) {
  try {
    using namespace vegetation_sim;
    physics::run(bench::readOptions(argc, argv, {"growth", "joints", "trees", "storms"}));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "stability_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
