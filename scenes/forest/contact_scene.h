// Bodies that are driven at the trees of a forest, and records of the contacts.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "forest/contact/contact_body.h"
#include "forest/contact/contact_finder.h"
#include "forest/forest.h"
#include "scenes/forest/forest_fixture.h"

namespace vegetation_sim::forest {

constexpr int TICKS = 60;  // [Hz]

/// A tree in still air, and a capsule of 5 cm that is driven through its crown along x.
class Drive {
 public:
  explicit Drive(double speed, const Vec3& start = Vec3(-1.6, 0.3, 6.5),
                 const std::string& species = "birch", std::uint64_t tree = 7)
      : forest_(layout(species, tree), flatTerrain(), Settings()) {
    body_.id = "arm";
    body_.frame = "arm_link";
    body_.shape = Shape::CAPSULE;
    body_.size = Vec3(0.025, 0.0, 0.6);
    body_.pose = {start, Quat{std::sqrt(0.5), std::sqrt(0.5), 0.0, 0.0}};
    body_.velocity = Vec3(speed, 0.0, 0.0);
    body_.stamp = stampOf(0);
    tree_ = growTree(forest_.layout(), 0, forest_.terrain());
    forest_.advance(stampOf(0));
  }

  static Layout layout(const std::string& species = "birch", std::uint64_t tree = 7) {
    Layout out;
    out.species = {shippedSpecies(species)};
    TreeSeed seed;
    seed.seed = tree;
    out.trees = {seed};
    return out;
  }

  static Nanoseconds stampOf(std::int64_t tick) {
    return 100 * NANOSECONDS_PER_SECOND + TickGrid(TICKS).timeOf(tick);
  }
  void tick() { forest_.advance(stampOf(++tick_)); }
  /// Advances one tick with the body at the pose that tf would give.
  void driveOn() {
    Body now = body_;
    now.pose = poseAt(body_, stampOf(tick_ + 1));
    now.stamp = stampOf(tick_ + 1);
    forest_.setBody(now);
    tick();
  }
  /// Returns the deepest overlap of thin wood with the body at this tick [m].
  double depth() const {
    const Pose at = poseAt(body_, stampOf(tick_));
    const std::vector<Pose> poses = forest_.pose(tree_, 0, stampOf(tick_));
    double out = 0.0;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const Branch& b = tree_.skeleton.branches[i];
      const Quat turn = conjugate(at.orientation);
      const physics::Bar bar{rotate(turn, Vec3(tree_.foot + poses[i].position - at.position)),
                             rotate(turn, axisZ(poses[i].orientation)), b.length, b.base_radius,
                             b.tip_radius};
      const physics::Proximity found = nearest(shapeOf(body_), bar);
      if (bar.radiusAt(found.along) < 0.01) out = std::max(out, -found.gap);
    }
    return out;
  }

  Forest& forest() { return forest_; }
  const Body& body() const { return body_; }

 private:
  Forest forest_;
  Tree tree_;
  Body body_;
  std::int64_t tick_{0};
};

/// Records the contacts of a forest: the impulse on the trees and how these move.
class ContactRecorder {
 public:
  /// Returns a finder whose results are recorded here; it must not outlive this object.
  std::shared_ptr<const ContactFinder> makeFinder() {
    ContactTrace trace;
    trace.on_search = [this](const ContactTree& tree, Nanoseconds from,
                             const PersistentContacts& contacts) {
      recordSearch(tree, from, contacts);
    };
    trace.on_step = [this](const ContactTree& tree, const std::vector<physics::Contact>& contacts,
                           Nanoseconds to) { recordStep(tree, contacts, to); };
    return std::make_shared<ContactFinder>(trace);
  }
  int searches{0};             ///< substeps, repeated ones included
  Vec3 impulse{Vec3::Zero()};  ///< on the trees [N s]
  double size{0.0};            ///< sum of the sizes of all contributions to `impulse` [N s]
  double rise{0.0};            ///< largest rise of the force on a branch between substeps [N]
  double shortest{1.0};        ///< substep [s]
  double farthest{0.0};        ///< displacement of a joint in a substep [m]
  double leap{0.0};     ///< largest part of a displacement that velocities do not explain [m]
  int repeated{0};      ///< substeps that were repeated
  int inconsistent{0};  ///< of these, begun with other persistent contacts than before

 private:
  void recordSearch(const ContactTree& tree, Nanoseconds from, const PersistentContacts& contacts) {
    ++searches;
    if (from > from_ && last_.pose.size() == tree.start.pose.size()) {
      const double h = secondsBetween(from_, from);
      for (std::size_t i = 0; i < last_.pose.size(); ++i) {
        const Vec3 way = tree.start.pose[i].position - last_.pose[i].position;
        const Vec3 mean = 0.5 * (tree.start.velocity[i] + last_.velocity[i]);
        farthest = std::max(farthest, length(way));
        leap = std::max(leap, length(way - h * mean));
      }
    }
    const bool again = from == from_;
    repeated += again;
    inconsistent += again && contacts.size() != count_;
    count_ = contacts.size();
    last_ = tree.start;
    from_ = from;
  }
  void recordStep(const ContactTree& tree, const std::vector<physics::Contact>& contacts,
                  Nanoseconds to) {
    const double h = secondsBetween(from_, to);
    shortest = std::min(shortest, h);
    std::map<int, double> forces;
    for (const physics::Contact& contact : contacts) {
      impulse += h * contact.force * contact.normal, size += h * contact.force;
      forces[tree.branches[static_cast<std::size_t>(contact.link)]] += contact.force;
    }
    for (const auto& [branch, force] : forces) rise = std::max(rise, force - forces_[branch]);
    forces_ = forces;
  }

  Nanoseconds from_{0};
  std::size_t count_{0};
  physics::Kinematics last_;
  std::map<int, double> forces_;  // on branches
};

/// Spheres that touch a birch's trunk at a fraction `part` of its length, so small that each has
/// one contact. `from` is the direction of each about the trunk [rad].
class Ram {
 public:
  Ram(double speed, int ticks, double part = 0.0, const std::vector<double>& from = {0.0})
      : grid_(ticks), forest_(Drive::layout(), flatTerrain(), Settings()) {
    const Branch trunk = growTree(forest_.layout(), 0, forest_.terrain()).skeleton.branches[0];
    const double radius = trunk.base_radius + part * (trunk.tip_radius - trunk.base_radius);
    for (const double angle : from) {
      const Vec3 way(std::cos(angle), std::sin(angle), 0.0);
      Body body;
      body.id = "arm" + std::to_string(bodies_.size());
      body.shape = Shape::SPHERE;
      body.size = Vec3(0.05, 0.0, 0.0);
      body.velocity = speed * way;
      body.pose.position = -(radius + 0.05) * way;
      body.pose.position.z() = std::max(0.3, part * trunk.length);
      body.stamp = now();
      bodies_.push_back(body);
    }
    forest_.advance(now());
  }
  void driveOn() {
    ++tick_;
    for (Body there : bodies_) {
      there.pose = poseAt(there, now());
      there.stamp = now();
      forest_.setBody(there);
    }
    forest_.advance(now());
  }
  Forest& forest() { return forest_; }

 private:
  Nanoseconds now() const { return 100 * NANOSECONDS_PER_SECOND + grid_.timeOf(tick_); }

  TickGrid grid_;
  Forest forest_;
  std::vector<Body> bodies_;
  std::int64_t tick_{0};
};

}  // namespace vegetation_sim::forest
