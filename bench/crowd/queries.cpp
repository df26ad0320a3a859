// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdio>

#include "crowd/peer_distance.h"
#include "crowd/sections.h"
#include "processor_time.h"
#include "scenes/crowd/random_shapes.h"

namespace vegetation_sim::crowd::bench {
namespace {

constexpr std::size_t PAIRS = 4000;

struct Family {
  const char* name;
  int kind;
  bool capsules;  ///< the second shape is a segment with radius
};
constexpr Family FAMILIES[] = {{"boxes, any pose", 0, false},
                               {"boxes, upright", 1, false},
                               {"boxes, axis-aligned", 2, false},
                               {"box and tilted capsule", 0, true},
                               {"box and upright capsule", 1, true}};

void fill(const Family& family, std::vector<Box>& first, std::vector<Box>& second) {
  for (std::size_t i = 0; i < PAIRS; ++i) {
    const Random random = Random(77).child(i);
    first.push_back(randomBox(random.child(0), family.kind));
    second.push_back(randomBox(random.child(1), family.kind));
    // The shapes are apart, as are most pairs after a broad phase, so every library has a distance.
    second.back().centre += Vec3(2.5, 0.0, 0.0);
    if (!family.capsules) continue;
    second.back().half = Vec3(0.0, 0.0, second.back().half.z());
    second.back().radius = 0.2;
  }
}

void compare(const Family& family, int rounds) {
  std::vector<Box> first, second;
  fill(family, first, second);
  double sum = 0.0;
  std::vector<::vegetation_sim::bench::Candidate> candidates{
      {"own", [&] {
         for (std::size_t i = 0; i < PAIRS; ++i) sum += separation(first[i], second[i]).upper;
       }}};
  std::vector<PeerDistance> peers;
#ifdef WITH_FCL
  peers = fclDistances(first, second);
#endif
  for (const PeerDistance& peer : peers)
    candidates.push_back({peer.name, [&sum, &peer] {
                            for (std::size_t i = 0; i < PAIRS; ++i) sum += peer.distance(i);
                          }});
  ::vegetation_sim::bench::timeOnProcessor(candidates, rounds);
  std::printf("%-24s", family.name);
  for (const auto& candidate : candidates)
    std::printf("  %s %.0f ns (%.1fx)", candidate.name.c_str(), candidate.seconds / PAIRS * 1e9,
                candidate.seconds / candidates.front().seconds);
  std::printf("%s\n", sum > 0.0 ? "" : " ");
  for (const PeerDistance& peer : peers) {
    double worst = 0.0;
    int wrong = 0;
    for (std::size_t i = 0; i < PAIRS; ++i) {
      const Separation own = separation(first[i], second[i]);
      if (own.overlapping) continue;
      const double off = std::max(own.lower - peer.distance(i), peer.distance(i) - own.upper);
      worst = std::max(worst, off);
      wrong += off > 1e-6 * own.upper;
    }
    std::printf("    %-22s  beyond our proof by up to %.1e m; off by more than 1e-6: %.2f %%\n",
                peer.name, worst, 100.0 * wrong / PAIRS);
  }
}

}  // namespace

void benchQueries(double count, int rounds) {
  double worst = 0.0;
  int most = 0;
  long long bad = 0, touching = 0;
  const auto all = static_cast<std::uint64_t>(count);
  for (std::uint64_t i = 0; i < all; ++i) {
    const ShapePair pair = randomPair(i);
    const Separation found = separation(pair.a, pair.b);
    worst = std::max(worst, found.upper - found.lower);
    most = std::max(most, found.rounds);
    touching += found.overlapping;
    bad += !(found.upper - found.lower <= 1e-10);
  }
  std::printf(
      "%.0f queries: widest proof %.1e m, wider than 1e-10: %lld; at most %d rounds; "
      "%.1f %% overlap\n",
      count, worst, bad, most, 100.0 * static_cast<double>(touching) / count);
  for (const Family& family : FAMILIES) compare(family, rounds);
}

}  // namespace vegetation_sim::crowd::bench
