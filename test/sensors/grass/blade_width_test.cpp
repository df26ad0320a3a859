// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/grass/blade_width.h"

#include <gtest/gtest.h>

namespace vegetation_sim::scan {
namespace {

/// Mean width at `way` along blades that are cut, by counting.
double countedWidth(double way, double least, double most, double cut) {
  constexpr int COUNT = 20000;
  double sum = 0.0;
  for (int i = 0; i < COUNT; ++i) {
    const double length = std::min(cut, least + (most - least) * (i + 0.5) / COUNT);
    if (way < length) sum += 1.0 - way * way / (length * length);
  }
  return sum / COUNT;
}

// N1
TEST(BladeWidth, IsTheMeanOfBladesOfAllLengthsCutOrNot) {
  for (const double least : {0.1, 0.2, 0.3})
    for (const double cut : {0.05, 0.15, 0.25, 0.29, 1.0})
      for (const double way : {0.0, 0.04, 0.12, 0.2, 0.27, 0.31})
        EXPECT_NEAR(widthAfterCut(way, least, 0.3, cut), countedWidth(way, least, 0.3, cut), 1e-4)
            << "from " << least << " m, cut at " << cut << " m, at " << way << " m";
}

}  // namespace
}  // namespace vegetation_sim::scan
