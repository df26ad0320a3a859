// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Compares trees that have one level of detail with trees whose boughs have levels of their own:
// triangles, and how far their silhouettes are from those of the finest mesh, as the share of each
// block of 8 x 8 pixels that they cover.
// usage: bough_bench

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "scenes/forest/forest_fixture.h"
#include "tree/mesh/bark_mesh.h"
#include "tree/mesh/bough_levels.h"
#include "tree/mesh/skin.h"
#include "vegetation_sim/tree/motion/batch_poser.h"

namespace vegetation_sim::forest {
namespace {

constexpr int BLOCK = 8, TREES = 8;  // [pixel], trees of a species
constexpr double PIXELS = 1000.0;    // per radian

/// A picture in black and white around the direction to the middle of a tree.
class Silhouette {
 public:
  Silhouette(double distance, double middle, double half_size)
      : distance_(distance),
        middle_(middle),
        edge_(BLOCK * (1 + static_cast<int>(2.0 * half_size) / BLOCK)),
        covered_(static_cast<std::size_t>(edge_) * static_cast<std::size_t>(edge_)) {}

  // The viewer is at x = distance, at the height of the middle.
  void add(const float* a, const float* b, const float* c) {
    std::array<std::array<double, 2>, 3> p{};
    const std::array<const float*, 3> corners{a, b, c};
    for (std::size_t i = 0; i < 3; ++i) {
      const double depth = distance_ - static_cast<double>(corners[i][0]);
      if (depth < 0.1) return;
      p[i] = {0.5 * edge_ + PIXELS * static_cast<double>(corners[i][1]) / depth,
              0.5 * edge_ + PIXELS * (static_cast<double>(corners[i][2]) - middle_) / depth};
    }
    const auto range = [&](std::size_t axis) {
      const auto [low, high] = std::minmax({p[0][axis], p[1][axis], p[2][axis]});
      return std::pair(std::max(0, static_cast<int>(low)),
                       std::min(edge_ - 1, static_cast<int>(high)));
    };
    const auto side = [&](std::size_t i, double x, double y) {
      const auto &u = p[i], &v = p[(i + 1) % 3];
      return (v[0] - u[0]) * (y - u[1]) - (v[1] - u[1]) * (x - u[0]);
    };
    const auto [left, right] = range(0);
    const auto [low, high] = range(1);
    for (int y = low; y <= high; ++y)
      for (int x = left; x <= right; ++x) {
        const double s = side(0, x + 0.5, y + 0.5), t = side(1, x + 0.5, y + 0.5),
                     u = side(2, x + 0.5, y + 0.5);
        if ((s >= 0 && t >= 0 && u >= 0) || (s <= 0 && t <= 0 && u <= 0))
          covered_[static_cast<std::size_t>(y * edge_ + x)] = 1;
      }
  }
  /// Adds the squares of the differences of the blocks that either covers, and their number.
  void compare(const Silhouette& other, double& squares, std::size_t& count) const {
    const auto blocks = edge_ / BLOCK;
    for (int y = 0; y < blocks; ++y)
      for (int x = 0; x < blocks; ++x) {
        const double a = share(x, y), b = other.share(x, y);
        if (a + b == 0.0) continue;
        squares += (a - b) * (a - b);
        ++count;
      }
  }

 private:
  double share(int column, int row) const {
    int out = 0;
    for (int y = row * BLOCK; y < (row + 1) * BLOCK; ++y)
      for (int x = column * BLOCK; x < (column + 1) * BLOCK; ++x)
        out += covered_[static_cast<std::size_t>(y * edge_ + x)];
    return static_cast<double>(out) / (BLOCK * BLOCK);
  }

