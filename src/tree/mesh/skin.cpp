// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/mesh/skin.h"

namespace vegetation_sim::forest {
namespace {

struct Turn {
  float w, x, y, z;
};

struct Axes {
  std::array<float, 3> x, y, z;
};

Turn turnOf(const BatchPoses& poses, int branch) {
  const auto i = static_cast<std::size_t>(branch);
  return {poses.qw[i], poses.qx[i], poses.qy[i], poses.qz[i]};
}

Turn multiply(const Turn& a, const std::array<float, 4>& b) {
  return {a.w * b[0] - a.x * b[1] - a.y * b[2] - a.z * b[3],
          a.w * b[1] + a.x * b[0] + a.y * b[3] - a.z * b[2],
          a.w * b[2] - a.x * b[3] + a.y * b[0] + a.z * b[1],
          a.w * b[3] + a.x * b[2] - a.y * b[1] + a.z * b[0]};
}

Axes axesOf(const Turn& q) {
  return {{1.f - 2.f * (q.y * q.y + q.z * q.z), 2.f * (q.x * q.y + q.w * q.z),
           2.f * (q.x * q.z - q.w * q.y)},
          {2.f * (q.x * q.y - q.w * q.z), 1.f - 2.f * (q.x * q.x + q.z * q.z),
           2.f * (q.y * q.z + q.w * q.x)},
          {2.f * (q.x * q.z + q.w * q.y), 2.f * (q.y * q.z - q.w * q.x),
           1.f - 2.f * (q.x * q.x + q.y * q.y)}};
}

float along(const Axes& a, const std::array<float, 3>& v, std::size_t i) {
  return a.x[i] * v[0] + a.y[i] * v[1] + a.z[i] * v[2];
}

std::array<float, 3> baseOf(const BatchPoses& poses, int branch) {
  const auto i = static_cast<std::size_t>(branch);
  return {poses.x[i], poses.y[i], poses.z[i]};
}

// Computes the corners of one card. Flutter is a rotation by small angles: the axes tilt towards
// the normal.
void writeCard(const LeafCard& card, const LeafOutline& outline, const std::array<float, 3>& foot,
               const Axes& axes, const std::array<float, 2>& turn, float* out) {
  for (std::size_t i = 0; i < 3; ++i) {
    const float across = card.size * (axes.x[i] + turn[0] * axes.z[i]);
    const float up = card.size * (axes.y[i] + turn[1] * axes.z[i]);
    for (std::size_t corner = 0; corner < LEAF_CORNERS; ++corner)
      out[3 * corner + i] =
          foot[i] + (outline[corner][0] - 0.5f) * across + outline[corner][1] * up;
  }
}

}  // namespace

Flutter::Flutter(double seconds, double wind_speed, double largest) {
  for (std::uint32_t kind = 0; kind < KINDS; ++kind)
    turns_[kind] = leafFlutter(kind * 0x9e3779b9u, seconds, wind_speed, largest);
}

void skinBark(const TreeMesh& mesh, const BatchPoses& poses, const std::array<float, 3>& foot,
              float* positions) {
  int branch = -1;
  Axes axes{};
  std::array<float, 3> base{};
  for (const BarkVertex& vertex : mesh.bark) {
    if (vertex.branch != branch) {  // vertices of one ring are consecutive
      branch = vertex.branch;
      axes = axesOf(turnOf(poses, branch));
      base = baseOf(poses, branch);
    }
    for (std::size_t i = 0; i < 3; ++i)
      *positions++ = foot[i] + base[i] + along(axes, vertex.local, i);
  }
}

void turnBarkNormals(const TreeMesh& mesh, const BatchPoses& poses, float* normals) {
  for (const BarkVertex& vertex : mesh.bark) {
    const Axes axes = axesOf(turnOf(poses, vertex.branch));
    for (std::size_t i = 0; i < 3; ++i) *normals++ = along(axes, vertex.normal, i);
  }
}

void skinLeaves(const TreeMesh& mesh, const BatchPoses& poses, const std::array<float, 3>& foot,
                const Flutter& flutter, float* positions) {
  for (std::size_t number = 0; number < mesh.leaves.size(); ++number) {
    const LeafCard& card = mesh.leaves[number];
    const Turn turn = turnOf(poses, card.branch);
    const Axes axes = axesOf(turn);
    std::array<float, 3> at = baseOf(poses, card.branch);
    for (std::size_t i = 0; i < 3; ++i) at[i] += foot[i] + along(axes, card.local, i);
    writeCard(card, mesh.outlineOf(number), at, axesOf(multiply(turn, card.rotation)),
              flutter.of(card.key), positions);
    positions += std::size_t{3} * LEAF_CORNERS;
  }
}

}  // namespace vegetation_sim::forest
