// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Drives a capsule of 5 cm through crowns that are physical as a whole, where they have most thin
// wood, and measures how deep wood enters and with which force, for the worst of all drives of a
// tree and speed. Then measures the wrenches that a forest publishes to a robot at 60 Hz. The part
// `substeps` compares ways to divide steps near a body: depth, rise of the force, processor time.
// usage: contact_bench [--quick | --full] [--part depth,published,substeps] [--csv FILE]
// The options choose one, three or all paths through each tree. The file holds the depths, or what
// `substeps` measures if that is the only part.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <map>

#include "options.h"
#include "processor_time.h"
#include "scenes/forest/contact_scene.h"
#include "scenes/forest/crown_scene.h"
#include "table.h"

namespace vegetation_sim::forest {
namespace {

// size of the capsule and length of its path [m]
constexpr double RADIUS = 0.025, LENGTH = 0.6, WAY = 2.0;
constexpr double CLEAR = 0.15;           // distance to any wood where a path begins [m]
constexpr double LANE = 0.1;             // between the paths that are tried [m]
constexpr double BAND = 0.5;             // height of a band, each with a path [m]
constexpr double LARGEST_DEPTH = 0.005;  // depth that thin wood must not exceed [m]
constexpr std::uint64_t SEED = 7;        // of the trees for `substeps`

bool isClear(const Skeleton& skeleton, const Vec3& start) {
  for (const Branch& b : skeleton.branches)
    for (int k = 0; k <= 4; ++k) {
      const Vec3 off = b.rest.position + 0.25 * k * b.length * axisZ(b.rest.orientation) - start;
      if (std::fabs(off.y()) < 0.5 * LENGTH + CLEAR && std::hypot(off.x(), off.z()) < CLEAR)
        return false;
    }
  return true;
}

// Returns the number of thin branches whose middle a path sweeps over.
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

// Returns, of each band of heights, the path that meets most thin wood, the busiest first.
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

/// The worst values of several drives.
struct Worst {
  int drives{0}, touched{0}, disagreed{0}, deeper{0};  ///< deeper: drives above LARGEST_DEPTH
  double thin{0.0}, own{0.0}, thick{0.0}, force{0.0}, rise{0.0}, fall{0.0};
  double parts{0.0};

  void add(const CrownResult& found, double ticks) {
    ++drives;
    touched += found.touched;
    disagreed += found.disagreed;
    deeper += found.deepest_thin > LARGEST_DEPTH;
    thin = std::max(thin, found.deepest_thin);
    own = std::max(own, found.deepest_own);
    thick = std::max(thick, found.deepest_thick);
    force = std::max(force, found.hardest);
    rise = std::max(rise, found.largest_rise);
    fall = std::max(fall, found.largest_fall);
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
    std::printf("%-7s %4llu %5.1f %6d %7d %9.2f %9.2f %6d %10.1f %9.0f %8.0f %8.0f %6.2f %9d\n",
                species.c_str(), static_cast<unsigned long long>(seed), speed, worst.drives,
                worst.touched, 1e3 * worst.thin, 1e3 * worst.own, worst.deeper, 1e3 * worst.thick,
                worst.force, worst.rise, worst.fall, worst.parts, worst.disagreed);
    table.row(species, seed, speed, worst.drives, worst.touched, worst.thin, worst.own,
              worst.deeper, worst.thick, worst.force, worst.rise, worst.fall, worst.parts,
              worst.disagreed);
  }
}

/// Wrenches of branches as they are published, tick by tick: the worst values of several drives.
struct Published {
  double force{0.0}, rise{0.0}, fall{0.0};  ///< of one branch; from tick to tick [N]
  double whole{0.0}, jump{0.0};             ///< of the body; from tick to tick [N]
  int ticks{0}, rises{0};  ///< wrenches published; those that rose by more than MAX_FORCE_CHANGE

