// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "canopy/plants/mesh_leaves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "canopy/plants/slice_leaves.h"
#include "core/error_text.h"
#include "scenes/canopy/canopy_scene.h"
#include "scenes/canopy/plane_scene.h"

namespace vegetation_sim::canopy {
namespace {

/// Leaves of two triangles with a shared edge, one above the other; the corners of each triangle
/// are its own, as files without indices have them.
LeafMesh ladderOf(std::uint32_t leaves) {
  LeafMesh out;
  for (std::uint32_t i = 0; i < leaves; ++i) {
    const double z = i, x = 0.1 * (i % 7);
    const Vec3 a(x, 0.0, z), b(x + 0.3, 0.0, z), c(x, 0.1, z + 0.4), d(x + 0.3, 0.1, z + 0.4);
    for (const Vec3& v : {a, b, c, b, d, c}) out.vertices.push_back(v);
    const std::uint32_t at = 6 * i;
    out.faces.push_back({at, at + 1, at + 2});
    out.faces.push_back({at + 3, at + 4, at + 5});
  }
  return out;
}

PlantKind kindOf(const LeafMesh& mesh) {
  PlantKind out;
  out.shape = PlantShape::MESH;
  out.file = "none";
  out.height = 2.0;
  auto form = std::make_shared<Form>(formOf(mesh, false));
  out.radius = 2.0 * form->radius;
  out.form = form;
  return out;
}

// S3-03: what shares an edge is one leaf; what touches in a point is not.
TEST(LeavesOf, AreWhatHangsTogetherByEdges) {
  EXPECT_EQ(leavesOf(ladderOf(3)), (std::vector<std::uint32_t>{0, 0, 1, 1, 2, 2}));
  LeafMesh touching = ladderOf(1);
  touching.vertices.push_back(Vec3(0.3, 0.1, 0.4));
  touching.vertices.push_back(Vec3(0.5, 0.1, 0.9));
  touching.vertices.push_back(Vec3(0.6, 0.1, 0.9));
  touching.faces.push_back({6, 7, 8});
  EXPECT_EQ(leavesOf(touching), (std::vector<std::uint32_t>{0, 0, 1}));
}

// S3-03: the root is the vertex with the smallest (u, v), and all faces of a leaf have it.
TEST(FormOf, HangsEachLeafOnItsRoot) {
  LeafMesh mesh = ladderOf(4);
  const Form low = formOf(mesh, false);
  for (std::size_t i = 0; i < low.leaves.size(); ++i) {
    EXPECT_EQ(low.leaves[i].anchor, low.leaves[i / 2 * 2].anchor);
    EXPECT_NEAR(low.leaves[i].anchor.z(), static_cast<double>(i / 2) / 3.4, 1e-12);
  }
  mesh.uv.assign(mesh.vertices.size(), {0.5, 0.5});
  for (std::size_t i = 4; i < mesh.uv.size(); i += 6) mesh.uv[i] = {0.0, 0.1};  // corner d
  for (const Leaf& leaf : formOf(mesh, false).leaves)
    EXPECT_NEAR(std::fmod(leaf.anchor.z() * 3.4, 1.0), 0.4, 1e-9);
}

// S3-02: rigid faces are separate, marked by names, and never displaced.
TEST(FormOf, KeepsRigidPartsApart) {
  LeafMesh mesh = ladderOf(2);
  mesh.rigid = {true, true, false, false};
  const Form form = formOf(mesh, false);
  EXPECT_EQ(form.rigid.size(), 2U);
  EXPECT_EQ(form.leaves.size(), 2U);
  EXPECT_TRUE(isRigidName("Old_Trunk.001", RIGID_WORDS));
  EXPECT_TRUE(isRigidName("BARK", RIGID_WORDS));
  EXPECT_FALSE(isRigidName("leaves", RIGID_WORDS));
  EXPECT_TRUE(isRigidName("Holz_2", "stamm HOLZ"));
  EXPECT_FALSE(isRigidName("trunk", "stamm holz"));
  EXPECT_FALSE(isRigidName("trunk", " "));
}

TEST(FormOf, IsOneHighOnItsFootInTheMiddle) {
  for (const bool y_up : {false, true}) {
    const Form form = formOf(ladderOf(5), y_up);
    double low = 1e9, high = -1e9;
    for (const Leaf& leaf : form.leaves)
      for (const Vec3& v : {Vec3(leaf.root - leaf.side), Vec3(leaf.root + leaf.side), leaf.tip}) {
        low = std::min(low, v.z());
        high = std::max(high, v.z());
        EXPECT_LE(std::hypot(v.x(), v.y()), form.radius + 1e-12);
      }
    EXPECT_NEAR(low, 0.0, 1e-12);
    EXPECT_NEAR(high, 1.0, 1e-12);
  }
}

// S3-03: no leaf is cut by layers, and faces stay joined at their corners in any wind.
TEST(Mesh, StaysWholeInTheWind) {
  Layout layout = shrubScene();
  layout.kinds = {kindOf(ladderOf(40))};
  layout.motion.cuts.near_layers = 9;
  Canopy canopy(layout);
  canopy.setWind(breezeFrom(Vec3(1.0, 6.0, 0.0)));
  run(canopy, 0, 60);
  const Foliage& foliage = canopy.foliage();
  const GrownPlant grown = grow(layout.kinds[0], layout.plants[1]);
  double moved = 0.0;
  for (std::size_t i = 0; i < grown.leaves.size(); i += 2) {
    const Leaf &first = grown.leaves[i], &second = grown.leaves[i + 1];
    EXPECT_EQ(foliage.layerAt(first.anchor), foliage.layerAt(second.anchor));
    const MovedLeaf a = foliage.move(first, 1), b = foliage.move(second, 1);
    // Corner b of the first triangle is corner b of the second one; c likewise.
    EXPECT_LT(length(Vec3(a.root + a.side - (b.root - b.side))), 1e-12);
    EXPECT_LT(length(Vec3(a.tip - b.tip)), 1e-12);
    moved = std::max(moved, length(Vec3(a.tip - first.tip)));
  }
  EXPECT_GT(moved, 0.02);
}

// Bad input: each fault by name.
TEST(FormOf, RejectsInvalidMeshes) {
  EXPECT_NE(errorOf([] { formOf(LeafMesh(), false); }).find("no faces"), std::string::npos);
  LeafMesh mesh = ladderOf(3);
  mesh.vertices[7].x() = std::numeric_limits<double>::quiet_NaN();
  mesh.vertices[9].z() = std::numeric_limits<double>::infinity();
  mesh.faces[5][2] = 1000;
  const std::string text = errorOf([&] { formOf(mesh, false); });
  EXPECT_NE(text.find("2 vertices are not finite or beyond 1e9, the first is number 7"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("1 corners of faces are no vertices, the first is number 5"),
            std::string::npos)
      << text;
  LeafMesh flat = ladderOf(3);
  for (Vec3& v : flat.vertices) v.z() = 1.0;
  EXPECT_NE(errorOf([&] { formOf(flat, false); }).find("height = 0"), std::string::npos);
  LeafMesh point;
  point.vertices = {Vec3::Zero()};
  point.faces = {{0, 0, 0}};
  EXPECT_THROW(formOf(point, false), InvalidInput);
}

// Bad input: one million components.
TEST(FormOf, MayHaveAMillionLeaves) {
  const std::uint32_t leaves = 500000;
  LeafMesh mesh = ladderOf(leaves);
  for (std::size_t i = 3; i < mesh.vertices.size(); i += 6)
    for (std::size_t k = 0; k < 3; ++k) mesh.vertices[i + k].y() += 5.0;  // parts all pairs
  const Form form = formOf(mesh, false);
  ASSERT_EQ(form.leaves.size(), 2 * leaves);
  for (std::size_t i = 1; i < form.leaves.size(); ++i)
    ASSERT_NE(form.leaves[i].anchor, form.leaves[i - 1].anchor);
}

SliceStack ballOf(int cells) {
  SliceStack out{cells, cells, cells, {}};
  for (int slice = 0; slice < cells; ++slice)
    for (int row = 0; row < cells; ++row)
      for (int column = 0; column < cells; ++column) {
        const auto at = [&](int i) { return (2.0 * i + 1.0) / cells - 1.0; };
        const double square = at(slice) * at(slice) + at(row) * at(row) + at(column) * at(column);
        out.density.push_back(square < 1.0 ? 1.0 - 0.3 * square : 0.0);
      }
  return out;
}

// S3-29: a leaf for each cell that is not buried; all within the stack.
TEST(Slices, MakeALeafOfEachCellOnTheOutside) {
  const Form form = formOf(ballOf(16), 0.5);
  EXPECT_GT(form.leaves.size(), 16U * 16U * 2U);
  EXPECT_LT(form.leaves.size(), 16U * 16U * 8U);
  for (const Leaf& leaf : form.leaves) {
    EXPECT_LE(length(Vec3(leaf.anchor - Vec3(0.0, 0.0, 0.5))), 0.5);
    EXPECT_GT(length(Vec3(leaf.anchor - Vec3(0.0, 0.0, 0.5))), 0.3);
    EXPECT_LT(length(Vec3(leaf.root - leaf.anchor)), 1.0 / 16.0);  // within its cell
  }
  EXPECT_LT(form.radius, 0.7);
}

// S3-W6: smoke and clouds are slices that nothing holds: with a rigidity of 0 all of it drifts, in
// layers, its lowest parts too.
TEST(Slices, DriftInLayersAsACloud) {
  Layout layout = shrubScene();
  layout.motion.warp.rigidity = 0.0;
  layout.kinds[0].shape = PlantShape::SLICES;
  layout.kinds[0].file = "none";
  layout.kinds[0].form = std::make_shared<Form>(formOf(ballOf(12), 0.5));
  for (Plant& plant : layout.plants) plant.position.z() = 3.0;
  Canopy canopy(layout);
  canopy.setWind(breezeFrom(Vec3(2.0, 6.0, 0.0)));
  run(canopy, 0, 60);
  const Foliage& foliage = canopy.foliage();
  std::vector<Vec3> first(static_cast<std::size_t>(foliage.layers()), Vec3::Zero());
  for (std::size_t plant = 0; plant < 2; ++plant)
    for (const Leaf& leaf : grow(layout.kinds[0], layout.plants[plant]).leaves) {
      const Vec3 way = foliage.move(leaf, plant).root - leaf.root;
      EXPECT_GT(length(way), 0.005);
      first[static_cast<std::size_t>(foliage.layerAt(leaf.anchor))] = way;
    }
  EXPECT_GT(length(Vec3(first.front() - first.back())), 1e-3);
}

// S3-W6: slices may be puffs; other shapes have no such key.
TEST(Slices, MayLookLikePuffs) {
  Faults faults;
  YamlSection slices(parseYaml("{shape: slices, look: puffs}", "a"), "a", faults);
  PlantKind kind;
  describe(slices, kind);
  slices.finish();
  EXPECT_TRUE(faults.empty()) << faults.text();
  EXPECT_EQ(kind.look, CellLook::PUFFS);
  YamlSection shrub(parseYaml("{shape: shrub, look: puffs}", "b"), "b", faults);
  PlantKind other;
  describe(shrub, other);
  shrub.finish();
  EXPECT_NE(faults.text().find("look is not a known key"), std::string::npos) << faults.text();
}

TEST(Slices, AreRejectedIfTheyAreEmpty) {
  EXPECT_THROW(formOf(SliceStack(), 0.5), InvalidInput);
  EXPECT_THROW(formOf(SliceStack{2, 2, 1, {0.0, 0.1, 0.2, 0.3}}, 0.5), InvalidInput);
  EXPECT_THROW(formOf(SliceStack{2, 2, 2, {0.0, 0.1, 0.2, 0.3}}, 0.2), InvalidInput);
  SliceStack odd = ballOf(4);
  odd.density[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(errorOf([&] { formOf(odd, 0.5); }).find("density"), std::string::npos);
}

}  // namespace
}  // namespace vegetation_sim::canopy
