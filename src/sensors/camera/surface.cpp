// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/camera/surface.h"

#include <algorithm>
#include <cmath>

#include "grass/mesh/grass_geometry.h"
#include "sensors/camera/person_colour.h"
#include "sensors/camera/texture.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::scan {
namespace {

// Colours in sRGB.
const Vec3 SOIL(0.36, 0.29, 0.20), LITTER(0.38, 0.30, 0.20), MOSS(0.26, 0.31, 0.13);
const Vec3 TURF(0.34, 0.40, 0.17), DRY_TURF(0.53, 0.49, 0.28), HAY(0.72, 0.64, 0.36);
constexpr double LEAF_TRANSMITS = 0.55, BLADE_TRANSMITS = 0.45;
constexpr double STUBBLE_DRYNESS = 0.25;  // stems are drier than leaves
constexpr double HALF_HIDDEN = 0.12;      // cut grass that hides half of what is below [kg/m^2]
constexpr double LEAF_SPOT = 0.045;       // size of what has one colour [m]
constexpr std::uint32_t GROUND_KEY = 0x67726fU, BLADE_KEY = 0x626c61U, CLOTH_KEY = 0x636c6fU;

double hayShare(double swath) {
  return swath / (swath + HALF_HIDDEN);
}

Vec3 blend(const Vec3& a, const Vec3& b, double share) {
  return a + saturate(share) * (b - a);
}

Vec3 wide(const forest::Colour& c) {
  return {double{c[0]}, double{c[1]}, double{c[2]}};
}

Vec3 unit(const Vec3& v) {
  const double size = length(v);
  return size > 0.0 ? Vec3(v / size) : Vec3(Vec3::UnitZ());
}

Vec3 normalOf(const Rod& rod, const Vec3& place) {
  const Vec3 offset = place - rod.base;
  const double along = dot(offset, rod.axis);
  const Vec3 out = unit(offset - std::clamp(along, 0.0, rod.length) * rod.axis);
  if (!(along > 0.0 && along < rod.length)) return out;
  return unit(out + (rod.base_radius - rod.tip_radius) / rod.length * rod.axis);
}

// Returns the share of the sky at a place of a tree: leaves hide it inside and below.
double skyIn(const Box& bounds, const Vec3& place, Vec3& outwards) {
  const Vec3 half = (0.5 * (bounds.high - bounds.low)).cwiseMax(0.01);
  outwards = (place - 0.5 * (bounds.high + bounds.low)).cwiseQuotient(half);
  const double way = length(outwards);
  return (0.35 + 0.65 * smoothStep(way / 1.1)) * (0.8 + 0.2 * saturate(0.5 + 0.5 * outwards.z()));
}

std::uint32_t keyOf(const Hit& hit) {
  return mix32(hit.plant * 0x9e3779b9U + static_cast<std::uint32_t>(hit.branch));
}

}  // namespace

Vec3 linearOf(const Vec3& srgb) {
  Vec3 out;
  for (int i = 0; i < 3; ++i)
    out[i] = srgb[i] <= 0.04045 ? srgb[i] / 12.92 : std::pow((srgb[i] + 0.055) / 1.055, 2.4);
  return out;
}

Surfaces::Surfaces(const Scene& scene) : scene_(scene) {
  for (const auto& tree : scene.trees.all()) trees_[tree->id()] = tree.get();
  for (const auto& plant : scene.plants.all()) plants_[plant->id()] = plant.get();
  for (std::size_t limb = 0; limb < scene.people.limbs(); limb += crowd::PARTS) {
    const std::uint32_t id = scene.people.personOf(limb);
    people_[id] = {limb, crowd::clothesOf(id)};
  }
}

Surface Surfaces::at(const Ray& ray, const Hit& hit) const {
  const Vec3 place = ray.at(hit.distance);
  Surface out;
  switch (hit.label) {
    case Label::TRUNK:
    case Label::BRANCH:
      out = woodAt(place, hit);
      break;
    case Label::LEAF:
      out = leafAt(place, hit);
      break;
    case Label::GRASS:
      out = grassAt(place);
      break;
    case Label::FOLIAGE:
    case Label::STEM:
      out = plantAt(place, hit);
      break;
    case Label::PERSON:
      out = personAt(place, hit);
      break;
    default:
      out = groundAt(place);
  }
  if (dot(out.normal, ray.direction) > 0.0) out.normal = -out.normal;
  return out;
}

