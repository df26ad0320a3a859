// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/params/mesh_scene.h"

#include <assimp/BaseImporter.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/config.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cmath>
#include <filesystem>
#include <memory>
#include <new>
#include <utility>

#include "ros/params/mesh_bytes.h"
#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim {
namespace {

constexpr int MOST_DEPTH = 256;       // of nodes in nodes
constexpr float DEFAULT_GREY = 0.6F;  // of a material that assimp has not found

/// Removes the readers of other files: assimp tries them if the file's own reader rejects it.
void keepReaderOf(const std::string& ending, Assimp::Importer& importer) {
  const Assimp::BaseImporter* own = importer.GetImporter(ending.c_str());
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    std::unique_ptr<Assimp::BaseImporter> other(importer.GetImporter(i));
    if (other.get() == own || importer.UnregisterLoader(other.get()) != aiReturn_SUCCESS)
      (void)other.release();
  }
}

/// Gives assimp the material files that were read, and no others: assimp would open whatever a mesh
/// names.
class MaterialFiles : public Assimp::IOSystem {
 public:
  explicit MaterialFiles(const std::map<std::string, std::string>& texts) : texts_(texts) {}

  bool Exists(const char* file) const override { return find(file) != nullptr; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* file, const char* /*mode*/) override {
    const std::string* text = find(file);
    if (!text) return nullptr;
    return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(text->data()),
                                      text->size());
  }
  void Close(Assimp::IOStream* stream) override { delete stream; }

 private:
  const std::string* find(const char* file) const {
    const auto found = texts_.find(std::filesystem::path(file).filename().string());
    return found == texts_.end() || found->second.empty() ? nullptr : &found->second;
  }

  const std::map<std::string, std::string>& texts_;
};

/// Returns the material of a mesh, and whether it has a colour or a texture of its own.
std::pair<canopy::FaceMaterial, bool> readMaterial(const aiMaterial& material) {
  canopy::FaceMaterial out;
  aiString name, texture;
  material.Get(AI_MATKEY_NAME, name);
  if (std::string(name.C_Str()) == AI_DEFAULT_MATERIAL_NAME) return {out, false};
  aiColor3D colour;
  const bool coloured = material.Get(AI_MATKEY_COLOR_DIFFUSE, colour) == aiReturn_SUCCESS;
  const std::array<float, 3> parts{colour.r, colour.g, colour.b};
  const bool is_default = parts == std::array<float, 3>{DEFAULT_GREY, DEFAULT_GREY, DEFAULT_GREY};
  for (int i = 0; coloured && i < 3; ++i) {
    const auto part = static_cast<double>(parts[static_cast<std::size_t>(i)]);
    out.colour[i] = std::isfinite(part) ? std::clamp(part, 0.0, 1.0) : 1.0;
  }
  const bool textured = material.GetTexture(aiTextureType_DIFFUSE, 0, &texture) == aiReturn_SUCCESS;
  if (textured) out.texture = std::string(texture.C_Str()).substr(0, LONGEST_TEXTURE_NAME);
  // Many tools write a black colour beside a texture.
  if (textured && out.colour.maxCoeff() < 0.05) out.colour = Vec3::Ones();
  return {out, (coloured && !is_default) || !out.texture.empty()};
}

/// Collects the triangles of a scene, each where its node puts it.
class Collector {
 public:
  /// @param rigid words in the names of rigid parts.
  Collector(const aiScene& scene, const std::string& rigid) : scene_(scene), rigid_(rigid) {}

  canopy::LeafMesh collect() {
    readMaterials();
    if (scene_.mRootNode) add(*scene_.mRootNode, aiMatrix4x4(), 0);
    if (!textured_) out_.uv.clear();
    if (!has_normals_) out_.normals.clear();
    if (out_.materials.empty()) out_.material.clear(), out_.normals.clear();
    return std::move(out_);
  }

 private:
  void readMaterials() {
    number_.assign(scene_.mNumMaterials, 0);
    for (unsigned i = 0; i < scene_.mNumMaterials && out_.materials.size() < MOST_MESH_MATERIALS;
         ++i) {
      auto [material, is_own] = readMaterial(*scene_.mMaterials[i]);
      if (!is_own) continue;
      out_.materials.push_back(std::move(material));
      number_[i] = static_cast<std::uint16_t>(out_.materials.size());
    }
  }

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
    if (out_.vertices.size() + mesh.mNumVertices > MOST_MESH_CORNERS ||
        out_.faces.size() + mesh.mNumFaces > MOST_MESH_CORNERS)
      throw InvalidInput("more than " + std::to_string(MOST_MESH_CORNERS) + " corners or faces");
    const auto first = static_cast<std::uint32_t>(out_.vertices.size());
    const aiVector3D* uv = mesh.mTextureCoords[0];
    textured_ = textured_ && uv;
    has_normals_ = has_normals_ && mesh.mNormals;
    const aiMatrix3x3 turn(here);
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const aiVector3D v = here * mesh.mVertices[i];
      out_.vertices.emplace_back(v.x, v.y, v.z);
      if (has_normals_) {
        const aiVector3D n = turn * mesh.mNormals[i];
        out_.normals.emplace_back(n.x, n.y, n.z);
      }
      out_.uv.push_back(uv ? std::array<double, 2>{uv[i].x, uv[i].y} : std::array<double, 2>{});
    }
    const bool rigid = canopy::isRigidName(mesh.mName.C_Str(), rigid_) ||
                       canopy::isRigidName(node, rigid_) ||
                       canopy::isRigidName(materialOf(mesh), rigid_);
    const std::uint16_t material =
        mesh.mMaterialIndex < number_.size() ? number_[mesh.mMaterialIndex] : std::uint16_t{0};
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) add(mesh.mFaces[i], first, rigid);
    out_.material.resize(out_.faces.size(), material);
  }

  // Splits a convex face into a fan of triangles; points and lines have none. The splitting by
  // assimp ends the process for some broken files.
  void add(const aiFace& face, std::uint32_t first, bool rigid) {
    const unsigned* corner = face.mIndices;
    for (unsigned i = 2; i < face.mNumIndices; ++i) {
      if (out_.faces.size() >= MOST_MESH_CORNERS)
        throw InvalidInput("more than " + std::to_string(MOST_MESH_CORNERS) + " triangles");
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
  bool textured_{true}, has_normals_{true};
  std::vector<std::uint16_t> number_;  // 1 + index in out_.materials of each material; 0: none
  canopy::LeafMesh out_;
};

}  // namespace

canopy::LeafMesh readScene(const MeshSource& source, MeshAxes axes, const std::string& rigid) {
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, axes == MeshAxes::KEPT);
  keepReaderOf(source.ending, importer);
  importer.SetIOHandler(new MaterialFiles(source.materials));  // the importer deletes it
  const aiScene* scene = importer.ReadFileFromMemory(source.bytes.data(), source.bytes.size(), 0,
                                                     source.ending.c_str());
  if (scene) return Collector(*scene, rigid).collect();
  const std::string fault = importer.GetErrorString();
  if (fault == std::bad_alloc().what()) throw std::bad_alloc();
  throw InvalidInput("no mesh: " + fault);
}

}  // namespace vegetation_sim
