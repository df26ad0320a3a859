// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <memory>

#include "modal/measure.h"
#include "processor_time.h"
#include "scenes/forest/modal_scene.h"
#include "trees/modal_engine.h"
#include "vegetation_sim/dynamics/modes/batch_modes.h"

namespace vegetation_sim::bench {
namespace {

/// A birch of 818 branches in a breeze, posed again and again.
class Posing {
 public:
  Posing() {
    bends_.first.assign(tree_.skeleton.branches.size() + forest::BatchPoser::PADDING, 0.1f);
    bends_.second = bends_.first;
  }

  void add(const std::string& name, const std::function<void()>& once) {
    candidates_.push_back({name, [once] {
                             for (int i = 0; i < REPEATS; ++i) once();
                           }});
  }
  void addRivals() {
    add("forward kinematics", [this] { poser_.pose(bends_, poses_); });
    add("procedural",
        [this] { poser_.pose(air_, forest::fullWeights(), forest::MAX_DEPTHS, poses_); });
  }
  void addModes(forest::ModalDepth depth) {
    const forest::ModalTree modal(tree_, layout_.species[2], depth);
    const auto batch = std::make_shared<physics::BatchModes>(modal.modes());
    const std::vector<double> amplitude(modal.size(), 0.01);
    add(std::to_string(modal.size()) + " modes", [this, batch, amplitude] {
      batch->bends(amplitude, bends_);
      poser_.pose(bends_, poses_);
    });
  }
  void addWind() {
    const auto modal = std::make_shared<forest::ModalTree>(tree_, layout_.species[2]);
    const auto stepper = std::make_shared<physics::ModalStepper>(modal->modes());
    state_ = stepper->atRest();
    add("wind and step", [this, modal, stepper] {
      modal->loadOf(air_, kept_, load_);
      stepper->step(load_, load_, 1.0 / 60.0, state_);
    });
  }
  /// Returns the cost in addition to forward kinematics [ns].
  double proceduralCost() {
    const std::size_t n = tree_.skeleton.branches.size();
    const double all =
        costOf([this] { poser_.pose(air_, forest::fullWeights(), forest::MAX_DEPTHS, poses_); }, n);
    return all - costOf([this] { poser_.pose(bends_, poses_); }, n);
  }
  void print(int rounds) {
    timeOnProcessor(candidates_, rounds);
    const double share = 1e9 / REPEATS / static_cast<double>(tree_.skeleton.branches.size());
    std::printf("\nposing %zu branches, %s, ns a branch and frame:\n",
                tree_.skeleton.branches.size(), chosenInstructionSet().c_str());
    for (const Candidate& each : candidates_)
      std::printf("| %-18s | %6.2f |\n", each.name.c_str(), share * each.seconds);
  }

 private:
  static constexpr int REPEATS = 200;
  forest::Layout layout_{forest::gridLayout(2, 12.0)};
  forest::Tree tree_{forest::groundedTree(layout_, 2)};
  wind::Field field_{{forest::makeBreeze(1, Vec3(5.0, 1.0, 0.0))}, 3};
  wind::Instant air_{field_.at(forest::MODAL_START)};
  forest::BatchPoser poser_{tree_};
  forest::BatchPoses poses_;
  forest::BatchBends bends_;
  forest::ModalAir kept_;
  physics::ModalState state_;
  std::vector<double> load_;
  std::vector<Candidate> candidates_;
};

}  // namespace

double costOf(const std::function<void()>& once, std::size_t branches) {
  constexpr int REPEATS = 40, ROUNDS = 5;
  std::vector<Candidate> candidates{{"", [&once] {
                                       for (int i = 0; i < REPEATS; ++i) once();
                                     }}};
  timeOnProcessor(candidates, ROUNDS);
  return 1e9 / REPEATS / static_cast<double>(branches) * candidates[0].seconds;
}

double modalCost(const physics::Modes& modes) {
  const physics::BatchModes batch(modes);
  physics::ModalStepper stepper(modes);
  physics::ModalState state = stepper.atRest();
  const std::vector<double> load(modes.size(), 0.01);
  physics::BatchBends bends;
  return costOf(
      [&] {
        stepper.step(load, load, 1.0 / 60.0, state);
        batch.bends(state.amplitude, bends);
      },
      modes.length / 2);
}

double proceduralCost() {
  return Posing().proceduralCost();
}

void measureFinding(const TestTree& tree, int rounds) {
  const std::vector<physics::Link> links = coreLinks(tree);
  const TestLoad load = pull(tree);
  std::vector<Candidate> candidates;
  for (const int modes : {5, 20})
    candidates.push_back({std::to_string(modes) + " modes", [&links, modes] {
                            physics::LinearChain chain(links);
                            physics::slowestModes(chain, modes);
                          }});
  physics::LinearChain chain(links);
  const physics::Modes ten = physics::slowestModes(chain, 10);
  const std::vector<double> torque = torquesOf(chain, load);
  candidates.push_back({"10 load vectors", [&chain, &ten, &torque] {
                          physics::Modes more = ten;
                          physics::addLoadVectors(chain, {{torque, 10}}, more);
                        }});
  timeOnProcessor(candidates, rounds);
  std::printf("\nfinding, %zu branches:", links.size());
  for (const Candidate& each : candidates)
    std::printf(" %s %.2f ms;", each.name.c_str(), 1e3 * each.seconds);
  std::printf("\n");
}

void measurePosing(int rounds) {
  Posing posing;
  posing.addRivals();
  for (const forest::ModalDepth depth : {forest::ModalDepth{5, 0, 0, false}, {}, {20, 0, 0, false}})
    posing.addModes(depth);
  posing.addWind();
  posing.print(rounds);
}

}  // namespace vegetation_sim::bench
