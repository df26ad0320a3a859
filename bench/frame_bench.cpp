// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Where the time of a frame goes in the shipped scenarios: levels, physics, state, poses and meshes
// of the trees, as node and display do it, without ROS and graphics card. An eye stands 25 m south
// of the origin; in `grab` a hand pulls a branch.
// usage: frame_bench [--quick | --full] [--part SCENARIO,..] [--csv FILE]

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "forest/level_scene.h"
#include "options.h"
#include "processor_time.h"
#include "table.h"
#include "vegetation_sim/common/scenario.h"
#include "vegetation_sim/forest/narrow.h"
#include "vegetation_sim/forest/skin.h"
#include "vegetation_sim/wind/yaml.h"

namespace vegetation_sim::forest {
namespace {

using bench::Options;
using bench::Table;

constexpr Nanoseconds START = 1700000000LL * NANOSECONDS_PER_SECOND;
constexpr int RATE = 30;  // ticks and pictures a second

struct Scene {
  Layout layout;
  std::shared_ptr<const terrain::HeightMap> terrain = flatTerrain();
  wind::Field wind;
  PhysicsSettings physics;
};

Scene load(const std::string& name) {
  const std::string folder = std::string(PACKAGE_FOLDER) + "/config/scenarios";
  Scenario file = Scenario::load(folder + "/" + name + ".yaml");
  Scene out;
  std::uint64_t seed = 0;
  std::string terrain;
  file.top().seed("seed", seed);
  file.top().text("terrain", terrain);
  out.layout = readLayout(file.section("forest"), folder, seed, file.faults());
  if (file.has("physics")) {
    YamlSection physics = file.section("physics");
    describe(physics, out.physics);
    physics.finish();
  }
  YamlSection air = file.section("wind");
  std::vector<wind::Primitive> primitives;
  for (const wind::Source& source : wind::readWind(air, seed))
    primitives.push_back(wind::startedAt(source, START).primitive);
  for (std::size_t i = 0; i < primitives.size(); ++i)
    primitives[i].id = static_cast<std::uint32_t>(i + 1);
  out.wind = wind::Field(primitives, seed);
  if (!terrain.empty())
    out.terrain = std::make_shared<const terrain::HeightMap>(
        terrain::HeightMap::load((std::filesystem::path(folder) / terrain).lexically_normal()));
  return out;
}

/// A tree as the display has it.
struct Drawn {
  Tree tree;
  BatchPoser poser;
  TreeMesh mesh;
  int level{0};
  std::vector<float> bark, leaves;
  BatchPoses poses;
};

/// Seconds of each part, in the order of a frame.
struct Frame {
  double levels{0.0}, physics{0.0}, state{0.0}, poses{0.0}, meshes{0.0};
  double sum() const { return levels + physics + state + poses + meshes; }
};

class Loop {
 public:
  Loop(const std::string& name, const Options& options)
      : scene_(load(name)),
        held_(scene_.layout, scene_.terrain, Settings()),
        free_(scene_.layout, scene_.terrain, Settings()) {
    eye_.id = "eye";
    eye_.eye.position = Vec3(0.0, -25.0, 3.0 + scene_.terrain->height(0.0, -25.0));
    eye_.eye.forward = Vec3::UnitY();
    eye_.eye.cone_cosine = 0.7;
    eye_.eye.pixels_per_radian = 0.5 * PICTURE_HEIGHT / std::tan(0.5 * FIELD_OF_VIEW);
    for (Forest* forest : {&held_, &free_}) {
      forest->setPhysics(scene_.physics);
      forest->setWind(scene_.wind);
    }
    tick_ = grid_.tickAt(START);
    growTrees();
    for (int i = 0; i < 2 * RATE; ++i) advance();
    if (name == "grab") hold();
    for (int i = 0; i < (options.quick ? 1 : 2) * RATE; ++i) advance();
  }

  /// One tick and one picture.
  Frame frame() {
    Frame out;
    const double start = bench::processorTime();
    advanceOne(free_);
    const double chosen = bench::processorTime();
    advanceOne(held_);
    const double stepped = bench::processorTime();
    ++tick_;
    held_.update(tick_ % RATE == 0);
    const double told = bench::processorTime();
    out.levels = chosen - start;
    out.physics = std::max(0.0, stepped - chosen - out.levels);
    out.state = told - stepped;
    pose();
    const double posed = bench::processorTime();
    skin();
    out.poses = posed - told;
    out.meshes = bench::processorTime() - posed;
    return out;
  }
  std::size_t trees() const { return drawn_.size(); }
  std::size_t physical() const { return held_.physicsFigures().branches; }

