// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/camera/surface.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "scenes/sensors/grove_scene.h"
#include "scenes/sensors/lidar_scene.h"

namespace vegetation_sim::scan {
namespace {

// Trees, a lawn, leafy plants and a person, seen from one place.
class SurfacesTest : public testing::Test {
 protected:
  SurfacesTest() : lawn_(0.15, 100.0) {
    ThreadPool alone;
    const auto forest = movingForest(forest::gridLayout(2, 9.0), breezeOf(Vec3(4, 0, 0)));
    scene_.trees.update(forest, Vec3(10, 10, 1), 60.0, START);
    lawn_.show(scene_.grass);
    Grove(groveLayout(Vec3(12.0, 12.0, 0.0))).show(scene_.plants, alone);
    crowd::Walker walker;
    walker.position = {4.0, 5.0};
    walker.id = 7;
    scene_.people.set({{7, crowd::skeletonOf(walker, terrain::HeightMap())}});
  }
  /// Calls each(ray, hit) for random rays that hit.
  template <class Each>
  void visit(std::uint64_t rays, Each&& each) const {
    for (std::uint64_t i = 0; i < rays; ++i) {
      const Ray ray(Vec3(1.0, 6.0, 1.6), randomDirection(Random(4), i, -0.5, 0.6));
      const Hit hit = cast(scene_, ray, 40.0);
      if (hit.label != Label::NONE) each(ray, hit);
    }
  }
  Lawn lawn_;
  Scene scene_;
};

// Normals of leaves, blades and ground vary by themselves; the others are those of which the lidar
// takes the cosine of incidence.
TEST_F(SurfacesTest, NormalsAgreeWithTheCosineOfTheHit) {
  const Surfaces surfaces(scene_);
  int tested = 0, exact = 0;
  visit(40000, [&](const Ray& ray, const Hit& hit) {
    const Surface surface = surfaces.at(ray, hit);
    EXPECT_NEAR(length(surface.normal), 1.0, 1e-9);
    EXPECT_LE(dot(surface.normal, ray.direction), 1e-9);
    for (int k = 0; k < 3; ++k) EXPECT_TRUE(surface.albedo[k] >= 0.0 && surface.albedo[k] < 1.5);
    if (hit.label == Label::LEAF || hit.label == Label::GRASS || hit.label == Label::GROUND) return;
    // The two triangles of a leaf share a normal. Near the ends of a tapered rod, whose balls
    // protrude by the square of its slope, a hit may be on either surface. Axes of branches have
    // single precision, which moves a thin rod's surface by a thousandth of its radius.
    const double error = std::fabs(-dot(surface.normal, ray.direction) - hit.cosine);
    EXPECT_LT(error, 0.02);
    if (hit.label == Label::FOLIAGE) return;
    ++tested;
    exact += error < 1e-3;
  });
  EXPECT_GT(tested, 300);
  EXPECT_GT(exact, 0.98 * tested);
}

// The mean over many hits is near the colour of the species or of the clothes.
TEST_F(SurfacesTest, ColoursAreThoseOfTheState) {
  const Surfaces surfaces(scene_);
  std::array<Vec3, LABELS> sums;
  std::array<int, LABELS> counts{};
  sums.fill(Vec3::Zero());
  visit(40000, [&](const Ray& ray, const Hit& hit) {
    const auto label = static_cast<std::size_t>(hit.label);
    sums[label] += surfaces.at(ray, hit).albedo;
    ++counts[label];
  });
  const auto mean = [&](Label label) {
    const auto i = static_cast<std::size_t>(label);
    EXPECT_GT(counts[i], 0) << i;
    return Vec3(sums[i] / counts[i]);
  };
  for (const Label green : {Label::LEAF, Label::GRASS, Label::FOLIAGE}) {
    const Vec3 colour = mean(green);
    EXPECT_GT(colour.y(), 1.1 * colour.x()) << static_cast<int>(green);
    EXPECT_GT(colour.y(), 2.0 * colour.z()) << static_cast<int>(green);
  }
  const Vec3 bark = mean(Label::BRANCH);
  EXPECT_GT(bark.x(), bark.z());
  const Hit chest{1.0, Label::PERSON, 7, static_cast<int>(crowd::Part::CHEST), 1.0};
  const Rod& rod = scene_.people.rods()[static_cast<std::size_t>(crowd::Part::CHEST)];
  const Ray ray(rod.base + 0.5 * rod.length * rod.axis - Vec3(1.0 + rod.base_radius, 0, 0),
                Vec3::UnitX());
  const Vec3 shirt = linearOf(crowd::clothesOf(7).shirt), own = surfaces.at(ray, chest).albedo;
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(own[k], shirt[k], 0.16 * shirt[k]);
}

// A texture belongs to the bark: it moves with a branch.
TEST_F(SurfacesTest, TexturesMoveWithTheirBranch) {
  const auto forest = movingForest(forest::gridLayout(1, 9.0), breezeOf(Vec3(9, 0, 0)));
  Vec3 before, after;
  for (Vec3* colour : {&before, &after}) {
    Scene scene;
    scene.trees.update(forest, Vec3(0, 0, 1), 60.0,
                       START + (colour == &after ? fromSeconds(3.0) : 0));
    const PosedTree& tree = *scene.trees.all().front();
    const std::size_t branch = tree.parts() / 2;
    const Rod& rod = tree.branches()[branch].rod;
    const Vec3 side = axisX(tree.branches()[branch].turn);
    const Vec3 place = rod.base + 0.5 * rod.length * rod.axis + 0.01 * side;
    const Hit hit{1.0, Label::BRANCH, tree.id(), static_cast<int>(branch), 1.0};
    *colour = Surfaces(scene).at(Ray(place + side, -side), hit).albedo;
  }
  EXPECT_NEAR((before - after).norm(), 0.0, 1e-6);
}

}  // namespace
}  // namespace vegetation_sim::scan
