// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/trees/limb_ends.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace vegetation_sim::view {
namespace {

using forest::BarkVertex;

constexpr float POINT = 0.12f;    // radius of a tip relative to that without a point
constexpr float CAP_RISE = 0.5f;  // height of a cap relative to its radius

/// What lies at the far end of a branch.
enum class End : std::uint8_t { JOINT, TIP, BREAK };

std::vector<End> endsOf(const forest::Skeleton& skeleton) {
  std::vector<End> out;
  for (const forest::Branch& branch : skeleton.branches)
    out.push_back(branch.next < 0 ? End::TIP : End::JOINT);
  for (const forest::Branch& branch : skeleton.branches) {
    if (!branch.broken || branch.parent < 0) continue;
    const auto parent = static_cast<std::size_t>(branch.parent);
    if (skeleton.branches[parent].depth == branch.depth) out[parent] = End::BREAK;
  }
  return out;
}

// Returns the end of the ring that begins at a vertex.
std::size_t endOfRing(const forest::TreeMesh& mesh, std::size_t first) {
  const BarkVertex& like = mesh.bark[first];
  std::size_t last = first + 1;
  while (last < mesh.bark.size() && mesh.bark[last].branch == like.branch &&
         mesh.bark[last].local[2] == like.local[2])
    ++last;
  return last;
}

// Closes a ring. @param way 1 at the far end of a branch, -1 at its foot.
void addCap(std::size_t first, std::size_t last, float way, forest::TreeMesh& mesh) {
  BarkVertex middle = mesh.bark[first];
  const float rise = way * CAP_RISE * std::hypot(middle.local[0], middle.local[1]);
  middle.local = {0.f, 0.f, middle.local[2] + rise};
  middle.normal = {0.f, 0.f, way};
  middle.uv[1] += rise;
  const auto top = static_cast<std::uint32_t>(mesh.bark.size());
  mesh.bark.push_back(middle);
  for (auto a = static_cast<std::uint32_t>(first); a + 1 < last; ++a) {
    const std::uint32_t b = a + 1;
    if (way > 0.f)
      mesh.triangles.insert(mesh.triangles.end(), {a, b, top});
    else
      mesh.triangles.insert(mesh.triangles.end(), {b, a, top});
  }
}

}  // namespace

void finishLimbEnds(const forest::Skeleton& skeleton, forest::TreeMesh& mesh) {
  const std::vector<End> ends = endsOf(skeleton);
  const std::size_t count = mesh.bark.size();
  for (std::size_t first = 0; first < count;) {
    const std::size_t last = endOfRing(mesh, first);
    const auto branch = static_cast<std::size_t>(mesh.bark[first].branch);
    const float z = mesh.bark[first].local[2];
    if (branch == 0 && !skeleton.rooted && z == 0.f) addCap(first, last, -1.f, mesh);
    if (z > 0.f && z == forest::narrow(skeleton.branches[branch].length)) {
      if (ends[branch] == End::BREAK) addCap(first, last, 1.f, mesh);
      for (std::size_t i = first; ends[branch] == End::TIP && i < last; ++i)
        for (std::size_t k : {0u, 1u}) mesh.bark[i].local[k] *= POINT;
    }
    first = last;
  }
}

}  // namespace vegetation_sim::view
