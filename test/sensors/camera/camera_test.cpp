// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/camera/camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "scenes/sensors/grove_scene.h"
#include "scenes/sensors/lidar_scene.h"
#include "sensors/camera/pixels.h"

namespace vegetation_sim::scan {
namespace {

constexpr double ENDLESS_DEPTH = std::numeric_limits<double>::infinity();

ThreadPool alone;

// A camera at a place that looks along x, or down by an angle.
Pose lookingAlongX(const Vec3& place, double down = 0.0) {
  Pose out;
  out.position = place;
  const SinCos half = sinCos(0.5 * down);
  // The optical frame of a camera that looks along x is turned by this quaternion (REP 103).
  out.orientation = Quat{half.cos, 0.0, half.sin, 0.0} * Quat{0.5, -0.5, 0.5, -0.5};
  return out;
}

Camera smallCamera(int width = 64, int height = 48) {
  LensSettings settings;
  settings.width = width;
  settings.height = height;
  settings.distortion = {-0.1, 0.02, 0.001, -0.001, 0.0};
  Camera out;
  out.lens = lensOf(settings);
  out.range_max = 60.0;
  return out;
}

Ray rayOf(const Camera& camera, const Pose& pose, int column, int row) {
  return {pose.position,
          rotate(pose.orientation, directionOf(camera.lens, {double(column), double(row)}))};
}

// Trees, a lawn, leafy plants and a person.
struct Place {
  Place() : lawn(0.15, 100.0) {
    const auto forest = movingForest(forest::gridLayout(2, 9.0), breezeOf(Vec3(4, 0, 0)));
    scene.trees.update(forest, Vec3(10, 10, 1), 60.0, START);
    lawn.show(scene.grass);
    Grove(groveLayout(Vec3(12.0, 12.0, 0.0))).show(scene.plants, alone);
    crowd::Walker walker;
    walker.position = {8.0, 5.0};
    scene.people.set({{7, crowd::skeletonOf(walker, terrain::HeightMap())}});
  }
  Lawn lawn;
  Scene scene;
  Pose pose = lookingAlongX(Vec3(1.0, 6.0, 1.6));
};

template <class Value>
std::uint64_t hashOf(const std::vector<Value>& values) {
  Hash out;
  for (const Value& value : values) out.add(static_cast<double>(value));
  return out.value();
}

std::uint64_t hashOf(const std::vector<Rgb8>& values) {
  Hash out;
  for (const Rgb8& value : values)
    out.add(static_cast<double>(value.red + 256 * (value.green + 256 * value.blue)));
  return out.value();
}

// Labels, instances and depths are those of the rays through the middles of the pixels.
TEST(Camera, ImagesHoldWhatRaysIntoTheSceneMeet) {
  const Place place;
  const Camera camera = smallCamera();
  const Images images = takeImages(place.scene, camera, place.pose, {}, Wanted(), alone);
  std::array<int, LABELS> counts{};
  const Vec3 axis = rotate(place.pose.orientation, Vec3(0.0, 0.0, 1.0));
  EXPECT_NEAR(axis.x(), 1.0, 1e-12);
  for (int row = 0; row < camera.lens.height; ++row)
    for (int column = 0; column < camera.lens.width; ++column) {
      const auto i = static_cast<std::size_t>(row * camera.lens.width + column);
      const Ray ray = rayOf(camera, place.pose, column, row);
      const Hit hit = cast(place.scene, ray, camera.range_max, GrassGrain::BLADES);
      ++counts[static_cast<std::size_t>(hit.label)];
      ASSERT_EQ(images.label[i], static_cast<std::uint16_t>(hit.label));
      const bool object =
          hit.label != Label::NONE && hit.label != Label::GROUND && hit.label != Label::GRASS;
      ASSERT_EQ(images.instance[i], object ? static_cast<int>(hit.plant) : -1);
      if (hit.label == Label::NONE)
        ASSERT_EQ(images.depth[i], ENDLESS_DEPTH);
      else
        ASSERT_NEAR(images.depth[i], dot(ray.at(hit.distance) - place.pose.position, axis),
                    1e-6 * hit.distance);
    }
  for (const Label label : {Label::NONE, Label::GROUND, Label::TRUNK, Label::BRANCH, Label::LEAF,
                            Label::GRASS, Label::PERSON, Label::FOLIAGE, Label::STEM})
    EXPECT_GT(counts[static_cast<std::size_t>(label)], 0) << static_cast<int>(label);
}

// N1: depths and labels against a lidar's rays, whose directions are those of a pinhole. They
// differ where the lidar meets cubes of grass and the camera blades, and by the rounding of depths.
TEST(Camera, AgreesWithALidarOnGroundAndWood) {
  const Place place;
  LensSettings settings;
  settings.width = 160;
  settings.height = 120;
  Camera camera;
  camera.lens = lensOf(settings);
  camera.range_max = 60.0;
  const Images images = takeImages(place.scene, camera, place.pose, {}, Wanted(), alone);
  std::vector<double> errors;
  int equal = 0, objects = 0, grass[2] = {0, 0};
  for (int row = 0; row < settings.height; ++row)
    for (int column = 0; column < settings.width; ++column) {
      const auto i = static_cast<std::size_t>(row * settings.width + column);
      const double x = (column - camera.lens.cx) / camera.lens.fx;
      const double y = (row - camera.lens.cy) / camera.lens.fy;
      const Vec3 direction = rotate(place.pose.orientation, Vec3(x, y, 1.0));
      const Hit hit = cast(place.scene, Ray(place.pose.position, direction / length(direction)),
                           camera.range_max);
      const auto label = static_cast<Label>(images.label[i]);
      grass[0] += hit.label == Label::GRASS;
      grass[1] += label == Label::GRASS;
      if (hit.label == Label::GRASS || label == Label::GRASS) continue;
      ++objects;
      equal += label == hit.label;
      const bool solid =
          hit.label == Label::GROUND || hit.label == Label::TRUNK || hit.label == Label::BRANCH;
      if (solid && label == hit.label)
        errors.push_back(std::fabs(double{images.depth[i]} - hit.distance / length(direction)));
    }
  std::sort(errors.begin(), errors.end());
  const double median = errors[errors.size() / 2], most = errors[errors.size() * 99 / 100];
  std::printf("%zu pixels of ground and wood: median %.1e m, 99 %% %.1e m; %.2f %% of %d labels\n",
              errors.size(), median, most, 100.0 * equal / objects, objects);
  EXPECT_GT(errors.size(), 1000u);
  EXPECT_LE(median, 1e-5);
  EXPECT_LE(most, 1e-3);  // meetGround() is within 1 mm
  EXPECT_GE(equal, 0.999 * objects);
  EXPECT_GT(grass[0], 500);
  EXPECT_NEAR(grass[1], grass[0], 0.1 * grass[0]);
}

TEST(Camera, ImagesAreTheSameForAnyNumberOfThreads) {
  const Place place;
  Camera camera = smallCamera();
  camera.samples = 2;
  camera.exposure.read_noise = camera.exposure.shot_noise = 0.02;
  const Images one = takeImages(place.scene, camera, place.pose, {3, 9, 2}, Wanted(), alone);
  for (const int count : {2, 3, 8}) {
    ThreadPool threads(count);
    const Images other = takeImages(place.scene, camera, place.pose, {3, 9, 2}, Wanted(), threads);
    EXPECT_EQ(hashOf(one.colour), hashOf(other.colour)) << count;
    EXPECT_EQ(hashOf(one.depth), hashOf(other.depth)) << count;
    EXPECT_EQ(hashOf(one.label), hashOf(other.label)) << count;
    EXPECT_EQ(hashOf(one.instance), hashOf(other.instance)) << count;
  }
  const Images later = takeImages(place.scene, camera, place.pose, {3, 10, 2}, Wanted(), alone);
  EXPECT_NE(hashOf(one.colour), hashOf(later.colour));  // The noise is another one.
  EXPECT_EQ(hashOf(one.depth), hashOf(later.depth));
}

TEST(Camera, ImagesThatAreNotWantedAreEmptyAndChangeNoOther) {
  const Place place;
  const Camera camera = smallCamera(24, 18);
  const Images all = takeImages(place.scene, camera, place.pose, {}, Wanted(), alone);
  const Images depth =
      takeImages(place.scene, camera, place.pose, {}, {false, true, false, false}, alone);
  EXPECT_TRUE(depth.colour.empty() && depth.label.empty() && depth.instance.empty());
  EXPECT_EQ(depth.depth, all.depth);
}

// A camera 1.6 m above a plane looks down by 0.5 rad: a pixel's ray of elevation e meets the ground
// at 1.6 / sin(-e).
TEST(Camera, DepthOfAPlaneIsThatOfTheGeometry) {
  const Scene scene;
  const Camera camera = smallCamera();
  const Pose pose = lookingAlongX(Vec3(3.0, -2.0, 1.6), 0.5);
  const Images images = takeImages(scene, camera, pose, {}, {false, true, true, false}, alone);
  double worst = 0.0;
  int met = 0;
  for (int row = 0; row < camera.lens.height; ++row)
    for (int column = 0; column < camera.lens.width; ++column) {
      const Vec3 own = directionOf(camera.lens, {double(column), double(row)});
      const Vec3 world = rotate(pose.orientation, own);
      const auto i = static_cast<std::size_t>(row * camera.lens.width + column);
      if (!(world.z() < -1.6 / 59.0)) continue;
      ++met;
      EXPECT_EQ(images.label[i], static_cast<std::uint16_t>(Label::GROUND));
      // terrain::meetGround() is within 1 mm of height.
      worst = std::max(worst, std::fabs(double{images.depth[i]} * world.z() / own.z() + 1.6));
    }
  EXPECT_GT(met, 2000);
  EXPECT_LT(worst, 1e-3);
}

// A limb is an upright cylinder of radius 0.25 m, 5 m ahead: at the height of the camera, a ray at
// the angle a meets it where 5 sin(a) < 0.25.
TEST(Camera, DepthOfAnUprightCylinderIsThatOfTheGeometry) {
  Scene scene;
  crowd::Skeleton post{};
  for (crowd::Limb& limb : post) limb = {Vec3(5.0, 0.0, -1.0), Vec3(5.0, 0.0, 6.0), 0.25};
  scene.people.set({{42, post}});
  LensSettings settings;
  settings.width = 401;
  settings.height = 1;
  settings.field_of_view = 0.3;
  Camera camera;
  camera.lens = lensOf(settings);
  const Pose pose = lookingAlongX(Vec3(0.0, 0.0, 2.0));
  const Images images = takeImages(scene, camera, pose, {}, Wanted(), alone);
  int met = 0;
  for (int column = 0; column < 401; ++column) {
    const Vec3 own = directionOf(camera.lens, {double(column), 0.0});
    const double missing = 5.0 * std::fabs(own.x());
    const auto i = static_cast<std::size_t>(column);
    if (std::fabs(missing - 0.25) < 1e-3) continue;
    EXPECT_EQ(images.instance[i], missing < 0.25 ? 42 : -1) << column;
    if (!(missing < 0.25)) continue;
    ++met;
    const double distance = 5.0 * own.z() - std::sqrt(0.25 * 0.25 - missing * missing);
    EXPECT_NEAR(images.depth[i], distance * own.z(), 1e-6);
  }
  EXPECT_NEAR(met, 2.0 * camera.lens.fx * 0.25 / std::sqrt(25.0 - 0.0625), 2.0);
}

// REP 117
TEST(Camera, DepthOutsideOfTheRangeIsInfinite) {
  const Scene scene;
  Camera camera = smallCamera(5, 5);
  camera.range_min = 2.0;
  camera.range_max = 20.0;
  const auto middle = [&](double height) {
    const Pose down = lookingAlongX(Vec3(0.0, 0.0, height), 0.5 * PI);
    return double{takeImages(scene, camera, down, {}, Wanted(), alone).depth[12]};
  };
  EXPECT_EQ(middle(1.9), -ENDLESS_DEPTH);
  EXPECT_NEAR(middle(10.0), 10.0, 1e-3);
  EXPECT_EQ(middle(21.0), ENDLESS_DEPTH);
}

// Samples only smooth the picture: of a sharp edge, half a pixel is covered.
TEST(Camera, SamplesSmoothEdgesOfThePictureAlone) {
  const Place place;
  Camera camera = smallCamera();
  const Images coarse = takeImages(place.scene, camera, place.pose, {}, Wanted(), alone);
  camera.samples = 8;
  const Images fine = takeImages(place.scene, camera, place.pose, {}, Wanted(), alone);
  EXPECT_EQ(coarse.depth, fine.depth);
  EXPECT_EQ(coarse.label, fine.label);
  const auto roughness = [&](const std::vector<Rgb8>& picture) {
    double sum = 0.0;
    for (std::size_t i = 1; i < picture.size(); ++i)
      sum += std::pow(double(picture[i].green) - double(picture[i - 1].green), 2);
    return sum;
  };
  EXPECT_LT(roughness(fine.colour), 0.7 * roughness(coarse.colour));
}

// A person between the sun and the ground: its shadow is darker than the open ground.
TEST(Camera, ThePersonsShadowIsDark) {
  Scene scene;
  crowd::Skeleton slab{};
  for (crowd::Limb& limb : slab) limb = {Vec3(-3.0, 0.0, 3.0), Vec3(3.0, 0.0, 3.0), 1.0};
  scene.people.set({{1, slab}});
  Camera camera = smallCamera(9, 9);
  camera.light.sun_elevation = 1.5707;
  const Pose down = lookingAlongX(Vec3(0.0, 0.0, 1.5), 0.5 * PI);
  const auto brightness = [&](Shadows shadows) {
    camera.shadows = shadows;
    double sum = 0.0;
    for (const Rgb8& pixel : takeImages(scene, camera, down, {}, Wanted(), alone).colour)
      sum += pixel.green;
    return sum;
  };
  EXPECT_LT(brightness(Shadows::SUN), 0.7 * brightness(Shadows::NONE));
}

// A picture is taken within one tick, so its rays are limited.
TEST(Camera, RaysOfAPictureAreLimited) {
  const auto faultsOf = [](int samples) {
    Camera camera;
    camera.lens.width = camera.lens.height = 1024;
    camera.samples = samples;
    Faults faults;
    check(camera, "camera/", faults);
    return faults.list();
  };
  EXPECT_TRUE(faultsOf(16).empty());
  EXPECT_EQ(faultsOf(17),
            std::vector<std::string>{"camera/samples = 17 makes 17825792 rays an image, allowed "
                                     "are 16777216"});
}

}  // namespace
}  // namespace vegetation_sim::scan
