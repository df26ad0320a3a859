// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/canopy/plant_textures.h"

#include <map>

#include "rviz/textures/file_texture.h"
#include "rviz/textures/foliage_texture.h"

namespace vegetation_sim::view {
namespace {

constexpr int PICTURE_EDGE = 256;  // [pixel]

// Returns the mean colour of the pixels that are not transparent.
Vec3 meanOf(const Image& picture) {
  Vec3 sum = Vec3::Zero();
  double weight = 1e-9;
  for (const Rgba& pixel : picture.pixels) {
    const auto alpha = static_cast<double>(pixel[3]);
    for (int k = 0; k < 3; ++k)
      sum[k] += alpha * static_cast<double>(pixel[static_cast<std::size_t>(k)]);
    weight += alpha;
  }
  return sum / weight;
}

}  // namespace

PlantTextures::PlantTextures(const canopy::Layout& layout) {
  std::map<const std::string*, std::pair<int, Vec3>> known;  // materials share bytes of a file
  for (const canopy::PlantKind& kind : layout.kinds) {
    std::vector<Look>& looks = looks_.emplace_back();
    if (!kind.form) continue;
    for (const canopy::FaceMaterial& material : kind.form->materials) {
      Look look;
      look.colour = look.mean = material.colour;
      if (!material.texture.empty()) {
        Vec3 mean = Vec3::Ones();
        const auto found = known.find(material.picture.get());
        if (material.picture && found != known.end())
          look.place = found->second.first, mean = found->second.second;
        else
          look.place = addPicture(kind.name, material, mean);
        if (material.picture) known[material.picture.get()] = {look.place, mean};
        look.mean = look.colour.cwiseProduct(mean);
      }
      looks.push_back(look);
    }
  }
}

// Returns the place in the atlas, or -1 for the plain picture.
int PlantTextures::addPicture(const std::string& kind, const canopy::FaceMaterial& material,
                              Vec3& mean) {
  const auto refuse = [&](const std::string& fault) {
    faults_.push_back("kind " + kind + ": " + fault);
    return -1;
  };
  if (!material.picture) return refuse(material.fault);
  const std::string name = "texture " + inQuotes(material.texture) + " ";
  if (pictures_.size() >= static_cast<std::size_t>(MOST_PICTURES))
    return refuse(name + "is one more than the " + std::to_string(MOST_PICTURES) + " allowed");
  try {
    pictures_.push_back(readPicture(*material.picture, PICTURE_EDGE));
  } catch (const InvalidInput& error) {
    return refuse(name + error.what());
  }
  mean = meanOf(pictures_.back());
  return firstPicturePlace() + static_cast<int>(pictures_.size()) - 1;
}

std::vector<Image> PlantTextures::atlas(int edge) const {
  std::vector<Image> out = foliageAtlas(pictures_.empty() ? edge : PICTURE_EDGE);
  for (std::size_t i = 0; i < pictures_.size(); ++i)
    addToAtlas(pictures_[i], firstPicturePlace() + static_cast<int>(i), out);
  return out;
}

}  // namespace vegetation_sim::view
