// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/model/hit_merging.h"

#include <gtest/gtest.h>

namespace vegetation_sim::scan {
namespace {

Hit hitAt(double distance, double cosine = 1.0, Label label = Label::TRUNK, int branch = 0) {
  return {distance, label, 1, branch, cosine};
}

TEST(HitMerging, OneHitIsItsEcho) {
  std::vector<Hit> hits{hitAt(7.25, 0.3, Label::LEAF, 4)};
  std::vector<Echo> echoes;
  joinHits(hits, 0.5, echoes);
  ASSERT_EQ(echoes.size(), 1u);
  EXPECT_EQ(echoes[0].distance, 7.25);
  EXPECT_EQ(echoes[0].signal, 0.5 * 0.3);
  EXPECT_EQ(echoes[0].hit.branch, 4);
}

TEST(HitMerging, HitsWithinTheSeparationAreJoinedAndOthersStayApart) {
  std::vector<Hit> hits{hitAt(9.0, 0.5, Label::TRUNK, 3), hitAt(4.0), Hit(),
                        hitAt(4.4, 0.5, Label::TRUNK, 2), hitAt(9.6)};
  std::vector<Echo> echoes;
  joinHits(hits, 0.5, echoes);
  ASSERT_EQ(echoes.size(), 3u);
  EXPECT_NEAR(echoes[0].distance, (1.0 * 4.0 + 0.5 * 4.4) / 1.5, 1e-12);
  EXPECT_NEAR(echoes[0].signal, 0.35 * 1.5 / 5.0, 1e-12);
  EXPECT_EQ(echoes[0].hit.branch, 0);
  EXPECT_EQ(echoes[1].distance, 9.0);
  EXPECT_EQ(echoes[2].distance, 9.6);
  hits = {hitAt(9.0), hitAt(9.6), hitAt(8.5)};
  joinHits(hits, 0.6, echoes);
  EXPECT_EQ(echoes.size(), 1u);
}

TEST(HitMerging, RaysThatHitNothingGiveNone) {
  std::vector<Hit> hits(7);
  std::vector<Echo> echoes(2);
  joinHits(hits, 0.5, echoes);
  EXPECT_TRUE(echoes.empty());
}

}  // namespace
}  // namespace vegetation_sim::scan
