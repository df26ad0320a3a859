// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// A capsule of 5 cm driven through crowns that are physical as a whole, where they have most thin
// wood: how deep wood enters, and with which force; the worst of all drives of a tree and speed.
// usage: contact_bench [--quick | --full] [--csv FILE]: one, three or all ways through each tree
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>

#include "forest/crown_scene.h"
#include "options.h"
#include "table.h"

namespace vegetation_sim::forest {
namespace {

constexpr double RADIUS = 0.025, LENGTH = 0.6, WAY = 2.0;  // of the capsule, and how far [m]
constexpr double CLEAR = 0.15;                             // to any wood where a way begins [m]
constexpr double LANE = 0.1;                               // between ways that are looked at [m]
constexpr double BAND = 0.5;                               // of heights, each with a way [m]
constexpr double BAR = 0.005;  // depth that thin wood is to stay above [m]

bool isClear(const Skeleton& skeleton, const Vec3& start) {
  for (const Branch& b : skeleton.branches)
    for (int k = 0; k <= 4; ++k) {
      const Vec3 off = b.rest.position + 0.25 * k * b.length * axisZ(b.rest.orientation) - start;
      if (std::fabs(off.y()) < 0.5 * LENGTH + CLEAR && std::hypot(off.x(), off.z()) < CLEAR)
        return false;
    }
  return true;
}

// Middles of thin branches that a way sweeps over.
int thinWoodOn(const Skeleton& skeleton, const Vec3& start) {
  int out = 0;
  for (const Branch& b : skeleton.branches) {
    const Vec3 off = b.rest.position + 0.5 * b.length * axisZ(b.rest.orientation) - start;
    out += b.base_radius < THIN && off.x() > 0.0 && off.x() < WAY &&
           std::fabs(off.y()) < 0.5 * LENGTH && std::fabs(off.z()) < LANE;
  }
  return out;
}

struct Way {
  Vec3 start{Vec3::Zero()};
  int wood{0};
};

// Of each band of heights the way that meets most thin wood; the busiest first.
std::vector<Way> busiestWays(const Skeleton& skeleton) {
  std::vector<Way> out;
  for (double low = BAND; low < skeleton.height; low += BAND) {
    Way best;
    for (double z = low; z < low + BAND - 0.5 * LANE; z += LANE)
      for (double y = -skeleton.reach; y < skeleton.reach; y += LANE)
        for (double x = -skeleton.reach - CLEAR; x < 0.0; x += LANE) {
          const Way way{Vec3(x, y, z), thinWoodOn(skeleton, Vec3(x, y, z))};
          if (way.wood > best.wood && isClear(skeleton, way.start)) best = way;
        }
    if (best.wood > 0) out.push_back(best);
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const Way& a, const Way& b) { return a.wood > b.wood; });
  return out;
}

/// The worst of several drives.
struct Worst {
  int drives{0}, touched{0}, disagreed{0}, deeper{0};  ///< deeper: drives above the bar
  double thin{0.0}, own{0.0}, thick{0.0}, force{0.0}, rise{0.0}, parts{0.0};

  void add(const CrownResult& found, double ticks) {
    ++drives;
    touched += found.touched;
    disagreed += found.disagreed;
    deeper += found.deepest_thin > BAR;
    thin = std::max(thin, found.deepest_thin);
    own = std::max(own, found.deepest_own);
    thick = std::max(thick, found.deepest_thick);
    force = std::max(force, found.hardest);
    rise = std::max(rise, found.largest_rise);
    parts = std::max(parts, found.parts / ticks);
  }
};

void driveAll(const std::string& species, std::uint64_t seed, std::size_t most,
              bench::Table& table) {
  std::vector<Way> ways = busiestWays(CrownScene(species, seed).skeleton());
  ways.resize(std::min(ways.size(), most));
  for (const double speed : {0.5, 1.0, 3.0}) {
    Worst worst;
    for (const Way& way : ways) {
      CrownScene scene(species, seed);
      worst.add(scene.drive(way.start, RADIUS, LENGTH, speed, WAY), WAY / speed * PHYSICS_RATE);
    }
    std::printf("%-7s %4llu %5.1f %6d %7d %9.2f %9.2f %6d %10.1f %9.0f %8.0f %6.2f %9d\n",
                species.c_str(), static_cast<unsigned long long>(seed), speed, worst.drives,
                worst.touched, 1e3 * worst.thin, 1e3 * worst.own, worst.deeper, 1e3 * worst.thick,
                worst.force, worst.rise, worst.parts, worst.disagreed);
    table.row(species, seed, speed, worst.drives, worst.touched, worst.thin, worst.own,
              worst.deeper, worst.thick, worst.force, worst.rise, worst.parts, worst.disagreed);
  }
}

}  // namespace
}  // namespace vegetation_sim::forest

int main(int argc, char** argv) {
  using namespace vegetation_sim;
  try {
    const bench::Options options = bench::readOptions(argc, argv, {});
    const std::size_t most = options.full ? 1000 : options.quick ? 1 : 3;
    bench::Table table(options.csv,
                       "species,seed,speed,drives,touched,deepest_thin,deepest_own,deeper_than_bar,"
                       "deepest_thick,force,largest_rise,parts,disagreed");
    std::printf("%-7s %4s %5s %6s %7s %9s %9s %6s %10s %9s %8s %6s %9s\n", "species", "seed",
                "[m/s]", "drives", "touched", "thin [mm]", "own [mm]", "> 5 mm", "other [mm]",
                "force [N]", "rise [N]", "parts", "disagreed");
    for (const std::string& species : forest::speciesNames())
      for (std::uint64_t seed = 7; seed < 10; ++seed) forest::driveAll(species, seed, most, table);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "contact_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
