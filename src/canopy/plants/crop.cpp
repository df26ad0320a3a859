// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "canopy/plants/crop.h"

#include <algorithm>
#include <cmath>

#include "canopy/plants/placing.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::canopy {
namespace {

// Heights as shares of that of the plant.
constexpr double RIGID_STALK = 0.4, STALK_TOP = 0.92, LOWEST_LEAF = 0.08, HIGHEST_LEAF = 0.8;
constexpr double LOWEST_WIRE = 0.4, HIGHEST_WIRE = 0.97;
constexpr double LONGEST_LEAF = 0.55;  // place of the longest leaf, from the lowest to the highest
constexpr double LEAF_START = 0.45;    // angle of a leaf to the vertical at its foot [rad]
constexpr double SIDE_VARIATION = 0.35;           // of the two sides of the leaves [rad]
constexpr double WIRE_RADIUS = 0.00125;           // [m]
constexpr int STALK_SIDES = 2, STALK_PIECES = 3;  // crossed ribbons of the moving stalk

enum StalkDraw : std::uint64_t { SIDE, LENGTH, DROOP, TONE };
enum StalkPart : std::uint64_t { TASSEL = 1ULL << 40 };

class Stalk {
 public:
  Stalk(const PlantKind& kind, const Plant& plant)
      : kind_(kind), random_(plant.seed), placing_(plant, plant.scale), scale_(plant.scale) {}

  GrownPlant grow() {
    out_.leaves.reserve(stalkLeafCount(kind_));
    out_.stems.push_back({placing_.placed(Vec3::Zero()), placing_.placed(at(RIGID_STALK)),
                          kind_.stem_radius * scale_});
    addUpperStalk();
    // Every other leaf comes first, because displays omit the last ones of a distant plant.
    for (int first = 0; first < 2; ++first)
      for (int i = first; i < kind_.leaves; i += 2) addBlade(i);
    for (int i = 0; i < kind_.stems; ++i) addTasselBranch(i);
    return std::move(out_);
  }

 private:
  Vec3 at(double share) const { return {0.0, 0.0, share * kind_.height}; }

  void add(const Vec3& root, const Vec3& tip, const Vec3& side, double root_width, double tip_width,
           double shade) {
    Leaf leaf;
    leaf.root = root;
    leaf.tip = tip;
    leaf.side = side;
    leaf.root_width = static_cast<float>(root_width);
    leaf.tip_width = static_cast<float>(tip_width);
    leaf.shade = static_cast<float>(saturate(shade));
    leaf.light = static_cast<float>(saturate(0.4 + 0.6 * tip.z() / kind_.height));
    out_.leaves.push_back(placing_.placed(leaf));
  }

  void addUpperStalk() {
    const double step = (STALK_TOP - RIGID_STALK) / STALK_PIECES;
    for (int side = 0; side < STALK_SIDES; ++side)
      for (int i = 0; i < STALK_PIECES; ++i)
        add(at(RIGID_STALK + i * step), at(RIGID_STALK + (i + 1) * step),
            0.5 * kind_.stem_radius * (side == 0 ? Vec3::UnitX() : Vec3::UnitY()), 1.0 - 0.2 * i,
            0.8 - 0.2 * i, 0.4);
  }

