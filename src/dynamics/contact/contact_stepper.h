// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "dynamics/chain/articulated.h"
#include "dynamics/contact/contact_settings.h"

namespace vegetation_sim::physics {

/// A link that touches a moving body, or may touch it during the step, with both at the start of
/// the step.
struct Contact {
  int link{0};
  double along{0.0};           ///< position of the point on the link's axis [m]
  Vec3 normal{Vec3::UnitZ()};  ///< from body to link, unit, world axes
  double gap{0.0};             ///< between the surfaces, along the normal; negative: overlap [m]
  Vec3 surface{Vec3::Zero()};  ///< velocity of the body there, world [m/s]
  double share{1.0};           ///< share of the force limit that it may reach, 0 to 1
  double hardness{1.0};        ///< factor of the law's stiffness and limit, for harder wood
  std::size_t touch{0};        ///< identifies the contact to the caller
  double force{0.0};    ///< force on the link along the normal [N]: first a guess, then the result
  bool limited{false};  ///< the force was at its limit
};

/// Steps chains that touch bodies: the linearly implicit step of ChainStepper with a force per
/// contact that pushes and never pulls. Trials find which contacts press, starting from the forces
/// of the last step. Keeps scratch memory only.
class ContactStepper {
 public:
  /// Takes one step of `h` seconds from `time`. `theta` runs from 1/2, the midpoint, to 1, backward
  /// Euler, and must be guarded already. `contacts` are as at the start of the step and receive
  /// their forces.
  void step(const std::vector<Link>& links, const Surroundings& outside, const ContactLaw& law,
            double time, double h, double theta, ChainState& state, std::vector<Contact>& contacts);
  /// Number of trials of the last step, and whether the last of them changed no contact.
  int trials() const { return trials_; }
  bool agreed() const { return agreed_; }
  /// Returns the largest change of the forces on a link in the last step, up and down, with those
  /// of all bodies summed [N].
  double forceChange() const { return force_change_; }

 private:
  enum class Mode { FREE, PRESSING, EASING, LIMITED };  // FREE: at its lowest force, mostly zero
  struct Point {
    Mode mode{Mode::FREE};
    Vec3 arm;
    double speed;            // along the normal, relative to the body [m/s]
    double gap;              // the gap that the speed at the end of the step changes [m]
    double stiffness, full;  // [N/m]; largest force [N]
    double floor, limit;     // lowest and highest force in this step [N]
    double before;           // force at the start of the step [N]
  };
  // Force as a linear function of the speed at the end of the step.
  struct Line {
    double at_rest, slope;  // [N], [N s/m]
    double at(double speed) const { return at_rest - slope * speed; }
  };
  void updateGeometry(const std::vector<Link>& links, const Surroundings& outside, double time,
                      double h, double theta, const ChainState& state);
  void prepare(const ContactLaw& law, double h, double theta, const std::vector<Contact>& contacts);
  void addAnchors(const ContactLaw& law, double h, double theta,
                  const std::vector<Contact>& contacts);
  void spread(const std::vector<Link>& links);
  static Line lineOf(const ContactLaw& law, double h, const Point& point, Mode mode);
  static Mode modeAt(const ContactLaw& law, double h, const Point& point, double speed);
  static double forceOf(const ContactLaw& law, double h, const Point& point, double speed);
  static double forceChangeOf(double h, const Point& point, const Contact& contact);
  double speedAfter(double h, const Point& point, const Contact& contact) const;
  bool revise(const ContactLaw& law, double h, bool one_by_one, std::vector<Contact>& contacts);

  ArticulatedBody body_;
  std::vector<BaseMotion> bases_;
  Kinematics kinematics_;
  Loads loads_;
  ChainState between_;
  std::vector<Vec2> acceleration_;
  std::vector<Vec3> turn_, move_;
  std::vector<Point> points_;
  int trials_{0};
  bool agreed_{true};
  std::vector<double> force_changes_;  // per link, over all bodies
  double force_change_{0.0};
};

}  // namespace vegetation_sim::physics
