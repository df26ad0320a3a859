// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/lod/response_error.h"

#include <gtest/gtest.h>

#include "scenes/forest/modal_scene.h"
#include "vegetation_sim/tree/growth/response.h"

namespace vegetation_sim::forest {
namespace {

Tree stranger(const Species& species, const MotionLaw& law, std::uint64_t seed, double scale) {
  TreeSeed out;
  out.seed = seed;
  out.scale = scale;
  return growTree(out, species, law);
}

/// A tree and a wind that were not used for measurements.
struct Strange {
  std::uint64_t seed;
  double scale;
  Vec3 wind;
};

bool withinTwo(double predicted, double measured) {
  return predicted > 0.5 * measured && predicted < 2.0 * measured;
}

// N7: the predicted error of a tree in a breeze is that against the full chain within a factor of
// two for nine trees in ten, procedural and modal. Measurements used seeds 1 and 2 at the grid's
// sizes; these are others, of other sizes, in other winds.
TEST(ResponseError, OfStrangersIsPredictedWithinAFactorOfTwo) {
  constexpr double WARM_UP = 3.0, DURATION = 7.0;  // until initial transients have decayed
  const Strange strangers[] = {{101, 0.85, Vec3(1.8, -2.4, 0.0)},
                               {202, 1.0, Vec3(-7.0, 0.5, 0.0)},
                               {303, 1.15, Vec3(2.0, 3.0, 0.0)}};
  const MotionLaw law = gridLayout(2, 12.0).motion;
  int all = 0, procedural = 0, modal = 0, fine = 0;
  for (const std::string& name : speciesNames()) {
    const Species species = shippedSpecies(name);
    LevelScales scales;
    for (const Strange& each : strangers) {
      const wind::Field field({makeBreeze(1, each.wind)}, each.seed);
      const Swaying scene(stranger(species, law, each.seed, each.scale), species, field, DURATION,
                          4);
      const wind::GustSpectrum spectrum =
          wind::GustSpectrumField(field, MODAL_START).at(Vec3::Zero(), 0.0);
      const PredictedError lag = scales.responseErrorAt(species, law, each.scale, spectrum);
      const double off = scene.procedural(WARM_UP).farthest, left = scene.modal(WARM_UP).farthest,
                   least = scene.modal(WARM_UP, FINE_MODES).farthest;
      std::printf(
          "%-6s %.2f: %.1f mm, predicted %.1f; in modes %.1f, predicted %.1f; in fine "
          "ones %.1f, predicted %.1f\n",
          name.c_str(), each.scale, 1e3 * off, 1e3 * lag.procedural, 1e3 * left, 1e3 * lag.modal,
          1e3 * least, 1e3 * lag.fine);
      ++all;
      procedural += withinTwo(lag.procedural, off);
      modal += withinTwo(lag.modal, left);
      fine += withinTwo(lag.fine, least);
      EXPECT_LT(lag.fine, lag.modal);
    }
  }
  EXPECT_GE(procedural, 0.9 * all);
  EXPECT_GE(modal, 0.9 * all);
  EXPECT_GE(fine, 0.9 * all);
}

}  // namespace
}  // namespace vegetation_sim::forest
