// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "trees/modal_engine.h"

#include <algorithm>

namespace vegetation_sim::bench {
namespace {

physics::Modes findModes(const TestTree& tree, const TestLoad& load, int modes, int vectors) {
  constexpr double FRAME = 1.0 / 60.0;
  const std::vector<physics::Link> links = coreLinks(tree);
  physics::LinearChain chain(links);
  physics::Modes out = physics::slowestModes(chain, modes);
  const std::vector<double> torque = torquesOf(chain, load);
  std::vector<physics::LoadShape> shapes;
  std::vector<double> quick;  // per frame
  if (vectors >= 5 && load.links.size() == 1)
    quick = {0.25, 0.5};
  else if (vectors >= 2)
    quick = {0.5};
  for (const double part : quick)
    shapes.push_back({torque, 0, physics::quickResponse(links, torque, part * FRAME)});
  if (vectors > 0) {
    shapes.insert(shapes.begin(), {torque, vectors - static_cast<int>(shapes.size())});
    physics::addLoadVectors(chain, shapes, out);
  }
  return out;
}

}  // namespace

std::vector<physics::Link> coreLinks(const TestTree& tree) {
  std::vector<physics::Link> out(tree.links.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const TestLink& from = tree.links[i];
    physics::Link& link = out[i];
    link.parent = from.parent;
    link.h = from.h;
    link.rest = from.rest;
    link.length = from.length;
    link.mass = from.mass;
    link.centre = Vec3(0.0, 0.0, 0.5 * from.length);
    link.inertia = {from.across, from.across, from.along, 0.0, 0.0, 0.0};
    link.stiffness = from.stiffness;
    link.damping = from.damping;
  }
  return out;
}

std::vector<double> torquesOf(const physics::LinearChain& chain, const TestLoad& load) {
  std::vector<physics::Wrench> wrenches(chain.rest().size());
  for (std::size_t i = 0; i < load.links.size(); ++i) {
    const auto link = static_cast<std::size_t>(load.links[i]);
    const Vec3 arm = load.along[i] * axisZ(chain.rest()[link].orientation);
    wrenches[link] = {load.force[i], cross(arm, load.force[i])};
  }
  return chain.torquesOf(wrenches);
}

ModalEngine::ModalEngine(const TestTree& tree, const TestLoad& load, int modes, int vectors)
    : tree_(tree),
      load_(load),
      modes_(findModes(tree, load, modes, vectors)),
      stepper_(modes_),
      before_(modes_.size()),
      after_(modes_.size()) {
  physics::LinearChain chain(coreLinks(tree));
  probe_ = physics::RotationProbe(chain, modes_);
  const std::vector<double> torque = torquesOf(chain, load);
  for (std::size_t m = 0; m < modes_.size(); ++m) {
    push_.push_back(0.0);
    for (std::size_t k = 0; k < torque.size(); ++k) push_[m] += modes_.shapeOf(m)[k] * torque[k];
  }
  rest();
}

void ModalEngine::rest() {
  state_ = stepper_.atRest();
  largest_turn_ = 0.0;
}

void ModalEngine::step(int interval, double time, double h) {
  for (std::size_t m = 0; m < push_.size(); ++m) {
    before_[m] = load_.factor(interval, time) * push_[m];
    after_[m] = load_.factor(interval, time + h) * push_[m];
  }
  stepper_.step(before_, after_, h, state_);
  largest_turn_ = std::max(largest_turn_, probe_.largestTurn(state_.amplitude));
}

std::vector<Vec3> ModalEngine::tips() const {
  std::vector<double> bends(2 * tree_.links.size(), 0.0);
  for (std::size_t m = 0; m < modes_.size(); ++m)
    for (std::size_t k = 0; k < bends.size(); ++k)
      bends[k] += state_.amplitude[m] * modes_.shapeOf(m)[k];
  return tipsOf(tree_, Bend::SWING, bends);
}

StaticEngine::StaticEngine(const TestTree& tree, const TestLoad& load) : tree_(tree), load_(load) {
  const physics::LinearChain chain(coreLinks(tree));
  bends_ = torquesOf(chain, load);
  for (std::size_t k = 0; k < bends_.size(); ++k) bends_[k] /= chain.stiffness()[k];
}

std::vector<Vec3> StaticEngine::tips() const {
  std::vector<double> bends = bends_;
  for (double& bend : bends) bend *= factor_;
  return tipsOf(tree_, Bend::SWING, bends);
}

}  // namespace vegetation_sim::bench
