// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/params/plant_files.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "core/error_text.h"
#include "ros/params/mesh_file.h"
#include "terrain/opacity_mask.h"
#include "vegetation_sim/ros/conversions/canopy_conversions.h"

namespace vegetation_sim {
namespace {

/// A folder of this test, which is deleted afterwards.
class PlantFiles : public ::testing::Test {
 protected:
  PlantFiles()
      : folder_(std::filesystem::temp_directory_path() /
                ("plant_files_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~PlantFiles() override { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }

  std::filesystem::path folder_;
};

// The mesh has a leaf of two triangles and a trunk of one.
const char* const SHRUB =
    "v 0 0 1\nv 1 0 1\nv 0 0.2 2\nv 1 0.2 2\nv 0 0 0\nv 0.1 0 0\nv 0 0 1\n"
    "o leaf\nusemtl green\nf 1 2 3\nf 2 4 3\no old_trunk\nusemtl brown\nf 5 6 7\n";

std::string slice(int dark, int rows = 2) {
  std::string out = "P2\n2 " + std::to_string(rows) + "\n255\n";
  for (int i = 0; i < 2 * rows; ++i) out += std::to_string(i < dark ? 0 : 200) + "\n";
  return out;
}

// S3-02, S3-03, S3-29: the names in the file distinguish leaves and rigid parts of a mesh.
TEST_F(PlantFiles, HaveLeavesAndRigidPartsOfAMesh) {
  const canopy::LeafMesh mesh = loadMesh(write("shrub.obj", SHRUB), MeshAxes::TURNED);
  const canopy::Form form = canopy::formOf(mesh, false);
  ASSERT_EQ(form.leaves.size(), 2U);
  EXPECT_EQ(form.rigid.size(), 1U);
  EXPECT_EQ(form.leaves[0].anchor, form.leaves[1].anchor);
  EXPECT_EQ(canopy::formOf(loadMesh("file://" + (folder_ / "shrub.obj").string(), MeshAxes::TURNED),
                           false)
                .hash,
            form.hash);
}

TEST_F(PlantFiles, FacesOfMoreThanThreeCornersAreSplit) {
  const canopy::LeafMesh mesh =
      loadMesh(write("square.obj", "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0.5 0 2\nv 0 0 1\nf 1 2 3 4 5\n"),
               MeshAxes::TURNED);
  EXPECT_EQ(mesh.faces.size(), 3U);
  EXPECT_EQ(mesh.rigid.size(), 3U);
}

// Found by fuzzing: assimp reads damaged OFF files beyond its memory. A file of another kind is not
// read, whatever it is called.
TEST_F(PlantFiles, OfOtherKindsAreRejected) {
  const std::string triangle = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 1\n3 0 1 2\n";
  const std::string file = write("leaf.off", triangle);
  EXPECT_EQ(errorOf([&] { loadMesh(file, MeshAxes::TURNED); }),
            file + ": no mesh: it ends in '.off', allowed are .dae, .obj, .ply and .stl");
  for (const char* name : {"leaf.dae", "leaf.obj", "leaf.ply", "leaf.stl"}) {
    const std::string disguised = write(name, triangle);
    EXPECT_NE(errorOf([&] { canopy::formOf(loadMesh(disguised, MeshAxes::TURNED), false); }), "")
        << name;
  }
  EXPECT_EQ(loadMesh(write("LEAF.OBJ", SHRUB), MeshAxes::TURNED).faces.size(),
            loadMesh(write("leaf.obj", SHRUB), MeshAxes::TURNED).faces.size());
}

// Found by fuzzing: assimp did not return.
TEST_F(PlantFiles, HeaderWithoutEndIsRejected) {
  const std::string file = write("endless.ply", "ply\nformat ascii 1.0\nelement vertex 3\n");
  EXPECT_EQ(errorOf([&] { loadMesh(file, MeshAxes::TURNED); }),
            file + ": no mesh: the header has no line end_header");
}

// Found by fuzzing: assimp did not return.
TEST_F(PlantFiles, TextWithAZeroByteIsRejected) {
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header";
  for (const std::string& text :
       {header + std::string("\1\0 0 0\n", 7), std::string("v \0 0", 5)}) {
    const std::string file = write(text[0] == 'p' ? "zero.ply" : "zero.obj", text);
    EXPECT_EQ(errorOf([&] { loadMesh(file, MeshAxes::TURNED); }),
              file + ": no mesh: a byte of a text file is zero");
  }
}

// The mesh of a package is named as in other nodes.
TEST_F(PlantFiles, AreFoundInPackages) {
  const canopy::Form fern = canopy::formOf(
      loadMesh("package://vegetation_sim/media/plants/fern.obj", MeshAxes::TURNED), false);
  EXPECT_GT(fern.leaves.size(), 500U);
  EXPECT_GT(fern.rigid.size(), 10U);
  const canopy::Form moss =
      canopy::formOf(loadSlices("package://vegetation_sim/media/plants/cushion_00.png"), 0.5);
  EXPECT_GT(moss.leaves.size(), 500U);
}

// S3-29: the fern of the package has fronds that are cut out of a texture, each of which is one
// leaf.
TEST_F(PlantFiles, OfThePackageHaveATextureWithAlpha) {
  canopy::Layout layout;
  layout.kinds.resize(1);
  layout.kinds[0].shape = canopy::PlantShape::MESH;
  layout.kinds[0].file = "package://vegetation_sim/media/plants/fern.obj";
  Faults faults;
  loadPublishedForms(layout, {}, faults);
  ASSERT_TRUE(faults.empty()) << faults.text();
  const canopy::Form& form = *layout.kinds[0].form;
  std::set<std::array<double, 3>> anchors;
  for (const canopy::Leaf& face : form.leaves) {
    anchors.insert({face.anchor.x(), face.anchor.y(), face.anchor.z()});
    ASSERT_GT(face.look, 0U);
    EXPECT_EQ(form.materials[form.looks[face.look - 1].material].texture, "fern.png");
  }
  EXPECT_EQ(anchors.size(), 22U);
  const auto frond =
      std::find_if(form.materials.begin(), form.materials.end(),
                   [](const canopy::FaceMaterial& each) { return !each.texture.empty(); });
  ASSERT_NE(frond, form.materials.end());
  ASSERT_TRUE(frond->picture) << frond->fault;
  const terrain::OpacityMask mask = terrain::parseOpacityMask(*frond->picture);
  EXPECT_EQ(mask.columns, 64);
  EXPECT_EQ(mask.rows, 128);
  const auto opaque = std::count(mask.opaque.begin(), mask.opaque.end(), true);
  EXPECT_GT(opaque, 64 * 128 / 3);
  EXPECT_LT(opaque, 64 * 128 * 2 / 3);
}

// S3-29: an image stack is a plant.
TEST_F(PlantFiles, AreReadAsSlices) {
  write("s_9.pgm", slice(1));
  write("s_10.pgm", slice(0));
  const canopy::SliceStack stack = loadSlices((folder_ / "s_9.pgm").string());
  EXPECT_EQ(stack.slices, 2);
  EXPECT_EQ(canopy::formOf(stack, 0.5).leaves.size(), 7U);
  write("t_00.pgm", slice(1));
  write("t_01.pgm", slice(1, 3));
  EXPECT_NE(errorOf([&] { loadSlices((folder_ / "t_00.pgm").string()); }).find("the first slice"),
            std::string::npos);
}

// Each error names the file and the fault.
TEST_F(PlantFiles, AreRejectedWithTheNameOfTheFile) {
  const auto text = [&](const std::string& name) {
    return errorOf([&] { canopy::formOf(loadMesh(name, MeshAxes::TURNED), false); });
  };
  EXPECT_NE(text((folder_ / "none.obj").string()).find("none.obj: cannot be read"),
            std::string::npos);
  EXPECT_NE(text("package://vegetation_sim/none.obj").find("cannot be read"), std::string::npos);
  EXPECT_NE(text("package://no_such_package/none.obj").find("not known"), std::string::npos);
  EXPECT_FALSE(text(write("empty.obj", "")).empty());
  EXPECT_FALSE(text(write("points.obj", "v 0 0 0\nv 0 0 1\n")).empty());
  EXPECT_FALSE(text(write("odd.obj", "v nan 0 0\nv 0 nan 1\nv 1 1 1\nf 1 2 3\n")).empty());
  EXPECT_FALSE(text(write("noise.stl", std::string(500, '\xff'))).empty());
  EXPECT_FALSE(text(write("wild.obj", "v 0 0 0\nv 0 0 1\nv 1 1 1\nf 1 2 99\n")).empty());
}

// The size is checked before the file is read.
TEST_F(PlantFiles, AreRefusedIfTheyAreTooLarge) {
  const std::string name = write("huge.obj", "");
  std::filesystem::resize_file(name, (std::uintmax_t{512} << 20) + 1);  // The file is sparse.
  const std::string text = errorOf([&] { loadMesh(name, MeshAxes::TURNED); });
  EXPECT_NE(text.find("huge.obj: 536870913 bytes, more than the 536870912"), std::string::npos)
      << text;
}

// S3-02: the key `rigid` of a kind has the words for a file in another language, also in the
// layout's message.
TEST_F(PlantFiles, HaveRigidPartsByTheWordsOfTheirKind) {
  std::string german = SHRUB;
  german.replace(german.find("old_trunk"), 9, "Altholz_1");
  write("shrub.obj", german);
  canopy::Layout layout;
  layout.kinds.resize(1);
  layout.kinds[0].shape = canopy::PlantShape::MESH;
  layout.kinds[0].file = "shrub.obj";
  layout.plants.resize(1);
  for (const auto& [words, rigid] : std::map<std::string, std::size_t>{
           {canopy::RIGID_WORDS, 0}, {"stamm holz", 1}, {"", 0}, {"leaf holz", 3}}) {
    canopy::Layout named = layout;
    named.kinds[0].rigid = words;
    Faults faults;
    loadForms(named, folder_.string(), faults);
    ASSERT_TRUE(faults.empty()) << faults.text();
    EXPECT_EQ(named.kinds[0].form->rigid.size(), rigid) << words;
    const canopy::Layout received = fromMsg(toMsg(named), {folder_.string()});
    EXPECT_EQ(received.kinds[0].rigid, words);
    EXPECT_EQ(received.kinds[0].form->rigid.size(), rigid) << words;
  }
  layout.kinds[0].rigid = std::string(501, 'x');
  Faults faults;
  check(layout, faults);
  EXPECT_NE(faults.text().find("rigid has 501 characters, more than the 500 allowed"),
            std::string::npos)
      << faults.text();
}

// S3-29: a mesh keeps textures, colours and normals of its materials, in files that may be opened.
TEST_F(PlantFiles, KeepTheLookOfTheirMaterials) {
  write("shrub.obj",
        "mtllib shrub.mtl\nv 0 0 0\nv 1 0 0\nv 0 0 2\nv 1 0 2\nvt 0 0\nvt 1 0\nvt 0 1\nvt 3 1\n"
        "vn 0 -0.6 0.8\nusemtl blade\nf 1/1/1 2/2/1 3/3/1\nusemtl berry\nf 2/2/1 4/4/1 3/3/1\n"
        "usemtl away\nf 1/1/1 4/4/1 3/3/1\n");
  write("shrub.mtl",
        "newmtl blade\nKd 0 0 0\nmap_Kd leaf.png\nnewmtl berry\nKd 0.8 0.1 0.2\n"
        "newmtl away\nKd 1 1 1\nmap_Kd ../../../../etc/hostname\n");
  write("leaf.png", "picture");
  canopy::Layout layout;
  layout.kinds.resize(1);
  layout.kinds[0].shape = canopy::PlantShape::MESH;
  layout.kinds[0].file = (folder_ / "shrub.obj").string();
  Faults faults;
  canopy::Layout of_a_node = layout;
  loadForms(of_a_node, folder_.string(), faults);
  loadPublishedForms(layout, {folder_.string()}, faults);
  ASSERT_TRUE(faults.empty()) << faults.text();
  EXPECT_TRUE(of_a_node.kinds[0].form->looks.empty());  // it draws nothing
  const canopy::Form& form = *layout.kinds[0].form;
  EXPECT_EQ(form.hash, of_a_node.kinds[0].form->hash);
  ASSERT_EQ(form.materials.size(), 3U);
  ASSERT_EQ(form.looks.size(), 3U);
  const auto materialOf = [&](std::size_t leaf) {
    return form.materials[form.looks[form.leaves[leaf].look - 1].material];
  };
  EXPECT_EQ(materialOf(0).texture, "leaf.png");
  EXPECT_EQ(materialOf(0).colour, Vec3::Ones());  // black is written beside a texture
  ASSERT_TRUE(materialOf(0).picture);
  EXPECT_EQ(*materialOf(0).picture, "picture");
  EXPECT_NEAR(materialOf(1).colour.x(), 0.8, 1e-6);
  EXPECT_TRUE(materialOf(1).texture.empty());
  EXPECT_FALSE(materialOf(2).picture);
  EXPECT_NE(materialOf(2).fault.find("hostname' cannot be opened here"), std::string::npos)
      << materialOf(2).fault;
  const canopy::FaceLook& look = form.looks[form.leaves[0].look - 1];
  EXPECT_EQ(look.uv[1], (std::array<float, 2>{1.F, 0.F}));
  EXPECT_NEAR(static_cast<double>(look.normal[2]), 0.8, 1e-6);
  EXPECT_EQ(form.looks[1].uv[1], (std::array<float, 2>{1.F, 1.F}));  // repeats end at the edge
}

// S3-29: what is missing or too large is a fault of the material alone.
TEST_F(PlantFiles, TexturesThatCannotBeOpenedAreNamed) {
  write("shrub.mtl", "newmtl green\nmap_Kd huge.png\nnewmtl brown\nmap_Kd none.png\n");
  write("shrub.obj", std::string("mtllib shrub.mtl\n") + SHRUB);
  std::filesystem::resize_file(write("huge.png", ""), std::uintmax_t{17} << 20);
  canopy::Layout layout;
  layout.kinds.resize(1);
  layout.kinds[0].shape = canopy::PlantShape::MESH;
  layout.kinds[0].file = (folder_ / "shrub.obj").string();
  Faults faults;
  loadPublishedForms(layout, {folder_.string()}, faults);
  ASSERT_TRUE(faults.empty()) << faults.text();
  ASSERT_EQ(layout.kinds[0].form->materials.size(), 2U);
  EXPECT_EQ(layout.kinds[0].form->materials[0].fault,
            "texture 'huge.png' cannot be opened here, or has more than 16777216 bytes");
  EXPECT_NE(layout.kinds[0].form->materials[1].fault.find("'none.png'"), std::string::npos);
  // Materials are read from the folder of the mesh alone, and not through links to devices.
  write("shrub.obj", std::string("mtllib /dev/zero.mtl\nmtllib ../shrub.mtl\n") + SHRUB);
  EXPECT_EQ(loadMesh((folder_ / "shrub.obj").string(), MeshAxes::TURNED).materials.size(), 0U);
}

// A layout with a mesh survives the conversion to a message, and a changed file is detected.
TEST_F(PlantFiles, GoThroughTheLayoutsMessage) {
  canopy::Layout layout;
  layout.kinds.resize(1);
  layout.kinds[0].shape = canopy::PlantShape::MESH;
  layout.kinds[0].file = "shrub.obj";
  layout.plants.resize(1);
  write("shrub.obj", SHRUB);
  Faults faults;
  loadForms(layout, folder_.string(), faults);
  ASSERT_TRUE(faults.empty());
  EXPECT_EQ(layout.leafCount(), 3U);
  const CanopyLayout message = toMsg(layout);
  EXPECT_NE(errorOf([&] { fromMsg(message); }).find("resource_folders"), std::string::npos);
  const std::vector<std::string> folders{folder_.string()};
  EXPECT_EQ(fromMsg(message, folders).leafCount(), 3U);
  std::string other = SHRUB;
  write("shrub.obj", other.replace(0, 7, "v 0 0.3 1"));
  EXPECT_NE(errorOf([&] { fromMsg(message, folders); }).find("hash"), std::string::npos);
  std::filesystem::remove(folder_ / "shrub.obj");
  EXPECT_NE(errorOf([&] { fromMsg(message, folders); }).find("is no plant here"),
            std::string::npos);
}

}  // namespace
}  // namespace vegetation_sim
