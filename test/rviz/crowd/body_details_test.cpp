// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/crowd/body_details.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "crowd/body/walker.h"
#include "rviz/crowd/body_mesh.h"
#include "rviz/crowd/marked_clothes.h"

namespace vegetation_sim::view {
namespace {

grass::GrassMesh bodyOf(const crowd::Clothes& clothes, double pixels = 400.0) {
  crowd::Walker walker;
  walker.height = TALL;
  grass::GrassMesh out;
  appendBody(
      crowd::skeletonOf(walker, terrain::HeightMap()), clothes, bodyStyle(pixels), Daylight(),
      [](const Vec3&) { return SharedLight::Shares(); }, out);
  return out;
}

struct SeenVertex {
  Vec3 at;  ///< in heights of the person
  int red, green, blue;
};

std::vector<SeenVertex> verticesOf(const grass::GrassMesh& mesh) {
  std::vector<SeenVertex> out;
  for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
    const float* p = &mesh.positions[3 * i];
    const std::uint8_t* c = &mesh.colours[4 * i];
    const Vec3 at(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]));
    out.push_back({at / TALL, c[0], c[1], c[2]});
  }
  return out;
}

bool isHair(const SeenVertex& vertex) {
  return vertex.blue > 5 && vertex.red == 0 && vertex.green == 0;
}

bool isSkin(const SeenVertex& vertex) {
  return vertex.green > 5 && vertex.red == 0 && vertex.blue == 0;
}

// Returns the lowest hair and the highest skin in heights of the person.
std::pair<double, double> hairAndSkin(crowd::HairCut cut) {
  double hair = 1.0, skin = 0.0;
  for (const SeenVertex& vertex : verticesOf(bodyOf(markedClothes(cut, crowd::Outfit::TROUSERS)))) {
    if (isHair(vertex)) hair = std::min(hair, vertex.at.z());
    if (isSkin(vertex)) skin = std::max(skin, vertex.at.z());
  }
  return {hair, skin};
}

// Hair ends at the nape, the chin or the shoulders; the crown is bare or covered.
TEST(BodyDetails, HairHasSeveralCuts) {
  EXPECT_GT(hairAndSkin(crowd::HairCut::SHORT).first, 0.86);
  EXPECT_LT(hairAndSkin(crowd::HairCut::BOB).first, 0.88);
  EXPECT_LT(hairAndSkin(crowd::HairCut::LONG).first, 0.80);
  EXPECT_LT(hairAndSkin(crowd::HairCut::TAIL).first, 0.84);
  EXPECT_GT(hairAndSkin(crowd::HairCut::BALD).second, 0.99);
  EXPECT_LT(hairAndSkin(crowd::HairCut::SHORT).second, 0.99);
}

// The whites of the eyes are the only red vertices of a head of marked colours.
TEST(BodyDetails, FacesHaveTwoEyesAndANose) {
  int left = 0, right = 0;
  double nose = 0.0, brow = 0.0;
  for (const SeenVertex& vertex :
       verticesOf(bodyOf(markedClothes(crowd::HairCut::SHORT, crowd::Outfit::TROUSERS)))) {
    if (vertex.red > 60 && vertex.blue > 60) {
      EXPECT_NEAR(vertex.at.z(), 0.93, 0.015);
      EXPECT_GT(vertex.at.x(), 0.03);
      ++(vertex.at.y() > 0.0 ? left : right);
    }
    if (std::fabs(vertex.at.y()) > 1e-3) continue;
    if (std::fabs(vertex.at.z() - 0.914) < 0.006) nose = std::max(nose, vertex.at.x());
    if (std::fabs(vertex.at.z() - 0.947) < 0.006) brow = std::max(brow, vertex.at.x());
  }
  EXPECT_EQ(left, 24);
  EXPECT_EQ(right, 24);
  EXPECT_GT(nose, brow + 0.008);
}

