// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/scenario/simulation.h"
#include "vegetation_sim/canopy/canopy.h"

namespace vegetation_sim::fuzz {
namespace {

constexpr double FASTEST_LEAF = 200.0;  // [m/s] of a layer

canopy::Layout plainLayout(Draw& draw) {
  canopy::Layout out;
  out.seed = draw.key();
  out.motion.fluid.cells = 16;
  out.kinds.resize(1);
  out.kinds[0].shape = static_cast<canopy::PlantShape>(draw.below(4));
  out.kinds[0].leaves = 10;
  out.plants.resize(static_cast<std::size_t>(1 + draw.below(2)));
  for (canopy::Plant& plant : out.plants) plant.position = Vec3(draw.between(0.0, 4.0), 0.0, 0.0);
  return out;
}

canopy::Layout randomLayout(Draw& draw) {
  const canopy::Layout plain = plainLayout(draw);
  canopy::Layout out = plain;
  RandomFields fields(draw, 2.0, 0.2);
  describe(fields, out.motion);
  describe(fields, out.kinds[0].push);
  out.motion.fluid.cells = draw.chance(0.2) ? 32 : 16;
  Faults faults;
  check(out, faults);
  return faults.empty() ? out : plain;
}

class RandomCanopy final : public Simulation {
 public:
  explicit RandomCanopy(Draw& draw) : canopy_(randomLayout(draw)), replica_(canopy_.layout()) {
    const canopy::Layout& layout = canopy_.layout();
    leaves_ = canopy::grow(layout.kinds[0], layout.plants[0]).leaves;
  }

  void setWind(const wind::Field& wind) override { canopy_.setWind(wind); }
  void act(Draw& draw, Nanoseconds stamp) override {
    if (draw.chance(0.5)) return push(draw, stamp);
    if (draw.chance(0.3)) return canopy_.setViewer(std::nullopt);
    canopy_.setViewer(canopy::CutView{draw.point(9.0), Quat{1.0, 0.0, 0.0, 0.0}});
  }
  void advance(Nanoseconds stamp, bool, bool lost) override {
    canopy_.advance(stamp);
    if (!lost) replica_.apply(canopy_.update(false));
    lost_ = lost;
  }
  void restart() override { canopy_.reset(); }
  void verify() override {
    const canopy::Foliage& foliage = canopy_.foliage();
    for (int layer = 0; layer < foliage.layers(); ++layer)
      for (const float speed : foliage.sheet(layer))
        requireWithin(double{speed}, FASTEST_LEAF, "motion of a layer [m/s]");
    for (const canopy::PushForce& force : canopy_.pushForces())
      requireWithin(length(force.force), 1e9, "force of a plant [N]");
    for (const auto& entry : canopy_.snapshot().push.plants)
      for (const canopy::Cluster& cluster : entry.second)
        requireWithin(cluster.lean.size(), canopy::LARGEST_LEAN + 1e-9, "lean [rad]");
    const bool comparable = !lost_ && replica_.exact();
    for (const canopy::Leaf& leaf : leaves_) {
      const Vec3 tip = foliage.move(leaf, 0).tip;
      requireWithin((tip - leaf.tip).norm(), 50.0, "displacement of a leaf [m]");
      if (comparable && replica_.foliage().move(leaf, 0).tip != tip)
        throw Divergence("the replica has a leaf elsewhere");
    }
  }
  std::uint64_t hash() const override { return canopy_.snapshot().hash(); }

 private:
  void push(Draw& draw, Nanoseconds stamp) {
    if (draw.chance(0.2) && canopy_.bodies().count("body") > 0) return canopy_.removeBody("body");
    forest::Body body;
    body.id = "body";
    body.shape = static_cast<forest::Shape>(draw.below(3));
    body.size = Vec3(draw.between(0.05, 1.0), draw.between(0.05, 1.0), draw.between(0.05, 1.0));
    body.pose.position =
        Vec3(draw.between(-1.0, 5.0), draw.between(-1.0, 1.0), draw.between(0.0, 2.0));
    body.velocity = draw.point(5.0);
    body.spin = draw.point(2.0);
    body.stamp = stamp;
    canopy_.setBody(body);
  }

  canopy::Canopy canopy_;
  canopy::Replica replica_;
  std::vector<canopy::Leaf> leaves_;
  bool lost_{false};
};

}  // namespace

std::unique_ptr<Simulation> makeCanopy(Draw& draw) {
  return std::make_unique<RandomCanopy>(draw);
}

}  // namespace vegetation_sim::fuzz
