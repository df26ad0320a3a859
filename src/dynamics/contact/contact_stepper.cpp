// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/contact/contact_stepper.h"

#include <algorithm>
#include <cmath>

#include "dynamics/integration/integrator.h"

namespace vegetation_sim::physics {
namespace {

constexpr int MOST_TRIALS = 24;
// After this many trials contacts change state one at a time, so that no two can alternate for
// ever.
constexpr int JOINT_TRIALS = 6;
// Forces that differ less count as equal, so that rounding decides nothing [N].
constexpr double SLACK = 1e-5;
// Forces rise at the law's rate, and by the spring beyond this overlap [m].
constexpr double DEEP = 1e-3;
// Wood does not rebound faster than this: a force falls by at most the law's limit in this time
// [s].
constexpr double FALL_TIME = 32e-6;

Symmetric3 along(const Vec3& n, double factor) {
  return {factor * n.x() * n.x(), factor * n.y() * n.y(), factor * n.z() * n.z(),
          factor * n.x() * n.y(), factor * n.x() * n.z(), factor * n.y() * n.z()};
}

}  // namespace

// Computes geometry and loads at q + theta h rate, once for all trials.
void ContactStepper::updateGeometry(const std::vector<Link>& links, const Surroundings& outside,
                                    double time, double h, double theta, const ChainState& state) {
  between_.rate = state.rate;
  between_.q.resize(links.size());
  for (std::size_t i = 0; i < links.size(); ++i)
    for (int axis = 0; axis < 2; ++axis)
      between_.q[i][axis] = state.q[i][axis] + theta * h * state.rate[i][axis];
  if (outside.bases) outside.bases(time + theta * h, bases_);
  if (!outside.bases) bases_.clear();
  kinematicsOf(links, bases_, between_, kinematics_);
  loads_.clear(links.size());
  if (outside.loads) outside.loads(kinematics_, time + theta * h, loads_);
}

// The gap that follows speeds exactly is the one at (1 - theta) h after the step's start: its next
// value is this one plus h times the speed at the end of the step.
void ContactStepper::prepare(const ContactLaw& law, double h, double theta,
                             const std::vector<Contact>& contacts) {
  points_.assign(contacts.size(), Point());
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Contact& contact = contacts[c];
    const auto i = static_cast<std::size_t>(contact.link);
    Point& p = points_[c];
    p.arm = contact.along * axisZ(kinematics_.pose[i].orientation);
    const Vec3 velocity = kinematics_.velocity[i] + cross(kinematics_.spin[i], p.arm);
    p.speed = dot(contact.normal, velocity - contact.surface);
    p.gap = contact.gap + (1.0 - theta) * h * p.speed;
    // This is the overlap that the step would add beyond DEEP. It makes the force continuous in all
    // its arguments.
    const double gain = std::clamp(-DEEP / contact.hardness - (p.gap + h * p.speed), 0.0,
                                   std::max(0.0, -h * p.speed));
    p.stiffness = contact.hardness * law.stiffness;
    p.full = contact.hardness * law.force_limit;
    p.before = contact.force;
    const double risen = contact.force + h * law.force_rate + p.stiffness * gain;
    p.floor = std::max(0.0, contact.force - h * law.force_limit / FALL_TIME);
    p.limit = std::max(p.floor, contact.share * std::min(p.full, risen));
    if (contact.force >= p.limit)
      p.mode = Mode::LIMITED;
    else if (contact.force > 0.0 || forceOf(law, h, p, p.speed) > 0.0)
      p.mode = modeAt(law, h, p, p.speed);
  }
}

// Returns the line on which the force falls with the speed at the end of the step: that of the
// spring, or that which limits the rebound to push_speed, whichever is lower. Neither depends on
// the length of the step.
ContactStepper::Line ContactStepper::lineOf(const ContactLaw& law, double h, const Point& p,
                                            Mode mode) {
  if (mode == Mode::PRESSING) return {-p.stiffness * p.gap, p.stiffness * h};
  return {p.full, p.full / law.push_speed};
}

ContactStepper::Mode ContactStepper::modeAt(const ContactLaw& law, double h, const Point& p,
                                            double speed) {
  const double spring = lineOf(law, h, p, Mode::PRESSING).at(speed);
  return lineOf(law, h, p, Mode::EASING).at(speed) < spring ? Mode::EASING : Mode::PRESSING;
}

double ContactStepper::forceOf(const ContactLaw& law, double h, const Point& p, double speed) {
  return lineOf(law, h, p, modeAt(law, h, p, speed)).at(speed);
}

