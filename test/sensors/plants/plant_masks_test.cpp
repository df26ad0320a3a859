// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/plants/plant_masks.h"

#include <gtest/gtest.h>

#include <cmath>

#include "reference/sensors/cast_plain.h"
#include "scenes/sensors/card_scene.h"
#include "scenes/sensors/grove_scene.h"
#include "scenes/sensors/lidar_scene.h"
#include "terrain/png_fixture.h"

namespace vegetation_sim::scan {
namespace {

constexpr double CARD_REACH = 20.0;  // [m]

ThreadPool card_thread;

/// Returns the bytes of a picture whose left half is transparent and whose right half is green.
std::string halfCard() {
  return terrain::pngOf(std::vector<std::uint8_t>{20, 90, 10, 0, 20, 90, 10, 255}, 2,
                        PNG_FORMAT_RGBA);
}

Hit castAtCards(const Plants& plants, const Ray& ray) {
  Hit out;
  out.distance = CARD_REACH;
  plants.meet(ray, FloatRay(ray), out);
  return out;
}

Hit castAlongX(const Plants& plants, double y, double z) {
  return castAtCards(plants, {Vec3(-5.0, y, z), Vec3::UnitX()});
}

// S3-29: the left half of the first card lets rays pass to the second, whose texture is mirrored.
TEST(PlantMasks, RaysPassWhereTheTextureIsTransparent) {
  const canopy::Layout layout = cardLayout(halfCard());
  Grove cards(layout, false);
  Plants plants;
  cards.show(plants, card_thread);
  EXPECT_TRUE(plants.textureFaults().empty());
  for (const double z : {0.1, 0.5, 0.9})
    for (const double y : {0.05, 0.2, 0.45}) {
      const Hit first = castAlongX(plants, y, z), second = castAlongX(plants, -y, z);
      EXPECT_NEAR(first.distance, 5.0, 1e-6);
      EXPECT_EQ(first.plant, 0U);
      EXPECT_EQ(first.label, Label::FOLIAGE);
      EXPECT_NEAR(second.distance, 7.0, 1e-6);
      EXPECT_EQ(second.plant, 1U);
      EXPECT_EQ(castAlongX(plants, y + 0.5, z).distance, CARD_REACH);
    }
}

// The holes move with the face: each place of a moved face is what its texture says.
TEST(PlantMasks, HolesMoveWithTheWind) {
  const canopy::Layout layout = cardLayout(halfCard());
  Grove calm(layout, false), windy(layout);
  Plants still, moved;
  calm.show(still, card_thread);
  windy.show(moved, card_thread);
  int holes = 0, hits = 0;
  for (std::size_t card = 0; card < moved.all().size(); ++card)
    for (std::size_t i = 0; i < 2; ++i) {
      const PosedPlant& plant = *moved.all()[card];
      const Strip& face = plant.strips()[i];
      EXPECT_GT(length(Vec3(face.tip - still.all()[card]->strips()[i].tip)), 1e-3);
      const canopy::FaceLook& look = layout.kinds[0].form->looks[plant.leaves()[i].look - 1];
      for (double p = 0.05; p < 1.0; p += 0.1)
        for (double q = 0.05; p + q < 0.99; q += 0.1) {
          const Vec3 corner = face.root - face.low;
          const Vec3 target = corner + p * 2.0 * face.low + q * (face.tip - corner);
          const double u = (1.0 - p - q) * double{look.uv[0][0]} + p * double{look.uv[1][0]} +
                           q * double{look.uv[2][0]};
          if (std::abs(u - 0.5) < 1e-3) continue;
          const Ray ray{target - 3.0 * Vec3::UnitX(), Vec3::UnitX()};
          Hit hit;
          hit.distance = CARD_REACH;
          EXPECT_EQ(plant.meetStrip(i, ray, hit), u > 0.5) << p << " " << q;
          ++(u > 0.5 ? hits : holes);
        }
    }
  EXPECT_GT(holes, 50);
  EXPECT_GT(hits, 50);
}

TEST(PlantMasks, AreThoseOfTheSearchOfEveryFace) {
  Grove cards(cardLayout(halfCard()));
  Plants plants;
  cards.show(plants, card_thread);
  int met = 0;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const Vec3 way = randomDirection(Random(5), i, -0.4, 0.4);
    const Vec3 target(Random(6).uniform(2 * i, 0.0, 2.0), Random(6).uniform(2 * i + 1, -0.5, 0.5),
                      0.5);
    const Ray ray{target - 6.0 * way, way};
    Hit plain;
    plain.distance = CARD_REACH;
    meetEachPlant(plants, ray, plain);
    EXPECT_TRUE(same(castAtCards(plants, ray), plain)) << i;
    if (plain.label == Label::FOLIAGE) ++met;
  }
  EXPECT_GT(met, 100);
  EXPECT_LT(met, 900);
}

// What cannot be read is opaque and named; a picture without alpha is no fault.
TEST(PlantMasks, FaultyTexturesAreOpaqueAndNamed) {
  const std::string grey = terrain::grey8({200, 100}, 2);
  const std::pair<std::string, std::string> cases[] = {
      {grey, ""},
      {"\xff\xd8\xff\xe0 a JPEG", ""},
      {"GIF89a", "kind card: texture 'card.png' is no PNG"},
      {halfCard().substr(0, 40), "kind card: texture 'card.png' is damaged"}};
  for (const auto& [picture, fault] : cases) {
    Grove cards(cardLayout(picture), false);
    Plants plants;
    cards.show(plants, card_thread);
    EXPECT_NEAR(castAlongX(plants, -0.2, 0.5).distance, 5.0, 1e-6) << fault;
    EXPECT_EQ(plants.textureFaults(),
              fault.empty() ? std::vector<std::string>{} : std::vector<std::string>{fault});
  }
}

TEST(PlantMasks, HaveALimitedNumber) {
  canopy::Layout layout = cardLayout(halfCard());
  canopy::Form form = *layout.kinds[0].form;
  const canopy::FaceMaterial material_of_card = form.materials[0];
  form.materials.assign(PlantMasks::MOST_MASKS + 1, material_of_card);
  layout.kinds[0].form = std::make_shared<const canopy::Form>(form);
  EXPECT_TRUE(PlantMasks(layout).faults().empty());  // one picture, which is read once
  for (canopy::FaceMaterial& material : form.materials)
    material.picture = std::make_shared<const std::string>(halfCard());
  layout.kinds[0].form = std::make_shared<const canopy::Form>(form);
  const PlantMasks masks(layout);
  ASSERT_EQ(masks.faults().size(), 1U);
  EXPECT_EQ(masks.faults()[0], "kind card: texture 'card.png' is one more than the 64 allowed");
  EXPECT_TRUE(masks.of(0)->of_material[63]);
  EXPECT_FALSE(masks.of(0)->of_material[64]);
}

// The hash of a layout says nothing of its textures.
TEST(PlantMasks, AnotherPictureOfTheSameLayoutIsRead) {
  const canopy::Layout solid = cardLayout(terrain::grey8({200, 100}, 2));
  const canopy::Layout holed = cardLayout(halfCard());
  ASSERT_EQ(solid.hash(), holed.hash());
  Grove before(solid, false), after(holed, false);
  Plants plants;
  before.show(plants, card_thread);
  const auto first = plants.all()[0];
  before.show(plants, card_thread);
  EXPECT_EQ(plants.all()[0], first);
  EXPECT_NEAR(castAlongX(plants, -0.2, 0.5).distance, 5.0, 1e-6);
  after.show(plants, card_thread);
  EXPECT_NEAR(castAlongX(plants, -0.2, 0.5).distance, 7.0, 1e-6);
}

}  // namespace
}  // namespace vegetation_sim::scan
