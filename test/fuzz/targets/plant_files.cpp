// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/params/plant_files.h"
#include "ros/params/mesh_file.h"

#include "fuzz/targets/decoding.h"
#include "fuzz/targets/scratch_folder.h"
#include "fuzz/targets/target_lists.h"
#include "fuzz/targets/usage.h"

namespace vegetation_sim::fuzz {
namespace {

void grow(const std::shared_ptr<canopy::Form>& form, canopy::PlantShape shape) {
  canopy::PlantKind kind;
  kind.shape = shape;
  kind.form = form;
  if (canopy::leafCount(kind) > 5000) return;
  for (const canopy::Leaf& leaf : canopy::grow(kind, canopy::Plant()).leaves)
    requireFinite(leaf.tip, "tip of a leaf");
}

// The first byte chooses the format; assimp reads the rest.
void runMesh(std::string_view input) {
  static const char* const NAMES[] = {"plant.obj", "plant.stl", "plant.ply", "plant.dae"};
  if (input.empty()) return;
  const char* name = NAMES[static_cast<unsigned char>(input[0]) % 4];
  const ScratchFolder& folder = ScratchFolder::instance();
  try {
    const canopy::LeafMesh mesh = loadMesh(folder.write(name, input.substr(1)), MeshAxes::TURNED);
    grow(std::make_shared<canopy::Form>(canopy::formOf(mesh, false)), canopy::PlantShape::MESH);
  } catch (const InvalidInput&) {
  }
}

// Faces of any kind, as an importer may return them. The first byte is the number of vertices.
void runFaces(std::string_view input) {
  Numbers numbers(input);
  canopy::LeafMesh mesh;
  const int vertices = numbers.byte(), options = numbers.byte();
  for (int i = 0; i < vertices; ++i) {
    const double x = (options & 1) ? numbers.real() : numbers.between(-1.0, 1.0);
    mesh.vertices.emplace_back(x, numbers.between(-1.0, 1.0), numbers.between(0.0, 1.0));
    if (options & 2) mesh.uv.push_back({numbers.between(0.0, 1.0), numbers.real()});
  }
  while (!numbers.empty() && mesh.faces.size() < 1000) {
    mesh.faces.push_back({numbers.byte(), numbers.byte(), numbers.byte()});
    if (options & 4) mesh.rigid.push_back(numbers.byte() % 2 == 1);
  }
  try {
    grow(std::make_shared<canopy::Form>(canopy::formOf(mesh, (options & 8) != 0)),
         canopy::PlantShape::MESH);
  } catch (const InvalidInput&) {
  }
}

// Pieces are pictures with the numbers 0 to 3.
void runSlices(std::string_view input) {
  const ScratchFolder& folder = ScratchFolder::instance();
  std::string first;
  int number = 0;
  for (const Piece& piece : splitPieces(input)) {
    if (number == 4) break;
    const std::string file =
        folder.write("slice_" + std::to_string(number++) + ".png", piece.bytes);
    if (first.empty()) first = file;
  }
  for (; number < 4; ++number) folder.remove("slice_" + std::to_string(number) + ".png");
  if (first.empty()) return;
  try {
    grow(std::make_shared<canopy::Form>(canopy::formOf(loadSlices(first), 0.5)),
         canopy::PlantShape::SLICES);
  } catch (const InvalidInput&) {
  }
}

std::vector<std::string> meshSeeds() {
  return {std::string(1, '\0') +
              "v 0 0 1\nv 1 0 1\nv 0 0.2 2\nv 1 0.2 2\nv 0 0 0\nv 0.1 0 0\n"
              "vt 0 0\nvt 1 0\nvt 1 1\no leaf\nusemtl green\nf 1/1 2/2 3/3\n"
              "f 2/1 4/2 3/3\no trunk\nf 5/1 6/2 1/3\n",
          "\x01solid leaf\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
          "vertex 0 1 1\nendloop\nendfacet\nendsolid leaf\n",
          "\x02ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
          "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
          "0 0 0\n1 0 0\n0 1 1\n3 0 1 2\n",
          "\x03<COLLADA version='1.4.1'><asset><unit meter='0.01'/><up_axis>Z_UP</up_axis></asset>"
          "<library_geometries><geometry id='g'><mesh><source id='p'>"
          "<float_array id='a' count='9'>0 0 0 100 0 0 0 0 200</float_array><technique_common>"
          "<accessor source='#a' count='3' stride='3'><param name='X' type='float'/>"
          "<param name='Y' type='float'/><param name='Z' type='float'/></accessor>"
          "</technique_common></source><vertices id='v'>"
          "<input semantic='POSITION' source='#p'/></vertices><triangles count='1'>"
          "<input semantic='VERTEX' source='#v' offset='0'/><p>0 1 2</p></triangles></mesh>"
          "</geometry></library_geometries><library_visual_scenes><visual_scene id='s'>"
          "<node id='n'><instance_geometry url='#g'/></node></visual_scene>"
          "</library_visual_scenes><scene><instance_visual_scene url='#s'/></scene></COLLADA>"};
}

std::vector<std::string> faceSeeds() {
  std::string out{6, 6};  // vertices, options
  for (int i = 0; i < 6; ++i) {
    for (const int byte : {0, 40 * i, 0, 255 - 40 * i, 0, 30 * i}) out += static_cast<char>(byte);
    out.append(10, '\x3f');
  }
  for (const int byte : {0, 1, 2, 0, 2, 1, 3, 0, 3, 4, 5, 1}) out += static_cast<char>(byte);
  return {out};
}

std::vector<std::string> sliceSeeds() {
  const std::string picture = "P2\n2 2\n255\n0 200\n200 200\n";
  return {pieceOf(0, picture), pieceOf(0, picture) + pieceOf(0, picture)};
}

}  // namespace

std::vector<Target> plantFileTargets() {
  return {{"mesh", "a mesh file, read by assimp", runMesh, meshSeeds},
          {"faces", "the faces of a mesh as a plant", runFaces, faceSeeds},
          {"slices", "pictures of slices as a plant", runSlices, sliceSeeds}};
}

}  // namespace vegetation_sim::fuzz
