// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/falling_piece.h"

#include <algorithm>
#include <cmath>

#include "tree/growth/branch_mass.h"
#include "tree/growth/broken_branch.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::forest {
namespace {

constexpr double GRAVITY = 9.81;            // [m/s^2]
constexpr double LONGEST_FALL = 10.0;       // [s], down 490 m
constexpr double SEARCH_STEP = 1.0 / 60.0;  // [s]
constexpr int BISECTIONS = 30;
constexpr double TURN_TIME = 0.5;            // of the turn on the ground [s]
constexpr std::size_t TURN_STEPS = 16;       // at which its height is found
constexpr double SLOWEST_SPIN = 1e-9;        // [rad/s]
constexpr std::size_t TIPS_PER_BRANCH = 16;  // whose heights take as long as the growth of a branch

Quat rotationBy(const Vec3& axis, double angle) {
  const SinCos half = sinCos(0.5 * angle);
  return {half.cos, half.sin * axis.x(), half.sin * axis.y(), half.sin * axis.z()};
}

/// Ways under linear drag after x time constants: of an initial speed v over v t, and of an
/// acceleration g over g t^2; 1 and 1/2 without drag.
struct DampedWay {
  double coasted, fallen;
};

// (1 - e^-x) / x and (x - 1 + e^-x) / x^2; the series is within 1e-13 below its end.
DampedWay dampedWay(double x) {
  if (x < 0.02) {
    const double fallen =
        0.5 * (1.0 - x / 3.0 * (1.0 - x / 4.0 * (1.0 - x / 5.0 * (1.0 - x / 6.0))));
    return {1.0 - x * fallen, fallen};
  }
  const double coasted = (1.0 - exponential(-x)) / x;
  return {coasted, (1.0 - coasted) / x};
}

}  // namespace

FallingPiece::FallingPiece(const Layout& layout, const terrain::HeightMap& terrain,
                           std::uint32_t tree, const BrokenBranches& broken, std::size_t number)
    : record_(broken.at(number)) {
  const BrokenBranches before(broken.begin(), broken.begin() + static_cast<std::ptrdiff_t>(number));
  tree_ = growTree(layout, tree, terrain, before);
  work_ = tree_.skeleton.branches.size();
  branches_ = keepPiece(record_.branch, tree_.skeleton);
  tree_.skeleton.branches.shrink_to_fit();
  tree_.response = std::vector<Response>(branches_.size());
  const Skeleton& skeleton = tree_.skeleton;
  const Species& species = layout.species[tree_.seed.species];
  const Composite body = woodOf(skeleton, species, Material::BEAM).subtree.front();
  centre_ = body.moment / body.mass;
  const double added = addedMass(species);
  gravity_ = GRAVITY * (1.0 - added) / (1.0 + added);
  drag_ = body.drag / body.mass * std::max(0.0, 1.0 - AIR_DENSITY / species.fluid_density);
  const Pose& joint = skeleton.branches.front().rest;
  const Quat back = conjugate(joint.orientation);
  points_.push_back(Vec3::Zero());
  for (const Branch& branch : skeleton.branches)
    points_.push_back(rotate(back, Vec3(tipOf(branch, branch.rest) - joint.position)));
  for (const Vec3& point : points_) reach_ = std::max(reach_, length(point));
  const Vec3 arm = rotate(record_.pose.orientation, centre_);
  velocity_ = record_.velocity + cross(record_.spin, arm);
  const double speed = length(velocity_);
  if (speed > FASTEST_PIECE) velocity_ *= FASTEST_PIECE / speed;
  land(terrain);
}

// The centre of mass falls on a parabola, less what the drag of the fluid at rest takes beyond that
// of air; the piece keeps its angular velocity.
Pose FallingPiece::fallenAt(double time) const {
  const Quat& from = record_.pose.orientation;
  const Vec3 arm = rotate(from, centre_);
  const DampedWay way = dampedWay(drag_ * time);
  const Vec3 centre = record_.pose.position + arm + (way.coasted * time) * velocity_ -
                      Vec3(0.0, 0.0, way.fallen * gravity_ * time * time);
  const double spin = length(record_.spin);
  Pose out;
  out.orientation =
      spin > SLOWEST_SPIN ? rotationBy(record_.spin / spin, spin * time) * from : from;
  out.position = centre - rotate(out.orientation, centre_);
  return out;
}

