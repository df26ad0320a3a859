// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "core/math/symmetric_eigen.h"
#include "core/math/vector_sums.h"
#include "dynamics/chain/articulated.h"
#include "vegetation_sim/dynamics/modes/modes.h"

namespace vegetation_sim::physics {
namespace {

constexpr double DEPENDENT_LOAD = 1e-9;  // remainder of a vector that adds nothing

/// Vectors of unit modal mass, orthogonal to each other and to the modes.
class Basis {
 public:
  Basis(LinearChain& chain, const Modes& modes)
      : chain_(chain), length_(modes.length), modes_(modes.size()), vectors_(modes.shape) {}

  std::size_t added() const { return vectors_.size() / length_ - modes_; }
  const double* vector(std::size_t i) const { return vectors_.data() + (modes_ + i) * length_; }

  /// Adds the new part of `x` and computes M times it. Returns false if nothing is new.
  bool add(std::vector<double>& x, std::vector<double>& momentum) {
    momentum.resize(length_);
    chain_.timesMass(x.data(), momentum.data());
    const double before = dotOf(x.data(), momentum.data(), length_);
    for (int round = 0; round < 2; ++round) {  // two rounds are enough
      for (std::size_t j = 0; j < modes_ + added(); ++j) {
        const double* known = vectors_.data() + j * length_;
        share_.push_back(dotOf(known, momentum.data(), length_));
      }
      for (std::size_t j = 0; j < share_.size(); ++j)
        addScaled(-share_[j], vectors_.data() + j * length_, length_, x.data());
      share_.clear();
      chain_.timesMass(x.data(), momentum.data());
    }
    const double left = dotOf(x.data(), momentum.data(), length_);
    if (!(left > DEPENDENT_LOAD * DEPENDENT_LOAD * before)) return false;
    const double scale = 1.0 / std::sqrt(left);
    for (std::size_t k = 0; k < length_; ++k) x[k] *= scale, momentum[k] *= scale;
    vectors_.insert(vectors_.end(), x.begin(), x.end());
    return true;
  }

 private:
  LinearChain& chain_;
  std::size_t length_, modes_;
  std::vector<double> vectors_, share_;
};

// Rayleigh-Ritz: makes oscillators of the new vectors among themselves.
SymmetricEigen oscillators(const LinearChain& chain, const Basis& basis) {
  const std::size_t n = basis.added(), length = chain.size();
  std::vector<double> stiffness(n * n), force(length);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < length; ++k) force[k] = chain.stiffness()[k] * basis.vector(i)[k];
    for (std::size_t j = 0; j <= i; ++j)
      stiffness[i * n + j] = stiffness[j * n + i] = dotOf(force.data(), basis.vector(j), length);
  }
  return symmetricEigen(std::move(stiffness), n);
}

}  // namespace

// The response is that of one step of backward Euler.
std::vector<double> quickResponse(const std::vector<Link>& links, const std::vector<double>& torque,
                                  double h) {
  const std::vector<Vec2> none(links.size(), Vec2::Zero());
  const ChainState rest{none, none};
  Kinematics kinematics;
  kinematicsOf(links, {}, rest, kinematics);
  Loads loads;
  loads.clear(links.size());
  for (std::size_t i = 0; i < links.size(); ++i)
    loads.joint_torque[i] = Vec2(torque[2 * i], torque[2 * i + 1]);
  std::vector<Vec2> acceleration;
  ArticulatedBody().accelerations(links, {}, rest, kinematics, loads, {h * h, h, 0.0, 0.0},
                                  acceleration);
  std::vector<double> out;
  for (const Vec2& a : acceleration) out.insert(out.end(), {a.x(), a.y()});
  return out;
}

void addLoadVectors(LinearChain& chain, const std::vector<LoadShape>& loads, Modes& modes) {
  const std::size_t length = modes.length;
  Basis basis(chain, modes);
  std::vector<double> x(length), force;
  for (const LoadShape& load : loads) {
    force = load.torque;
    for (int level = 0; level < load.depth; ++level) {
      for (std::size_t k = 0; k < length; ++k) x[k] = force[k] / chain.stiffness()[k];
      if (!basis.add(x, force)) break;  // the next vector is the response to its inertia
    }
    if (load.quick.empty()) continue;
    x = load.quick;
    basis.add(x, force);
  }
  const SymmetricEigen ritz = oscillators(chain, basis);
  for (std::size_t i = basis.added(); i-- > 0;) {
    std::fill(x.begin(), x.end(), 0.0);
    for (std::size_t j = 0; j < basis.added(); ++j)
      addScaled(ritz.vector(i)[j], basis.vector(j), length, x.data());
    modes.frequency.push_back(std::sqrt(ritz.values[i]));
    modes.damping.push_back(modalDamping(chain, x.data()));
    modes.shape.insert(modes.shape.end(), x.begin(), x.end());
  }
}

}  // namespace vegetation_sim::physics
