// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/params/mesh_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <vector>

#include "core/error_text.h"

namespace vegetation_sim {
namespace {

// A triangle whose third corner is 2 m up, in centimetres, with the up axis of the file. The array
// of its coordinates announces `numbers` of them.
std::string colladaWithUp(const std::string& axis, const std::string& numbers = "9") {
  return "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' "
         "version='1.4.1'><asset><unit name='centimeter' meter='0.01'/><up_axis>" +
         axis +
         "</up_axis></asset><library_geometries><geometry id='g'><mesh>"
         "<source id='p'><float_array id='a' count='" +
         numbers +
         "'>0 0 0 100 0 0 0 0 200</float_array>"
         "<technique_common><accessor source='#a' count='3' stride='3'><param name='X' "
         "type='float'/><param name='Y' type='float'/><param name='Z' type='float'/></accessor>"
         "</technique_common></source><vertices id='v'><input semantic='POSITION' source='#p'/>"
         "</vertices><triangles count='1'><input semantic='VERTEX' source='#v' offset='0'/>"
         "<p>0 1 2</p></triangles></mesh></geometry></library_geometries><library_visual_scenes>"
         "<visual_scene id='s'><node id='n'><instance_geometry url='#g'/></node></visual_scene>"
         "</library_visual_scenes><scene><instance_visual_scene url='#s'/></scene></COLLADA>";
}

class MeshFile : public testing::Test {
 protected:
  MeshFile() {
    folder_ = std::filesystem::temp_directory_path() / ("mesh_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }
  ~MeshFile() override { std::filesystem::remove_all(folder_); }

  canopy::LeafMesh load(const std::string& text, MeshAxes axes) {
    const std::string file = folder_ / "part.dae";
    std::ofstream(file) << text;
    return loadMesh(file, axes);
  }

  std::filesystem::path folder_;
};

// As in rviz: the meshes of a robot keep the axes of the file, and are in metres.
TEST_F(MeshFile, RobotsKeepTheAxesOfColladaFiles) {
  for (const char* up : {"Y_UP", "Z_UP"}) {
    const canopy::LeafMesh mesh = load(colladaWithUp(up), MeshAxes::KEPT);
    ASSERT_EQ(mesh.faces.size(), 1u) << up;
    const Vec3& top = mesh.vertices[mesh.faces[0][2]];
    EXPECT_NEAR(length(top - Vec3(0.0, 0.0, 2.0)), 0.0, 1e-6) << up << ": " << top.transpose();
  }
}

TEST_F(MeshFile, PlantsAreTurnedAsColladaFilesSay) {
  const canopy::LeafMesh one = load(colladaWithUp("Y_UP"), MeshAxes::TURNED);
  const canopy::LeafMesh other = load(colladaWithUp("Z_UP"), MeshAxes::TURNED);
  EXPECT_GT(length(one.vertices[one.faces[0][2]] - other.vertices[other.faces[0][2]]), 1.0);
}

// Found by fuzzing: assimp 5.2 reads from a null pointer. Other versions may reject the file.
TEST_F(MeshFile, ThatCrashesAssimpIsRejected) {
  const std::string file = folder_ / "part.dae";
  const std::string text = errorOf([&] { load(colladaWithUp("Z_UP", "0"), MeshAxes::TURNED); });
  EXPECT_TRUE(text == file + ": the reader of meshes crashed (SIGSEGV)" ||
              text.find(file + ": no mesh: ") == 0)
      << text;
  EXPECT_EQ(load(colladaWithUp("Z_UP"), MeshAxes::TURNED).faces.size(), 1U);
}

// S3-29: this process asks for each material file once, and not for any number of them.
TEST_F(MeshFile, MaterialFilesAreAskedForOnceEach) {
  std::string text = "mtllib a.mtl\r\n mtllib b.mtl\nmtllib\t../a.mtl\nmtllib c.txt\nmtllib\n";
  std::vector<std::string> asked;
  const FindFile find = [&](const std::string& path) {
    asked.push_back(path);
    return path;
  };
  const auto askedFor = [&] {
    asked.clear();
    std::ofstream(folder_ / "part.obj") << text + "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n";
    loadMesh(folder_ / "part.obj", MeshAxes::TURNED, "", find);
    return asked;
  };
  EXPECT_EQ(askedFor(), std::vector<std::string>{folder_ / "a.mtl"});
  for (int i = 0; i < 200; ++i) text += "mtllib " + std::to_string(i) + ".mtl\n";
  EXPECT_EQ(askedFor().size(), 64U);
}

}  // namespace
}  // namespace vegetation_sim
