// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/crowd/body_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "rviz/crowd/body_template.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::view {
namespace {

constexpr double BOUNCED = 0.3;  // share of skylight that reaches every place below trees
constexpr double CLOTH = 0.72;   // factor of the colours, which sunlight makes brighter
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

/// Moves of the bones from the pose of the template to that of a person.
class SkinPose {
 public:
  SkinPose(const crowd::Skeleton& skeleton, const Vec3& left, double height) {
    static const BoneFrames REST = framesOf(formSkeleton(), Vec3::UnitY());
    const BoneFrames now = framesOf(skeleton, left);
    for (std::size_t i = 0; i < BONES; ++i) {
      turns_[i] = now[i].axes * REST[i].axes.transpose();
      scaled_[i] = height * turns_[i];
      ways_[i] = now[i].origin - scaled_[i] * REST[i].origin;
    }
  }

  Vec3 positionOf(const SkinVertex& vertex, const Vec3& rest) const {
    const auto [first, second] = vertex.bones;
    const Vec3 at = scaled_[first] * rest + ways_[first];
    if (vertex.second <= 0.0) return at;
    return at + vertex.second * (scaled_[second] * rest + ways_[second] - at);
  }
  Vec3 normalOf(const SkinVertex& vertex) const {
    const auto [first, second] = vertex.bones;
    const Vec3 out = turns_[first] * vertex.normal;
    if (vertex.second <= 0.0) return out;
    const Vec3 mixed = out + vertex.second * (turns_[second] * vertex.normal - out);
    return mixed / std::max(1e-6, length(mixed));
  }

 private:
  std::array<BoneAxes, BONES> turns_, scaled_;
  std::array<Vec3, BONES> ways_;
};

/// Draws the skin of a body.
class SkinWriter {
 public:
  SkinWriter(const SkinPose& pose, const crowd::Clothes& clothes, const BodyStyle& style,
             const Daylight& daylight, const LightAt& light, grass::GrassMesh& mesh)
      : pose_(pose),
        colours_(coverColours(clothes)),
        fullness_(2.0 * clothes.fullness - 1.0),
        tucked_(clothes.tucked ? 1.0 : 0.0),
        wide_(clothes.build > 0.5),
        build_(std::fabs(2.0 * clothes.build - 1.0)),
        style_(style),
        daylight_(daylight),
        light_(light),
        mesh_(mesh) {}

  void write(const SkinRings& rings) {
    const std::size_t count = rings.size();
    for (std::size_t first = 0; first < count;) {
      std::size_t end = first + 1;
      while (end < count && !rings[end].begins) ++end;
      writeTube(rings, first, end);
      first = end;
    }
  }

 private:
  void writeTube(const SkinRings& rings, std::size_t first, std::size_t end) {
    bool joined = false;
    for (std::size_t i = first; i < end; ++i) {
      if (rings[i].fine && style_.rings <= 0.0) continue;
      if (rings[i].close && sides() < MOST_SIDES) continue;
      const auto at = static_cast<std::uint32_t>(mesh_.vertexCount());
      const std::size_t count = sidesOf(rings[i]);
      writeRing(cornersOf(rings, i, first, end), count);
      if (joined) join(at, static_cast<std::uint32_t>(count));
      joined = true;
    }
  }

  // A fine ring of a small body lies between its neighbours, so that nothing changes when it goes.
  Corners cornersOf(const SkinRings& rings, std::size_t i, std::size_t first,
                    std::size_t end) const {
    const Corners own = posed(rings[i]);
    if (rings[i].close) return emerged(rings[first], own);
    if (!rings[i].fine || style_.rings >= 1.0) return own;
    std::size_t before = i, after = i;
    while (before > first && rings[before].fine) --before;
    while (after + 1 < end && rings[after].fine) ++after;
    if (rings[before].fine) before = after;
    if (rings[after].fine) after = before;
    const Corners a = posed(rings[before]), b = posed(rings[after]);
    const double share = after == before ? 0.0 : double(i - before) / double(after - before);
    Corners out;
    for (std::size_t k = 0; k < sides(); ++k)
      out[k] = between(between(a[k], b[k], share), own[k], style_.rings);
    return out;
  }

