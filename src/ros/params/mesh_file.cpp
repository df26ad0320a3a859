// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/params/mesh_file.h"

#include <assimp/BaseImporter.h>
#include <assimp/config.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cctype>
#include <filesystem>
#include <memory>

#include "core/config/files.h"
#include "ros/params/resources.h"

namespace vegetation_sim {
namespace {

constexpr std::size_t LARGEST_MESH_FILE = 512U << 20;  // [B]
constexpr std::size_t MOST_CORNERS = 16000000;         // and as many faces
constexpr int MOST_DEPTH = 256;                        // of nodes in nodes
constexpr std::array<const char*, 4> ENDINGS{"dae", "obj", "ply", "stl"};

/// @return the ending of a mesh file in small letters. @throws InvalidInput if it is another one.
std::string endingOf(const std::string& name) {
  const std::string own = std::filesystem::path(name).extension().string();
  std::string ending = own.empty() ? own : own.substr(1);
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  if (std::find(ENDINGS.begin(), ENDINGS.end(), ending) == ENDINGS.end())
    throw InvalidInput(name + ": no mesh: it ends in '" + own +
                       "', allowed are .dae, .obj, .ply and .stl");
  return ending;
}

/// @return where the line end_header of a PLY file begins, or npos.
std::size_t findEndOfHeader(const std::string& bytes) {
  const std::string line = "\nend_header";
  std::size_t found = bytes.find(line);
  while (found != std::string::npos) {
    const std::size_t after = found + line.size();
    if (after < bytes.size() && (bytes[after] == '\n' || bytes[after] == '\r')) return found + 1;
    found = bytes.find(line, after);
  }
  return found;
}

/// Rejects text at which assimp does not end.
void checkText(const std::string& name, const std::string& ending, const std::string& bytes) {
  const std::size_t header = findEndOfHeader(bytes);
  const bool is_text =
      ending == "obj" || ending == "dae" ||
      (ending == "ply" && bytes.rfind("format ascii", header) != std::string::npos);
  if (is_text && bytes.find('\0') != std::string::npos)
    throw InvalidInput(name + ": no mesh: a byte of a text file is zero");
  if (ending == "ply" && header == std::string::npos)
    throw InvalidInput(name + ": no mesh: the header has no line end_header");
}

/// Removes the readers of other files: assimp tries them if the file's own reader rejects it.
void keepReaderOf(const std::string& ending, Assimp::Importer& importer) {
  const Assimp::BaseImporter* own = importer.GetImporter(ending.c_str());
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    std::unique_ptr<Assimp::BaseImporter> other(importer.GetImporter(i));
    if (other.get() == own || importer.UnregisterLoader(other.get()) != aiReturn_SUCCESS)
      (void)other.release();
  }
}

/// Collects the triangles of a scene, each where its node puts it.
class Collector {
 public:
  /// @param rigid words in the names of rigid parts.
  Collector(const aiScene& scene, const std::string& rigid) : scene_(scene), rigid_(rigid) {}

  canopy::LeafMesh collect() {
    if (scene_.mRootNode) add(*scene_.mRootNode, aiMatrix4x4(), 0);
    if (!textured_) out_.uv.clear();
    return std::move(out_);
  }

 private:
  void add(const aiNode& node, const aiMatrix4x4& above, int depth) {
    if (depth > MOST_DEPTH)
      throw InvalidInput("nodes in nodes, more than " + std::to_string(MOST_DEPTH) + " deep");
    const aiMatrix4x4 here = above * node.mTransformation;
    for (unsigned i = 0; i < node.mNumMeshes; ++i)
      add(*scene_.mMeshes[node.mMeshes[i]], here, node.mName.C_Str());
    for (unsigned i = 0; i < node.mNumChildren; ++i) add(*node.mChildren[i], here, depth + 1);
  }

  void add(const aiMesh& mesh, const aiMatrix4x4& here, const std::string& node) {
    // Before they are made: many nodes may have one mesh.
    if (out_.vertices.size() + mesh.mNumVertices > MOST_CORNERS ||
        out_.faces.size() + mesh.mNumFaces > MOST_CORNERS)
      throw InvalidInput("more than " + std::to_string(MOST_CORNERS) + " corners or faces");
    const auto first = static_cast<std::uint32_t>(out_.vertices.size());
    const aiVector3D* uv = mesh.mTextureCoords[0];
    textured_ = textured_ && uv;
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const aiVector3D v = here * mesh.mVertices[i];
      out_.vertices.emplace_back(v.x, v.y, v.z);
      out_.uv.push_back(uv ? std::array<double, 2>{uv[i].x, uv[i].y} : std::array<double, 2>{});
    }
    const bool rigid = canopy::isRigidName(mesh.mName.C_Str(), rigid_) ||
                       canopy::isRigidName(node, rigid_) ||
                       canopy::isRigidName(materialOf(mesh), rigid_);
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) add(mesh.mFaces[i], first, rigid);
  }

  // Splits a convex face into a fan of triangles; points and lines have none. The splitting by
  // assimp ends the process for some broken files.
  void add(const aiFace& face, std::uint32_t first, bool rigid) {
    const unsigned* corner = face.mIndices;
    for (unsigned i = 2; i < face.mNumIndices; ++i) {
      if (out_.faces.size() >= MOST_CORNERS)
        throw InvalidInput("more than " + std::to_string(MOST_CORNERS) + " triangles");
      out_.faces.push_back({first + corner[0], first + corner[i - 1], first + corner[i]});
      out_.rigid.push_back(rigid);
    }
  }

  std::string materialOf(const aiMesh& mesh) const {
    if (mesh.mMaterialIndex >= scene_.mNumMaterials) return {};
    aiString name;
    scene_.mMaterials[mesh.mMaterialIndex]->Get(AI_MATKEY_NAME, name);
    return name.C_Str();
  }

  const aiScene& scene_;
  const std::string& rigid_;
  bool textured_{true};
  canopy::LeafMesh out_;
};

}  // namespace

canopy::LeafMesh loadMesh(const std::string& name, MeshAxes axes, const std::string& rigid) {
  const std::string ending = endingOf(name);
  const std::string bytes = readFile(resolveFile(name), LARGEST_MESH_FILE);
  checkText(name, ending, bytes);
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, axes == MeshAxes::KEPT);
  keepReaderOf(ending, importer);
  const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, ending.c_str());
  if (!scene) throw InvalidInput(name + ": no mesh: " + importer.GetErrorString());
  try {
    return Collector(*scene, rigid).collect();
  } catch (const InvalidInput& error) {
    throw InvalidInput(name + ": " + error.what());
  }
}

}  // namespace vegetation_sim
