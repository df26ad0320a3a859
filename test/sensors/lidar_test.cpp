// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/lidar.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "package_folder.h"
#include "vegetation_sim/core/config/yaml.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::scan {
namespace {

const std::string FOLDER = std::string(PACKAGE_FOLDER) + "/config/sensors";

Lidar load(const std::string& name) {
  Lidar out;
  Faults faults;
  YamlSection section(loadYamlFile(FOLDER + "/" + name + ".yaml"), name, faults);
  describe(section, out);
  section.finish();
  check(out, "", faults);
  EXPECT_EQ(faults.text(), "");
  return out;
}

double degrees(double angle) {
  return angle * 180.0 / PI;
}

TEST(Lidar, AllPresetsAreValid) {
  int count = 0;
  for (const auto& file : std::filesystem::directory_iterator(FOLDER)) {
    load(file.path().stem().string());
    ++count;
  }
  EXPECT_GE(count, 4);
}

TEST(Lidar, PresetsHaveTheAnglesAndRatesOfTheirDataSheets) {
  const Lidar small = load("vlp16");
  for (int ring = 0; ring < 16; ++ring)
    EXPECT_NEAR(degrees(std::asin(directionOf(small.beams, ring, 0).z())), 2.0 * ring - 15.0, 1e-3);
  EXPECT_EQ(small.beams.rings * small.beams.columns * small.rate, 288000);
  const Lidar large = load("os1_128");
  EXPECT_EQ(large.beams.rings * large.beams.columns * large.rate, 2621440);
  EXPECT_NEAR(degrees(large.beams.elevation_high - large.beams.elevation_low), 45.0, 1e-3);
  EXPECT_NEAR(degrees(load("os1_64").beams.elevation_high), 16.6, 1e-3);
  const Lidar plane = load("utm30lx");
  const auto azimuth = [&](int column) {
    const Vec3 ray = directionOf(plane.beams, 0, column);
    return degrees(arcTangent(ray.y(), ray.x()));
  };
  EXPECT_NEAR(azimuth(0), -135.0, 1e-3);
  EXPECT_NEAR(azimuth(1) - azimuth(0), 0.25, 1e-4);
  EXPECT_NEAR(azimuth(1080), 135.0, 1e-3);
}

TEST(Lidar, PresetsHaveTheRangesAndNoiseOfTheirDataSheets) {
  // A target of 80 % at 0.8 m and 120 m is detected, one of 10 % at 40 m in half of all cases.
  for (const char* name : {"os1_64", "os1_128"}) {
    const Lidar os1 = load(name);
    EXPECT_EQ(os1.beams.range_min, 0.8);
    EXPECT_EQ(os1.beams.range_max, 120.0);
    EXPECT_NEAR(detectionProbability(os1.model.detection, 0.1, 1.0, 40.0), 0.5, 1e-12);
    EXPECT_EQ(os1.model.returns, ReturnMode::STRONGEST);
    // The light of a signal-to-noise ratio over that of 12.
    const auto deviationAt = [&](double ratio) {
      return deviationOf(os1.model, 0.1 * ratio / 12.0, 1.0, 40.0);
    };
    EXPECT_NEAR(deviationAt(12.0), 0.10, 1e-12);
    EXPECT_NEAR(deviationAt(100.0), 0.03, 0.005);
    EXPECT_NEAR(deviationAt(600.0), 0.015, 1e-12);
  }
  EXPECT_NEAR(degrees(load("os1_128").model.shape.divergence), 0.18, 1e-3);
  EXPECT_NEAR(degrees(load("os1_64").model.shape.divergence), 0.13, 1e-3);
  const Lidar vlp16 = load("vlp16");
  EXPECT_EQ(vlp16.beams.range_max, 100.0);
  EXPECT_EQ(vlp16.model.shape.divergence, 0.003);
  EXPECT_EQ(vlp16.model.shape.separation, 1.0);
  EXPECT_GT(vlp16.model.shape.samples, 1);  // otherwise both of the above would have no effect
  EXPECT_EQ(deviationOf(vlp16.model, 0.1, 1.0, 50.0), 0.03);
  const Lidar plane = load("utm30lx");
  EXPECT_EQ(plane.beams.range_max, 30.0);
  EXPECT_LE(deviationOf(plane.model, 0.1, 1.0, 10.0), 0.010 + 1e-12);
  EXPECT_LE(deviationOf(plane.model, 0.1, 1.0, 30.0), 0.030);
}

TEST(Lidar, WeakNoiseNeedsADetectionRange) {
  Lidar lidar;
  lidar.model.noise_weak = 0.1;
  Faults faults;
  check(lidar, "~", faults);
  EXPECT_EQ(faults.text(), "~noise_weak = 0.100000 m needs a detection_range above 0 m");
}

TEST(Lidar, RaysStandWhereTheyAreAskedFor) {
  Beams beams;
  beams.rings = 3;
  beams.columns = 4;
  beams.elevation_low = -0.2;
  beams.elevation_high = 0.2;
  beams.azimuth_low = -PI;
  beams.azimuth_high = PI;
  EXPECT_NEAR((directionOf(beams, 1, 2) - Vec3(1, 0, 0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((directionOf(beams, 1, 3) - Vec3(0, 1, 0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(directionOf(beams, 0, 0).z(), -std::sin(0.2), 1e-12);
  const BeamDirections directions(beams);
  for (int ring = 0; ring < beams.rings; ++ring)
    for (int column = 0; column < beams.columns; ++column)
      EXPECT_EQ(directions.at(ring, column), directionOf(beams, ring, column));
  EXPECT_NEAR(directionOf(planeOf({beams, {}}).beams, 0, 1).z(), 0.0, 1e-15);
}

TEST(Lidar, ColumnsAreMeasuredOneAfterTheOther) {
  Beams beams;
  beams.columns = 4;
  beams.azimuth_low = -PI;
  beams.azimuth_high = PI;
  EXPECT_NEAR(timeOf(beams, 3, 0.1), 0.075, 1e-12);
  beams.azimuth_low = 0.0;  // half of a turn
  EXPECT_NEAR(timeOf(beams, 3, 0.1), 0.0375, 1e-12);
  EXPECT_EQ(timeOf(beams, 3, 0.0), 0.0);
}

TEST(Lidar, APlanarScanHasOneReturnForEachRay) {
  Lidar lidar;
  lidar.model.returns = ReturnMode::BOTH;
  EXPECT_EQ(planeOf(lidar).model.returns, ReturnMode::STRONGEST);
  lidar.model.returns = ReturnMode::LAST;
  EXPECT_EQ(planeOf(lidar).model.returns, ReturnMode::LAST);
}

TEST(Lidar, InvalidBeamsAreRejected) {
  Lidar lidar;
  lidar.beams.elevation_low = 0.3;
  lidar.beams.azimuth_high = lidar.beams.azimuth_low;
  lidar.beams.range_min = 80.0;
  lidar.model.shape.samples = 5;
  Faults faults;
  check(lidar, "", faults);
  const std::string text = faults.text();
  for (const char* name : {"elevation_high", "azimuth_high", "range_max", "samples"})
    EXPECT_NE(text.find(std::string(name) + " = "), std::string::npos) << text;
  Beams beams;
  beams.azimuth_low = -6.0;
  beams.azimuth_high = 6.0;
  Faults turn;
  check(beams, "", turn);
  EXPECT_NE(turn.text().find("more than a turn"), std::string::npos);
}

}  // namespace
}  // namespace vegetation_sim::scan
