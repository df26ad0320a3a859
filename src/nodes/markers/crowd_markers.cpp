// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/markers/crowd_markers.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "crowd/body/body_skeleton.h"
#include "crowd/body/clothes.h"
#include "ros/services/allocation_report.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim {
namespace {

using crowd::Part;

constexpr std::array<int, 5> SIDES{0, 3, 4, 6, 10};  // of a limb, by tier; 0: not drawn
constexpr double GIRTH = 0.17;                       // radius of a body [m]
constexpr double DEFAULT_SCALE = 100.0;              // [pixel/m] without a viewer
// Rings of a cap, from its limb outwards: a head's is round and closed, the others end in joints.
struct Cap {
  int rings;
  double heights[3], radii[3];
};
constexpr Cap ROUND{3, {0.0, 0.62, 1.0}, {1.0, 0.78, 0.0}};
constexpr Cap PLAIN{2, {0.0, 0.85, 0.85}, {1.0, 0.45, 0.45}};

const Cap& capOf(std::size_t part) {
  return part == static_cast<std::size_t>(Part::HEAD) ? ROUND : PLAIN;
}

// Bands between the rings of both caps, each of two triangles a side.
std::size_t pointsOf(int sides) {
  std::size_t bands = 0;
  for (std::size_t part = 0; part < crowd::PARTS; ++part)
    bands += static_cast<std::size_t>(2 * capOf(part).rings - 1);
  return bands * static_cast<std::size_t>(sides) * 6;
}

/// A circle across a limb.
struct Ring {
  Vec3 centre, u, v;
  Vec3 at(int side, int sides) const {
    const SinCos turn = sinCosTurns(static_cast<double>(side) / sides);
    return centre + turn.cos * u + turn.sin * v;
  }
};

void addBand(TriangleLists& lists, const Ring& low, const Ring& high, int sides,
             const std_msgs::ColorRGBA& colour) {
  for (int i = 0; i < sides; ++i) {
    const Vec3 corners[4] = {low.at(i, sides), low.at(i + 1, sides), high.at(i + 1, sides),
                             high.at(i, sides)};
    for (const int k : {0, 1, 2, 0, 2, 3}) lists.add(0, corners[k], colour);
  }
}

void addLimb(TriangleLists& lists, const crowd::Limb& limb, std::size_t part, int sides,
             const std_msgs::ColorRGBA& colour, const std_msgs::ColorRGBA& end_colour) {
  const Cap& cap = capOf(part);
  const Vec3 span = limb.to - limb.from;
  const double size = length(span);
  const Vec3 along = size > 1e-9 ? Vec3(span / size) : Vec3(Vec3::UnitZ());
  const Vec3 aside = std::fabs(along.x()) < 0.7 ? Vec3::UnitX() : Vec3::UnitY();
  Vec3 u = cross(along, aside);
  u /= length(u);
  const Vec3 v = cross(along, u);
  const auto ring = [&](const Vec3& end, double sign, int step) {
    const double r = limb.radius * cap.radii[step];
    return Ring{end + sign * limb.radius * cap.heights[step] * along, r * u, r * v};
  };
  for (int step = cap.rings - 1; step > 0; --step)
    addBand(lists, ring(limb.from, -1.0, step), ring(limb.from, -1.0, step - 1), sides, colour);
  addBand(lists, ring(limb.from, -1.0, 0), ring(limb.to, 1.0, 0), sides, colour);
  for (int step = 0; step < cap.rings - 1; ++step)
    addBand(lists, ring(limb.to, 1.0, step), ring(limb.to, 1.0, step + 1), sides, end_colour);
}

}  // namespace

CrowdMarkers::CrowdMarkers(const crowd::Crowd& crowd, int points, double tolerance,
                           const crowd::MotionStyles& styles, const Shard& shard)
    : crowd_(crowd), tolerance_(tolerance), styles_(styles) {
  lists_.addList(namespaceOf("people", shard), static_cast<std::size_t>(points) / 3 * 3);
}

void CrowdMarkers::addPerson(const crowd::Walker& walker, int sides) {
  const crowd::Clothes clothes = crowd::clothesOf(walker.id);
  const crowd::Skeleton skeleton =
      skeletonOf(walker, crowd_.terrain(), styles_, secondsBetween(0, crowd_.snapshot().stamp));
  for (std::size_t i = 0; i < crowd::PARTS; ++i) {
    const std_msgs::ColorRGBA own = opaque(colourOf(clothes, i));
    addLimb(lists_, skeleton[i], i, sides, own,
            i == static_cast<std::size_t>(Part::HEAD) ? opaque(clothes.hair) : own);
  }
}

// The error of a tier is the height of a body that is not drawn, or the gap between the polygon
// and the circle of its girth.
void CrowdMarkers::choose(const std::vector<Viewpoint>& viewers, Nanoseconds stamp) {
  choices_.clear();
  for (const crowd::Walker& walker : crowd_.walkers()) {
    const crowd::Point& p = walker.position;
    const Vec3 middle(p.x, p.y, crowd_.terrain().height(p.x, p.y) + 0.5 * walker.height);
    const double scale = viewers.empty() ? DEFAULT_SCALE : largestScale(viewers, middle);
    TierChoice choice;
    choice.id = walker.id;
    choice.scale = scale;
    for (std::size_t tier = 0; tier < SIDES.size(); ++tier) {
      const int sides = SIDES[tier];
      const double off = sides > 0 ? GIRTH * (1.0 - sinCosTurns(0.5 / sides).cos) : walker.height;
      choice.error[tier] = static_cast<float>(scale * off);
      choice.cost[tier] = static_cast<float>(pointsOf(sides));
    }
    choices_.push_back(choice);
  }
  balance_ = held_.allocateTiers(choices_, SIDES.size() - 1, static_cast<double>(lists_.budget()),
                                 tolerance_, stamp);
}

BalanceTerms CrowdMarkers::balanceTerms() const {
  std::vector<std::string> tiers{"not drawn"};
  for (std::size_t tier = 1; tier < SIDES.size(); ++tier)
    tiers.push_back("of " + std::to_string(SIDES[tier]) + " facets");
  return {"Walkers", tolerance_, "marker_points", "points", static_cast<double>(lists_.budget()),
          tiers};
}

void CrowdMarkers::build(const std::vector<Viewpoint>& viewers, Nanoseconds stamp) {
  lists_.clear(0);
  choose(viewers, stamp);
  for (std::size_t i = 0; i < choices_.size(); ++i) {
    const int sides = SIDES[static_cast<std::size_t>(choices_[i].chosen)];
    if (sides > 0 && lists_.hasRoom(0, pointsOf(sides))) addPerson(crowd_.walkers()[i], sides);
  }
}

}  // namespace vegetation_sim