  // The lower and upper leaves are shorter; old leaves hang more than young ones.
  void addBlade(int number) {
    const Random random = random_.child(static_cast<std::uint64_t>(number));
    const double place = (number + 0.5) / kind_.leaves, off = (place - LONGEST_LEAF) / LONGEST_LEAF;
    const double size =
        kind_.leaf_length * (1.0 - 0.5 * off * off) * random.uniform(LENGTH, 0.85, 1.0);
    const double last = 2.4 - 1.2 * place + random.uniform(DROOP, -0.25, 0.25);
    const SinCos way =
        sinCos(PI * (number % 2) + random.uniform(SIDE, -SIDE_VARIATION, SIDE_VARIATION));
    const Vec3 out(way.cos, way.sin, 0.0), side(-way.sin, way.cos, 0.0);
    Vec3 root = at(LOWEST_LEAF + (HIGHEST_LEAF - LOWEST_LEAF) * place);
    for (int i = 0; i < kind_.pieces; ++i) {
      const double middle = (i + 0.5) / kind_.pieces;
      const SinCos bend = sinCos(LEAF_START + (last - LEAF_START) * middle);
      Vec3 tip = root + (size / kind_.pieces) * (bend.sin * out + bend.cos * Vec3::UnitZ());
      tip.z() = std::max(0.0, tip.z());
      add(root, tip, 0.5 * kind_.leaf_width * side, widthAt(i), widthAt(i + 1),
          0.25 + 0.3 * random.uniform(TONE) + 0.35 * place);
      root = tip;
    }
  }

  // Returns the width of a leaf at the end of a piece: widest at a third of its length.
  double widthAt(int piece) const {
    const double s = static_cast<double>(piece) / kind_.pieces;
    return s < 0.35 ? 0.6 + 0.4 * s / 0.35 : std::sqrt((1.0 - s) / 0.65);
  }

  void addTasselBranch(int number) {
    const Random random = random_.child(TASSEL).child(static_cast<std::uint64_t>(number));
    const SinCos way = sinCos(2.0 * PI * random.uniform(SIDE));
    const SinCos lean = sinCos(number == 0 ? 0.0 : random.uniform(DROOP, 0.3, 0.8));
    const double size = (1.0 - STALK_TOP) * kind_.height * random.uniform(LENGTH, 0.8, 1.0);
    const Vec3 along(lean.sin * way.cos, lean.sin * way.sin, lean.cos);
    add(at(STALK_TOP), at(STALK_TOP) + size * along,
        0.4 * kind_.stem_radius * Vec3(-way.sin, way.cos, 0.0), 1.0, 0.6, 1.0);
  }

  const PlantKind& kind_;
  Random random_;
  Placing placing_;
  double scale_;
  GrownPlant out_;
};

// Adds the four faces of a square post.
void addPost(const PlantKind& kind, const Vec3& foot, const Placing& placing, GrownPlant& out) {
  const double half = kind.stem_radius;
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY();
  for (const Vec3& face : {x, y, Vec3(-x), Vec3(-y)}) {
    Leaf leaf;
    leaf.root = foot + half * face;
    leaf.tip = leaf.root + kind.height * Vec3::UnitZ();
    leaf.side = half * cross(face, Vec3::UnitZ());
    leaf.root_width = leaf.tip_width = 1.0F;
    leaf.light = static_cast<float>(0.75 + 0.15 * face.x() + 0.1 * face.y());
    out.rigid.push_back(placing.placed(leaf));
  }
}

}  // namespace

std::size_t stalkLeafCount(const PlantKind& kind) {
  return static_cast<std::size_t>(kind.leaves) * static_cast<std::size_t>(kind.pieces) +
         static_cast<std::size_t>(kind.stems) + STALK_SIDES * STALK_PIECES;
}

GrownPlant growStalk(const PlantKind& kind, const Plant& plant) {
  return Stalk(kind, plant).grow();
}

GrownPlant buildTrellis(const PlantKind& kind, const Plant& plant) {
  const Placing placing(plant, plant.scale);
  const Vec3 span(kind.radius, 0.0, kind.slope * kind.radius);
  GrownPlant out;
  addPost(kind, Vec3::Zero(), placing, out);
  addPost(kind, span, placing, out);
  for (int i = 0; i < kind.stems; ++i) {
    const double share = kind.stems > 1 ? static_cast<double>(i) / (kind.stems - 1) : 1.0;
    const Vec3 from(0.0, 0.0, kind.height * (LOWEST_WIRE + (HIGHEST_WIRE - LOWEST_WIRE) * share));
    out.stems.push_back(
        {placing.placed(from), placing.placed(from + span), WIRE_RADIUS * plant.scale});
  }
  return out;
}

}  // namespace vegetation_sim::canopy