// Returns the height of the lowest point above the ground.
double FallingPiece::clearance(const terrain::HeightMap& terrain, const Pose& joint) const {
  double out = 1e300;
  for (const Vec3& point : points_) {
    const Vec3 at = joint.position + rotate(joint.orientation, point);
    out = std::min(out, at.z() - terrain.height(at.x(), at.y()));
  }
  return out;
}

void FallingPiece::land(const terrain::HeightMap& terrain) {
  double low = 0.0, high = 0.0;
  const auto is_above = [&](double time) {
    const Pose joint = fallenAt(time);
    if (joint.position.z() - reach_ > terrain.bounds().max_z) return true;
    work_ += 1 + points_.size() / TIPS_PER_BRANCH;
    return clearance(terrain, joint) > 0.0;
  };
  while (high < LONGEST_FALL && is_above(high)) {
    low = high;
    high += SEARCH_STEP;
  }
  for (int i = 0; i < BISECTIONS && high > low; ++i) {
    const double middle = 0.5 * (low + high);
    (is_above(middle) ? low : high) = middle;
  }
  fall_time_ = low;
  landed_ = fallenAt(fall_time_);
  const Vec3 axis = rotate(landed_.orientation, centre_);
  const double across = std::sqrt(axis.x() * axis.x() + axis.y() * axis.y());
  turn_angle_ = arcTangent(axis.z(), across);  // down to level
  if (across > 1e-9) turn_axis_ = Vec3(-axis.y() / across, axis.x() / across, 0.0);
  const double height = landed_.position.z() + axis.z();
  heights_.assign(TURN_STEPS + 1, height);
  for (std::size_t i = 1; i <= TURN_STEPS; ++i) {
    const Pose turned = turnedBy(static_cast<double>(i) / TURN_STEPS);
    heights_[i] = height - clearance(terrain, turned);
  }
}

// Returns the pose of the joint after a share of the turn on the ground.
Pose FallingPiece::turnedBy(double share) const {
  const Vec3 arm = rotate(landed_.orientation, centre_);
  Pose out;
  out.orientation = rotationBy(turn_axis_, share * turn_angle_) * landed_.orientation;
  Vec3 centre = landed_.position + arm;
  const double place = share * TURN_STEPS;
  const auto step = std::min(static_cast<std::size_t>(place), TURN_STEPS - 1);
  const double part = place - static_cast<double>(step);
  centre.z() = (1.0 - part) * heights_[step] + part * heights_[step + 1];
  out.position = centre - rotate(out.orientation, centre_);
  return out;
}

Nanoseconds FallingPiece::restsFrom() const {
  return landsAt() + fromSeconds(TURN_TIME);
}

Pose FallingPiece::jointAt(double time) const {
  if (time <= fall_time_) return fallenAt(std::max(0.0, time));
  return turnedBy(smoothStep((time - fall_time_) / TURN_TIME));
}

Vec3 FallingPiece::placeAt(Nanoseconds stamp) const {
  return jointAt(secondsBetween(record_.stamp, stamp)).position;
}

// The joint is never farther from the centre of mass than the size, and that falls on a parabola.
bool FallingPiece::mayReach(const BrokenBranch& record, double size, const Vec3& centre,
                            double radius) {
  const double speed =
      std::min(FASTEST_PIECE, length(record.velocity) + length(record.spin) * size);
  const Vec3 away = record.pose.position - centre;
  const double distance = std::sqrt(away.x() * away.x() + away.y() * away.y());
  return distance <= radius + 3.0 * size + speed * LONGEST_FALL;
}

std::vector<Pose> FallingPiece::poseAt(Nanoseconds stamp) const {
  const std::vector<Branch>& branches = tree_.skeleton.branches;
  const Pose& rest = branches.front().rest;
  const Pose joint = jointAt(secondsBetween(record_.stamp, stamp));
  const Quat turn = joint.orientation * conjugate(rest.orientation);
  std::vector<Pose> out(branches.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Vec3 offset = branches[i].rest.position - rest.position;
    out[i].orientation = turn * branches[i].rest.orientation;
    out[i].position = joint.position - tree_.foot + rotate(turn, offset);
  }
  return out;
}

std::vector<PieceKey> piecesOf(const BrokenTrees& trees) {
  std::vector<PieceKey> out;
  for (const auto& [tree, pieces] : trees)
    for (std::size_t i = 0; i < pieces.size(); ++i) out.push_back({tree, i});
  std::stable_sort(out.begin(), out.end(), [&](const PieceKey& a, const PieceKey& b) {
    return trees.at(a.tree)[a.number].stamp < trees.at(b.tree)[b.number].stamp;
  });
  return out;
}

}  // namespace vegetation_sim::forest
