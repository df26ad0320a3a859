// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "dynamics/chain/articulated.h"
#include "vegetation_sim/dynamics/contact/contact_law.h"

namespace vegetation_sim::physics {

/// A link that touches a moving body, or may during the step, where both are at its start.
struct Contact {
  int link{0};
  double along{0.0};           ///< of the point on the link's axis [m]
  Vec3 normal{Vec3::UnitZ()};  ///< from body to link, unit, world axes
  double gap{0.0};             ///< between the surfaces, along the normal; negative: overlap [m]
  Vec3 surface{Vec3::Zero()};  ///< velocity of the body there, world [m/s]
  double share{1.0};           ///< of the force limit that it may reach, 0 to 1
  double bears{1.0};           ///< times the law's stiffness and limit: harder wood
  std::size_t touch{0};        ///< whatever the caller knows it by
  double force{0.0};           ///< on the link along the normal [N]: a guess, then what it was
  bool limited{false};         ///< the force was at its limit
};

/// Steps chains that touch bodies: the linearly implicit step of ChainStepper with a force per
/// contact that pushes and never pulls. Which contacts press is found by trial, from the last
/// step's forces on. Keeps scratch only.
class ContactStepper {
 public:
  /// One step of `h` seconds from `time`. `theta`: 1/2 midpoint to 1 backward Euler, already
  /// guarded. `contacts`: as at the start of the step; gives their forces.
  void step(const std::vector<Link>& links, const Surroundings& outside, const ContactLaw& law,
            double time, double h, double theta, ChainState& state, std::vector<Contact>& contacts);
  /// Trials of the last step, and whether the last of them agreed with itself.
  int trials() const { return trials_; }
  bool agreed() const { return agreed_; }
  /// By how much the forces on a link changed at most in the last step, to and fro, those of all
  /// bodies together [N].
  double swing() const { return swing_; }

 private:
  enum class Mode { FREE, PRESSING, EASING, LIMITED };  // FREE: at the floor, mostly zero
  struct Point {
    Mode mode{Mode::FREE};
    Vec3 arm;
    double speed;            // along the normal, relative to the body [m/s]
    double gap;              // the one that the step's last speed changes [m]
    double stiffness, full;  // [N/m]; the most that it bears [N]
    double floor, limit;     // of the force in this step [N]
    double before;           // the force [N]
  };
  // Force over speed at the end of the step.
  struct Line {
    double at_rest, slope;  // [N], [N s/m]
    double at(double speed) const { return at_rest - slope * speed; }
  };
  void look(const std::vector<Link>& links, const Surroundings& outside, double time, double h,
            double theta, const ChainState& state);
  void prepare(const ContactLaw& law, double h, double theta, const std::vector<Contact>& contacts);
  void addAnchors(const ContactLaw& law, double h, double theta,
                  const std::vector<Contact>& contacts);
  void spread(const std::vector<Link>& links);
  static Line lineOf(const ContactLaw& law, double h, const Point& point, Mode mode);
  static Mode modeAt(const ContactLaw& law, double h, const Point& point, double speed);
  static double forceOf(const ContactLaw& law, double h, const Point& point, double speed);
  static double swingOf(double h, const Point& point, const Contact& contact);
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
  std::vector<double> swings_;  // of links, by all bodies
  double swing_{0.0};
};

}  // namespace vegetation_sim::physics
