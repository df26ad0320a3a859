// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/canopy/plants/plant.h"

#include <algorithm>
#include <cmath>

#include "canopy/plants/crop.h"
#include "canopy/plants/placing.h"
#include "canopy/plants/stubble.h"
#include "canopy/plants/swath.h"
#include "core/math/growth_stage.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::canopy {
namespace {

constexpr double SHORTEST = 1e-9;  // [m]

Vec3 unit(const Vec3& v, const Vec3& otherwise) {
  const double size = length(v);
  return size > SHORTEST ? Vec3(v / size) : otherwise;
}

GrownPlant placeForm(const PlantKind& kind, const Plant& plant) {
  GrownPlant out;
  if (!kind.form) return out;
  const Placing placing(plant, plant.scale * kind.height);
  for (const Leaf& leaf : kind.form->leaves) out.leaves.push_back(placing.placed(leaf));
  for (const Leaf& face : kind.form->rigid) out.rigid.push_back(placing.placed(face));
  return out;
}

/// A ball of leaves within a ball of radius 1, in the same unit.
struct Tuft {
  Vec3 centre;
  double radius;
};

// Places one tuft at the top and the others around and below it, so that outlines vary.
std::vector<Tuft> tuftsOf(const Random& random, bool crown) {
  std::vector<Tuft> out{{Vec3(0.0, 0.0, 0.45), 0.55}};
  const int count = 6 + static_cast<int>(5.0 * random.uniform(0));
  for (int i = 0; i < count; ++i) {
    const auto at = static_cast<std::uint64_t>(4 * i + 1);
    const SinCos around = sinCosTurns((i + 0.7 * random.uniform(at)) * 0.381966);
    const double ring = random.uniform(at + 1, 0.35, 0.62);
    const double z = random.uniform(at + 2, crown ? -0.55 : -0.75, 0.45);
    out.push_back({Vec3(ring * around.cos, ring * around.sin, z),
                   random.uniform(at + 3, 0.30, 0.46) * (z < 0.0 && !crown ? 1.15 : 1.0)});
  }
  return out;
}

/// Grows one plant at the origin, unscaled; `place` moves it.
class Grower {
 public:
  Grower(const PlantKind& kind, const Plant& plant)
      : kind_(kind),
        plant_(plant),
        random_(plant.seed),
        placing_(plant, plant.scale),
        tufts_(tuftsOf(random_.child(2ULL << 40), kind.shape == PlantShape::CROWN)) {}

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
  void add(const Vec3& anchor, const Vec3& root, const Vec3& tip, const Vec3& side, Leaf leaf) {
    leaf.anchor = anchor;
    leaf.root = root;
    leaf.tip = tip;
    leaf.side = side;
    out_.leaves.push_back(placing_.placed(leaf));
  }
  Vec3 placed(const Vec3& v) const { return placing_.placed(v); }

  double crownBase() const {
    return kind_.shape == PlantShape::CROWN ? TRUNK_SHARE * kind_.height : 0.0;
  }

  // Less light inside and below the mass.
  double lightAt(const Vec3& place, const Vec3& outward) const {
    double cover = 0.0;
    for (const Tuft& tuft : tufts_) {
      const Vec3 above = place + Vec3(0.0, 0.0, 0.25);  // most light comes from above
      cover += std::max(0.0, 1.0 - length(Vec3(place - tuft.centre)) / tuft.radius) +
               0.8 * std::max(0.0, 1.0 - length(Vec3(above - tuft.centre)) / tuft.radius);
    }
    const double open = 1.0 / (1.0 + 1.3 * cover);
    return saturate(open * (0.72 + 0.28 * outward.z()) * (0.88 + 0.12 * place.z()) * 1.2 + 0.1);
  }

  // Most leaves are near the surface of a tuft, where the light is.
  void addLeaf(const Random& random) {
    const double base = crownBase(), half = 0.5 * (kind_.height - base);
    const auto last = static_cast<double>(tufts_.size());
    const Tuft& tuft = tufts_[static_cast<std::size_t>(last * random.uniform(10))];
    const double z = random.uniform(0, -0.85, 1.0), around = random.uniform(1);
    const double ring = std::sqrt(std::max(0.0, 1.0 - z * z));
    const SinCos turn = sinCosTurns(around);
    const Vec3 outward(ring * turn.cos, ring * turn.sin, z);
    const double deep = random.uniform(2), reach = 1.0 - 0.6 * deep * deep;
    const Vec3 place = tuft.centre + tuft.radius * reach * outward;
    const Vec3 root(kind_.radius * place.x(), kind_.radius * place.y(),
                    std::max(0.0, base + half + half * place.z()));
    const Vec3 jitter(random.uniform(3, -1.0, 1.0), random.uniform(4, -1.0, 1.0),
                      random.uniform(5, -0.9, 0.5));
    Vec3 along = unit(outward + 1.1 * jitter, Vec3::UnitZ());
    // No leaf points into the ground.
    if (root.z() < kind_.leaf_length) along.z() = std::fabs(along.z());
    const Vec3 across =
        unit(cross(along, Vec3(random.uniform(6, -1.0, 1.0), random.uniform(7, -1.0, 1.0), 1.5)),
             Vec3::UnitX());
    const double size = random.uniform(8, 0.65, 1.35);
    Leaf leaf;
    leaf.root_width = 0.9F;
    leaf.tip_width = 0.25F;
    const double tone = random.uniform(9);
    leaf.shade =
        static_cast<float>(saturate(0.25 * reach + 0.25 * outward.z() + 0.6 * tone * tone));
    leaf.light = static_cast<float>(lightAt(place, outward));
    add(root, root, root + size * kind_.leaf_length * along, 0.5 * size * kind_.leaf_width * across,
        leaf);
  }

