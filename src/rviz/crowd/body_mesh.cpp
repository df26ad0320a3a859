// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/crowd/body_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "rviz/crowd/body_shape.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::view {
namespace {

constexpr double CLOTH = 0.72;  // factor of the colours, which sunlight makes brighter
constexpr double EYES = 0.35;   // the same of the sockets of eyes
constexpr std::size_t MOST_SIDES = 12;
// Heights [pixel] above which tubes have all sides, half of them, and all rings.
constexpr double FINE = 120.0, COARSE = 24.0, RINGS = 35.0;

// Rises from 0 at a height to 1 at 1.5 times the height.
double risen(double pixels, double from) {
  return smootherStep((pixels / from - 1.0) / 0.5);
}

struct Corner {
  Vec3 at, colour;
};

Corner between(const Corner& a, const Corner& b, double share) {
  return {(1.0 - share) * a.at + share * b.at, (1.0 - share) * a.colour + share * b.colour};
}

using Corners = std::array<Corner, MOST_SIDES>;

/// Draws the tubes of a body.
class TubeWriter {
 public:
  TubeWriter(const std::vector<BodyRing>& rings, const BodyStyle& style, const Daylight& daylight,
             const LightAt& light, grass::GrassMesh& mesh)
      : rings_(rings), style_(style), daylight_(daylight), light_(light), mesh_(mesh) {}

  void write() {
    const std::size_t count = rings_.size();
    for (std::size_t first = 0; first < count;) {
      std::size_t end = first + 1;
      while (end < count && !rings_[end].begins) ++end;
      writeTube(first, end);
      first = end;
    }
  }

 private:
  void writeTube(std::size_t first, std::size_t end) {
    bool joined = false;
    for (std::size_t i = first; i < end; ++i) {
      if (rings_[i].fine && style_.rings <= 0.0) continue;
      const auto at = static_cast<std::uint32_t>(mesh_.vertexCount());
      writeRing(cornersOf(i, first, end));
      if (joined) join(at);
      joined = true;
    }
  }

  // A fine ring of a small body lies between its neighbours, so that nothing changes when it goes.
  Corners cornersOf(std::size_t i, std::size_t first, std::size_t end) const {
    const Corners own = ellipse(i, first, end);
    if (!rings_[i].fine || style_.rings >= 1.0) return own;
    std::size_t before = i, after = i;
    while (before > first && rings_[before].fine) --before;
    while (after + 1 < end && rings_[after].fine) ++after;
    if (rings_[before].fine) before = after;
    if (rings_[after].fine) after = before;
    const Corners a = ellipse(before, first, end), b = ellipse(after, first, end);
    const double share = after == before ? 0.0 : double(i - before) / double(after - before);
    Corners out;
    for (std::size_t k = 0; k < sides(); ++k)
      out[k] = between(between(a[k], b[k], share), own[k], style_.rings);
    return out;
  }

  // Slope of a radius along the tube.
  double slope(std::size_t i, std::size_t first, std::size_t end, double BodyRing::*radius) const {
    const BodyRing& a = rings_[i > first ? i - 1 : i];
    const BodyRing& b = rings_[i + 1 < end ? i + 1 : i];
    const double way = dot(b.centre - a.centre, rings_[i].along);
    return way > 1e-6 ? std::clamp((b.*radius - a.*radius) / way, -4.0, 4.0) : 0.0;
  }

