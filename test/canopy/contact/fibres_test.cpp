// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/canopy/contact/fibres.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/archive/archive.h"
#include "core/error_text.h"

namespace vegetation_sim::canopy {
namespace {

TEST(Fibres, FillThePlantAtItsScale) {
  PlantKind kind;
  kind.height = 2.0;
  kind.radius = 0.5;
  Plant plant;
  plant.position = Vec3(3.0, 4.0, 1.0);
  plant.scale = 2.0;
  const Fibres shrub = fibresOf(kind, plant);
  EXPECT_EQ(shrub.length, 4.0);
  EXPECT_EQ(shrub.half, 1.0);
  EXPECT_EQ(shrub.side, 8);
  EXPECT_EQ(shrub.foot, plant.position);
  EXPECT_EQ(shrub.footOf(0), Vec3(2.125, 3.125, 1.0));
  EXPECT_EQ(shrub.footOf(63), Vec3(3.875, 4.875, 1.0));
  kind.shape = PlantShape::CROWN;
  const Fibres crown = fibresOf(kind, plant);
  EXPECT_NEAR(crown.foot.z(), 1.0 + 0.35 * 4.0, 1e-12);
  EXPECT_NEAR(crown.length, 0.65 * 4.0, 1e-12);
}

TEST(Fibres, CellsShareTheGroundOfTheCircle) {
  Fibres fibres;
  fibres.half = 0.7;
  for (const int side : {1, 2, 5, 16}) {
    fibres.side = side;
    double ground = 0.0;
    for (std::size_t cell = 0; cell < fibres.cells(); ++cell)
      ground += filledShare(fibres, cell) * fibres.edge() * fibres.edge();
    EXPECT_NEAR(ground, 3.14159265 * 0.49, 0.02 * 3.14 * 0.49) << side;
  }
}

TEST(Fibres, LeansAreContinuousAndThoseOfTheCells) {
  Fibres fibres;
  fibres.side = 4;
  std::vector<Flat> leans(16);
  for (std::size_t i = 0; i < leans.size(); ++i)
    leans[i] = {0.01 * static_cast<double>(i * i % 7), -0.02 * static_cast<double>(i % 5)};
  for (std::size_t i = 0; i < leans.size(); ++i) {
    const Flat lean = leanAt(fibres, leans, fibres.footOf(i));
    EXPECT_NEAR(lean.x, leans[i].x, 1e-15);
    EXPECT_NEAR(lean.y, leans[i].y, 1e-15);
  }
  for (double x = -1.5; x < 1.5; x += 0.01) {
    const Flat a = leanAt(fibres, leans, Vec3(x, 0.3, 0.0));
    const Flat b = leanAt(fibres, leans, Vec3(x + 1e-6, 0.3, 0.0));
    EXPECT_NEAR(a.x, b.x, 1e-6);
  }
  fibres.side = 1;
  EXPECT_EQ(leanAt(fibres, {{0.3, 0.1}}, Vec3(0.9, -0.9, 0.0)).x, 0.3);
}

TEST(Fibres, ALeanTurnsTheFibreTowardsItAndKeepsItsLength) {
  for (const Flat lean : {Flat{0.4, 0.0}, Flat{0.0, -1.2}, Flat{0.3, 0.4}, Flat{0.0, 0.0}}) {
    const Vec3 top = rotate(leanTurn(lean), Vec3(0.0, 0.0, 2.0));
    const double angle = lean.size();
    EXPECT_NEAR(length(top), 2.0, 1e-15 * 8);
    EXPECT_NEAR(top.z(), 2.0 * std::cos(angle), 1e-14);
    const double part = angle > 0.0 ? std::sin(angle) / angle : 1.0;
    EXPECT_NEAR(top.x(), 2.0 * part * lean.x, 1e-14);
    EXPECT_NEAR(top.y(), 2.0 * part * lean.y, 1e-14);
  }
}

PushState someState() {
  PushState out;
  out.plants[3].resize(4);
  out.plants[3][1].lean = {0.5, -0.25};
  out.plants[3][2].set = {0.1, 0.0};
  forest::Body body;
  body.id = body.frame = "robot";
  body.stamp = 5;
  out.bodies["robot"] = body;
  return out;
}

TEST(Fibres, OnlyCellsThatLeanAreSent) {
  const std::vector<BentCell> bent = bentCells(someState());
  ASSERT_EQ(bent.size(), 1u);
  EXPECT_EQ(bent[0].plant, 3u);
  EXPECT_EQ(bent[0].cell, 1u);
  EXPECT_EQ(bent[0].x, 10000);
  EXPECT_EQ(bent[0].y, -5000);
}

TEST(Fibres, AStateComesBackFromItsBytes) {
  PushState state = someState();
  Archive writer;
  archivePush(writer, state);
  Archive reader = Archive::reading(writer.bytes());
  PushState read;
  archivePush(reader, read);
  reader.finish();
  const auto hashOf = [](const PushState& s) {
    Hash hash;
    s.addTo(hash);
    return hash.value();
  };
  EXPECT_EQ(hashOf(read), hashOf(state));
  EXPECT_NE(hashOf(read), hashOf(PushState()));
  EXPECT_EQ(hashOf(PushState()), Hash().value());
  state.plants[3][1].lean.x = 2.0;
  Archive bad;
  archivePush(bad, state);
  Archive bad_reader = Archive::reading(bad.bytes());
  const std::string text = errorOf([&] { archivePush(bad_reader, read); });
  EXPECT_NE(text.find("lean = 2"), std::string::npos) << text;
  EXPECT_NE(text.find("-1.5 to 1.5"), std::string::npos) << text;
}

}  // namespace
}  // namespace vegetation_sim::canopy
