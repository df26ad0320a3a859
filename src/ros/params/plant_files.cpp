// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/params/plant_files.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include "core/config/files.h"
#include "ros/params/mesh_file.h"
#include "ros/params/resources.h"
#include "vegetation_sim/terrain/grey_image.h"

namespace vegetation_sim {
namespace {

constexpr std::size_t LARGEST_FILE = 512U << 20;    // [B]
constexpr std::size_t LARGEST_TEXTURE = 16U << 20;  // [B] of the file
constexpr int MOST_SLICES = 1024;
constexpr std::size_t MOST_CELLS = std::size_t{1} << 25;  // of all slices

std::string read(const std::string& name) {
  return readFile(resolveFile(name), LARGEST_FILE);
}

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

// Only displays read the look of a mesh.
canopy::LeafMesh loadPlantMesh(const std::string& file, const std::string& rigid,
                               const FindFile& find) {
  canopy::LeafMesh out = loadMesh(file, MeshAxes::TURNED, rigid, find);
  if (find) return out;
  out.normals.clear();
  out.material.clear();
  out.materials.clear();
  return out;
}

// Reads the pictures that the materials of a mesh name. @param file of the mesh. @param find as
// for loadMesh(). Faults are kept with the materials.
void readPictures(const std::string& file, const FindFile& find,
                  std::vector<canopy::FaceMaterial>& materials) {
  const std::filesystem::path folder = std::filesystem::path(resolveFile(file)).parent_path();
  std::map<std::string, canopy::FaceMaterial> read;
  for (canopy::FaceMaterial& material : materials) {
    if (material.texture.empty()) continue;
    const auto [found, is_new] = read.try_emplace(material.texture);
    if (is_new) {
      try {
        std::string name = material.texture;
        std::replace(name.begin(), name.end(), '\\', '/');
        if (name.find("://") != std::string::npos || name.front() == '*')
          throw InvalidInput("is no file beside the mesh");
        const std::string path = find((folder / name).lexically_normal().string());
        found->second.picture =
            std::make_shared<const std::string>(readFile(path, LARGEST_TEXTURE));
      } catch (const InvalidInput&) {  // its text may show more than the message names
        found->second.fault = "texture " + inQuotes(material.texture) +
                              " cannot be opened here, or has more than " +
                              std::to_string(LARGEST_TEXTURE) + " bytes";
      }
    }
    material.picture = found->second.picture;
    material.fault = found->second.fault;
  }
}

// @param find null: the look of a mesh is not read.
void loadForm(const std::string& file, const FindFile& find, canopy::PlantKind& kind) {
  const bool mesh = kind.shape == canopy::PlantShape::MESH;
  auto form = std::make_shared<canopy::Form>(
      mesh ? canopy::formOf(loadPlantMesh(file, kind.rigid, find), kind.up == canopy::UpAxis::Y)
           : canopy::formOf(loadSlices(file), kind.solid));
  if (find) readPictures(file, find, form->materials);
  kind.radius = form->radius * kind.height;
  kind.form = std::move(form);
}

}  // namespace

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
      loadForm(kind.file, {}, kind);
    } catch (const InvalidInput& error) {
      faults.add("kind " + kind.name + ": " + error.what());
    }
  }
}

void loadPublishedForms(canopy::Layout& layout, const std::vector<std::string>& folders,
                        Faults& faults) {
  const FindFile find = [&](const std::string& path) { return findPublishedFile(path, folders); };
  for (canopy::PlantKind& kind : layout.kinds) {
    if (!canopy::isRead(kind) || kind.file.empty()) continue;
    try {
      const std::string file = findPublishedFile(kind.file, folders);
      try {
        loadForm(file, find, kind);
      } catch (const InvalidInput&) {  // its text may show what is in the file
        throw InvalidInput(inQuotes(kind.file, LONGEST_ADDRESS) + " is no plant here");
      }
    } catch (const InvalidInput& error) {
      faults.add("kind " + kind.name + ": " + error.what());
    }
  }
}

}  // namespace vegetation_sim