  Corners ellipse(std::size_t i, std::size_t first, std::size_t end) const {
    const BodyRing& ring = rings_[i];
    const double broader = slope(i, first, end, &BodyRing::broad);
    const double deeper = slope(i, first, end, &BodyRing::deep);
    const SharedLight::Shares shares = light_(ring.centre);
    Corners out;
    for (std::size_t k = 0; k < sides(); ++k) {
      const SinCos turn = sinCosTurns(static_cast<double>(k) / style_.sides);
      const double front = -turn.sin;
      const Vec3 facing = turn.cos * ring.deep * ring.across + turn.sin * ring.broad * ring.back;
      const double steep = turn.cos * turn.cos * broader + turn.sin * turn.sin * deeper;
      const Vec3 normal = facing / std::max(1e-9, length(facing)) - steep * ring.along;
      const double nose = front > 0.95 ? ring.nose : 0.0;
      const bool eye = ring.eyes && front > 0.7 && front < 0.95;
      out[k] = {ring.centre + turn.cos * ring.broad * ring.across +
                    (turn.sin * ring.deep - nose) * ring.back,
                lit(normal / length(normal), shares,
                    (eye ? EYES : CLOTH) * (turn.sin > 0.2 ? ring.behind : ring.colour))};
    }
    for (std::size_t k = 1; k < sides() && style_.odd < 1.0; k += 2)
      out[k] = between(between(out[k - 1], out[(k + 1) % sides()], 0.5), out[k], style_.odd);
    return out;
  }

  Vec3 lit(const Vec3& normal, const SharedLight::Shares& shares, const Vec3& colour) const {
    Vec3 out;
    const double facing = shares.sun * std::max(0.0, 0.15 + 0.85 * dot(normal, daylight_.to_sun));
    const auto up = static_cast<float>(0.5 + 0.5 * normal.z());
    for (std::size_t i = 0; i < 3; ++i) {
      const float around = daylight_.ground_light[i] * (1.f - up) + daylight_.zenith_light[i] * up;
      const double light =
          static_cast<double>(daylight_.sun[i]) * facing + shares.sky * static_cast<double>(around);
      const auto axis = static_cast<int>(i);
      out[axis] = std::clamp(colour[axis] * light, 0.0, 1.0);
    }
    return out;
  }

  void writeRing(const Corners& corners) {
    for (std::size_t k = 0; k < sides(); ++k) vertex(corners[k]);
  }

  void vertex(const Corner& corner) {
    const Vec3 local = corner.at - mesh_.origin;
    for (int i = 0; i < 3; ++i) mesh_.positions.push_back(static_cast<float>(local[i]));
    mesh_.texture.insert(mesh_.texture.end(), {0.f, 0.f});
    for (int i = 0; i < 3; ++i)
      mesh_.colours.push_back(static_cast<std::uint8_t>(255.0 * corner.colour[i]));
    mesh_.colours.push_back(255);
  }

  // Joins the ring before a vertex to the one that begins there.
  void join(std::uint32_t next) {
    const auto sides = static_cast<std::uint32_t>(style_.sides);
    const std::uint32_t last = next - sides;
    for (std::uint32_t i = 0; i < sides; ++i) {
      const std::uint32_t j = (i + 1) % sides;
      mesh_.indices.insert(mesh_.indices.end(),
                           {last + i, last + j, next + j, last + i, next + j, next + i});
    }
  }

  std::size_t sides() const { return static_cast<std::size_t>(style_.sides); }

  const std::vector<BodyRing>& rings_;
  const BodyStyle& style_;
  const Daylight& daylight_;
  const LightAt& light_;
  grass::GrassMesh& mesh_;
};

}  // namespace

BodyStyle bodyStyle(double pixels) {
  BodyStyle out;
  const int most = static_cast<int>(MOST_SIDES);
  out.sides = pixels > FINE ? most : pixels > COARSE ? most / 2 : most / 4;
  if (pixels > COARSE) out.odd = risen(pixels, pixels > FINE ? FINE : COARSE);
  out.rings = risen(pixels, RINGS);
  return out;
}

void appendBody(const crowd::Skeleton& skeleton, const crowd::Clothes& clothes,
                const BodyStyle& style, const Daylight& daylight, const LightAt& light,
                grass::GrassMesh& mesh) {
  std::vector<BodyRing> rings;
  shapeBody(skeleton, clothes, Vec3(style.left_x, style.left_y, 0.0), rings);
  TubeWriter(rings, style, daylight, light, mesh).write();
}

}  // namespace vegetation_sim::view
