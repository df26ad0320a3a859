// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/plants/plant_masks.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim::scan {
namespace {

// A JPEG has no alpha: it is opaque, without a fault.
bool looksLikeJpeg(const std::string& bytes) {
  return bytes.compare(0, 3, "\xff\xd8\xff") == 0;
}

std::vector<std::shared_ptr<const std::string>> picturesOf(const canopy::Layout& layout) {
  std::vector<std::shared_ptr<const std::string>> out;
  for (const canopy::PlantKind& kind : layout.kinds) {
    if (!kind.form) continue;
    for (const canopy::FaceMaterial& material : kind.form->materials)
      if (!material.texture.empty()) out.push_back(material.picture);
  }
  return out;
}

// Returns the weights of the corners root - low, root + low and tip of a face at a place on it; all
// are 0 if it has no area.
std::array<double, 3> weightsAt(const Vec3& place, const Strip& face) {
  const Vec3 corner = face.root - face.low, arm = place - corner;
  const Vec3 across = 2.0 * face.low, up = face.tip - corner;
  const Vec3 normal = cross(across, up);
  const double square = dot(normal, normal);
  if (!(square > 0.0)) return {};
  const double right = dot(cross(arm, up), normal) / square;
  const double top = dot(cross(across, arm), normal) / square;
  return {1.0 - right - top, right, top};
}

}  // namespace

bool KindMasks::isHole(const canopy::Leaf& face, const Strip& strip, const Vec3& place) const {
  if (face.look == 0) return false;
  const canopy::FaceLook& look = form->looks[face.look - 1];
  const auto& mask = of_material[look.material];
  if (!mask) return false;
  const std::array<double, 3> weights = weightsAt(place, strip);
  double u = 0.0, v = 0.0;
  for (std::size_t corner = 0; corner < 3; ++corner) {
    u += weights[corner] * double{look.uv[corner][0]};
    v += weights[corner] * double{look.uv[corner][1]};
  }
  return !mask->isOpaqueAt(u, v);
}

PlantMasks::PlantMasks(const canopy::Layout& layout) : pictures_(picturesOf(layout)) {
  std::map<const std::string*, Mask> known;  // materials share the bytes of a file
  for (const canopy::PlantKind& kind : layout.kinds) {
    auto masks = std::make_shared<KindMasks>();
    masks->form = kind.form;
    if (kind.form)
      for (const canopy::FaceMaterial& material : kind.form->materials) {
        const auto found = known.find(material.picture.get());
        const bool is_known = material.picture && found != known.end();
        masks->of_material.push_back(is_known ? found->second : read(kind.name, material));
        if (material.picture) known[material.picture.get()] = masks->of_material.back();
      }
    const bool opaque = std::none_of(masks->of_material.begin(), masks->of_material.end(),
                                     [](const Mask& mask) { return mask != nullptr; });
    kinds_.push_back(opaque ? nullptr : std::move(masks));
  }
}

bool PlantMasks::areOf(const canopy::Layout& layout) const {
  return pictures_ == picturesOf(layout);
}

// Returns null for what is opaque.
PlantMasks::Mask PlantMasks::read(const std::string& kind, const canopy::FaceMaterial& material) {
  const auto refuse = [&](const std::string& fault) {
    faults_.push_back("kind " + kind + ": " + fault);
    return nullptr;
  };
  if (material.texture.empty()) return nullptr;
  if (!material.picture) return refuse(material.fault);
  if (looksLikeJpeg(*material.picture)) return nullptr;
  const std::string name = "texture " + inQuotes(material.texture) + " ";
  if (count_ >= MOST_MASKS)
    return refuse(name + "is one more than the " + std::to_string(MOST_MASKS) + " allowed");
  try {
    auto mask =
        std::make_shared<terrain::OpacityMask>(terrain::parseOpacityMask(*material.picture));
    if (mask->empty()) return nullptr;
    ++count_;
    return mask;
  } catch (const InvalidInput& error) {
    return refuse(name + error.what());
  }
}

}  // namespace vegetation_sim::scan
