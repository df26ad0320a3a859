// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "trees/test_trees.h"

#include <cmath>

#include "vegetation_sim/core/math/hash.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"
#include "vegetation_sim/tree/growth/skeleton.h"

namespace vegetation_sim::bench {
namespace {

constexpr double DAMPING_RATIO = 0.1;

void weigh(TestLink& link, double density, double modulus) {
  const double r2 = link.radius * link.radius;
  link.mass = density * PI * r2 * link.length;
  link.across = link.mass * (link.length * link.length / 3.0 + r2 / 4.0);
  link.along = 0.5 * link.mass * r2;
  link.stiffness = modulus * PI * r2 * r2 / (4.0 * link.length);
}

std::vector<Pose> restPoses(const TestTree& tree) {
  std::vector<Pose> out(tree.links.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const TestLink& link = tree.links[i];
    const Pose bearer = link.parent < 0 ? Pose() : out[static_cast<std::size_t>(link.parent)];
    out[i].position = bearer.position + link.h * axisZ(bearer.orientation);
    out[i].orientation = bearer.orientation * link.rest;
  }
  return out;
}

// nu = 2 zeta sqrt(k J), where J is the inertia of all that the joint carries about it, as points.
void damp(TestTree& tree) {
  const std::vector<Pose> rest = restPoses(tree);
  std::vector<double> mass(rest.size()), second(rest.size());
  std::vector<Vec3> moment(rest.size(), Vec3::Zero());
  for (std::size_t i = rest.size(); i-- > 0;) {
    TestLink& link = tree.links[i];
    mass[i] += link.mass;
    second[i] += link.across;
    moment[i] += 0.5 * link.mass * link.length * axisZ(rest[i].orientation);
    link.damping = 2.0 * DAMPING_RATIO * std::sqrt(link.stiffness * second[i]);
    if (link.parent < 0) continue;
    const auto p = static_cast<std::size_t>(link.parent);
    const Vec3 arm = rest[i].position - rest[p].position;
    mass[p] += mass[i];
    second[p] += second[i] + 2.0 * dot(arm, moment[i]) + mass[i] * dot(arm, arm);
    moment[p] += moment[i] + mass[i] * arm;
  }
}

// ---- fractal family ---------------------------------------------------------------------------

constexpr double TRUNK_RADIUS = 0.09, TIP_RADIUS = 0.002, LONGEST_PATH = 8.0;

struct Fractal {
  TestTree tree;
  double exponent;  // pipe model: radius^exponent ~ number of tips
  Random random{2026};

