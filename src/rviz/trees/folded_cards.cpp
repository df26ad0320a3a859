// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/trees/folded_cards.h"

#include <algorithm>
#include <cmath>

namespace vegetation_sim::view {
namespace {

constexpr float FOLD = 0.2f;  // offset of a corner relative to the edge of the square

// The diagonal of LEAF_TRIANGLES from corner 0 to corner 2 goes to one side, the other corners to
// the other side. The middle of the foot stays on its branch.
void foldCard(float offset, float* at) {
  const float* const b = at + 3;
  const float* const c = at + 6;
  const float* const d = at + 9;
  const float ac[3]{c[0] - at[0], c[1] - at[1], c[2] - at[2]};
  const float bd[3]{d[0] - b[0], d[1] - b[1], d[2] - b[2]};
  const float normal[3]{ac[1] * bd[2] - ac[2] * bd[1], ac[2] * bd[0] - ac[0] * bd[2],
                        ac[0] * bd[1] - ac[1] * bd[0]};
  const float size =
      std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
  const float factor = offset / (size + 1e-12f);
  for (int i = 0; i < 3; ++i) {
    const float way = factor * normal[i];
    at[i] -= way;
    at[3 + i] += way;
    at[6 + i] -= way;
    at[9 + i] += way;
  }
}

}  // namespace

void foldClusters(const forest::TreeMesh& mesh, float* positions) {
  const std::size_t clusters = std::min(mesh.clusters, mesh.leaves.size());
  for (std::size_t card = 0; card < clusters; ++card) {
    const forest::LeafCard& leaf = mesh.leaves[card];
    foldCard(leaf.size * (leaf.key & 1u ? FOLD : -FOLD), positions);
    positions += 3 * forest::LEAF_CORNERS;
  }
}

}  // namespace vegetation_sim::view
