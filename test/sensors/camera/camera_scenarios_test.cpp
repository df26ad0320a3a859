// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Depths and labels of a camera in shipped scenarios against rays that are cast without any search
// structure.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "crowd/agents/crowd.h"
#include "reference/sensors/camera_plain.h"
#include "scenes/sensors/lidar_scene.h"
#include "scenes/shipped_scene.h"
#include "sensors/camera/pixels.h"

namespace vegetation_sim::scan {
namespace {

constexpr double SEEN_RANGE = 60.0, AFTER = 4.0;  // [m], [s]

// A shipped scenario some seconds after its start, with all joints in motion.
struct SeenScenario {
  SeenScenario(const std::string& name, double x, double y, double height, double yaw, double down)
      : shipped(scenes::loadShippedScene(name)) {
    scene.ground = shipped.terrain;
    pose.position = Vec3(x, y, height + shipped.terrain->height(x, y));
    const SinCos turn = sinCos(0.5 * yaw), tilt = sinCos(0.5 * down);
    pose.orientation = Quat{turn.cos, 0.0, 0.0, turn.sin} * Quat{tilt.cos, 0.0, tilt.sin, 0.0} *
                       Quat{0.5, -0.5, 0.5, -0.5};
    if (shipped.forest) addTrees();
    if (shipped.grass) {
      tread = std::make_unique<grass::TreadMap>(shipped.grass->layout.map->law(),
                                                grass::TreadSettings());
      scene.grass.update(shipped.grass->layout, *tread, shipped.terrain, shipped.wind,
                         pose.position, SEEN_RANGE, now);
    }
    if (shipped.crowd) addPeople();
  }
  void addTrees() {
    forest.setLayout(*shipped.forest, shipped.terrain);
    forest.setWind(shipped.wind);
    forest::StateUpdate update;
    update.stamp = now;
    update.key_frame = true;
    update.layout_hash = forest.layoutHash();
    update.base = forest::LevelState::settled(forest::MAX_DEPTHS);
    ASSERT_TRUE(forest.apply(update)) << forest.why();
    scene.trees.update(forest, pose.position, SEEN_RANGE, now);
  }
  void addPeople() {
    crowd::Crowd crowd(shipped.seed, shipped.crowd->settings, shipped.crowd->area, shipped.terrain);
    crowd.setObstacles(crowd::obstaclesOf(shipped.crowd->walls));
    for (const crowd::Spawn& spawn : shipped.crowd->spawns) crowd.spawn(spawn);
    for (int i = 1; i <= 60; ++i) crowd.advance(START + fromSeconds(AFTER * i / 60.0));
    std::vector<People::Person> people;
    for (const crowd::Walker& walker : crowd.walkers())
      people.push_back({walker.id, crowd::skeletonOf(walker, crowd.terrain())});
    scene.people.set(people);
  }
  scenes::ShippedScene shipped;
  Nanoseconds now{START + fromSeconds(AFTER)};
  forest::ForestReplica forest;
  std::unique_ptr<grass::TreadMap> tread;
  Scene scene;
  Pose pose;
};

// Counts of pixels, all and those whose neighbours show the same object.
struct PixelCounts {
  int all{0}, equal{0};
  void add(bool same) {
    ++all;
    equal += same;
  }
  double share() const { return static_cast<double>(equal) / all; }
};

struct Comparison {
  PixelCounts pixels, inner, inner_grass;
  std::vector<double> errors;  ///< of depths of ground, wood and people with equal labels [m]
  std::vector<double> grass;   ///< of depths of grass with equal labels [m]
  std::array<int, LABELS> labels{};
};

bool isInner(const Images& images, const Lens& lens, int column, int row) {
  const auto at = [&](int c, int r) { return static_cast<std::size_t>(r * lens.width + c); };
  const std::size_t here = at(column, row);
  for (const std::size_t near :
       {at(column - 1, row), at(column + 1, row), at(column, row - 1), at(column, row + 1)})
    if (images.label[near] != images.label[here] || images.instance[near] != images.instance[here])
      return false;
  return true;
}

/// @param stride of the pixels that are compared, along each side.
Comparison compare(const SeenScenario& seen, int stride) {
  LensSettings settings;
  settings.width = 480;
  settings.height = 360;
  settings.distortion = {-0.1, 0.02, 0.001, -0.001, 0.0};
  Camera camera;
  camera.lens = lensOf(settings);
  camera.range_max = SEEN_RANGE;
  ThreadPool alone;
  const Images images =
      takeImages(seen.scene, camera, seen.pose, {}, {false, true, true, true}, alone);
  Comparison out;
  for (int row = stride / 2; row < settings.height - 1; row += stride)
    for (int column = stride / 2; column < settings.width - 1; column += stride) {
      const auto i = static_cast<std::size_t>(row * settings.width + column);
      const Vec3 own = directionOf(camera.lens, {double(column), double(row)});
      const Ray ray(seen.pose.position, rotate(seen.pose.orientation, own));
      const Hit hit = castCameraPlain(seen.scene, ray, SEEN_RANGE);
      const auto label = static_cast<Label>(images.label[i]);
      const bool object =
          hit.label != Label::NONE && hit.label != Label::GROUND && hit.label != Label::GRASS;
      const bool same =
          label == hit.label && images.instance[i] == (object ? static_cast<int>(hit.plant) : -1);
      ++out.labels[static_cast<std::size_t>(hit.label)];
      out.pixels.add(same);
      const bool grass = hit.label == Label::GRASS || label == Label::GRASS;
      if (isInner(images, camera.lens, column, row))
        (grass ? out.inner_grass : out.inner).add(same);
      if (same && hit.label != Label::NONE)
        (grass ? out.grass : out.errors)
            .push_back(std::fabs(double{images.depth[i]} - hit.distance * own.z()));
    }
  return out;
}

double quantile(std::vector<double>& values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

void report(const char* name, Comparison& found) {
  std::printf(
      "%s: %.1f %% of %d pixels with the same label and instance; outside edges %.1f %% of "
      "%d without grass",
      name, 100.0 * found.pixels.share(), found.pixels.all, 100.0 * found.inner.share(),
      found.inner.all);
  if (found.inner_grass.all > 0)
    std::printf(", %.1f %% of %d with grass", 100.0 * found.inner_grass.share(),
                found.inner_grass.all);
  if (!found.errors.empty())
    std::printf("; depths: median %.1e m, 99 %% %.1e m", quantile(found.errors, 0.5),
                quantile(found.errors, 0.99));
  if (!found.grass.empty())
    std::printf("; of grass: median %.1e m, 99 %% %.1e m", quantile(found.grass, 0.5),
                quantile(found.grass, 0.99));
  std::printf("\n");
}

int countOf(const Comparison& found, Label label) {
  return found.labels[static_cast<std::size_t>(label)];
}

TEST(CameraScenarios, ForestIsWhatRaysPastNoBoxFind) {
  Comparison found = compare(SeenScenario("forest", 0.0, -25.0, 2.0, 0.5 * PI, 0.0), 20);
  report("forest", found);
  for (const Label label : {Label::GROUND, Label::BRANCH, Label::LEAF})
    EXPECT_GT(countOf(found, label), 5) << static_cast<int>(label);
  EXPECT_GE(found.pixels.share(), 0.995);
  EXPECT_GE(found.inner.share(), 0.998);
  EXPECT_LE(quantile(found.errors, 0.99), 2e-3);
}

TEST(CameraScenarios, MeadowRobotIsWhatRaysThroughEveryBladeFind) {
  Comparison found = compare(SeenScenario("meadow_robot", 0.0, 0.0, 1.6, 0.3, 0.25), 15);
  report("meadow_robot", found);
  EXPECT_GT(countOf(found, Label::GRASS), 300);
  EXPECT_GE(found.pixels.share(), 0.95);
  EXPECT_LE(quantile(found.grass, 0.9), 0.02);
}

TEST(CameraScenarios, CrowdIsWhatRaysPastNoBoxFind) {
  Comparison found = compare(SeenScenario("crowd", -14.0, -10.0, 1.6, 0.6, 0.05), 15);
  report("crowd", found);
  for (const Label label : {Label::PERSON, Label::GRASS, Label::LEAF})
    EXPECT_GT(countOf(found, label), 10) << static_cast<int>(label);
  EXPECT_GE(found.pixels.share(), 0.95);
  EXPECT_GE(found.inner.share(), 0.995);
  EXPECT_LE(quantile(found.errors, 0.99), 2e-3);
}

}  // namespace
}  // namespace vegetation_sim::scan
