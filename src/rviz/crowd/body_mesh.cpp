// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/crowd/body_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::view {
namespace {

using crowd::Part;

constexpr double CLOTH = 0.72;  // factor of the colours, which sunlight makes brighter
constexpr int MOST_SIDES = 12;
// Heights [pixel] above which limbs have all sides, half of them, and round ends.
constexpr double FINE = 120.0, COARSE = 24.0, CAPS = 35.0;
constexpr std::array<double, 3> CAP_ANGLES{0.0, 0.6, 1.15};  // [rad] of the rings of a cap

// Factors on a capsule: radius at the start and the end, breadth and depth.
struct Form {
  double from{1.0}, to{1.0}, broad{1.0}, deep{1.0};
};

Form formOf(std::size_t limb) {
  switch (static_cast<Part>(limb)) {
    case Part::HEAD:
      return {0.82, 0.95, 0.82, 0.95};
    case Part::CHEST:
      return {0.86, 1.0, 1.2, 0.8};
    case Part::SHOULDERS:
      return {0.85, 0.85, 1.0, 1.0};
    case Part::PELVIS:
      return {0.9, 0.9, 1.0, 1.0};
    default:
      break;
  }
  if (limb < static_cast<std::size_t>(Part::THIGH)) return {};
  if (limb < static_cast<std::size_t>(Part::SHANK)) return {1.15, 0.8, 1.0, 1.0};
  if (limb < static_cast<std::size_t>(Part::FOOT)) return {1.1, 0.72, 1.0, 1.0};
  if (limb < static_cast<std::size_t>(Part::UPPER_ARM)) return {1.1, 1.1, 1.35, 1.0};
  if (limb < static_cast<std::size_t>(Part::FOREARM)) return {1.2, 0.95, 1.0, 1.0};
  return {1.05, 0.85, 1.0, 1.0};
}

// Rises from 0 at a height to 1 at 1.5 times the height.
double risen(double pixels, double from) {
  return smootherStep((pixels / from - 1.0) / 0.5);
}

bool isHead(std::size_t limb) {
  return limb == static_cast<std::size_t>(Part::HEAD);
}

/// Draws rings across one limb and joins them.
class LimbWriter {
 public:
  LimbWriter(const crowd::Limb& limb, const Form& form, const BodyStyle& style,
             const Daylight& daylight, grass::GrassMesh& mesh)
      : limb_(limb), form_(form), style_(style), daylight_(daylight), mesh_(mesh) {
    const Vec3 span = limb.to - limb.from;
    const double size = length(span);
    along_ = size > 1e-9 ? Vec3(span / size) : Vec3(Vec3::UnitZ());
    const Vec3 left(style.left_x, style.left_y, 0.0);
    const Vec3 flat = left - dot(left, along_) * along_;
    const Vec3 any = cross(along_, std::fabs(along_.x()) < 0.7 ? Vec3::UnitX() : Vec3::UnitY());
    side_ = length(flat) > 0.3 ? Vec3(flat / length(flat)) : Vec3(any / length(any));
    back_ = cross(along_, side_);
  }

  /// Adds a ring at the start (0) or the end (1) of the limb, `rise` [rad] up its cap.
  /// @param behind colour of the back.
  void ring(bool end, double rise, const Vec3& colour, const Vec3& behind) {
    const SinCos up = sinCos(rise);
    const double sign = end ? 1.0 : -1.0;
    const double radius = limb_.radius * (end ? form_.to : form_.from);
    const Vec3 centre = (end ? limb_.to : limb_.from) + sign * up.sin * radius * along_;
    const auto first = static_cast<std::uint32_t>(mesh_.vertexCount());
    const auto sides = static_cast<std::size_t>(style_.sides);
    std::array<Corner, MOST_SIDES> corners;
    for (std::size_t i = 0; i < sides; ++i) {
      const SinCos turn = sinCosTurns(static_cast<double>(i) / style_.sides);
      const Vec3 out = turn.cos * form_.broad * side_ + turn.sin * form_.deep * back_;
      const Vec3 facing = turn.cos / form_.broad * side_ + turn.sin / form_.deep * back_;
      const Vec3 normal = up.cos * facing + sign * up.sin * along_;
      corners[i] = {centre + up.cos * radius * out,
                    lit(normal / length(normal), turn.sin > 0.2 ? behind : colour)};
    }
    for (std::size_t i = 1; i < sides && style_.odd < 1.0; i += 2)
      corners[i].approach(corners[i - 1], corners[(i + 1) % sides], style_.odd);
    for (std::size_t i = 0; i < sides; ++i) vertex(corners[i]);
    if (started_) join(first);
    started_ = true;
    last_ = first;
  }