  double distance_, middle_;
  int edge_;
  std::vector<unsigned char> covered_;
};

/// Trees of a species beside each other, from a distance.
class View {
 public:
  View(const std::string& name, double distance)
      : species_(shippedSpecies(name)), distance_(distance) {
    for (std::uint64_t i = 0; i < TREES; ++i) {
      TreeSeed seed;
      seed.seed = i;
      trees_.push_back(grow(seed, species_));
      best_.push_back(
          draw(trees_.back(), buildMesh(trees_.back(), species_, meshDetail(GEOMETRY_LEVELS - 1))));
    }
  }
  struct Result {
    double triangles{0.0}, error{0.0};
  };
  Result measure(double factor, bool by_bough) const {
    Result out;
    double squares = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < trees_.size(); ++i) {
      const TreeMesh mesh = meshAt(trees_[i], factor, by_bough);
      out.triangles += static_cast<double>(mesh.triangleCount()) / TREES;
      draw(trees_[i], mesh).compare(best_[i], squares, count);
    }
    out.error = std::sqrt(squares / static_cast<double>(count));
    return out;
  }
  /// Returns the result by bough with the factor that gives at most these triangles.
  Result atMost(double triangles) const {
    double low = 0.01, high = 4.0;
    for (int i = 0; i < 16; ++i) {
      const double middle = std::sqrt(low * high);
      (trianglesAt(middle) > triangles ? high : low) = middle;
    }
    return measure(low, true);
  }

 private:
  TreeMesh meshAt(const Skeleton& tree, double factor, bool by_bough) const {
    Viewpoint eye;
    eye.position = Vec3(distance_, 0.0, 0.5 * tree.height);
    eye.pixels_per_radian = PIXELS;
    const Boughs boughs(tree);
    return buildMesh(tree, species_,
                     treeMeshDetail(boughs, treeLevels(tree, boughs, Vec3::Zero(), eye, factor,
                                                       by_bough, TreeLevels())));
  }
  double trianglesAt(double factor) const {
    double out = 0.0;
    for (const Skeleton& tree : trees_)
      out += static_cast<double>(meshAt(tree, factor, true).triangleCount()) / TREES;
    return out;
  }
  Silhouette draw(const Skeleton& tree, const TreeMesh& mesh) const {
    Silhouette out(distance_, 0.5 * tree.height, 0.6 * PIXELS * tree.height / distance_);
    std::vector<Pose> rest;
    for (const Branch& branch : tree.branches) rest.push_back(branch.rest);
    BatchPoses poses;
    narrowPoses(rest, poses);
    std::vector<float> bark(3 * mesh.bark.size()), leaves(3 * LEAF_CORNERS * mesh.leaves.size());
    skinBark(mesh, poses, {}, bark.data());
    skinLeaves(mesh, poses, {}, Flutter(), leaves.data());
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3)
      out.add(&bark[3 * mesh.triangles[i]], &bark[3 * mesh.triangles[i + 1]],
              &bark[3 * mesh.triangles[i + 2]]);
    for (std::size_t i = 0; i < leaves.size(); i += 3 * LEAF_CORNERS) {
      out.add(&leaves[i], &leaves[i + 3], &leaves[i + 6]);
      out.add(&leaves[i], &leaves[i + 6], &leaves[i + 9]);
    }
    return out;
  }

  Species species_;
  double distance_;
  std::vector<Skeleton> trees_;
  std::vector<Silhouette> best_;
};

void run() {
  std::printf("%-8s %6s %6s | %10s %7s | %10s %7s | %7s\n", "species", "m", "factor", "triangles",
              "error", "by bough", "error", "error*");
  for (const std::string& name : speciesNames())
    for (const double distance : {6.0, 9.0, 13.0})
      for (const double factor : {0.1, 0.2, 0.3}) {
        const View view(name, distance);
        const auto whole = view.measure(factor, false), boughs = view.measure(factor, true);
        std::printf("%-8s %6.0f %6.2f | %10.0f %6.1f%% | %10.0f %6.1f%% | %6.1f%%\n", name.c_str(),
                    distance, factor, whole.triangles, 100.0 * whole.error, boughs.triangles,
                    100.0 * boughs.error, 100.0 * view.atMost(whole.triangles).error);
      }
  std::puts("error*: by bough, with as many triangles as one level for all takes");
}

}  // namespace
}  // namespace vegetation_sim::forest

int main() {
  vegetation_sim::forest::run();
}