// A pressing contact is a mass, h times the slope of its line, that the step adds at the point
// along the normal, plus the force at the present speed.
void ContactStepper::addAnchors(const ContactLaw& law, double h, double theta,
                                const std::vector<Contact>& contacts) {
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Point& p = points_[c];
    if (p.mode == Mode::FREE && p.floor == 0.0) continue;
    Anchor anchor;
    anchor.link = contacts[c].link;
    anchor.arm = p.arm;
    if (p.mode == Mode::LIMITED || p.mode == Mode::FREE) {
      anchor.force = (p.mode == Mode::FREE ? p.floor : p.limit) * contacts[c].normal;
    } else {
      const Line line = lineOf(law, h, p, p.mode);
      anchor.force = line.at(p.speed) * contacts[c].normal;
      anchor.damping = along(contacts[c].normal, line.slope / theta);
    }
    loads_.anchors.push_back(anchor);
  }
}

// Computes what the accelerations of the joints add to the velocities of the links, per second, for
// the anchors.
void ContactStepper::spread(const std::vector<Link>& links) {
  turn_.resize(links.size());
  move_.resize(links.size());
  for (std::size_t i = 0; i < links.size(); ++i) {
    const ArticulatedBody::Joint& joint = body_.joints()[i];
    const bool root = links[i].parent < 0;
    const auto p = static_cast<std::size_t>(root ? 0 : links[i].parent);
    turn_[i] = root ? Vec3(Vec3::Zero()) : turn_[p];
    move_[i] = root ? Vec3(Vec3::Zero()) : Vec3(move_[p] + cross(turn_[p], joint.offset));
    turn_[i] += acceleration_[i].x() * joint.first + acceleration_[i].y() * joint.second;
  }
}

// Returns the speed at the end of the step along the normal, by the motion of the last trial [m/s].
double ContactStepper::speedAfter(double h, const Point& p, const Contact& contact) const {
  const auto i = static_cast<std::size_t>(contact.link);
  return p.speed + h * dot(contact.normal, move_[i] + cross(turn_[i], p.arm));
}

// Returns whether no contact changed.
bool ContactStepper::revise(const ContactLaw& law, double h, bool one_by_one,
                            std::vector<Contact>& contacts) {
  bool settled = true;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    Point& p = points_[c];
    const double speed = speedAfter(h, p, contacts[c]);
    const Mode bearing = modeAt(law, h, p, speed);
    const double force = lineOf(law, h, p, bearing).at(speed);
    contacts[c].force = std::clamp(force, p.floor, p.limit);
    contacts[c].limited = force >= p.limit;
    Mode mode = p.mode;
    // The mode moves along the law one piece at a time, because skipping a piece may be answered by
    // a jump back.
    const bool pressed = p.mode == Mode::PRESSING || p.mode == Mode::EASING;
    const double other = p.mode == Mode::FREE ? force - p.floor : p.limit - force;
    if ((pressed ? lineOf(law, h, p, p.mode).at(speed) - force : other) > SLACK)
      mode = bearing;
    else if (pressed && force < p.floor - SLACK)
      mode = Mode::FREE;
    else if (pressed && force > p.limit + SLACK)
      mode = Mode::LIMITED;
    if (mode == p.mode || (one_by_one && !settled)) continue;
    p.mode = mode;
    settled = false;
  }
  return settled;
}

// A contact that bounces off in the middle of a step has as much force before as after it.
double ContactStepper::forceChangeOf(double h, const Point& p, const Contact& contact) {
  const double change = std::fabs(contact.force - p.before);
  if (contact.limited) return change;
  const double most = std::max(contact.force, p.before);
  return std::max(change, std::min(most, h * p.stiffness * std::fabs(p.speed)));
}

void ContactStepper::step(const std::vector<Link>& links, const Surroundings& outside,
                          const ContactLaw& law, double time, double h, double theta,
                          ChainState& state, std::vector<Contact>& contacts) {
  updateGeometry(links, outside, time, h, theta, state);
  prepare(law, h, theta, contacts);
  const std::size_t others = loads_.anchors.size();
  // These are the rules of ChainStepper for fast motion.
  const Implicitness predicted = implicitFor(theta, h, productsOf(state, h));
  agreed_ = false;
  for (trials_ = 0; trials_ < MOST_TRIALS && !agreed_; ++trials_) {
    loads_.anchors.resize(others);
    addAnchors(law, h, theta, contacts);
    body_.accelerations(links, bases_, between_, kinematics_, loads_, predicted, acceleration_);
    spread(links);
    agreed_ = revise(law, h, trials_ >= JOINT_TRIALS, contacts);
  }
  for (std::size_t i = 0; i < links.size(); ++i) {
    for (int axis = 0; axis < 2; ++axis) {
      const double change = h * acceleration_[i][axis];
      state.q[i][axis] += h * (state.rate[i][axis] + theta * change);
      state.rate[i][axis] += change;
    }
  }
  stopJoints(h, state);
  force_change_ = 0.0;
  force_changes_.assign(links.size(), 0.0);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    double& of_link = force_changes_[static_cast<std::size_t>(contacts[c].link)];
    force_change_ = std::max(force_change_, of_link += forceChangeOf(h, points_[c], contacts[c]));
  }
}

}  // namespace vegetation_sim::physics
