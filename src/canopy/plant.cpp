// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/canopy/plant.h"

#include <algorithm>
#include <cmath>

#include "vegetation_sim/common/math.h"
#include "vegetation_sim/common/random.h"

namespace vegetation_sim::canopy {
namespace {

constexpr double TRUNK_SHARE = 0.35;  // of a crown's height
constexpr double SHORTEST = 1e-9;     // [m]

Vec3 unit(const Vec3& v, const Vec3& otherwise) {
  const double size = length(v);
  return size > SHORTEST ? Vec3(v / size) : otherwise;
}

bool isRibbon(const PlantKind& kind) {
  return kind.shape == static_cast<int>(Shape::REED) || kind.shape == static_cast<int>(Shape::KELP);
}

/// Grows one plant at the origin, unscaled; `place` moves it.
class Grower {
 public:
  Grower(const PlantKind& kind, const Plant& plant)
      : kind_(kind), plant_(plant), random_(plant.seed), turn_(sinCos(plant.yaw)) {}

  GrownPlant grow() {
    out_.leaves.reserve(leafCount(kind_));
    for (int i = 0; i < kind_.leaves; ++i) {
      const Random random = random_.child(static_cast<std::uint64_t>(i));
      if (isRibbon(kind_))
        addRibbon(random);
      else
        addLeaf(random);
    }
    if (!isRibbon(kind_)) addStems();
    return std::move(out_);
  }

 private:
  Vec3 turned(const Vec3& v) const {
    return {turn_.cos * v.x() - turn_.sin * v.y(), turn_.sin * v.x() + turn_.cos * v.y(), v.z()};
  }
  Vec3 placed(const Vec3& v) const { return plant_.position + plant_.scale * turned(v); }

  void add(const Vec3& anchor, const Vec3& root, const Vec3& tip, const Vec3& side, Leaf leaf) {
    leaf.anchor = placed(anchor);
    leaf.root = placed(root);
    leaf.tip = placed(tip);
    leaf.side = plant_.scale * turned(side);
    out_.leaves.push_back(leaf);
  }

  double crownBase() const {
    return kind_.shape == static_cast<int>(Shape::CROWN) ? TRUNK_SHARE * kind_.height : 0.0;
  }

  // Most leaves near the surface of the ball, where the light is.
  void addLeaf(const Random& random) {
    const double base = crownBase(), half = 0.5 * (kind_.height - base);
    const double z = random.uniform(0, -0.95, 1.0), around = random.uniform(1);
    const double ring = std::sqrt(std::max(0.0, 1.0 - z * z));
    const SinCos turn = sinCosTurns(around);
    const Vec3 outward(ring * turn.cos, ring * turn.sin, z);
    const double deep = random.uniform(2), reach = 1.0 - 0.55 * deep * deep;
    const Vec3 root(reach * kind_.radius * outward.x(), reach * kind_.radius * outward.y(),
                    std::max(0.0, base + half + reach * half * outward.z()));
    const Vec3 jitter(random.uniform(3, -1.0, 1.0), random.uniform(4, -1.0, 1.0),
                      random.uniform(5, -0.6, 1.0));
    const Vec3 along = unit(outward + 0.9 * jitter, Vec3::UnitZ());
    const Vec3 across =
        unit(cross(along, Vec3(random.uniform(6, -1.0, 1.0), random.uniform(7, -1.0, 1.0), 1.5)),
             Vec3::UnitX());
    const double size = random.uniform(8, 0.7, 1.3);
    Leaf leaf;
    leaf.root_width = 0.8F;
    leaf.tip_width = 0.35F;
    const double light =
        saturate(0.55 * reach * (0.5 + 0.5 * outward.z()) + 0.45 * random.uniform(9) - 0.35 * deep);
    leaf.shade = static_cast<float>(light);
    add(root, root, root + size * kind_.leaf_length * along, 0.5 * size * kind_.leaf_width * across,
        leaf);
  }