Surface Surfaces::woodAt(const Vec3& place, const Hit& hit) const {
  const PosedTree& tree = *trees_.at(hit.plant);
  const PosedBranch& branch = tree.branches()[tree.partOf(hit.branch)];
  const Rod& rod = branch.rod;
  const Vec3 own = rotate(conjugate(branch.turn), Vec3(place - rod.base));
  const double bark = fractalNoise({28.0 * own.x(), 28.0 * own.y(), 7.0 * own.z()}, 3, keyOf(hit));
  Surface out;
  Vec3 outwards;
  out.sky = skyIn(tree.bounds(), place, outwards);
  out.normal = normalOf(rod, place);
  out.albedo = linearOf(wide(tree.paint().bark(rod.base_radius))) * (0.45 + 1.1 * bark);
  // Light bark, as that of birches, has dark bands around.
  const double band =
      fractalNoise({5.0 * own.x(), 5.0 * own.y(), 22.0 * own.z()}, 3, keyOf(hit) + 7);
  if (out.albedo.y() > 0.2) out.albedo *= 0.8 - 0.65 * smoothStep((band - 0.52) / 0.12);
  return out;
}

// A leaf has the colour of its cell and a normal between that of the crown and its own.
Surface Surfaces::leafAt(const Vec3& place, const Hit& hit) const {
  const PosedTree& tree = *trees_.at(hit.plant);
  const PosedBranch& branch = tree.branches()[tree.partOf(hit.branch)];
  const Vec3 own = rotate(conjugate(branch.turn), Vec3(place - branch.rod.base));
  const Cell cell = cellAt(own, LEAF_SPOT);
  const std::uint32_t key = keyOf(hit);
  Surface out;
  Vec3 outwards;
  out.sky = skyIn(tree.bounds(), place, outwards);
  out.normal = unit(0.5 * unit(outwards) + 1.1 * randomVector(cell, key) + Vec3(0.0, 0.0, 0.3));
  forest::LeafCard card;
  card.shade = static_cast<float>(shareOf(cell, key) * saturate(0.3 + length(outwards)));
  out.albedo = linearOf(wide(tree.paint().leaf(card))) * (0.75 + 0.5 * shareOf(cell, key + 1));
  out.transmits = LEAF_TRANSMITS;
  return out;
}

// Each column of ground belongs to one blade, whose root is dark among its neighbours.
Surface Surfaces::grassAt(const Vec3& place) const {
  const GrassVolume& grass = scene_.grass;
  const grass::FeatureMap& map = *grass.layout().map;
  grass::Features here = map.at(place.x(), place.y());
  here.colour = grass::averageColour(here.colour, grass.colours(), place.x(), place.y());
  const double flat = grass.tiltAt(place.x(), place.y()) / grass::BEND_LIMIT;
  const GrassVolume::Cut cut = grass.cutAt(place.x(), place.y());
  const bool is_cut = cut.height < here.height;
  const double top = std::max(0.02, std::min(cut.height, here.height) * (1.0 - 0.8 * flat));
  const double way = saturate(grass.heightOf(place) / top);
  const Cell column = cellAt({place.x(), place.y(), 0.0}, BLADE_COLUMNS.front().width);
  Vec3 colour = grass::meanColour(map, here);
  if (is_cut) colour = blend(colour, map.species()[0].species.dry_colour, STUBBLE_DRYNESS);
  colour = blend(colour, HAY, hayShare(cut.swath));
  const double patch = fractalNoise({0.9 * place.x(), 0.9 * place.y(), 0.0}, 3, BLADE_KEY);
  const double own = shareOf(column, BLADE_KEY + 9);
  colour = blend(colour, map.species()[0].species.dry_colour, own * own * own * (0.3 + patch));
  Surface out;
  for (std::size_t k = 0; k < map.species().size(); ++k) {
    const grass::Species& species = map.species()[k].species;
    const double size = 2.0 * species.flower_radius;
    if (!(size > 0.0) || way < 0.5 || is_cut) continue;
    const Cell spot = cellAt(place, size);
    const double share = here.density * here.mix[k] * size * size;
    if (shareOf(spot, BLADE_KEY + 20 + static_cast<std::uint32_t>(k)) < share * (way - 0.5))
      colour = species.flower_colour;
  }
  out.sky = flat * 0.8 + (1.0 - flat) * (0.22 + 0.78 * way);
  out.normal = unit(randomVector(column, BLADE_KEY + 5) + Vec3(0.0, 0.0, 0.7 + 0.6 * flat));
  out.albedo = linearOf(colour) * (0.65 + 0.5 * own + 0.5 * patch) * (1.0 + 0.25 * flat);
  out.transmits = BLADE_TRANSMITS;
  return out;
}

