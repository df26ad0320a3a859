// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/ground/blob_shadow.h"

#include <algorithm>
#include <cmath>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::view {
namespace {

constexpr double BLOB_LIFT = 0.02;        // [m] of the mesh over the ground
constexpr double LOWEST_BLOB_SUN = 0.25;  // sine of the lowest elevation that makes shadows longer
constexpr double FARTHEST_SHADOW = 8.0;   // [m] from a box to its shadow
constexpr double SOFT_EDGE = 1.3;         // factor of the half axes, since the edge is faint
constexpr double CONTACT_GAP = 0.12;      // [m] below a box at which its shadow is half as strong
constexpr double FAINTEST = 0.02;         // strength of shadows that are left out
constexpr double CONTACT_HEIGHT = 0.25;   // [m] BlobShadow::height below a box that stands

// Sets the half axes of the ellipse that has the second moments of horizontal vectors.
void setAxes(const std::array<Vec3, 3>& spans, double margin, BlobShadow& shadow) {
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (const Vec3& span : spans) {
    xx += span.x() * span.x();
    xy += span.x() * span.y();
    yy += span.y() * span.y();
  }
  const double turn = 0.5 * std::atan2(2.0 * xy, xx - yy);
  const double middle = 0.5 * (xx + yy), apart = std::hypot(0.5 * (xx - yy), xy);
  const double longer = SOFT_EDGE * std::sqrt(middle + apart) + margin;
  const double shorter = SOFT_EDGE * std::sqrt(std::max(0.0, middle - apart)) + margin;
  const double c = std::cos(turn), s = std::sin(turn);
  shadow.first = Vec3(longer * c, longer * s, 0.0);
  shadow.second = Vec3(-shorter * s, shorter * c, 0.0);
}

// Lays centre and axes onto the ground.
void layOn(const terrain::HeightMap& terrain, BlobShadow& shadow) {
  shadow.centre.z() = terrain.height(shadow.centre.x(), shadow.centre.y());
  if (terrain.isFlat()) return;
  const Vec3 normal = terrain.normal(shadow.centre.x(), shadow.centre.y());
  for (Vec3* axis : {&shadow.first, &shadow.second})
    axis->z() = -(normal.x() * axis->x() + normal.y() * axis->y()) / std::max(0.1, normal.z());
}

}  // namespace

ShadowBox capsuleBox(const Vec3& from, const Vec3& to, double radius) {
  const Vec3 way = to - from;
  const double size = length(way);
  const Vec3 along = size > 1e-9 ? Vec3(way / size) : Vec3(Vec3::UnitZ());
  const Vec3 other = std::fabs(along.z()) < 0.9 ? Vec3(Vec3::UnitZ()) : Vec3(Vec3::UnitX());
  const Vec3 side = cross(along, other) / length(cross(along, other));
  return {0.5 * (from + to),
          {(0.5 * size + radius) * along, radius * side, radius * cross(along, side)}};
}

std::optional<BlobShadow> contactShadow(const ShadowBox& box, double strength,
                                        const terrain::HeightMap& terrain) {
  double depth = 0.0;
  for (const Vec3& half : box.half) depth += std::fabs(half.z());
  const double ground = terrain.height(box.centre.x(), box.centre.y());
  if (box.centre.z() + depth < ground) return {};
  const double gap = std::max(0.0, box.centre.z() - depth - ground);
  BlobShadow out;
  out.centre = box.centre;
  setAxes(box.half, 0.0, out);
  // A broad body hides the sky from farther above.
  const double part = gap / (CONTACT_GAP + 0.3 * length(out.second));
  setAxes(box.half, 0.05 + 0.5 * gap, out);
  out.strength = strength / (1.0 + part * part);
  out.height = CONTACT_HEIGHT + gap;
  if (out.strength < FAINTEST) return {};
  layOn(terrain, out);
  return out;
}