  void drive(Drive& scene, double speed) {
    const double much = SubstepBisection::MAX_FORCE_CHANGE * physics::ContactLaw().force_limit;
    std::map<int, double> before;
    Vec3 last = Vec3::Zero();
    for (int i = 0; i < WAY / speed * TICKS; ++i) {
      scene.driveOn();
      std::map<int, double> now;
      Vec3 sum = Vec3::Zero();
      for (const Reaction& reaction : scene.forest().reactions()) {
        now[reaction.at.branch] += length(reaction.force);
        sum += reaction.force;
      }
      for (const auto& [branch, size] : now) {
        force = std::max(force, size);
        rise = std::max(rise, size - before[branch]);
        rises += size - before[branch] > much;
        ++ticks;
      }
      for (const auto& [branch, size] : before) fall = std::max(fall, size - now[branch]);
      whole = std::max(whole, length(sum));
      jump = std::max(jump, length(sum - last));
      before = now;
      last = sum;
    }
  }
};

void drivePublished(const std::string& species, std::uint64_t seed, std::size_t most) {
  std::vector<Way> ways = busiestWays(CrownScene(species, seed).skeleton());
  ways.resize(std::min(ways.size(), most));
  for (const double speed : {0.1, 0.5, 1.0, 3.0}) {
    Published published;
    for (const Way& way : ways) {
      Drive scene(speed, way.start, species, seed);
      published.drive(scene, speed);
    }
    std::printf("%-7s %4llu %5.1f %6zu %9.0f %9.0f %9.0f %9.0f %9.0f %8d %8d\n", species.c_str(),
                static_cast<unsigned long long>(seed), speed, ways.size(), published.force,
                published.rise, published.fall, published.whole, published.jump, published.ticks,
                published.rises);
  }
}

void benchDepth(std::size_t most, const std::string& csv) {
  bench::Table table(csv,
                     "species,seed,speed,drives,touched,deepest_thin,deepest_own,deeper_than_bar,"
                     "deepest_thick,force,largest_rise,largest_fall,parts,disagreed");
  std::printf("%-7s %4s %5s %6s %7s %9s %9s %6s %10s %9s %8s %8s %6s %9s\n", "species", "seed",
              "[m/s]", "drives", "touched", "thin [mm]", "own [mm]", "> 5 mm", "other [mm]",
              "force [N]", "rise [N]", "fall [N]", "parts", "disagreed");
  for (const std::string& species : speciesNames())
    for (std::uint64_t seed = 7; seed < 10; ++seed) driveAll(species, seed, most, table);
}

void benchPublished(std::size_t most) {
  std::printf("\npublished at %d Hz\n%-7s %4s %5s %6s %9s %9s %9s %9s %9s %8s %8s\n", TICKS,
              "species", "seed", "[m/s]", "drives", "force [N]", "rise [N]", "fall [N]", "body [N]",
              "jump [N]", "wrenches", "> 500 N");
  for (const std::string& species : speciesNames())
    for (std::uint64_t seed = 7; seed < 10; ++seed) drivePublished(species, seed, most);
}

// ---- substeps ----------------------------------------------------------------------------------

struct NamedRule {
  const char* name;
  SubstepRule rule;
};
const NamedRule RULES[] = {{"whole steps", {false, false}},
                           {"by travel", {true, false}},
                           {"by force", {false, true}},
                           {"by travel and force", {true, true}}};

/// Returns the processor time of a drive [s].
double timeOf(const std::string& species, const Way& way, double speed, const SubstepRule& rule) {
  CrownScene scene(species, SEED);
  scene.rule = rule;
  scene.observes = false;
  const double start = bench::threadTime();
  scene.drive(way.start, RADIUS, LENGTH, speed, WAY);
  return bench::threadTime() - start;
}

void driveBy(const NamedRule& named, const std::string& species, const std::vector<Way>& ways,
             double speed, bench::Table& table) {
  Worst worst;
  for (const Way& way : ways) {
    CrownScene scene(species, SEED);
    scene.rule = named.rule;
    worst.add(scene.drive(way.start, RADIUS, LENGTH, speed, WAY), WAY / speed * PHYSICS_RATE);
  }
  const double cost = timeOf(species, ways.at(0), speed, named.rule) * speed / WAY;
  std::printf("%-7s %4.1f m/s %-20s %7.2f mm %7.1f mm %6.0f N %6.0f N %8.1f ms %5.2f parts\n",
              species.c_str(), speed, named.name, 1e3 * worst.thin, 1e3 * worst.thick, worst.force,
              worst.rise, 1e3 * cost, worst.parts);
  table.row(named.name, species, speed, 1e3 * worst.thin, 1e3 * worst.thick, worst.force,
            worst.rise, 1e3 * cost, int(named.rule.by_travel && named.rule.by_force));
}

void benchSubsteps(const bench::Options& options) {
  bench::Table table(options.parts.size() == 1 ? options.csv : "",
                     "rule,species,speed,thin_mm,other_mm,force,rise,cost_ms,chosen");
  std::printf("\nsubsteps: thin and other wood, force, rise in a substep, time of a second\n");
  const std::vector<double> speeds =
      options.quick ? std::vector<double>{1.0, 4.0} : std::vector<double>{0.5, 1.0, 2.0, 4.0};
  for (const std::string& species : speciesNames()) {
    if (options.quick && species != "oak" && species != "pine") continue;
    std::vector<Way> ways = busiestWays(CrownScene(species, SEED).skeleton());
    ways.resize(std::min<std::size_t>(ways.size(), options.full ? 20 : options.quick ? 1 : 2));
    for (const double speed : speeds)
      for (const NamedRule& rule : RULES) driveBy(rule, species, ways, speed, table);
  }
}

}  // namespace
}  // namespace vegetation_sim::forest

int main(int argc, char** argv) {
  using namespace vegetation_sim;
  try {
    const bench::Options options =
        bench::readOptions(argc, argv, {"depth", "published", "substeps"});
    const std::size_t most = options.full ? 1000 : options.quick ? 1 : 3;
    if (options.wants("depth")) forest::benchDepth(most, options.csv);
    if (options.wants("published")) forest::benchPublished(most);
    if (options.wants("substeps")) forest::benchSubsteps(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "contact_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