/// Returns the height of the outline of a body at a distance to the left.
double outlineAt(const grass::GrassMesh& mesh, const std::vector<SeenVertex>& vertices, double y) {
  double out = 0.0;
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
    const Vec3 &a = vertices[mesh.indices[i]].at, &b = vertices[mesh.indices[next]].at;
    if ((a.y() - y) * (b.y() - y) >= 0.0) continue;
    out = std::max(out, a.z() + (b.z() - a.z()) * (y - a.y()) / (b.y() - a.y()));
  }
  return out;
}

// Shoulders fall from the neck to the arms without a notch, and are no balls.
TEST(BodyDetails, ShouldersFallSmoothly) {
  const grass::GrassMesh mesh =
      bodyOf(markedClothes(crowd::HairCut::SHORT, crowd::Outfit::TROUSERS));
  const std::vector<SeenVertex> vertices = verticesOf(mesh);
  double before = outlineAt(mesh, vertices, 0.06);
  for (double y = 0.065; y < 0.135; y += 0.005) {
    const double now = outlineAt(mesh, vertices, y);
    EXPECT_LT(now, before + 1e-4) << y;
    EXPECT_GT(now, before - 0.02) << y;
    before = now;
  }
}

// Returns how far the body reaches to the front between two heights.
double depthOf(const crowd::Clothes& clothes, double low, double high) {
  double out = 0.0;
  for (const SeenVertex& vertex : verticesOf(bodyOf(clothes)))
    if (vertex.at.z() > low && vertex.at.z() < high && std::fabs(vertex.at.y()) < 0.1)
      out = std::max(out, vertex.at.x());
  return out;
}

TEST(BodyDetails, SkirtsHangAroundBareLegsAndCoatsAroundTrousers) {
  const auto bareBelow = [](crowd::Outfit outfit, double height) {
    int out = 0;
    for (const SeenVertex& vertex : verticesOf(bodyOf(markedClothes({}, outfit))))
      out += isSkin(vertex) && vertex.at.z() < height ? 1 : 0;
    return out;
  };
  EXPECT_EQ(bareBelow(crowd::Outfit::TROUSERS, 0.3), 0);
  EXPECT_EQ(bareBelow(crowd::Outfit::COAT, 0.3), 0);
  EXPECT_GT(bareBelow(crowd::Outfit::SHORTS, 0.3), 80);
  EXPECT_GT(bareBelow(crowd::Outfit::SKIRT, 0.3), 80);
  const auto hem = [](crowd::Outfit outfit) {
    return depthOf(markedClothes({}, outfit), 0.3, 0.4);
  };
  EXPECT_GT(hem(crowd::Outfit::SKIRT), hem(crowd::Outfit::SHORTS) + 0.01);
  EXPECT_GT(hem(crowd::Outfit::COAT), hem(crowd::Outfit::TROUSERS) + 0.01);
}

TEST(BodyDetails, BuildsDiffer) {
  crowd::Clothes slim = markedClothes({}, crowd::Outfit::TROUSERS), stout = slim;
  slim.fullness = 0.0;
  stout.fullness = 1.0;
  EXPECT_GT(depthOf(stout, 0.6, 0.64), depthOf(slim, 0.6, 0.64) + 0.02);
}

// Every body has at most a third more triangles than one of the first release, which had 2 424, and
// a small one no more than its 222. Eyes and fingers are seen from near only.
TEST(BodyDetails, VarietyIsCheap) {
  std::size_t most = 0, middle = 0, small = 0;
  for (std::uint32_t id = 0; id < 200; ++id) {
    most = std::max(most, bodyOf(crowd::clothesOf(id)).indices.size() / 3);
    middle = std::max(middle, bodyOf(crowd::clothesOf(id), 110.0).indices.size() / 3);
    small = std::max(small, bodyOf(crowd::clothesOf(id), 20.0).indices.size() / 3);
  }
  std::printf("%zu triangles, %zu and %zu of smaller bodies\n", most, middle, small);
  EXPECT_LE(most, 3232u);
  EXPECT_LE(middle, 1392u);
  EXPECT_LE(small, 222u);
}

}  // namespace
}  // namespace vegetation_sim::view
