// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace vegetation_sim::physics {

/// Number of joints that the widest vector takes at once. Joints are stored in blocks of so many,
/// one row per quantity, so that a narrower vector reads the same rows in parts and gives the same
/// bits.
constexpr int ROW = 16;

/// Rows of ROW floats each, one after the other, on whole cache lines.
class Rows {
 public:
  void assign(std::size_t count) { lines_.assign(count, Line()); }
  void grow(std::size_t count) {
    if (count > lines_.size()) lines_.resize(count);
  }
  bool empty() const { return lines_.empty(); }
  std::size_t count() const { return lines_.size(); }
  std::size_t bytes() const { return lines_.capacity() * sizeof(Line); }
  float* at(std::size_t row) { return reinterpret_cast<float*>(lines_.data()) + row * ROW; }
  const float* at(std::size_t row) const {
    return reinterpret_cast<const float*>(lines_.data()) + row * ROW;
  }
  /// Returns the first of the `quantities` rows of the joint in `slot`.
  float* of(int slot, int quantities) {
    return at(static_cast<std::size_t>(slot / ROW * quantities)) + slot % ROW;
  }

 private:
  struct alignas(ROW * sizeof(float)) Line {
    float lane[ROW] = {};
  };
  std::vector<Line> lines_;
};

/// Rows of the constants of a joint; the inertia is about the joint, own axes. Rows that no round
/// bar needs come last: they are omitted if all joints are bars.
enum : int {
  C_H,
  C_REST,               // w x y z
  C_MASS = C_REST + 4,  //
  C_STIFFNESS,          //
  C_DAMPING,            //
  C_GUARANTEED,         // guaranteed inertia
  C_MOMENT,             // mass times centre: z
  C_XX,                 // inertia
  C_ZZ,
  C_BAR_ROWS,
  C_BESIDE = C_BAR_ROWS,  // mass times centre: x y
  C_YY = C_BESIDE + 2,
  C_XY,
  C_XZ,
  C_YZ,
  C_ROWS
};

/// Rows of its state; theta and the share of velocity products (productsOf) are the tree's. S_LEAD
/// is the predicted change of the rates until the middle of the next step.
enum : int { S_Q, S_RATE = S_Q + 2, S_LEAD = S_RATE + 2, S_THETA = S_LEAD + 2, S_PRODUCTS, S_ROWS };

/// Rows of the loads on it.
enum : int {
  L_FORCE,
  L_TORQUE = L_FORCE + 3,
  L_JOINT = L_TORQUE + 3,
  L_ARM = L_JOINT + 2,  // drag, read only where there is one: see Drag
  L_ALL = L_ARM + 3,
  L_ALONG,
  L_ROWS = L_ALONG + 3
};

/// Rows of its grip, see Grip: position along the own z axis and the two coefficients; position
/// beside that axis, x y.
enum : int { G_ALONG, G_STEADY, G_SQUARE, G_ROWS };
enum : int { B_ROWS = 2 };

/// Rows of the position of a grip, or of the wind there, see WindQuery.
enum : int { V_ROWS = 3 };

/// Rows that one step keeps between its passes. The results of the sweep down the tree overwrite
/// the motion and inertia of the link, which it has used. Bars with air on their axes have
/// W_BAR_ROWS: a large tree outgrows the second-level cache, and gaps would fill it.
enum : int {
  W_FIRST,                 // joint axes, world
  W_SECOND = W_FIRST + 3,  //
  W_ARM = W_SECOND + 3,    // from the parent's joint
  W_SWEPT = W_ARM + 3,     //
  W_BIAS = W_SWEPT,        // bias of the link alone, torque and force; for a mean: K_BIAS
  W_GRIPPED = W_BIAS + 6,  // velocity at the point where air acts
  W_AXIS = W_GRIPPED + 3,  // of a bar
  W_INERTIA = W_AXIS,      // of another rigid body: xx xy xz yy yz zz
  W_MOMENT = W_INERTIA + 6,
  W_GRIP = W_MOMENT + 3,  // from the joint to the point where air acts, unless on a bar's axis
  // after the sweep: torque and force gain of the first axis, then of the second
  W_GAIN = W_SWEPT,
  W_INVERSE = W_GAIN + 12,
  W_COUPLING = W_INVERSE + 2,
  W_DRIVE,
  W_BAR_ROWS = W_DRIVE + 2,
  W_ROWS = W_GRIP + 3
};
static_assert(W_BAR_ROWS <= W_ROWS, "the sweep writes where its motion and inertia were");

/// Additional rows of a step for the mean of velocity products.
enum : int {
  K_BIAS,               // the bias, or its change
  K_TURN = K_BIAS + 6,  // orientation
  K_SPIN = K_TURN + 4,
  K_ROWS = K_SPIN + 3
};

/// Rows that a parent passes to its children: orientation (w x y z), the spin of velocity products,
/// and the accelerations of spin and joint that it would have if no joint accelerated.
enum : int {
  F_TURN,
  F_SPIN = F_TURN + 4,
  F_SPIN_RATE = F_SPIN + 3,
  F_ACCELERATION = F_SPIN_RATE + 3,
  F_POSITION = F_ACCELERATION + 3,  // the rows from here on exist only where the motion is needed
  F_VELOCITY = F_POSITION + 3,
  F_NOW = F_VELOCITY + 3,  // the spin before the step, where F_SPIN is predicted
  F_ROWS = F_NOW + 3
};

/// Rows of the motion of joints, for callers that need it: orientation (w x y z), spin; position
/// and velocity relative to the base's position.
enum : int {
  M_TURN,
  M_SPIN = M_TURN + 4,
  M_POSITION = M_SPIN + 3,
  M_VELOCITY = M_POSITION + 3,
  M_ROWS = M_VELOCITY + 3
};

/// Rows of an articulated inertia on its way to the parent: a (6), b (9, by columns), m (6),
/// torque, force.
enum : int {
  P_A,
  P_B = P_A + 6,
  P_M = P_B + 9,
  P_TORQUE = P_M + 6,
  P_FORCE = P_TORQUE + 3,
  P_ROWS = P_FORCE + 3
};

static_assert(int{F_ROWS} <= int{P_ROWS},
              "what fits an articulated inertia fits all that is passed on");

/// Rows of the accelerations on their way to the children: of spin, of the joint.
enum : int { A_ROWS = 6 };

}  // namespace vegetation_sim::physics