 private:
  void growTrees() {
    for (std::uint32_t id = 0; id < scene_.layout.treeCount(); ++id) {
      const Tree tree = growTree(scene_.layout, id, *scene_.terrain);
      drawn_.push_back({tree, BatchPoser(tree), {}, 0, {}, {}, {}});
      Drawn& own = drawn_.back();
      const double scale = pixelsPerMetre(eye_.eye, length(tree.foot - eye_.eye.position));
      own.level = geometryLevel(tree.skeleton.height * scale, -1);
      const Species& species = scene_.layout.species[tree.seed.species];
      own.mesh = buildMesh(tree.skeleton, species, meshDetail(own.level));
      own.bark.resize(3 * own.mesh.bark.size());
      own.leaves.resize(3 * LEAF_CORNERS * own.mesh.leaves.size());
    }
  }
  void hold() {
    const Tree& tree = drawn_[0].tree;
    Grab grab;
    grab.point = {0, tree.skeleton.depth_end[2] - 1, 0.0};
    grab.target = tree.foot +
                  held_.pose(tree, 0, now())[static_cast<std::size_t>(grab.point.branch)].position +
                  Vec3(0.3, 0.0, 0.0);
    held_.addGrab(grab);
  }
  Nanoseconds now() const { return grid_.timeOf(tick_); }
  void advanceOne(Forest& forest) const {
    Viewer eye = eye_;
    eye.stamp = grid_.timeOf(tick_ + 1);
    forest.setViewer(eye);
    forest.advance(eye.stamp);
  }
  void advance() {
    advanceOne(free_);
    advanceOne(held_);
    ++tick_;
  }
  void pose() {
    const wind::Instant wind = scene_.wind.at(now());
    for (std::uint32_t id = 0; id < drawn_.size(); ++id) {
      Drawn& own = drawn_[id];
      if (!held_.promoted(id).branches.empty())
        narrow(held_.pose(own.tree, id, now()), own.poses);
      else
        own.poser.pose(wind.relativeTo(own.tree.foot),
                       weightsAt(held_.memory().levels.of(id), now(), scene_.layout.motion),
                       meshDetail(own.level).depths, own.poses);
    }
  }
  void skin() {
    for (Drawn& own : drawn_) {
      const std::array<float, 3> foot{};
      skinBark(own.mesh, own.poses, foot, own.bark.data());
      skinLeaves(own.mesh, own.poses, foot, Flutter(), own.leaves.data());
    }
  }

  Scene scene_;
  Forest held_, free_;
  Viewer eye_;
  TickGrid grid_{RATE};
  std::int64_t tick_{0};
  std::vector<Drawn> drawn_;
};

void run(const std::string& name, const Options& options, Table& table) {
  Loop loop(name, options);
  std::vector<Frame> frames;
  for (int i = 0; i < (options.quick ? 60 : 300); ++i) frames.push_back(loop.frame());
  std::printf("%s: %zu trees, %zu physical branches\n", name.c_str(), loop.trees(),
              loop.physical());
  const auto report = [&](const char* part, const auto& of) {
    std::vector<double> times;
    for (const Frame& frame : frames) times.push_back(of(frame));
    std::sort(times.begin(), times.end());
    const double median = times[times.size() / 2], high = times[times.size() * 99 / 100];
    std::printf("  %-10s %8.3f ms, 99 %% of frames below %8.3f ms\n", part, 1e3 * median,
                1e3 * high);
    table.row(name, part, 1e3 * median, 1e3 * high);
  };
  report("levels", [](const Frame& f) { return f.levels; });
  report("physics", [](const Frame& f) { return f.physics; });
  report("state", [](const Frame& f) { return f.state; });
  report("poses", [](const Frame& f) { return f.poses; });
  report("meshes", [](const Frame& f) { return f.meshes; });
  report("frame", [](const Frame& f) { return f.sum(); });
}

}  // namespace
}  // namespace vegetation_sim::forest

int main(int argc, char** argv) {
  try {
    using namespace vegetation_sim;
    const bench::Options options =
        bench::readOptions(argc, argv, {"single_tree", "grab", "forest"});
    bench::Table table(options.csv, "scenario,part,ms,ms_99");
    for (const std::string& name : options.parts) forest::run(name, options, table);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "frame_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
