// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/scenario/simulation.h"
#include "grass/tread_simulation.h"
#include "vegetation_sim/grass/blades/blade.h"

namespace vegetation_sim::fuzz {
namespace {

grass::Layout randomLayout(Draw& draw) {
  grass::MapInput input;
  input.law.columns = 3 + draw.below(4);
  input.law.rows = 3 + draw.below(4);
  input.law.resolution = draw.chance(0.5) ? 1.0 : 2.0;
  input.height.value = draw.between(0.0, 1.0);
  input.density.value = draw.between(0.0, 900.0);
  grass::Layout out;
  out.map = std::make_shared<const grass::FeatureMap>(input);
  out.seed = draw.key();
  return out;
}

grass::TreadSettings randomSettings(Draw& draw) {
  grass::TreadSettings out;
  out.spacing = draw.between(0.04, 0.2);
  if (draw.chance(0.2)) out.memory_cap = 1e6;
  return out;
}

grass::TreadLaw randomLaw(Draw& draw) {
  grass::TreadLaw out;
  RandomFields fields(draw, 3.0);
  describe(fields, out);
  Faults faults;
  check(out, "", faults);
  return faults.empty() && out.reach < 1.0 ? out : grass::TreadLaw();
}

class RandomMeadow final : public Simulation {
 public:
  explicit RandomMeadow(Draw& draw)
      : layout_(randomLayout(draw)),
        settings_(randomSettings(draw)),
        tread_(layout_.map->law(), settings_),
        simulation_(layout_, std::make_shared<const terrain::HeightMap>(), settings_, tread_),
        rebuilt_(layout_.map->law(), settings_) {}

  void setWind(const wind::Field&) override {}  // the state does not depend on it
  void act(Draw& draw, Nanoseconds stamp) override {
    const double choice = draw.between(0.0, 1.0);
    if (choice < 0.08) return raise(draw);
    if (choice < 0.1) return simulation_.setDrag(draw.between(0.0, 10.0));
    grass::TreadInput input;
    input.source = "source_" + std::to_string(draw.below(4));
    input.action = static_cast<grass::TreadAction>(draw.below(4));
    input.start = draw.point(9.0);
    input.position = draw.point(9.0);
    input.position.z() = draw.between(-0.1, 0.4);
    input.law = randomLaw(draw);
    input.body_frame = input.source;
    Faults faults;
    check(input, "", faults);
    faults.throwIfAny();
    simulation_.apply(input, stamp);
  }
  void advance(Nanoseconds stamp, bool key_frame, bool lost) override {
    stamp_ = stamp;
    simulation_.advance(stamp);
    const grass::TreadUpdate update = simulation_.update(key_frame || key_frame_due_);
    key_frame_due_ = false;
    if (!lost) in_step_ = replica_.apply(update, rebuilt_) && replica_.why().empty();
    lost_ = lost;
  }
  void restart() override {
    simulation_.reset();
    rebuilt_.clear();
    replica_.reset();
    in_step_ = false;
    key_frame_due_ = true;
  }
  void verify() override {
    for (const grass::Drag& drag : simulation_.drags())
      requireWithin(drag.force.norm(), 1e6, "drag of grass [N]");
    for (const auto& [place, block] : tread_.state().blocks)
      for (const grass::TreadNode& node : block.nodes)
        requireWithin(double{node.tilt}, grass::BEND_LIMIT, "tilt of grass [rad]");
    if (lost_ || !in_step_) return;
    if (hashOf(snapshotTreads(rebuilt_.state(), stamp_)) !=
        hashOf(snapshotTreads(tread_.state(), stamp_)))
      throw Divergence("the replica has other trodden grass");
  }
  std::uint64_t hash() const override { return simulation_.snapshot().hash(); }

 private:
  // As in GrassField: a delta cannot tell that grass was raised.
  void raise(Draw& draw) {
    if (draw.chance(0.3))
      simulation_.raiseAll();
    else
      simulation_.raise({draw.between(0.0, 8.0), draw.between(0.0, 8.0)}, 1.5);
    key_frame_due_ = true;
  }

  grass::Layout layout_;
  grass::TreadSettings settings_;
  grass::TreadMap tread_;
  grass::TreadSimulation simulation_;
  grass::TreadMap rebuilt_;
  grass::TreadReplica replica_;
  Nanoseconds stamp_{0};
  bool in_step_{false}, lost_{false}, key_frame_due_{false};
};

}  // namespace

std::unique_ptr<Simulation> makeMeadow(Draw& draw) {
  return std::make_unique<RandomMeadow>(draw);
}

}  // namespace vegetation_sim::fuzz
