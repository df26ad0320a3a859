// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/crowd/body_template.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "crowd/body/gait.h"
#include "crowd/body/walker.h"
#include "rviz/crowd/body_mesh.h"
#include "rviz/crowd/marked_clothes.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::view {
namespace {

using P = crowd::Proportions;

constexpr int PHASES = 12;  // of a cycle of walking
constexpr int STANDS = -1;  // instead of a phase

// Returns somebody who stands, or walks along x.
crowd::Walker walkerAt(int phase) {
  crowd::Walker out;
  out.height = TALL;
  for (int side = 0; side < 2; ++side)
    out.feet[static_cast<std::size_t>(side)].planted = {0.0, (side == 0 ? 0.05 : -0.05) * TALL};
  if (phase == STANDS) return out;
  constexpr double STEP = 0.01;  // [m]
  out.velocity = {1.3, 0.0};
  out.position.x = -600.0 * STEP;
  for (int i = 0; i < 600; ++i) {
    out.position.x += STEP;
    crowd::advanceGait(STEP, out);
  }
  for (int i = 0; i < 1000; ++i) {
    const double ahead = out.gait - std::floor(out.gait) - double(phase) / PHASES;
    if (ahead >= 0.0 && ahead < 0.02) break;
    out.position.x += STEP;
    crowd::advanceGait(STEP, out);
  }
  return out;
}

struct Hit {
  double way;  ///< [m]
  std::size_t part;
  Vec3 colour;  ///< 0 to 255
};

/// A body as parts, each of which is a surface that hangs together.
class Surface {
 public:
  explicit Surface(const crowd::Clothes& clothes, int phase = STANDS) {
    const crowd::Walker walker = walkerAt(phase);
    mesh_.origin = Vec3(walker.position.x, walker.position.y, 0.0);
    appendBody(
        crowd::skeletonOf(walker, terrain::HeightMap(), crowd::ownStyles(), 1.0), clothes,
        bodyStyle(400.0), Daylight(), [](const Vec3&) { return SharedLight::Shares(); }, mesh_);
    findParts();
  }

  const std::vector<std::vector<std::uint32_t>>& parts() const { return parts_; }
  Vec3 pointOf(std::size_t vertex) const {
    const float* p = &mesh_.positions[3 * vertex];
    return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
  }
  Vec3 colourOf(std::size_t vertex) const {
    const std::uint8_t* c = &mesh_.colours[4 * vertex];
    return Vec3(c[0], c[1], c[2]);
  }
  /// Returns the lowest and the highest corner of a part.
  std::pair<Vec3, Vec3> boxOf(std::size_t part) const {
    Vec3 low = Vec3::Constant(1e9), high = -low;
    for (const std::uint32_t vertex : parts_[part]) {
      low = low.cwiseMin(pointOf(vertex));
      high = high.cwiseMax(pointOf(vertex));
    }
    return {low, high};
  }

  /// Returns what is seen first from a place in a direction.
  std::optional<Hit> firstHit(const Vec3& from, const Vec3& way) const {
    std::optional<Hit> out;
    for (std::size_t k = 0; k + 2 < mesh_.indices.size(); k += 3) {
      const std::uint32_t* corner = &mesh_.indices[k];
      const Vec3 a = pointOf(corner[0]), u = pointOf(corner[1]) - a, v = pointOf(corner[2]) - a;
      const Vec3 p = cross(way, v);
      const double det = dot(u, p);
      if (std::fabs(det) < 1e-14) continue;
      const Vec3 q = cross(from - a, u);
      const double b = dot(from - a, p) / det, c = dot(way, q) / det, t = dot(v, q) / det;
      if (b < 0.0 || c < 0.0 || b + c > 1.0 || t <= 0.0 || (out && t >= out->way)) continue;
      out = Hit{
          t, part_[corner[0]],
          (1.0 - b - c) * colourOf(corner[0]) + b * colourOf(corner[1]) + c * colourOf(corner[2])};
    }
    return out;
  }

 private:
  std::uint32_t rootOf(std::uint32_t vertex) {
    while (roots_[vertex] != vertex) vertex = roots_[vertex] = roots_[roots_[vertex]];
    return vertex;
  }

  void findParts() {
    roots_.resize(mesh_.vertexCount());
    std::iota(roots_.begin(), roots_.end(), 0u);
    for (std::size_t k = 0; k + 2 < mesh_.indices.size(); k += 3)
      for (std::size_t i = 1; i < 3; ++i) {
        const std::uint32_t a = rootOf(mesh_.indices[k]), b = rootOf(mesh_.indices[k + i]);
        roots_[std::max(a, b)] = std::min(a, b);
      }
    part_.resize(roots_.size());
    for (std::uint32_t i = 0; i < roots_.size(); ++i) {
      const std::uint32_t root = rootOf(i);
      part_[i] = root == i ? parts_.size() : part_[root];
      if (root == i) parts_.emplace_back();
      parts_[part_[i]].push_back(i);
    }
  }

