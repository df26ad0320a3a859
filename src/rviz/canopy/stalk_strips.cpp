// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/canopy/stalk_strips.h"

#include <algorithm>
#include <cmath>

#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::view {
namespace {

constexpr int FACES = 3, PIECES = 3;  // of a stalk
constexpr double STALK_TOP = 0.92;    // share of the height, as in canopy::grow()
constexpr double SHEATHED = 1.35;     // radius of a stalk with the sheaths around it
constexpr double THIN_TOP = 0.45;     // radius at the top, both relative to the bare stalk
constexpr double SHEATH = 0.035;      // length below the foot of a blade, share of the height
constexpr double CLASP = 1.1;         // width of a blade at its foot relative to its stalk
constexpr double LYING = 2.0;         // width of a stalk on the ground relative to its strip
constexpr double CHANNEL = 0.45;      // tangent of the slope of the halves of a blade
constexpr double TWIST = 0.9;         // largest turn of a blade at its tip [rad]
constexpr double DEEP_LIGHT = 0.3;    // share of the daylight on the ground
constexpr double DEEP_COLOUR = 0.6;   // lightness of leaves on the ground
constexpr double PALE_FOOT = 0.4;     // share of the stalk's colour at the foot of a blade
constexpr double DRY_BELOW = 0.35;    // share of the height below which tips of leaves dry
constexpr double STALK_LIGHT = 1.15;  // lightness of the stalk relative to its colour
constexpr double WILTED = 0.35;       // share of the colour of dry leaves on the ground
constexpr double ON_AXIS = 1e-6;      // [m]
const Vec3 DRY(0.52, 0.43, 0.20);     // colour of dry leaves

const Vec3 TASSEL(0.50, 0.47, 0.22);

enum BladePart : std::uint64_t { BLADE = 5ULL << 40 };

Vec3 directionOr(const Vec3& v, const Vec3& otherwise) {
  const double size = length(v);
  return size > 1e-9 ? Vec3(v / size) : otherwise;
}

Vec3 between(const Vec3& a, const Vec3& b, double share_of_b) {
  return a + saturate(share_of_b) * (b - a);
}

class StalkStrips {
 public:
  StalkStrips(const canopy::PlantKind& kind, const canopy::Plant& plant, double height)
      : kind_(kind),
        plant_(plant),
        tall_(plant.scale * kind.height),
        top_(std::min(STALK_TOP * tall_, height)),
        is_cut_(height < canopy::UNCUT) {}

  std::vector<StalkStrip> of(const canopy::GrownPlant& grown) {
    if (!grown.stems.empty()) addStalk();
    // The tassel comes before the leaves, because displays omit the last strips of a distant plant.
    addRibbons(grown.leaves, true);
    addRibbons(grown.leaves, false);
    return std::move(out_);
  }

 private:
  double shareOfHeight(const Vec3& at) const { return (at.z() - plant_.position.z()) / tall_; }
  double wayFromAxis(const Vec3& at) const {
    return std::hypot(at.x() - plant_.position.x(), at.y() - plant_.position.y());
  }
  // Stalks and tassels are narrower than leaves.
  bool isThin(const canopy::Leaf& leaf) const {
    return length(leaf.side) < 0.55 * plant_.scale * kind_.stem_radius;
  }
  // The strips of a standing stalk are replaced, those of the tassel are not.
  bool isStalk(const canopy::Leaf& leaf) const {
    return !leaf.lies && isThin(leaf) && wayFromAxis(leaf.root) < ON_AXIS &&
           wayFromAxis(leaf.tip) < ON_AXIS && shareOfHeight(leaf.root) < STALK_TOP - 1e-6;
  }
  double radiusAt(double share_of_height) const {
    return plant_.scale * kind_.stem_radius *
           (SHEATHED + (THIN_TOP - SHEATHED) * saturate(share_of_height / STALK_TOP));
  }
  // Light falls on what is left of a plant that is cut.
  double lightAt(double share) const {
    return is_cut_ ? 1.0 : DEEP_LIGHT + (1.0 - DEEP_LIGHT) * smoothStep(1.1 * share);
  }
  double lightnessAt(double share) const {
    return is_cut_ ? 1.0 : DEEP_COLOUR + (1.0 - DEEP_COLOUR) * saturate(1.25 * share);
  }

