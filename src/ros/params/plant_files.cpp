// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/params/plant_files.h"

#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <filesystem>

#include "core/config/files.h"
#include "ros/params/resources.h"
#include "vegetation_sim/terrain/grey_image.h"

namespace vegetation_sim {
namespace {

constexpr std::size_t LARGEST_FILE = 512U << 20;  // [B]
constexpr int MOST_SLICES = 1024;
constexpr std::size_t MOST_CELLS = std::size_t{1} << 25;  // of all slices
constexpr std::size_t MOST_CORNERS = 16000000;            // and as many faces
constexpr int MOST_DEPTH = 256;                           // of nodes in nodes

std::string read(const std::string& name) {
  return readFile(resolveFile(name), LARGEST_FILE);
}

/// Collects the triangles of a scene, each where its node puts it.
class Collector {
 public:
  explicit Collector(const aiScene& scene) : scene_(scene) {}

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
    const bool rigid = canopy::isRigidName(mesh.mName.C_Str()) || canopy::isRigidName(node) ||
                       canopy::isRigidName(materialOf(mesh));
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
  bool textured_{true};
  canopy::LeafMesh out_;
};

/// "stem", digits, "ending": the parts of a numbered name.
struct Numbered {
  std::string before, number, after;
};

Numbered numberedName(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  if (dot == std::string::npos || dot == 0) return {name, "", ""};
  std::size_t begin = dot;
  while (begin > 0 && name[begin - 1] >= '0' && name[begin - 1] <= '9') --begin;
  return {name.substr(0, begin), name.substr(begin, dot - begin), name.substr(dot)};
}

std::string padded(int number, std::size_t digits) {
  const std::string out = std::to_string(number);
  return out.size() < digits ? std::string(digits - out.size(), '0') + out : out;
}

void append(const terrain::GreyImage& image, const std::string& name, canopy::SliceStack& out) {
  if (out.slices == 0) out.columns = image.columns, out.rows = image.rows;
  if (image.columns != out.columns || image.rows != out.rows)
    throw InvalidInput(name + ": " + std::to_string(image.columns) + " x " +
                       std::to_string(image.rows) + " pixels, the first slice has " +
                       std::to_string(out.columns) + " x " + std::to_string(out.rows));
  if (out.density.size() + image.samples.size() > MOST_CELLS)
    throw InvalidInput(name + ": the slices up to here have more than " +
                       std::to_string(MOST_CELLS) + " cells");
  for (const std::uint16_t sample : image.samples)
    out.density.push_back(static_cast<double>(sample) / image.white);
  ++out.slices;
}

void loadForm(const std::string& file, canopy::PlantKind& kind) {
  const bool mesh = kind.shape == canopy::PlantShape::MESH;
  auto form = std::make_shared<canopy::Form>(
      mesh ? canopy::formOf(loadLeafMesh(file), kind.up == canopy::UpAxis::Y)
           : canopy::formOf(loadSlices(file), kind.solid));
  kind.radius = form->radius * kind.height;
  kind.form = std::move(form);
}

}  // namespace

canopy::LeafMesh loadLeafMesh(const std::string& name) {
  const std::string bytes = read(name);
  // assimp searches for the end of the header without end.
  if (bytes.compare(0, 3, "ply") == 0 && bytes.find("end_header") == std::string::npos)
    throw InvalidInput(name + ": no mesh: the header has no line end_header");
  Assimp::Importer importer;
  const std::string ending = std::filesystem::path(name).extension().string();
  const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0,
                                                     ending.empty() ? "" : ending.c_str() + 1);
  if (!scene) throw InvalidInput(name + ": no mesh: " + importer.GetErrorString());
  try {
    return Collector(*scene).collect();
  } catch (const InvalidInput& error) {
    throw InvalidInput(name + ": " + error.what());
  }
}

canopy::SliceStack loadSlices(const std::string& name) {
  canopy::SliceStack out;
  append(terrain::parseGreyImage(read(name), name), name, out);
  const Numbered parts = numberedName(name);
  if (parts.number.empty() || parts.number.size() > 6) return out;
  for (int next = std::stoi(parts.number) + 1; out.slices < MOST_SLICES; ++next) {
    const std::string file = parts.before + padded(next, parts.number.size()) + parts.after;
    std::string bytes;
    try {
      bytes = read(file);
    } catch (const InvalidInput&) {
      break;  // the last one was the last
    }
    append(terrain::parseGreyImage(bytes, file), file, out);
  }
  return out;
}

void loadForms(canopy::Layout& layout, const std::string& folder, Faults& faults) {
  for (canopy::PlantKind& kind : layout.kinds) {
    if (!canopy::isRead(kind) || kind.file.empty()) continue;
    try {
      if (!isPackageAddress(kind.file)) kind.file = resolveFile(kind.file, folder);
      loadForm(kind.file, kind);
    } catch (const InvalidInput& error) {
      faults.add("kind " + kind.name + ": " + error.what());
    }
  }
}

void loadPublishedForms(canopy::Layout& layout, const std::vector<std::string>& folders,
                        Faults& faults) {
  for (canopy::PlantKind& kind : layout.kinds) {
    if (!canopy::isRead(kind) || kind.file.empty()) continue;
    try {
      const std::string file = findPublishedFile(kind.file, folders);
      try {
        loadForm(file, kind);
      } catch (const InvalidInput&) {  // its text may show what is in the file
        throw InvalidInput("'" + kind.file + "' is no plant here");
      }
    } catch (const InvalidInput& error) {
      faults.add("kind " + kind.name + ": " + error.what());
    }
  }
}

}  // namespace vegetation_sim