std::optional<BlobShadow> sunShadow(const ShadowBox& box, const Vec3& to_sun, double strength,
                                    const terrain::HeightMap& terrain) {
  const Vec3 slant = to_sun / std::max(LOWEST_BLOB_SUN, to_sun.z());
  BlobShadow out;
  out.centre = box.centre;
  for (int i = 0; i < 3; ++i)  // iterates along the ray to the nearly flat ground
    out.centre -= (out.centre.z() - terrain.height(out.centre.x(), out.centre.y())) * slant;
  if (length(out.centre - box.centre) > FARTHEST_SHADOW || strength < FAINTEST) return {};
  std::array<Vec3, 3> spans = box.half;
  for (Vec3& span : spans) span -= span.z() * slant;
  setAxes(spans, 0.02, out);
  out.slant = Vec3(slant.x(), slant.y(), 0.0);
  out.strength = strength;
  out.height = std::max(0.1, box.centre.z() - out.centre.z());
  layOn(terrain, out);
  return out;
}

void shareDarkness(std::vector<BlobShadow>& shadows) {
  const std::vector<BlobShadow> all = shadows;
  for (BlobShadow& shadow : shadows) {
    const double reach = length(shadow.first);
    const auto near = std::count_if(all.begin(), all.end(), [&](const BlobShadow& other) {
      return length(other.centre - shadow.centre) < reach;
    });
    shadow.strength = 1.0 - std::pow(1.0 - shadow.strength, 1.0 / static_cast<double>(near));
  }
}

double shadeAt(const BlobShadow& shadow, const Vec3& place) {
  const Vec3 &a = shadow.first, &b = shadow.second;
  const double area = a.x() * b.y() - a.y() * b.x();
  if (std::fabs(area) < 1e-12) return 0.0;
  const auto alongAxes = [&](const Vec3& way) {
    return std::array<double, 2>{(way.x() * b.y() - way.y() * b.x()) / area,
                                 (a.x() * way.y() - a.y() * way.x()) / area};
  };
  const Vec3 way = place - shadow.centre;
  const auto below = alongAxes(way);
  const double high = std::max(0.0, way.z() - below[0] * a.z() - below[1] * b.z());
  const auto [u, v] = alongAxes(way - high * shadow.slant);
  const double inside = 1.0 - u * u - v * v;
  if (inside <= 0.0) return 0.0;
  return shadow.strength * inside * inside * (3.0 - 2.0 * inside) * std::exp(-high / shadow.height);
}

void appendShadow(const BlobShadow& shadow, const terrain::HeightMap& terrain,
                  grass::GrassMesh& mesh) {
  const int cells = terrain.isFlat() ? 1 : 2;
  const auto alpha = static_cast<std::uint8_t>(255.0 * saturate(shadow.strength));
  const auto base = static_cast<std::uint32_t>(mesh.vertexCount());
  for (int r = 0; r <= cells; ++r) {
    for (int c = 0; c <= cells; ++c) {
      const double u = static_cast<double>(c) / cells, v = static_cast<double>(r) / cells;
      Vec3 at = shadow.centre + (2.0 * u - 1.0) * shadow.first + (2.0 * v - 1.0) * shadow.second;
      at.z() = terrain.height(at.x(), at.y()) + BLOB_LIFT;
      const Vec3 local = at - mesh.origin;
      for (int k = 0; k < 3; ++k) mesh.positions.push_back(static_cast<float>(local[k]));
      mesh.texture.insert(mesh.texture.end(), {static_cast<float>(u), static_cast<float>(v)});
      mesh.colours.insert(mesh.colours.end(), {0, 0, 0, alpha});
      if (r == cells || c == cells) continue;
      const auto a = base + static_cast<std::uint32_t>(r * (cells + 1) + c);
      const std::uint32_t b = a + static_cast<std::uint32_t>(cells) + 1;
      mesh.indices.insert(mesh.indices.end(), {a, a + 1, b + 1, a, b + 1, b});
    }
  }
}

}  // namespace vegetation_sim::view
