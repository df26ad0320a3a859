// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/tree/modal/modal_tree.h"

#include <algorithm>
#include <cmath>

#include "tree/growth/branch_mass.h"
#include "tree/modal/modal_load.h"
#include "tree/modal/modal_wind_load.h"
#include "vegetation_sim/core/config/faults.h"
#include "vegetation_sim/core/math/math.h"
#include "wind/laws.h"

namespace vegetation_sim::forest {
namespace {

constexpr int COARSE = 5, FINE = 10;    // bisections of the crown: 32 and 1024 points
constexpr double AT_ONCE = 0.5 / 60.0;  // time of the immediate response: half a frame [s]

physics::Modes modesIn(const std::vector<physics::Link>& links, physics::LinearChain& chain,
                       const std::vector<WindLoadPoint>& load_points, ModalDepth depth) {
  const auto shape = [&](const Vec3& direction, int vectors, bool quick) {
    physics::LoadShape out{uniformLoad(chain, load_points, direction), vectors};
    if (quick) out.quick = physics::quickResponse(links, out.torque, AT_ONCE);
    return out;
  };
  physics::Modes out = physics::slowestModes(chain, depth.modes);
  physics::addLoadVectors(chain,
                          {shape(Vec3::UnitX(), depth.sideways, depth.quick),
                           shape(Vec3::UnitY(), depth.sideways, depth.quick),
                           shape(Vec3::UnitZ(), depth.upwards, false)},
                          out);
  return out;
}

}  // namespace

std::vector<physics::Link> chainOf(const Skeleton& skeleton, const Species& species) {
  const Wood wood = woodOf(skeleton, species, Material::BEAM);
  std::vector<physics::Link> out(skeleton.branches.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Branch& b = skeleton.branches[i];
    const Composite& body = wood.own[i];
    physics::Link& link = out[i];
    link.parent = b.parent;
    link.h = b.h;
    link.rest = b.turn;
    link.length = b.length;
    link.mass = body.mass;
    link.centre = body.moment / body.mass;
    link.inertia = {body.inertia[0], body.inertia[1], body.inertia[2],
                    body.inertia[3], body.inertia[4], body.inertia[5]};
    link.stiffness = wood.stiffness[i];
    link.damping = wood.damping[i];
  }
  return out;
}

ModalTree::ModalTree(const Tree& tree, const Species& species, ModalDepth depth)
    : foot_(tree.foot), drag_(tree.drag), reference_speed_(tree.reference_speed) {
  if (tree.joint_model != JointModel::SWING)
    throw InvalidInput("modes: joint_model = paper has none; allowed: swing");
  const std::vector<physics::Link> links = chainOf(tree.skeleton, species);
  physics::LinearChain chain(links);
  std::vector<WindLoadPoint> load_points =
      windLoadPoints(tree.skeleton, woodOf(tree.skeleton, species, Material::BEAM));
  modes_ = modesIn(links, chain, load_points, depth);
  joints_ = modes_.damping;
  Motions motions(size());
  for (std::size_t m = 0; m < size(); ++m) {
    chain.motionOf(modes_.shapeOf(m), motions[m]);
    for (const WindLoadPoint& load_point : load_points) {  // still air damps motion
      const Vec3 way = wayOf(load_point, motions[m]);
      modes_.damping[m] += load_point.drag * dot(way, way);
    }
  }
  probe_ = physics::RotationProbe(chain, modes_);
  coarse_ = pointsOf(load_points, motions, COARSE);
  fine_ = pointsOf(load_points, motions, FINE);
  uniform_ = uniformWindLoad(load_points, motions);
  levers_ = leverArmChange(links, chain, modes_, load_points, motions);
  for (const WindPoint& whole : pointsOf(load_points, motions, 0).at) middle_ = whole.position;
  stiffness_ = chain.stiffness();
}

std::size_t ModalTree::bytes() const {
  std::size_t numbers = stiffness_.size() + joints_.size() + uniform_.size() + levers_.size();
  for (const WindPoints* points : {&coarse_, &fine_})
    numbers += points->push.size() + 4 * points->at.size();
  return sizeof(*this) + modes_.bytes() + sizeof(double) * numbers +
         sizeof(Vec3) * probe_.turn.size();
}

// Waves that remain keep their cached loads when wind primitives change.
void ModalTree::updateWaves(const wind::Instant& wind, ModalAir& air) const {
  const auto same = [](const Vec3& wave, const wind::Mode& mode) { return wave == mode.wave; };
  if (air.waves.size() == wind.modes.size() &&
      std::equal(air.waves.begin(), air.waves.end(), wind.modes.begin(), same))
    return;
  const std::size_t each = 6 * modalRow(size());
  const std::vector<Vec3> known = std::move(air.waves);
  const std::vector<double> push = std::move(air.push);
  air.waves.clear();
  air.push.assign(each * wind.modes.size(), 0.0);
  double* out = air.push.data();
  for (const wind::Mode& mode : wind.modes) {
    const auto found = std::find(known.begin(), known.end(), mode.wave);
    if (found != known.end())
      std::copy_n(push.begin() + (found - known.begin()) * static_cast<std::ptrdiff_t>(each), each,
                  out);
    else
      pushOf(mode.wave, out);
    air.waves.push_back(mode.wave);
    out += each;
  }
}

// The load of a wave a cos(2 pi (k . x + phase)) is that of its cosine at phase 0 times cos(2 pi
// phase), minus that of its sine times sin(2 pi phase).
void ModalTree::pushOf(const Vec3& wave, double* out) const {
  const std::size_t row = modalRow(size());
  for (std::size_t i = 0; i < fine_.at.size(); ++i) {
    const SinCos turn = sinCosTurns(dot(wave, foot_ + fine_.at[i].position));
    const double* push = fine_.push.data() + 3 * row * i;
    for (std::size_t k = 0; k < 3 * row; ++k) {
      out[k] += turn.cos * push[k];
      out[3 * row + k] += turn.sin * push[k];
    }
  }
}

void ModalTree::loadOf(const wind::Instant& wind, ModalAir& air, std::vector<double>& out) const {
  const std::size_t row = modalRow(size());
  std::vector<Vec3>& velocities = air.velocities;
  out.assign(row, 0.0);
  if (drag_ == Drag::LINEAR) {
    updateWaves(wind, air);
    velocities.clear();
    for (const wind::Mode& mode : wind.modes) {
      const SinCos turn = sinCosTurns(mode.phase);
      velocities.push_back(turn.cos * mode.amplitude);
      velocities.push_back(-turn.sin * mode.amplitude);
    }
    addPushes(uniform_.data(), row, &wind.mean, 1, out.data());
    addPushes(air.push.data(), row, velocities.data(), velocities.size(), out.data());
  }
  if (drag_ != Drag::LINEAR || !wind.terms.empty()) {
    velocitiesAt(wind, air);
    addPushes(coarse_.push.data(), row, velocities.data(), velocities.size(), out.data());
  }
  out.resize(size());
}

Vec3 ModalTree::airOn(const wind::Instant& wind) const {
  return wind.velocity(foot_ + middle_);
}

void ModalTree::bendLevers(const Vec3& velocity, const std::vector<double>& amplitude,
                           ModalAir& air, std::vector<double>& load) const {
  const std::size_t row = modalRow(size());
  const double turn = probe_.largestTurn(amplitude);
  const double share = turn > physics::MODAL_LIMIT ? physics::MODAL_LIMIT / turn : 1.0;
  air.velocities.clear();
  for (const double a : amplitude) air.velocities.push_back(share * a * velocity);
  load.resize(row, 0.0);
  addPushes(levers_.data(), row, air.velocities.data(), air.velocities.size(), load.data());
  load.resize(size());
}

// Loads at the coarse points, of all wind but the waves.
void ModalTree::velocitiesAt(const wind::Instant& wind, ModalAir& air) const {
  air.velocities.assign(coarse_.at.size(), Vec3::Zero());
  if (drag_ == Drag::LINEAR) {
    for (std::size_t i = 0; i < coarse_.at.size(); ++i)
      for (const wind::Term& term : wind.terms)
        air.velocities[i] += wind::velocityOf(term, foot_ + coarse_.at[i].position);
    return;
  }
  air.sampler.clear();
  for (const WindPoint& point : coarse_.at) air.sampler.add(foot_ + point.position);
  air.sampler.sample(wind);
  for (std::size_t i = 0; i < coarse_.at.size(); ++i)
    air.velocities[i] = effectiveVelocity(air.sampler.velocity(i), drag_, reference_speed_);
}

std::vector<JointAngles> ModalTree::bendsOf(const std::vector<double>& amplitude) const {
  std::vector<JointAngles> out(modes_.length / 2);
  for (std::size_t m = 0; m < size(); ++m) {
    const double* shape = modes_.shapeOf(m);
    for (std::size_t i = 0; i < out.size(); ++i) {
      out[i].first += amplitude[m] * shape[2 * i];
      out[i].second += amplitude[m] * shape[2 * i + 1];
    }
  }
  return out;
}

// Shapes of unit modal mass have the stiffness frequency^2 and are orthogonal in it.
std::vector<double> ModalTree::amplitudesOf(const std::vector<JointAngles>& bends) const {
  std::vector<double> out(size(), 0.0);
  for (std::size_t m = 0; m < size(); ++m) {
    const double* shape = modes_.shapeOf(m);
    for (std::size_t i = 0; i < bends.size(); ++i)
      out[m] +=
          stiffness_[2 * i] * (shape[2 * i] * bends[i].first + shape[2 * i + 1] * bends[i].second);
    out[m] /= modes_.frequency[m] * modes_.frequency[m];
  }
  return out;
}

JointAngles limited(const JointAngles& bends) {
  const double size = std::sqrt(bends.first * bends.first + bends.second * bends.second);
  if (size <= BEND_KNEE) return bends;
  const double scale = softLimit(size, BEND_KNEE, BEND_LIMIT) / size;
  return {scale * bends.first, scale * bends.second};
}

}  // namespace vegetation_sim::forest