  // Adds a chain of pieces from the ground; kelp is wavy.
  void addRibbon(const Random& random) {
    const double out = kind_.radius * std::sqrt(random.uniform(0));
    const SinCos place = sinCosTurns(random.uniform(1)), face = sinCosTurns(random.uniform(2));
    const Vec3 foot(out * place.cos, out * place.sin, 0.0);
    const double top = kind_.height * random.uniform(3, 0.6, 1.0),
                 lean = random.uniform(4, 0.0, 0.2);
    const bool wavy = kind_.shape == PlantShape::KELP;
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
      leaf.light = static_cast<float>(0.45 + 0.55 * (i + 1.0) / kind_.pieces);
      add(foot, point(i), point(i + 1), side, leaf);
    }
  }

  // Adds stems from the foot into the leaves; a crown's trunk is the first.
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
  Placing placing_;
  std::vector<Tuft> tufts_;
  GrownPlant out_;
};

GrownPlant growWhole(const PlantKind& kind, const Plant& plant) {
  if (kind.shape == PlantShape::STALK) return growStalk(kind, plant);
  if (kind.shape == PlantShape::TRELLIS) return buildTrellis(kind, plant);
  return isRead(kind) ? placeForm(kind, plant) : Grower(kind, plant).grow();
}

}  // namespace

void describe(FieldVisitor& v, PushLaw& l) {
  v.number("push_stiffness", l.stiffness, "N/m^3", {0.0, 1e6});
  v.number("push_frequency", l.frequency, "Hz", {0.05, 20.0});
  v.number("push_damping", l.damping, "", {0.0, 50.0});
  v.number("push_set", l.set, "", {0.0, 1.0});
  v.number("push_recovery", l.recovery, "s", {0.01, 1e6});
  v.number("push_pressure", l.pressure, "N/m^3", {0.0, 1e7});
  v.number("push_drag", l.drag, "N s/m^4", {0.0, 1e6});
  v.number("push_cell", l.cell, "m", {0.02, 100.0});
}

void describe(FieldVisitor& v, PlantKind& k) {
  v.choice("shape", k.shape,
           {"shrub", "crown", "reed", "kelp", "mesh", "slices", "stalk", "trellis"});
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
  v.choice("up", k.up, {"z", "y"});
  v.number("solid", k.solid, "", {0.01, 1.0});
  if (k.shape == PlantShape::TRELLIS) v.number("slope", k.slope, "", {-2.0, 2.0});
  if (k.shape == PlantShape::SLICES) v.choice("look", k.look, {"leaves", "puffs"});
}

PlantKind applyStage(const PlantKind& kind, double stage) {
  if (!(stage < GROWN) || kind.shape == PlantShape::TRELLIS) return kind;
  const GrowthFactors factors = growthFactors(stage);
  const auto scaled = [](double value, double factor, double least) {
    return std::max(least, value * factor);
  };
  PlantKind out = kind;
  out.height = scaled(kind.height, factors.height, 0.01);
  out.radius = scaled(kind.radius, factors.height, 0.01);
  out.leaf_length = scaled(kind.leaf_length, factors.leaf, 0.001);
  out.leaf_width = scaled(kind.leaf_width, factors.leaf, 0.001);
  out.stem_radius = scaled(kind.stem_radius, factors.thickness, 0.0005);
  out.leaves = static_cast<int>(kind.leaves * factors.count + 0.5);
  if (kind.shape == PlantShape::STALK && stage < TASSEL_STAGE) out.stems = 0;
  return out;
}

GrownPlant grow(const PlantKind& kind, const Plant& plant, double height) {
  GrownPlant out = growWhole(kind, plant);
  if (height < UNCUT) layDown(kind, plant, cutOff(plant.position.z() + height, out), out.leaves);
  return out;
}

std::size_t leafCount(const PlantKind& kind) {
  if (isRead(kind)) return kind.form ? kind.form->leaves.size() + kind.form->rigid.size() : 0;
  if (kind.shape == PlantShape::STALK) return stalkLeafCount(kind);
  if (kind.shape == PlantShape::TRELLIS) return TRELLIS_FACES;
  return static_cast<std::size_t>(kind.leaves) *
         static_cast<std::size_t>(isRibbon(kind) ? kind.pieces : 1);
}

}  // namespace vegetation_sim::canopy