  // A chain of pieces from the ground; kelp swings from side to side on its way up.
  void addRibbon(const Random& random) {
    const double out = kind_.radius * std::sqrt(random.uniform(0));
    const SinCos place = sinCosTurns(random.uniform(1)), face = sinCosTurns(random.uniform(2));
    const Vec3 foot(out * place.cos, out * place.sin, 0.0);
    const double top = kind_.height * random.uniform(3, 0.6, 1.0),
                 lean = random.uniform(4, 0.0, 0.2);
    const bool wavy = kind_.shape == static_cast<int>(Shape::KELP);
    const double sway = wavy ? 0.06 : 0.0, phase = random.uniform(5);
    const Vec3 side = 0.5 * kind_.leaf_width * Vec3(face.cos, face.sin, 0.0);
    const auto point = [&](int piece) {
      const double s = static_cast<double>(piece) / kind_.pieces;
      const double wave = sway * top * s * sinCosTurns(1.5 * s + phase).sin;
      return Vec3(foot + Vec3(lean * top * s * s * place.cos - wave * face.sin,
                              lean * top * s * s * place.sin + wave * face.cos, top * s));
    };
    const double tone = random.uniform(6);
    for (int i = 0; i < kind_.pieces; ++i) {
      Leaf leaf;
      const auto width = [&](int piece) {
        const double s = static_cast<double>(piece) / kind_.pieces;
        return static_cast<float>(wavy ? 1.0 - 0.5 * s : 1.0 - 0.9 * s);
      };
      leaf.root_width = width(i);
      leaf.tip_width = width(i + 1);
      leaf.shade = static_cast<float>(saturate(0.7 * tone + 0.3 * i / kind_.pieces));
      add(foot, point(i), point(i + 1), side, leaf);
    }
  }

  // Stems from the foot into the leaves; a crown's trunk first.
  void addStems() {
    const double base = crownBase();
    const Vec3 fork(0.0, 0.0, base);
    if (base > 0.0)
      out_.stems.push_back(
          {placed(Vec3::Zero()), placed(fork), 2.5 * kind_.stem_radius * plant_.scale});
    const Random random = random_.child(1ULL << 40);
    for (int i = 0; i < kind_.stems; ++i) {
      const auto at = static_cast<std::uint64_t>(3 * i);
      const SinCos around = sinCosTurns((i + 0.6 * random.uniform(at)) / kind_.stems);
      const double reach = kind_.radius * random.uniform(at + 1, 0.3, 0.75);
      const double rise = (kind_.height - base) * random.uniform(at + 2, 0.45, 0.85);
      out_.stems.push_back({placed(fork),
                            placed(fork + Vec3(reach * around.cos, reach * around.sin, rise)),
                            kind_.stem_radius * plant_.scale});
    }
  }

  const PlantKind& kind_;
  const Plant& plant_;
  Random random_;
  SinCos turn_;
  GrownPlant out_;
};

}  // namespace

void describe(FieldVisitor& v, PlantKind& k) {
  v.choice("shape", k.shape, {"shrub", "crown", "reed", "kelp"});
  v.number("height", k.height, "m", {0.01, 100.0});
  v.number("radius", k.radius, "m", {0.01, 100.0});
  v.integer("leaves", k.leaves, "", {0, 1000000});
  v.integer("pieces", k.pieces, "", {1, 32});
  v.number("leaf_length", k.leaf_length, "m", {0.001, 10.0});
  v.number("leaf_width", k.leaf_width, "m", {0.001, 10.0});
  v.integer("stems", k.stems, "", {0, 1000});
  v.number("stem_radius", k.stem_radius, "m", {0.0005, 2.0});
  v.vector("colour", k.colour, "", {0.0, 1.0});
  v.vector("colour_young", k.colour_young, "", {0.0, 1.0});
  v.vector("stem_colour", k.stem_colour, "", {0.0, 1.0});
}

GrownPlant grow(const PlantKind& kind, const Plant& plant) {
  return Grower(kind, plant).grow();
}

std::size_t leafCount(const PlantKind& kind) {
  return static_cast<std::size_t>(kind.leaves) *
         static_cast<std::size_t>(isRibbon(kind) ? kind.pieces : 1);
}

}  // namespace vegetation_sim::canopy
