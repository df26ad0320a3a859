// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/canopy/layers/layer_cut.h"

#include <gtest/gtest.h>

#include "core/error_text.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::canopy {
namespace {

CutView eastwardFrom(double x) {
  CutView out;
  out.position = Vec3(x, 0.0, 1.0);
  return out;
}

// S3-01: each depth in exactly one layer, near ones first.
TEST(LayerCut, PutsEachDepthIntoOneLayer) {
  CutSettings settings;
  settings.near_end = 100.0;
  const LayerCut cut(eastwardFrom(0.0), settings, 4.0, 7.0);
  ASSERT_EQ(cut.layers(), 3);
  int last = 0;
  for (double x = 4.0; x <= 7.0; x += 0.01) {
    const int layer = cut.layerAt(Vec3(x, 3.0, -2.0));
    EXPECT_EQ(layer, std::min(2, static_cast<int>(x - 4.0)));
    EXPECT_GE(layer, last);
    last = layer;
  }
  EXPECT_EQ(last, 2);
  EXPECT_NEAR(cut.distance(1), 1.0, 1e-12);  // S3-05: equal within a region
  EXPECT_NEAR(cut.distance(2), 2.0, 1e-12);
  EXPECT_EQ(cut.distance(0), 0.0);
}

// S3-05: counts by region.
TEST(LayerCut, HasTheLayersOfEachRegion) {
  CutSettings settings;  // 3-1-1
  const LayerCut all(eastwardFrom(0.0), settings, 1.0, 60.0);
  EXPECT_EQ(all.layers(), 5);
  EXPECT_EQ(all.layerAt(Vec3(9.9, 0.0, 0.0)), 2);
  EXPECT_EQ(all.layerAt(Vec3(10.1, 0.0, 0.0)), 3);
  EXPECT_EQ(all.layerAt(Vec3(25.1, 0.0, 0.0)), 4);
  EXPECT_EQ(LayerCut(eastwardFrom(0.0), settings, 30.0, 60.0).layers(), 1);
  settings = {1, 1, 1};
  EXPECT_EQ(LayerCut(eastwardFrom(0.0), settings, 1.0, 60.0).layers(), 3);
}

// S3-W1: what moves together without belonging together is parted by more layers.
TEST(LayerCut, PartsNeighboursInDepthWithMoreLayers) {
  const Vec3 near(4.2, 0.0, 1.0), far(4.9, 0.0, 1.0);
  for (const int layers : {1, 2, 5, 9}) {
    CutSettings settings;
    settings.near_layers = layers;
    settings.near_end = 100.0;
    const LayerCut cut(eastwardFrom(0.0), settings, 4.0, 7.0);
    EXPECT_EQ(cut.layerAt(near) != cut.layerAt(far), layers >= 5) << layers;
  }
}

// S3-04: a quarter turn cuts other layers.
TEST(LayerCut, IsOfTheViewThatItWasMadeFor) {
  CutSettings settings;
  settings.near_end = 100.0;
  CutView north;
  const SinCos half = sinCos(0.25 * PI);
  north.orientation = {half.cos, 0.0, 0.0, half.sin};
  const LayerCut cut(north, settings, 4.0, 7.0);
  EXPECT_EQ(cut.layerAt(Vec3(0.0, 4.5, 0.0)), 0);
  EXPECT_EQ(cut.layerAt(Vec3(6.5, 4.5, 0.0)), 0);
  EXPECT_EQ(cut.layerAt(Vec3(0.0, 6.5, 0.0)), 2);
}

TEST(LayerCut, IsLeftOnlyByAViewThatDiffersEnough) {
  CutSettings settings;
  settings.near_end = 100.0;
  const LayerCut cut(eastwardFrom(0.0), settings, 4.0, 7.0);  // layers of a metre
  EXPECT_FALSE(cut.leftBy(eastwardFrom(0.29), settings));
  EXPECT_TRUE(cut.leftBy(eastwardFrom(0.31), settings));
  for (const double angle : {0.09, 0.11}) {
    CutView turned = eastwardFrom(0.0);
    turned.orientation = {sinCos(0.5 * angle).cos, 0.0, 0.0, sinCos(0.5 * angle).sin};
    EXPECT_EQ(cut.leftBy(turned, settings), angle > 0.1);
  }
}

// Bad input: one layer, no depth, a viewer among the leaves.
TEST(LayerCut, HoldsWithoutDepthAndFromWithin) {
  const CutSettings settings;
  const LayerCut flat(eastwardFrom(0.0), settings, 3.0, 3.0);
  EXPECT_EQ(flat.layers(), 1);
  EXPECT_EQ(flat.last(), 0.0);
  const LayerCut within(eastwardFrom(5.0), settings, -1.0, 2.0);
  EXPECT_EQ(within.layerAt(Vec3(4.2, 0.0, 0.0)), 0);  // behind the viewer
  EXPECT_EQ(within.layerAt(Vec3(6.9, 0.0, 0.0)), within.layers() - 1);
  const LayerCut behind(eastwardFrom(50.0), settings, -10.0, -2.0);
  EXPECT_EQ(behind.layers(), 1);
  EXPECT_EQ(LayerCut().layers(), 1);
}

TEST(CutSettings, AreRejectedWithAllFaults) {
  const auto text = [](const CutSettings& settings) {
    Faults faults;
    check(settings, "layers: ", faults);
    return faults.text();
  };
  EXPECT_EQ(text({}), "");
  CutSettings bad{0, 0, 0, 5.0, 2.0};
  EXPECT_NE(text(bad).find("= 0 is outside 1 to 16"), std::string::npos) << text(bad);
  EXPECT_NE(text(bad).find("below near_end"), std::string::npos) << text(bad);
  bad = {10, 10, 10};
  EXPECT_NE(text(bad).find("= 30 is outside"), std::string::npos) << text(bad);
}

}  // namespace
}  // namespace vegetation_sim::canopy
