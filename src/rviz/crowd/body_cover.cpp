// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/crowd/body_cover.h"

namespace vegetation_sim::view {
namespace {

using crowd::Neckline;
using crowd::Outfit;
using crowd::Pattern;

Vec3 blend(const Vec3& a, const Vec3& b, double share) {
  return (1.0 - share) * a + share * b;
}

/// Fills the colours of a person, part by part.
struct Painter {
  const crowd::Clothes& clothes;
  CoverColours& out;

  Vec3& at(Cover cover) const { return out[static_cast<std::size_t>(cover)]; }

  void paintHead() const {
    const Vec3& skin = clothes.skin;
    at(Cover::SKIN) = skin;
    at(Cover::LIPS) = skin.cwiseProduct(Vec3(0.85, 0.66, 0.64));
    at(Cover::LIP_LINE) = 0.5 * at(Cover::LIPS);
    at(Cover::MOUSTACHE) = blend(0.92 * at(Cover::LIPS), clothes.hair, clothes.beard);
    at(Cover::BEARD) = blend(skin, clothes.hair, clothes.beard);
    at(Cover::BROW) = blend(0.8 * clothes.hair, skin, 0.35);
    at(Cover::EYE) = Vec3(0.86, 0.84, 0.82);
    at(Cover::IRIS) = blend(0.6 * clothes.hair, Vec3(0.20, 0.25, 0.28), 0.5);
    at(Cover::LASHES) = 0.3 * blend(skin, clothes.hair, 0.6);
    at(Cover::HAIR) = clothes.hair;
    at(Cover::HAT) = clothes.second;
  }

  // A closed top has a seam.
  void paintFront(Cover cover, Cover front, Cover lapel) const {
    const bool open = clothes.pattern == Pattern::OPEN;
    at(front) = open ? clothes.second : Vec3(0.93 * at(cover));
    at(lapel) = (open ? 0.7 : 1.0) * at(cover);
  }

  void paintTop() const {
    const Vec3 &shirt = clothes.shirt, &second = clothes.second;
    const bool open = clothes.pattern == Pattern::OPEN;
    at(Cover::SHIRT) = shirt;
    at(Cover::STRIPE) = clothes.pattern == Pattern::STRIPES ? second : shirt;
    at(Cover::YOKE) = clothes.pattern == Pattern::YOKE ? second : shirt;
    paintFront(Cover::SHIRT, Cover::FRONT, Cover::LAPEL);
    paintFront(Cover::STRIPE, Cover::STRIPE_FRONT, Cover::STRIPE_LAPEL);
    paintFront(Cover::YOKE, Cover::YOKE_FRONT, Cover::YOKE_LAPEL);
    at(Cover::THROAT) = clothes.neckline == Neckline::OPEN ? clothes.skin
                        : open                             ? second
                                                           : at(Cover::YOKE);
    at(Cover::NOTCH) =
        clothes.neckline == Neckline::HIGH ? Vec3(0.8 * at(Cover::THROAT)) : clothes.skin;
    at(Cover::COLLAR) =
        clothes.neckline == Neckline::ROUND && !open ? clothes.skin : Vec3(0.8 * shirt);
    at(Cover::SLEEVE) = clothes.long_sleeves ? shirt : clothes.skin;
    at(Cover::CUFF) = clothes.long_sleeves ? Vec3(0.75 * shirt) : clothes.skin;
    at(Cover::HEM) = clothes.tucked ? clothes.trousers : shirt;
    at(Cover::HEM_FRONT) = clothes.tucked ? clothes.trousers : at(Cover::FRONT);
    at(Cover::UNDER_HEM) = (clothes.tucked ? 1.0 : 0.6) * clothes.trousers;
    at(Cover::BELT) = clothes.tucked ? Vec3(0.5 * clothes.shoes) : shirt;
  }

  void paintLegs() const {
    const bool bare = clothes.outfit == Outfit::SHORTS || clothes.outfit == Outfit::SKIRT;
    at(Cover::SKIRT) = clothes.outfit == Outfit::COAT ? clothes.shirt : clothes.trousers;
    at(Cover::TROUSERS) = clothes.trousers;
    at(Cover::SHANK) = bare ? clothes.skin : clothes.trousers;
    at(Cover::SOCKS) = clothes.outfit == Outfit::SKIRT ? clothes.skin : Vec3(0.8 * clothes.soles);
    at(Cover::SHOES) = clothes.shoes;
    at(Cover::SOLES) = clothes.soles;
  }
};

}  // namespace

CoverColours coverColours(const crowd::Clothes& clothes) {
  CoverColours out;
  const Painter painter{clothes, out};
  painter.paintHead();
  painter.paintTop();
  painter.paintLegs();
  return out;
}

bool isCloth(Cover cover) {
  return cover >= Cover::SHIRT && cover <= Cover::TROUSERS;
}

}  // namespace vegetation_sim::view