  void addStalk() {
    for (int piece = 0; piece < PIECES; ++piece)
      for (int face = 0; face < FACES; ++face)
        addFace(top_ * piece / PIECES, top_ * (piece + 1) / PIECES, face);
  }

  // Adds the thin ribbons, or the others.
  void addRibbons(const std::vector<canopy::Leaf>& leaves, bool thin) {
    for (std::size_t i = 0; i < leaves.size();) {
      std::size_t end = i + 1;
      while (end < leaves.size() && leaves[end].root == leaves[end - 1].tip) ++end;
      if (isThin(leaves[i]) == thin && !isStalk(leaves[i]))
        addRibbon(leaves.data() + i, leaves.data() + end);
      i = end;
    }
  }

  // Adds a face of the stalk between two heights. Its normals are those of a round stalk.
  void addFace(double from, double to, int face) {
    const double turn = plant_.yaw / (2.0 * PI);
    const SinCos left = sinCosTurns(turn + static_cast<double>(face) / FACES);
    const SinCos right = sinCosTurns(turn + static_cast<double>(face + 1) / FACES);
    const Vec3 to_left(left.cos, left.sin, 0.0), to_right(right.cos, right.sin, 0.0);
    const std::array<double, 2> heights{from, to};
    StalkStrip strip;
    strip.face = face;
    strip.leaf.anchor = plant_.position;
    std::array<double, 2> radii{};
    for (std::size_t end = 0; end < 2; ++end) {
      const double share = heights[end] / tall_;
      radii[end] = radiusAt(share);
      (end == 0 ? strip.leaf.root : strip.leaf.tip) =
          plant_.position + heights[end] * Vec3::UnitZ() + 0.5 * radii[end] * (to_left + to_right);
      strip.paint.normals[2 * end] = to_left;
      strip.paint.normals[2 * end + 1] = to_right;
      strip.paint.colours[end] = STALK_LIGHT * lightnessAt(share) * kind_.stem_colour;
      strip.paint.light[end] = lightAt(share);
    }
    strip.leaf.side = 0.5 * radii[0] * (to_right - to_left);
    strip.leaf.root_width = 1.0F;
    strip.leaf.tip_width = static_cast<float>(radii[1] / radii[0]);
    strip.paint.across = {0.56f, 0.94f};  // beside the midrib
    out_.push_back(strip);
  }

  // Returns the largest turn of a blade. Its key is the height of its foot, which no cut changes.
  double twistOf(const canopy::Leaf& foot) const {
    const auto key = static_cast<std::uint64_t>(1e4 * std::max(0.0, shareOfHeight(foot.root)));
    return Random(plant_.seed).child(BLADE).uniform(key, -TWIST, TWIST);
  }

  // Returns the normals of the faces of a ribbon at its joints; those of leaves point up.
  static std::vector<Vec3> jointNormals(const canopy::Leaf* begin, const canopy::Leaf* end) {
    std::vector<Vec3> faces;
    for (const canopy::Leaf* leaf = begin; leaf != end; ++leaf) {
      const Vec3 face = directionOr(cross(leaf->tip - leaf->root, leaf->side), Vec3::UnitZ());
      faces.push_back(face.z() < 0.0 ? Vec3(-face) : face);
    }
    std::vector<Vec3> out{faces.front()};
    for (std::size_t i = 1; i < faces.size(); ++i)
      out.push_back(directionOr(faces[i - 1] + faces[i], Vec3::UnitZ()));
    out.push_back(faces.back());
    return out;
  }

