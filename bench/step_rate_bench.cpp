// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Measures the steps between two ticks of 60 Hz of whole physical trees, as a forest takes them, by
// their rate: processor time, and the distance of all tips from those of a converged run in double
// precision. The trees are free in a breeze or a storm, or one limb is held and moved, or pushed.
// usage: step_rate_bench [ROUNDS] [--quick | --full] [--part NAME,..] [--csv FILE]
//   parts: free, storm, held, pushed

#include <cstdio>

#include "forest/physics/tree_steps.h"
#include "options.h"
#include "processor_time.h"
#include "scenes/forest/physics_scene.h"
#include "scenes/forest/step_surroundings.h"
#include "table.h"

namespace vegetation_sim::forest {
namespace {

using bench::Options;

constexpr double SETTLING = 1.5, LOADED = 1.0, WATCHED = 3.0;  // [s]
constexpr double PULL = 0.3;                                   // [m]
constexpr int CALM_RATE = PHYSICS_RATE / static_cast<int>(CALM_STEPS);
constexpr double STORM = 4.0;    // speed over that of the breeze
constexpr double PUSH = 20.0;    // [N]
constexpr int LOADED_DEPTH = 2;  // of the limb that a load acts on

/// Tips of all branches tick by tick in the tree's frame [m], and the processor time of all steps.
struct Run {
  std::vector<std::vector<Vec3>> tips;
  double seconds{0.0};
};

/// One tree that is physical as a whole.
class WholeTree {
 public:
  WholeTree(const std::string& species, bool stormy) : rig_(wholeTree(), 1, species.c_str()) {
    wind::Primitive breeze = makeBreeze(1, (stormy ? STORM : 1.0) * Vec3(4.0, 2.0, 0.0));
    breeze.turbulence = stormy ? 0.4 : 0.2;
    rig_.forest.setWind(wind::Field({breeze}));
    Push touch;
    touch.point = {0, rig_.twig(), 0.0};
    touch.until = rig_.now() + seconds(SETTLING);
    touch.whole_tree = true;
    rig_.forest.push(touch);
    rig_.run(SETTLING);  // by then the compensation has faded
    branch_ = rig_.branchOfDepth(LOADED_DEPTH);
  }
  std::size_t branchCount() const { return rig_.branches().size(); }

  /// Continues with `rate` steps a second under a load.
  Run run(const std::string& load, int rate, Precision precision) const {
    Run out;
    PhysicsSettings settings = wholeTree();
    settings.precision = precision;
    PhysicalSubtree subtree = rig_.forest.snapshot().physics.subtrees().at(0);
    const HeldGrab held{rig_.grabOf(branch_)};
    HeldGrab grab = held;
    grab.last_target = grab.target;
    const Push push = pushOf();
    SubtreeScratch scratch;
    for (int tick = 1; tick <= WATCHED * TICK_RATE; ++tick) {
      const StepTimes times = timesOf(tick, rate);
      TreeSteps steps(0, subtree);
      grab.target = held.target + wayAt(double(tick) / TICK_RATE);
      if (load == "held" && tick <= LOADED * TICK_RATE) steps.add(grab);
      if (load == "pushed") steps.add(push);
      scratch.windows.clear();
      const double start = bench::threadTime();
      steps.run({surroundings_.at(rig_.forest, times.from), settings, bodies_, times}, scratch);
      out.seconds += bench::threadTime() - start;
      grab.last_target = grab.target;
      out.tips.push_back(tipsOf(subtree, times.to, scratch));
    }
    return out;
  }

 private:
  static PhysicsSettings wholeTree() {
    PhysicsSettings out;
    out.linger = 3600.0;
    out.most_branches = 1000000;
    return out;
  }
  // The held point moves out by PULL within 0.75 s, and is released on its way back.
  static Vec3 wayAt(double time) {
    return 0.5 * PULL * (1.0 - sinCosTurns(time / 1.5).cos) * Vec3(0.6, 0.0, -0.8);
  }
  Push pushOf() const {
    Push out;
    out.point = {0, branch_, rig_.branches()[static_cast<std::size_t>(branch_)].length};
    out.force = PUSH * Vec3(0.6, 0.0, -0.8);
    out.from = rig_.now();
    out.until = out.from + seconds(LOADED);
    return out;
  }
  StepTimes timesOf(int tick, int rate) const {
    return {rig_.grid.timeOf(rig_.tick + tick - 1), rig_.grid.timeOf(rig_.tick + tick),
            static_cast<std::size_t>(rate / TICK_RATE)};
  }
  std::vector<Vec3> tipsOf(const PhysicalSubtree& subtree, Nanoseconds stamp,
                           SubtreeScratch& scratch) const {
    physics::Kinematics& at = scratch.kinematics;
    subtree.kinematicsAt(surroundings_.at(rig_.forest, stamp).windOf(0), stamp, scratch, at);
    std::vector<Vec3> out;
    for (std::size_t i = 0; i < at.pose.size(); ++i)
      out.push_back(
          tipOf(rig_.branches()[static_cast<std::size_t>(subtree.branches()[i])], at.pose[i]));
    return out;
  }