  // Rings that are left out from a distance come out of the first ring, which lies in the body.
  Corners emerged(const SkinRing& first, const Corners& own) const {
    if (style_.odd >= 1.0) return own;
    Corners out = posed(first);
    for (std::size_t k = 0; k < sidesOf(first); ++k) out[k] = between(out[k], own[k], style_.odd);
    return out;
  }

  Corners posed(const SkinRing& ring) const {
    const std::size_t count = sidesOf(ring), stride = MOST_SIDES / count;
    const SkinVertex& any = ring.vertices.front();
    const SharedLight::Shares shares = light_(pose_.positionOf(any, any.position));
    Corners out;
    for (std::size_t k = 0; k < count; ++k) {
      const SkinVertex& vertex = ring.vertices[k * stride];
      const Vec3 rest = vertex.position + fullness_ * vertex.full + tucked_ * vertex.tucked +
                        build_ * (wide_ ? vertex.shoulders : vertex.hips);
      const Vec3& colour = colours_[static_cast<std::size_t>(vertex.cover)];
      out[k] = {pose_.positionOf(vertex, rest),
                lit(pose_.normalOf(vertex), shares, vertex.open, CLOTH * vertex.shade * colour)};
    }
    for (std::size_t k = 1; k < count && style_.odd < 1.0 && !ring.close; k += 2)
      out[k] = between(between(out[k - 1], out[(k + 1) % count], 0.5), out[k], style_.odd);
    return out;
  }

  Vec3 lit(const Vec3& normal, const SharedLight::Shares& shares, double open,
           const Vec3& colour) const {
    Vec3 out;
    const double facing = shares.sun * (0.35 + 0.65 * open) *
                          std::max(0.0, 0.12 + 0.88 * dot(normal, daylight_.to_sun));
    const auto up = static_cast<float>(0.5 + 0.5 * normal.z());
    for (std::size_t i = 0; i < 3; ++i) {
      const float around = daylight_.ground_light[i] * (1.f - up) + daylight_.zenith_light[i] * up;
      const double light =
          static_cast<double>(daylight_.sun[i]) * facing +
          (BOUNCED + (1.0 - BOUNCED) * shares.sky) * open * static_cast<double>(around);
      const auto axis = static_cast<int>(i);
      out[axis] = std::clamp(colour[axis] * light, 0.0, 1.0);
    }
    return out;
  }

  void writeRing(const Corners& corners, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) vertex(corners[k]);
  }

  void vertex(const Corner& corner) {
    const Vec3 local = corner.at - mesh_.origin;
    for (int i = 0; i < 3; ++i) mesh_.positions.push_back(static_cast<float>(local[i]));
    mesh_.texture.insert(mesh_.texture.end(), {0.f, 0.f});
    for (int i = 0; i < 3; ++i)
      mesh_.colours.push_back(static_cast<std::uint8_t>(255.0 * corner.colour[i]));
    mesh_.colours.push_back(255);
  }

  // Joins the ring before a vertex to the one that begins there. Left and right are alike.
  void join(std::uint32_t next, std::uint32_t sides) {
    const std::uint32_t last = next - sides;
    for (std::uint32_t i = 0; i < sides; ++i) {
      const std::uint32_t j = (i + 1) % sides;
      if (4 * i >= sides && 4 * i < 3 * sides)  // on the right
        mesh_.indices.insert(mesh_.indices.end(),
                             {last + i, last + j, next + i, last + j, next + j, next + i});
      else
        mesh_.indices.insert(mesh_.indices.end(),
                             {last + i, last + j, next + j, last + i, next + j, next + i});
    }
  }

  std::size_t sides() const { return static_cast<std::size_t>(style_.sides); }
  std::size_t sidesOf(const SkinRing& ring) const { return ring.close ? ring.sides : sides(); }

  const SkinPose& pose_;
  CoverColours colours_;
  double fullness_;  // -1 to 1
  double tucked_;    // 0 or 1
  bool wide_;        // at the shoulders
  double build_;     // 0 to 1
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
  const double height = limbOf(skeleton, crowd::Part::HEAD).radius / crowd::Proportions::HEAD;
  const SkinPose pose(skeleton, Vec3(style.left_x, style.left_y, 0.0), height);
  SkinWriter writer(pose, clothes, style, daylight, light, mesh);
  writer.write(bodyTemplate(clothes.outfit, clothes.long_sleeves));
  writer.write(headTemplate(clothes.cut));
}

}  // namespace vegetation_sim::view