  void sprout(int parent, int tips, const Quat& rest) {
    TestLink link;
    link.parent = parent;
    link.h = parent < 0 ? 0.0 : tree.links[static_cast<std::size_t>(parent)].length;
    link.rest = rest;
    link.radius = TIP_RADIUS * std::pow(tips, 1.0 / exponent);
    link.length = std::pow(link.radius, 2.0 / 3.0);
    const auto index = static_cast<std::uint64_t>(tree.links.size());
    tree.links.push_back(link);
    if (tips == 1) return;
    const double share = random.uniform(2 * index, 0.5, 0.75);
    const int first = std::min(tips - 1, std::max(1, static_cast<int>(share * tips)));
    const double turn = 2.0 * PI * random.uniform(2 * index + 1);
    sprout(static_cast<int>(index), first, forest::restRotation(turn, 0.25));
    sprout(static_cast<int>(index), tips - first, forest::restRotation(turn + PI, 0.7));
  }
};

void scaleToLongestPath(TestTree& tree) {
  double longest = 0.0;
  std::vector<double> path(tree.links.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    const int parent = tree.links[i].parent;
    path[i] = tree.links[i].length + (parent < 0 ? 0.0 : path[static_cast<std::size_t>(parent)]);
    longest = std::max(longest, path[i]);
  }
  for (TestLink& link : tree.links) {
    link.length *= LONGEST_PATH / longest;
    link.h *= LONGEST_PATH / longest;
  }
}

}  // namespace

TestTree fractalTree(int branches) {
  const int tips = (branches + 1) / 2;  // a tree that splits in two has 2 tips - 1 branches
  Fractal fractal;
  fractal.exponent = std::log(tips) / std::log(TRUNK_RADIUS / TIP_RADIUS);
  int root = -1;
  if (branches % 2 == 0) {  // one more joint in the trunk
    fractal.tree.links.push_back({});
    fractal.tree.links[0].radius = TRUNK_RADIUS;
    fractal.tree.links[0].length = std::pow(TRUNK_RADIUS, 2.0 / 3.0);
    root = 0;
  }
  fractal.sprout(root, tips, Quat());
  TestTree out = std::move(fractal.tree);
  out.name = "fractal";
  scaleToLongestPath(out);
  for (TestLink& link : out.links) weigh(link, 900.0, 8e9);
  damp(out);
  return out;
}

TestTree speciesTree(const std::string& file, int branches) {
  const forest::Species plain = forest::loadSpecies(file);
  forest::Species species = plain;
  forest::TreeSeed seed;
  forest::Skeleton skeleton;
  for (forest::Design design;; design.children *= 1.05) {
    species = applyDesign(plain, design);
    skeleton = grow(seed, species);
    if (skeleton.branches.size() >= static_cast<std::size_t>(branches)) break;
  }
  TestTree out;
  out.name = plain.name;
  for (int i = 0; i < branches; ++i) {
    const forest::Branch& b = skeleton.branches[static_cast<std::size_t>(i)];
    TestLink link;
    link.parent = b.parent;
    link.h = b.h;
    link.rest = forest::restRotation(b.theta, b.phi);
    link.length = b.length;
    link.radius = 0.5 * (b.base_radius + b.tip_radius);
    weigh(link, species.density, species.youngs_modulus);
    out.links.push_back(link);
  }
  damp(out);
  return out;
}

std::vector<int> TestTree::tips() const {
  std::vector<char> bears(links.size(), 0);
  for (const TestLink& link : links)
    if (link.parent >= 0) bears[static_cast<std::size_t>(link.parent)] = 1;
  std::vector<int> out;
  for (std::size_t i = 0; i < links.size(); ++i)
    if (!bears[i]) out.push_back(static_cast<int>(i));
  return out;
}

std::uint64_t TestTree::hash() const {
  Hash out;
  for (const TestLink& l : links) {
    out.add(static_cast<std::uint64_t>(l.parent + 1));
    for (const double x : {l.h, l.rest.w, l.rest.x, l.rest.y, l.rest.z, l.length, l.radius, l.mass,
                           l.across, l.along, l.stiffness, l.damping})
      out.add(x);
  }
  return out.value();
}

double TestLoad::factor(int interval, double time) const {
  if (interval >= LOADED_INTERVALS) return 0.0;
  if (kind == Kind::PULL) return 1.0;
  const double s = std::sin(PI * time);
  return s * s * s * s;  // the force is quadratic in a wind speed that is proportional to s^2
}

TestLoad gust(const TestTree& tree) {
  constexpr double SPEED = 18.0, AIR = 1.2;
  TestLoad out;
  out.kind = TestLoad::Kind::GUST;
  for (std::size_t i = 0; i < tree.links.size(); ++i) {
    const TestLink& link = tree.links[i];
    const double area = 2.0 * link.radius * link.length;
    out.links.push_back(static_cast<int>(i));
    out.force.emplace_back(0.5 * AIR * SPEED * SPEED * area, 0.0, 0.0);
    out.along.push_back(0.5 * link.length);
  }
  return out;
}

TestLoad pull(const TestTree& tree) {
  std::size_t best = 0;
  for (std::size_t i = 0; i < tree.links.size(); ++i)
    if (std::abs(tree.links[i].radius - 0.01) < std::abs(tree.links[best].radius - 0.01)) best = i;
  TestLoad out;
  out.kind = TestLoad::Kind::PULL;
  out.links = {static_cast<int>(best)};
  out.force = {Vec3(0.0, 20.0, 0.0)};
  out.along = {tree.links[best].length};
  return out;
}

}  // namespace vegetation_sim::bench