  void addRibbon(const canopy::Leaf* begin, const canopy::Leaf* end) {
    const std::vector<Vec3> normals = jointNormals(begin, end);
    const auto pieces = static_cast<double>(end - begin);
    const bool stands = !begin->lies && !isThin(*begin);
    const double twist = stands ? twistOf(*begin) : 0.0;
    for (const canopy::Leaf* leaf = begin; leaf != end; ++leaf) {
      const std::size_t piece = static_cast<std::size_t>(leaf - begin);
      StalkStrip strip;
      strip.leaf = *leaf;
      for (std::size_t at = 0; at < 2; ++at) {
        const double along = static_cast<double>(piece + at) / pieces;
        setEnd(*leaf, at, normals[piece + at], along, twist * along, strip);
      }
      if (stands && piece == 0 && wayFromAxis(leaf->root) < ON_AXIS) clasp(strip.leaf);
      if (leaf->lies && isThin(*leaf)) strip.leaf.side *= LYING;
      out_.push_back(strip);
    }
  }

  // The sheath around the stalk is as wide as the stalk.
  void clasp(canopy::Leaf& leaf) const {
    const double room = leaf.root.z() - plant_.position.z();
    leaf.root.z() -= std::min(SHEATH * tall_, 0.9 * room);
    const double half = length(leaf.side);
    if (half > 0.0)
      leaf.root_width = static_cast<float>(CLASP * radiusAt(shareOfHeight(leaf.root)) / half);
  }

  void setEnd(const canopy::Leaf& leaf, std::size_t end, const Vec3& normal, double along,
              double turn, StalkStrip& strip) const {
    const Vec3 side = directionOr(leaf.side, Vec3::UnitX());
    const Vec3 across = cross(directionOr(leaf.tip - leaf.root, Vec3::UnitZ()), side);
    const double up = dot(across, normal) < 0.0 ? -1.0 : 1.0;
    const SinCos roll = sinCos(turn);
    strip.roll[end] = {static_cast<float>(roll.cos), static_cast<float>(roll.sin)};
    const Vec3 turned_side = roll.cos * side + up * roll.sin * normal;
    const Vec3 turned = roll.cos * normal - up * roll.sin * side;
    // A tassel has light from all sides.
    if (isThin(leaf)) {
      strip.paint.normals[2 * end] = strip.paint.normals[2 * end + 1] = Vec3::UnitZ();
    } else {
      strip.paint.normals[2 * end] = directionOr(turned + CHANNEL * turned_side, Vec3::UnitZ());
      strip.paint.normals[2 * end + 1] = directionOr(turned - CHANNEL * turned_side, Vec3::UnitZ());
    }
    strip.paint.colours[end] = colourOf(leaf, end, along);
    strip.paint.light[end] =
        leaf.lies ? static_cast<double>(leaf.light)
                  : lightAt(shareOfHeight(end == 0 ? leaf.root : leaf.tip)) * (0.75 + 0.25 * along);
  }

  Vec3 colourOf(const canopy::Leaf& leaf, std::size_t end, double along) const {
    const Vec3 leafy = between(kind_.colour, kind_.colour_young, static_cast<double>(leaf.shade));
    if (leaf.lies)
      return isThin(leaf) ? Vec3(STALK_LIGHT * kind_.stem_colour) : between(leafy, DRY, WILTED);
    if (isThin(leaf)) return TASSEL;
    const double share = shareOfHeight(end == 0 ? leaf.root : leaf.tip);
    const Vec3 foot = between(leafy, kind_.stem_colour, PALE_FOOT * (1.0 - 4.0 * along));
    return lightnessAt(share) * between(foot, DRY, along * (1.0 - share / DRY_BELOW));
  }

  const canopy::PlantKind& kind_;
  const canopy::Plant& plant_;
  double tall_, top_;  // heights of the plant and of the end of its stalk [m]
  bool is_cut_;
  std::vector<StalkStrip> out_;
};

}  // namespace

std::vector<StalkStrip> stalkStrips(const canopy::PlantKind& kind, const canopy::Plant& plant,
                                    double height, const canopy::GrownPlant& grown) {
  return StalkStrips(kind, plant, height).of(grown);
}

}  // namespace vegetation_sim::view