  grass::GrassMesh mesh_;
  std::vector<std::uint32_t> roots_;
  std::vector<std::size_t> part_;  // of each vertex
  std::vector<std::vector<std::uint32_t>> parts_;
};

// Seen from the front, an eye is dark in the middle, white beside the iris, and has a dark line
// above.
TEST(BodyTemplate, EyesHaveIrisesAndLids) {
  const Surface body(markedClothes(crowd::HairCut::SHORT, crowd::Outfit::TROUSERS));
  for (const double side : {-1.0, 1.0}) {
    Vec3 middle = Vec3::Zero();
    int count = 0;
    for (std::size_t part = 0; part < body.parts().size(); ++part)
      for (const std::uint32_t vertex : body.parts()[part]) {
        const Vec3 colour = body.colourOf(vertex), at = body.pointOf(vertex);
        if (colour.x() < 60.0 || colour.z() < 60.0 || side * at.y() < 0.0) continue;
        middle += at;
        ++count;
      }
    ASSERT_GT(count, 0);
    middle /= count;
    const auto seenAt = [&](double left, double up) {
      const auto hit = body.firstHit(
          Vec3(1.0, middle.y() + side * left * TALL, middle.z() + up * TALL), -Vec3::UnitX());
      return hit ? hit->colour : Vec3(Vec3::Zero());
    };
    const double white = std::min(seenAt(-0.0046, 0.0).x(), seenAt(0.0046, 0.0).x());
    EXPECT_GT(white, 70.0);
    EXPECT_LT(seenAt(0.0, 0.0).x(), 0.5 * white);
    double darkest = 255.0;
    for (double up = 0.002; up < 0.006; up += 0.0002)
      darkest = std::min(darkest, seenAt(0.0, up).y());
    EXPECT_LT(darkest, 0.5 * seenAt(0.0, 0.008).y());
    EXPECT_LT(seenAt(0.0, 0.008).x(), 5.0) << "white above the lid";
    EXPECT_LT(seenAt(0.0, -0.008).x(), 5.0) << "white below the lid";
  }
}

// Each hand has four fingers, which are next to each other, and a thumb, which begins higher.
TEST(BodyTemplate, HandsHaveFourFingersAndAThumb) {
  const Surface body(markedClothes(crowd::HairCut::SHORT, crowd::Outfit::TROUSERS));
  for (const double side : {-1.0, 1.0}) {
    std::vector<Vec3> tips;
    std::vector<double> begins;
    for (std::size_t part = 0; part < body.parts().size(); ++part) {
      const auto [low, high] = body.boxOf(part);
      if (high.z() > 0.55 * TALL || low.z() < 0.3 * TALL || side * low.y() < 0.0) continue;
      const Vec3 colour = body.colourOf(body.parts()[part].front());
      EXPECT_GT(colour.y(), colour.x() + colour.z()) << "no skin";
      EXPECT_LT((high - low).norm(), 0.12);
      tips.push_back(body.pointOf(body.parts()[part].back()));
      begins.push_back(high.z());
    }
    ASSERT_EQ(tips.size(), 5u);
    for (std::size_t i = 0; i < tips.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) EXPECT_GT((tips[i] - tips[j]).norm(), 0.01);
    std::sort(begins.begin(), begins.end());
    EXPECT_LT(begins[3] - begins[0], 0.025);
    EXPECT_GT(begins[4] - begins[3], 0.025);
  }
}

// Returns how far an arm of somebody who stands reaches to the left at a height.
double outlineOf(const Surface& body, double up) {
  const auto hit = body.firstHit(Vec3(0.005, 1.0, up), -Vec3::UnitY());
  return hit ? 1.0 - hit->way : 0.0;
}

// A long sleeve is smooth at the upper arm. A short one ends there, with the skin less than 8 mm
// below its surface.
TEST(BodyTemplate, SleevesEndAtTheArm) {
  for (const bool long_sleeves : {true, false}) {
    crowd::Clothes clothes = markedClothes(crowd::HairCut::SHORT, crowd::Outfit::TROUSERS);
    clothes.long_sleeves = long_sleeves;
    const Surface body(clothes);
    constexpr double STEP = 0.004;
    double largest = 0.0;
    for (double up = 0.65 * TALL; up < 0.75 * TALL; up += STEP)
      largest = std::max(largest, outlineOf(body, up + STEP) - outlineOf(body, up));
    EXPECT_LT(largest, long_sleeves ? 0.0025 : 0.008);
    EXPECT_GT(largest, long_sleeves ? -0.001 : 0.0025);
  }
}

// A top has its colour down to its hem, and trousers theirs below it.
TEST(BodyTemplate, TopsEndAtTheirHems) {
  crowd::Clothes clothes = markedClothes(crowd::HairCut::SHORT, crowd::Outfit::TROUSERS);
  clothes.shirt = clothes.second = Vec3::UnitX();
  const Surface body(clothes);
  const auto red = [&](double up) {
    const auto hit = body.firstHit(Vec3(-1.0, 0.05, up * TALL), Vec3::UnitX());
    return hit ? hit->colour.x() : 0.0;
  };
  const double hips = P::THIGH + P::SHANK + P::ANKLE;
  EXPECT_GT(red(hips - 0.012), 0.7 * red(hips + 0.02));
  EXPECT_LT(red(hips - 0.03), 1.0);
}

class WalkingTest : public testing::TestWithParam<int> {};

// Returns the parts of a body that a skirt or a coat covers, and the heights between which it does.
struct Covered {
  std::vector<bool> parts;
  double hem, hips;
  Vec3 front;  ///< the middle of the hem
};
Covered coveredBy(const Surface& body) {
  Covered out{std::vector<bool>(body.parts().size(), false), 0.0, 0.0, Vec3::Zero()};
  for (std::size_t part = 0; part < out.parts.size(); ++part) {
    const auto [low, high] = body.boxOf(part);
    out.parts[part] = part == 0 || low.z() < 0.25 * TALL;  // the trunk and legs
    const bool around = low.z() > 0.25 * TALL && low.y() < -0.1 && high.y() > 0.1;
    if (!around || high.z() > 0.65 * TALL) continue;
    out.hips = high.z() - 0.05;
    out.front = body.pointOf(body.parts()[part][9]);
    for (std::size_t i = 0; i < 12; ++i)  // its first ring
      out.hem = std::max(out.hem, body.pointOf(body.parts()[part][i]).z());
  }
  return out;
}

// From all sides, the first that is seen where a skirt or a coat hangs is this skirt or coat or an
// arm, but not the hips or legs below it.
TEST_P(WalkingTest, NothingPokesThroughSkirtsAndCoats) {
  for (const crowd::Outfit outfit : {crowd::Outfit::SKIRT, crowd::Outfit::COAT}) {
    for (int kind = 0; kind < 9; ++kind) {
      crowd::Clothes clothes = markedClothes(crowd::HairCut::SHORT, outfit);
      clothes.fullness = 0.5 * (kind / 3);
      clothes.build = 0.5 * (kind % 3);
      clothes.tucked = outfit == crowd::Outfit::SKIRT;
      const Surface body(clothes, GetParam());
      const Covered covered = coveredBy(body);
      ASSERT_GT(covered.hips, covered.hem + 0.1);
      int seen = 0, poking = 0;
      for (double up = covered.hem; up < covered.hips; up += 0.012)
        for (int i = 0; i < 36; ++i) {
          const SinCos turn = sinCosTurns((i + 0.5) / 36.0);
          const Vec3 out(turn.cos, turn.sin, 0.0);
          const auto hit = body.firstHit(Vec3(0.0, 0.0, up) + out, -out);
          if (!hit) continue;
          ++seen;
          poking += covered.parts[hit->part] ? 1 : 0;
        }
      EXPECT_GT(seen, 100);
      EXPECT_EQ(poking, 0) << "kind " << kind << ", coat " << (outfit == crowd::Outfit::COAT);
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Phases, WalkingTest, testing::Range(STANDS, PHASES));

// The middle of a skirt is in front as much in the steps of the right leg as in those of the left.
TEST(BodyTemplate, SkirtsHangBetweenTheLegs) {
  const crowd::Clothes clothes = markedClothes(crowd::HairCut::SHORT, crowd::Outfit::SKIRT);
  for (int phase = 0; phase < PHASES / 2; ++phase) {
    const Vec3 left = coveredBy(Surface(clothes, phase)).front;
    const Vec3 right = coveredBy(Surface(clothes, phase + PHASES / 2)).front;
    EXPECT_NEAR(left.x(), right.x(), 0.03);
    EXPECT_NEAR(left.z(), right.z(), 0.03);
  }
}

// Going down from the crown, skin that has come into sight is not covered by hair again: the head
// does not poke through the hair.
TEST(BodyTemplate, HeadsStayBelowTheirHair) {
  for (const crowd::HairCut cut :
       {crowd::HairCut::SHORT, crowd::HairCut::CROP, crowd::HairCut::LONG, crowd::HairCut::BOB,
        crowd::HairCut::TAIL}) {
    const Surface body(markedClothes(cut, crowd::Outfit::TROUSERS));
    int again = 0;
    for (int degrees = -70; degrees <= 70; degrees += 2) {
      const SinCos turn = sinCosTurns(degrees / 360.0);
      const Vec3 out(turn.cos, turn.sin, 0.0);
      bool skin = false;
      for (double up = 0.995; up > 0.95; up -= 0.001) {
        const auto hit = body.firstHit(Vec3(0.0, 0.0, up * TALL) + out, -out);
        if (!hit) continue;
        const bool hair = hit->colour.z() > 2.0 * hit->colour.y();
        again += hair && skin ? 1 : 0;
        skin = skin || !hair;
      }
    }
    EXPECT_EQ(again, 0) << static_cast<int>(cut);
  }
}

}  // namespace
}  // namespace vegetation_sim::view
