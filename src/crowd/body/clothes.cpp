// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/body/clothes.h"

#include <iterator>

#include "crowd/body/body_skeleton.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::crowd {
namespace {

constexpr double SKINS[][3] = {{0.93, 0.76, 0.66}, {0.88, 0.69, 0.57}, {0.84, 0.65, 0.50},
                               {0.72, 0.52, 0.39}, {0.55, 0.38, 0.28}, {0.40, 0.27, 0.20}};
constexpr double HAIRS[][3] = {{0.09, 0.07, 0.06}, {0.14, 0.10, 0.08}, {0.24, 0.16, 0.10},
                               {0.33, 0.22, 0.13}, {0.42, 0.24, 0.13}, {0.56, 0.42, 0.25},
                               {0.72, 0.58, 0.37}, {0.52, 0.51, 0.50}};
constexpr std::size_t DARK_HAIRS = 2;  // the first of HAIRS, for the last two of SKINS
// Most clothes are muted; a few are bright.
constexpr double TOPS[][3] = {
    {0.86, 0.85, 0.81}, {0.60, 0.61, 0.62}, {0.23, 0.24, 0.26}, {0.15, 0.19, 0.29},
    {0.45, 0.57, 0.68}, {0.35, 0.38, 0.26}, {0.22, 0.33, 0.28}, {0.42, 0.17, 0.19},
    {0.58, 0.34, 0.22}, {0.66, 0.53, 0.30}, {0.70, 0.62, 0.50}, {0.71, 0.52, 0.52},
    {0.30, 0.40, 0.50}, {0.50, 0.46, 0.56}, {0.13, 0.13, 0.14}, {0.33, 0.44, 0.46},
    {0.45, 0.35, 0.28}, {0.74, 0.20, 0.17}, {0.20, 0.42, 0.66}, {0.82, 0.63, 0.20}};
constexpr double BOTTOMS[][3] = {{0.16, 0.20, 0.30}, {0.25, 0.32, 0.44}, {0.38, 0.45, 0.54},
                                 {0.13, 0.13, 0.15}, {0.26, 0.26, 0.27}, {0.52, 0.46, 0.36},
                                 {0.36, 0.29, 0.22}, {0.30, 0.32, 0.24}, {0.46, 0.46, 0.45}};
constexpr double SHOES[][3] = {{0.11, 0.10, 0.10}, {0.24, 0.16, 0.11}, {0.38, 0.27, 0.18},
                               {0.72, 0.71, 0.69}, {0.34, 0.36, 0.40}, {0.20, 0.22, 0.30}};
const Vec3 DARK_SOLES(0.13, 0.12, 0.11), LIGHT_SOLES(0.74, 0.72, 0.68);

template <std::size_t N>
Vec3 oneOf(const double (&list)[N][3], std::uint64_t bits, std::size_t most = N) {
  const auto& colour = list[bits % most];
  return {colour[0], colour[1], colour[2]};
}

// Each list has as many entries as its choices are likely.
constexpr HairCut SLENDER_CUTS[] = {HairCut::LONG, HairCut::LONG, HairCut::BOB, HairCut::BOB,
                                    HairCut::TAIL, HairCut::TAIL, HairCut::CAP, HairCut::SHORT};
constexpr HairCut BROAD_CUTS[] = {HairCut::SHORT, HairCut::SHORT, HairCut::SHORT, HairCut::CROP,
                                  HairCut::CROP,  HairCut::BALD,  HairCut::CAP,   HairCut::TAIL};
constexpr Outfit SLENDER_OUTFITS[] = {Outfit::TROUSERS, Outfit::TROUSERS, Outfit::TROUSERS,
                                      Outfit::SKIRT,    Outfit::SKIRT,    Outfit::SHORTS,
                                      Outfit::COAT};
constexpr Outfit BROAD_OUTFITS[] = {Outfit::TROUSERS, Outfit::TROUSERS, Outfit::TROUSERS,
                                    Outfit::TROUSERS, Outfit::SHORTS,   Outfit::COAT};
constexpr Pattern PATTERNS[] = {Pattern::PLAIN, Pattern::PLAIN,   Pattern::OPEN,
                                Pattern::OPEN,  Pattern::STRIPES, Pattern::YOKE};
constexpr Neckline NECKLINES[] = {Neckline::ROUND, Neckline::ROUND, Neckline::OPEN, Neckline::OPEN,
                                  Neckline::HIGH};

template <typename T, std::size_t N>
T oneOf(const T (&list)[N], std::uint64_t bits) {
  return list[bits % N];
}

void chooseShape(const Random& random, Clothes& out) {
  out.build = random.uniform(6, 0.0, 1.0);
  out.fullness = 0.5 * (random.uniform(7, 0.0, 1.0) + random.uniform(8, 0.0, 1.0));
  const bool broad = out.build > 0.5;
  out.cut = broad ? oneOf(BROAD_CUTS, random.bits(5)) : oneOf(SLENDER_CUTS, random.bits(5));
  out.outfit =
      broad ? oneOf(BROAD_OUTFITS, random.bits(9)) : oneOf(SLENDER_OUTFITS, random.bits(9));
  if (broad && random.bits(10) % 2 == 0) out.beard = random.uniform(11, 0.2, 0.85);
}

void chooseTop(const Random& random, Clothes& out) {
  out.pattern = oneOf(PATTERNS, random.bits(12));
  out.neckline = oneOf(NECKLINES, random.bits(13));
  if (out.outfit == Outfit::COAT && out.pattern == Pattern::STRIPES) out.pattern = Pattern::OPEN;
  const bool jacket = out.pattern == Pattern::OPEN || out.outfit == Outfit::COAT;
  out.long_sleeves = jacket || random.bits(4) % 2 == 0;
  out.tucked = !jacket && (out.outfit == Outfit::SKIRT || random.bits(14) % 3 == 0);
}

}  // namespace