  PhysicsRig rig_;
  int branch_{0};
  Bodies bodies_;
  StepSurroundings surroundings_;
};

/// Distances of all tips in all ticks [m].
struct Distance {
  double rms{0.0}, largest{0.0};
};

/// @param of returns the vector of a tip in a tick.
template <class Of>
Distance distanceOver(const Run& run, const Of& of) {
  double sum = 0.0, largest = 0.0;
  std::size_t count = 0;
  for (std::size_t tick = 0; tick < run.tips.size(); ++tick)
    for (std::size_t i = 0; i < run.tips[tick].size(); ++i, ++count) {
      const Vec3 way = of(tick, i);
      sum += dot(way, way);
      largest = std::max(largest, length(way));
    }
  return {std::sqrt(sum / static_cast<double>(count)), largest};
}

Distance differenceOf(const Run& a, const Run& b) {
  return distanceOver(a, [&](std::size_t tick, std::size_t i) -> Vec3 {
    return a.tips[tick][i] - b.tips[tick][i];
  });
}

/// Returns the motion about the mean position of each tip.
Distance motionOf(const Run& run) {
  std::vector<Vec3> mean(run.tips[0].size(), Vec3::Zero());
  for (const std::vector<Vec3>& tips : run.tips)
    for (std::size_t i = 0; i < tips.size(); ++i)
      mean[i] += tips[i] / static_cast<double>(run.tips.size());
  return distanceOver(
      run, [&](std::size_t tick, std::size_t i) -> Vec3 { return run.tips[tick][i] - mean[i]; });
}

bool isCalm(const std::string& load) {
  return load == "free" || load == "storm";
}

void benchLoad(const Options& options, const WholeTree& tree, const std::string& species,
               const std::string& load, bench::Table& table) {
  const Run truth = tree.run(load, (options.full ? 64 : 32) * TICK_RATE, Precision::DOUBLE);
  const double motion = motionOf(truth).rms;
  const double per_thousand = 1e3 * 1e3 / (WATCHED * static_cast<double>(tree.branchCount()));
  for (const int steps : {1, 2, 3, 4, 8, 16}) {
    const int rate = steps * TICK_RATE;
    std::vector<double> times;
    Run run;
    for (int i = 0; i < (options.quick ? 1 : std::min(options.rounds, 5)); ++i) {
      run = tree.run(load, rate, Precision::SINGLE);
      times.push_back(run.seconds);
    }
    std::sort(times.begin(), times.end());
    const double cost = per_thousand * times[times.size() / 2];
    const Distance error = differenceOf(run, truth);
    std::printf("%-7s %-7s %5d Hz %8.2f ms %8.3f mm %8.3f mm %8.3f %% of %.1f mm\n",
                species.c_str(), load.c_str(), rate, cost, 1e3 * error.rms, 1e3 * error.largest,
                100.0 * error.rms / motion, 1e3 * motion);
    table.row(load, species, rate, cost, error.rms / motion, 1e3 * error.rms, 1e3 * error.largest,
              1e3 * motion, int(rate == (isCalm(load) ? CALM_RATE : PHYSICS_RATE)));
  }
}

void run(const Options& options) {
  bench::Table table(options.csv,
                     "load,species,rate,cost_ms,error,error_mm,largest_mm,motion_mm,chosen");
  std::printf("%-7s %-7s %8s %11s %11s %11s %10s\n", "species", "load", "rate", "cost", "rms",
              "largest", "error");
  for (const std::string& species : speciesNames()) {
    if (options.quick && species != "oak" && species != "willow") continue;
    for (const std::string& load : options.parts)
      benchLoad(options, WholeTree(species, load == "storm"), species, load, table);
  }
}

}  // namespace
}  // namespace vegetation_sim::forest

int main(int argc, char** argv) {
  try {
    using namespace vegetation_sim;
    forest::run(bench::readOptions(argc, argv, {"free", "storm", "held", "pushed"}));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "step_rate_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
