// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/forest/modal_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "vegetation_sim/common/faults.h"
#include "vegetation_sim/common/math.h"
#include "vegetation_sim/forest/wood.h"

namespace vegetation_sim::forest {
namespace {

constexpr int HALVINGS = 5;  // of the crown, to 16 points

/// What the air holds on to: drag and its centre, per branch with leaves or wood.
struct Sail {
  std::size_t branch;
  double drag;  // [kg/s]
  Vec3 arm;     // from the joint, tree's axes
  Vec3 centre;  // tree's frame
};

std::vector<Sail> sailsOf(const Skeleton& skeleton, const Wood& wood) {
  std::vector<Sail> out;
  for (std::size_t i = 0; i < skeleton.branches.size(); ++i) {
    const Composite& body = wood.own[i];
    if (body.drag <= 0.0) continue;
    const Pose& rest = skeleton.branches[i].rest;
    const Vec3 arm = rotate(rest.orientation, Vec3(body.drag_moment / body.drag));
    out.push_back({i, body.drag, arm, rest.position + arm});
  }
  return out;
}

using Range = std::vector<Sail>::iterator;

int longestAxis(Range begin, Range end) {
  Vec3 low = begin->centre, high = begin->centre;
  for (Range i = begin; i != end; ++i) {
    low = low.cwiseMin(i->centre);
    high = high.cwiseMax(i->centre);
  }
  int axis = 0;
  for (int other = 1; other < 3; ++other)
    if (high[other] - low[other] > high[axis] - low[axis]) axis = other;
  return axis;
}

// Halves of equal drag, again and again.
void divide(Range begin, Range end, int halvings, std::vector<std::pair<Range, Range>>& out) {
  if (halvings == 0 || end - begin < 2) {
    if (begin != end) out.emplace_back(begin, end);
    return;
  }
  const int axis = longestAxis(begin, end);
  std::stable_sort(
      begin, end, [axis](const Sail& a, const Sail& b) { return a.centre[axis] < b.centre[axis]; });
  const auto add = [](double sum, const Sail& sail) { return sum + sail.drag; };
  const double all = std::accumulate(begin, end, 0.0, add);
  Range middle = begin;
  for (double sum = 0.0; middle != end && sum < 0.5 * all; ++middle) sum += middle->drag;
  divide(begin, middle, halvings - 1, out);
  divide(middle, end, halvings - 1, out);
}

// Joint torques of a uniform wind of 1 m/s.
std::vector<double> uniformLoad(const physics::LinearChain& chain, const std::vector<Sail>& sails,
                                const Vec3& direction) {
  std::vector<physics::Wrench> wrenches(chain.size() / 2);
  for (const Sail& sail : sails) {
    const Vec3 force = sail.drag * direction;
    wrenches[sail.branch] = {force, cross(sail.arm, force)};
  }
  return chain.torquesOf(wrenches);
}

std::vector<WindPoint> pointsOf(std::vector<Sail> sails,
                                const std::vector<std::vector<physics::SmallMotion>>& motions) {
  std::vector<std::pair<Range, Range>> parts;
  divide(sails.begin(), sails.end(), HALVINGS, parts);
  std::vector<WindPoint> out;
  for (const auto& [begin, end] : parts) {
    WindPoint point;
    point.push.assign(motions.size(), Vec3::Zero());
    for (Range sail = begin; sail != end; ++sail) {
      point.drag += sail->drag;
      point.position += sail->drag * sail->centre;
      for (std::size_t m = 0; m < motions.size(); ++m) {
        const physics::SmallMotion& motion = motions[m][sail->branch];
        point.push[m] += sail->drag * (motion.move + cross(motion.turn, sail->arm));
      }
    }
    point.position /= point.drag;
    out.push_back(std::move(point));
  }
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
    link.rest = restRotation(b.theta, b.phi);
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
  physics::LinearChain chain(chainOf(tree.skeleton, species));
  const std::vector<Sail> sails =
      sailsOf(tree.skeleton, woodOf(tree.skeleton, species, Material::BEAM));
  modes_ = physics::slowestModes(chain, depth.modes);
  physics::addLoadVectors(chain,
                          {{uniformLoad(chain, sails, Vec3::UnitX()), depth.sideways},
                           {uniformLoad(chain, sails, Vec3::UnitY()), depth.sideways},
                           {uniformLoad(chain, sails, Vec3::UnitZ()), depth.upwards}},
                          modes_);
  std::vector<std::vector<physics::SmallMotion>> motions(size());
  for (std::size_t m = 0; m < size(); ++m) {
    chain.motionOf(modes_.shapeOf(m), motions[m]);
    for (const Sail& sail : sails) {  // the air that is at rest holds back what moves in it
      const physics::SmallMotion& motion = motions[m][sail.branch];
      const Vec3 way = motion.move + cross(motion.turn, sail.arm);
      modes_.damping[m] += sail.drag * dot(way, way);
    }
  }
  probe_ = physics::RotationProbe(chain, modes_);
  points_ = pointsOf(sails, motions);
  stiffness_ = chain.stiffness();
}

std::size_t ModalTree::bytes() const {
  return sizeof(*this) + modes_.bytes() + sizeof(double) * stiffness_.size() +
         sizeof(Vec3) * (probe_.turn.size() + points_.size() * (1 + size()));
}

void ModalTree::loadOf(const wind::Instant& wind, AirSampler& air, std::vector<double>& out) const {
  air.clear();
  for (const WindPoint& point : points_) air.add(foot_ + point.position);
  air.sample(wind);
  out.assign(size(), 0.0);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Vec3 v = effectiveVelocity(air.velocity(i), drag_, reference_speed_);
    for (std::size_t m = 0; m < size(); ++m) out[m] += dot(points_[i].push[m], v);
  }
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

// Shapes of unit modal mass have frequency^2 as their stiffness, and share none.
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