Clothes clothesOf(std::uint32_t id) {
  const Random random = Random(id).child(0x70656F70);
  Clothes out;
  const std::uint64_t skin = random.bits(0) % std::size(SKINS);
  out.skin = oneOf(SKINS, skin);
  out.hair =
      oneOf(HAIRS, random.bits(1), skin + 2 < std::size(SKINS) ? std::size(HAIRS) : DARK_HAIRS);
  const std::uint64_t top = random.bits(2) % std::size(TOPS);
  out.shirt = oneOf(TOPS, top);
  out.second = oneOf(TOPS, top + 1 + random.bits(15) % (std::size(TOPS) - 1));
  out.trousers = oneOf(BOTTOMS, random.bits(3));
  out.shoes = oneOf(SHOES, random.bits(16));
  out.soles = random.bits(17) % 2 == 0 ? LIGHT_SOLES : DARK_SOLES;
  chooseShape(random, out);
  chooseTop(random, out);
  // A dress is a skirt of the top's colour.
  if (out.outfit == Outfit::SKIRT && random.bits(18) % 2 == 0) out.trousers = out.shirt;
  return out;
}

const Vec3& colourOf(const Clothes& clothes, std::size_t limb) {
  if (limb <= static_cast<std::size_t>(Part::NECK)) return clothes.skin;
  if (limb <= static_cast<std::size_t>(Part::SHOULDERS)) return clothes.shirt;
  if (limb < static_cast<std::size_t>(Part::FOOT)) {
    const bool bare = clothes.outfit == Outfit::SHORTS || clothes.outfit == Outfit::SKIRT;
    return bare && limb >= static_cast<std::size_t>(Part::SHANK) ? clothes.skin : clothes.trousers;
  }
  if (limb < static_cast<std::size_t>(Part::UPPER_ARM)) return clothes.shoes;
  const bool sleeve = limb < static_cast<std::size_t>(Part::FOREARM) || clothes.long_sleeves;
  return sleeve ? clothes.shirt : clothes.skin;
}

}  // namespace vegetation_sim::crowd