 private:
  struct Corner {
    Vec3 at, colour;

    void approach(const Corner& a, const Corner& b, double own) {
      at = own * at + 0.5 * (1.0 - own) * (a.at + b.at);
      colour = own * colour + 0.5 * (1.0 - own) * (a.colour + b.colour);
    }
  };

  Vec3 lit(const Vec3& normal, const Vec3& colour) const {
    Vec3 out;
    const double facing = std::max(0.0, 0.15 + 0.85 * dot(normal, daylight_.to_sun));
    const auto up = static_cast<float>(0.5 + 0.5 * normal.z());
    for (std::size_t i = 0; i < 3; ++i) {
      const float around = daylight_.ground_light[i] * (1.f - up) + daylight_.zenith_light[i] * up;
      const double light =
          static_cast<double>(daylight_.sun[i]) * facing + static_cast<double>(around);
      const auto axis = static_cast<int>(i);
      out[axis] = std::clamp(colour[axis] * light, 0.0, 1.0);
    }
    return out;
  }

  void vertex(const Corner& corner) {
    const Vec3 local = corner.at - mesh_.origin;
    for (int i = 0; i < 3; ++i) mesh_.positions.push_back(static_cast<float>(local[i]));
    mesh_.texture.insert(mesh_.texture.end(), {0.f, 0.f});
    for (int i = 0; i < 3; ++i)
      mesh_.colours.push_back(static_cast<std::uint8_t>(255.0 * corner.colour[i]));
    mesh_.colours.push_back(255);
  }

  void join(std::uint32_t next) {
    const auto sides = static_cast<std::uint32_t>(style_.sides);
    for (std::uint32_t i = 0; i < sides; ++i) {
      const std::uint32_t j = (i + 1) % sides;
      mesh_.indices.insert(mesh_.indices.end(),
                           {last_ + i, last_ + j, next + j, last_ + i, next + j, next + i});
    }
  }

  const crowd::Limb& limb_;
  Form form_;
  const BodyStyle& style_;
  const Daylight& daylight_;
  grass::GrassMesh& mesh_;
  Vec3 along_, side_, back_;
  bool started_{false};
  std::uint32_t last_{0};
};

}  // namespace

BodyStyle bodyStyle(double pixels) {
  BodyStyle out;
  out.sides = pixels > FINE ? MOST_SIDES : pixels > COARSE ? MOST_SIDES / 2 : MOST_SIDES / 4;
  if (pixels > COARSE) out.odd = risen(pixels, pixels > FINE ? FINE : COARSE);
  out.caps = risen(pixels, CAPS);
  return out;
}

void appendBody(const crowd::Skeleton& skeleton, const crowd::Clothes& clothes,
                const BodyStyle& style, const Daylight& daylight, grass::GrassMesh& mesh) {
  for (std::size_t i = 0; i < crowd::PARTS; ++i) {
    LimbWriter limb(skeleton[i], formOf(i), style, daylight, mesh);
    const Vec3 own = CLOTH * colourOf(clothes, i), hair = CLOTH * clothes.hair;
    const Vec3& end = isHead(i) ? hair : own;
    const double round = isHead(i) ? 1.0 : style.caps;
    if (round > 0.0)
      for (std::size_t k = CAP_ANGLES.size() - 1; k > 0; --k)
        limb.ring(false, round * CAP_ANGLES[k], own, end);
    limb.ring(false, 0.0, own, end);
    if (isHead(i)) limb.ring(true, -0.1, own, end);  // the brow, where hair begins
    limb.ring(true, 0.0, end, end);
    if (round > 0.0)
      for (std::size_t k = 1; k < CAP_ANGLES.size(); ++k)
        limb.ring(true, round * CAP_ANGLES[k], end, end);
  }
}

}  // namespace vegetation_sim::view