Surface Surfaces::plantAt(const Vec3& place, const Hit& hit) const {
  const PosedPlant& plant = *plants_.at(hit.plant);
  const auto part = static_cast<std::size_t>(hit.branch);
  Surface out;
  if (hit.label == Label::STEM && part < plant.stems().size()) {
    out.normal = normalOf(plant.stems()[part], place);
    out.albedo = linearOf(plant.paint().stem);
    out.sky = 0.6;
    return out;
  }
  const bool leaf = hit.label == Label::FOLIAGE;
  const std::size_t index = leaf ? part : plant.leaves().size() + part - plant.stems().size();
  const Strip& strip = plant.strips()[index];
  out.normal = unit(cross(strip.tip - strip.root, strip.low + strip.high));
  const canopy::Leaf* own = leaf ? &plant.leaves()[index] : nullptr;
  out.albedo = linearOf(own ? blend(plant.paint().leaf, plant.paint().young, double{own->shade})
                            : plant.paint().stem);
  if (own) out.sky = double{own->light};
  if (own) out.transmits = LEAF_TRANSMITS;
  return out;
}

Surface Surfaces::personAt(const Vec3& place, const Hit& hit) const {
  const Person& person = people_.at(hit.plant);
  const auto limb = static_cast<std::size_t>(hit.branch);
  const Rod& rod = scene_.people.rods()[person.first_limb + limb];
  Surface out;
  out.normal = normalOf(rod, place);
  const Rod& shoulders =
      scene_.people.rods()[person.first_limb + static_cast<std::size_t>(crowd::Part::SHOULDERS)];
  const double along = dot(place - rod.base, rod.axis) / std::max(rod.length, 1e-6);
  const Vec3 colour = personColour(person.clothes, {limb, along, out.normal, frontOf(shoulders)});
  const Vec3 own = 60.0 * (place - rod.base);
  out.albedo = linearOf(colour) * (0.85 + 0.3 * smoothNoise(own, CLOTH_KEY + hit.plant));
  return out;
}

Surface Surfaces::groundAt(const Vec3& place, double open) const {
  const Vec3 flat(place.x(), place.y(), 0.0);
  const double broad = fractalNoise(flat / 9.0, 3, GROUND_KEY);
  const double fine = fractalNoise(flat / 0.35, 3, GROUND_KEY + 10);
  const double grain = fractalNoise(flat / 0.04, 2, GROUND_KEY + 20);
  Vec3 colour = blend(TURF, DRY_TURF, 2.0 * broad - 0.6 + 0.5 * (fine - 0.5));
  const Vec3 floor = blend(LITTER, MOSS, 3.0 * (broad - 0.45) + fine - 0.4);
  colour = blend(floor, colour, 1.6 * open - 0.4 + 0.8 * (fine - 0.5));
  if (scene_.grass.isPresent()) {
    const double density = scene_.grass.layout().map->at(place.x(), place.y()).density;
    colour = blend(colour, SOIL, density / 100.0);
    colour = blend(colour, HAY, hayShare(scene_.grass.cutAt(place.x(), place.y()).swath));
  }
  Surface out;
  out.normal = unit(scene_.ground->normal(place.x(), place.y()) +
                    1.2 * Vec3(grain - 0.5, smoothNoise(flat / 0.03, GROUND_KEY + 30) - 0.5, 0.0));
  out.albedo = linearOf(colour) * (0.15 + 0.5 * fine + 1.2 * grain * grain / 0.5);
  return out;
}

}  // namespace vegetation_sim::scan
