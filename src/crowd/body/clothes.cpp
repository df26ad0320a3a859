// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/body/clothes.h"

#include "crowd/body/body_skeleton.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::crowd {
namespace {

constexpr double SKINS[][3] = {
    {0.93, 0.76, 0.65}, {0.80, 0.60, 0.46}, {0.55, 0.38, 0.28}, {0.36, 0.24, 0.18}};
constexpr double HAIRS[][3] = {
    {0.10, 0.07, 0.05}, {0.30, 0.19, 0.10}, {0.72, 0.55, 0.30}, {0.62, 0.62, 0.60}};
constexpr double SHIRTS[][3] = {{0.78, 0.16, 0.14}, {0.13, 0.33, 0.66}, {0.93, 0.90, 0.84},
                                {0.93, 0.68, 0.14}, {0.16, 0.48, 0.42}, {0.55, 0.30, 0.55}};
constexpr double TROUSERS[][3] = {
    {0.15, 0.19, 0.32}, {0.24, 0.23, 0.22}, {0.50, 0.42, 0.30}, {0.33, 0.38, 0.44}};

template <std::size_t N>
Vec3 oneOf(const double (&list)[N][3], std::uint64_t bits) {
  const auto& colour = list[bits % N];
  return {colour[0], colour[1], colour[2]};
}

}  // namespace

Clothes clothesOf(std::uint32_t id) {
  const Random random = Random(id).child(0x70656F70);
  return {oneOf(SKINS, random.bits(0)),  oneOf(HAIRS, random.bits(1)),
          oneOf(SHIRTS, random.bits(2)), oneOf(TROUSERS, random.bits(3)),
          Vec3(0.12, 0.10, 0.09),        random.bits(4) % 2 == 0,
          random.bits(5) % 3 == 0,       random.uniform(6, 0.0, 1.0)};
}

const Vec3& colourOf(const Clothes& clothes, std::size_t limb) {
  if (limb <= static_cast<std::size_t>(Part::NECK)) return clothes.skin;
  if (limb <= static_cast<std::size_t>(Part::SHOULDERS)) return clothes.shirt;
  if (limb < static_cast<std::size_t>(Part::FOOT)) return clothes.trousers;
  if (limb < static_cast<std::size_t>(Part::UPPER_ARM)) return clothes.shoes;
  const bool sleeve = limb < static_cast<std::size_t>(Part::FOREARM) || clothes.long_sleeves;
  return sleeve ? clothes.shirt : clothes.skin;
}

}  // namespace vegetation_sim::crowd
