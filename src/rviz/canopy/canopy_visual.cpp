// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/canopy/canopy_visual.h"

#include <OgreSceneManager.h>
#include <ros/time.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "rviz/ground/shadow_painter.h"
#include "rviz/textures/bark_texture.h"
#include "rviz/textures/foliage_texture.h"

namespace vegetation_sim::view {
namespace {

constexpr int LEAF_EDGE = 128, BARK_EDGE = 256;  // [pixel]
constexpr double PATCH = 5.0;                    // [m] edge of a patch
constexpr double SHADOW_MARGIN = 1.0;            // [m] for large leaves and soft shadows
constexpr double LOWEST_SUN = 0.15;              // as castShadows(): lower ones are as long
constexpr std::size_t MOST_READ_LEAVES = 1000000;
constexpr double STILL = 1e-4;  // [m], [rad] a viewer moves without effect

// Painted once per process.
const std::vector<Image>& sharedFoliage() {
  static const std::vector<Image> atlas = foliageAtlas(LEAF_EDGE);
  return atlas;
}

const std::vector<Image>& sharedStems() {
  static const std::vector<Image> atlas = mipmaps(barkAtlas(BARK_EDGE), 16);
  return atlas;
}

using Cells = std::map<std::pair<int, int>, std::vector<std::size_t>>;

Cells cellsOf(const canopy::Layout& layout) {
  Cells out;
  for (std::size_t i = 0; i < layout.plants.size(); ++i) {
    const Vec3& at = layout.plants[i].position;
    out[{static_cast<int>(std::floor(at.x() / PATCH)),
         static_cast<int>(std::floor(at.y() / PATCH))}]
        .push_back(i);
  }
  return out;
}

// Returns the wanted number of leaves: fewer if leaves are smaller than the tolerance.
double wantedOf(const CanopyPatch& patch, const View& view, float tolerance) {
  const double distance = length(patch.middle() - view.eye.position) - 0.5 * patch.reach();
  const double pixels = patch.leafSize() * pixelsPerMetre(view.eye, distance);
  const double share = std::min(1.0, pixels / std::max(0.1, static_cast<double>(tolerance)));
  return share * share * static_cast<double>(patch.leafCount());
}

bool touch(const Extent& a, const Extent& b) {
  return a.low.x() <= b.high.x() && b.low.x() <= a.high.x() && a.low.y() <= b.high.y() &&
         b.low.y() <= a.high.y();
}

}  // namespace

CanopyVisual::CanopyVisual(Ogre::SceneNode& parent, const SubscribedCanopy& canopy,
                           const Vec3& to_sun)
    : frame_(canopy.frame()),
      to_sun_(to_sun),
      node_(parent.createChildSceneNode()),
      textures_(canopy.replica()->layout()),
      leaf_texture_(uniqueName("foliage_picture"),
                    textures_.empty() ? sharedFoliage() : textures_.atlas(LEAF_EDGE)),
      stem_texture_(uniqueName("stem_picture"), sharedStems()),
      leaf_material_(Material::Kind::LEAVES, uniqueName("foliage_material"),
                     {leaf_texture_.name()}),
      stem_material_(Material::Kind::BARK, uniqueName("stem_material"), {stem_texture_.name()}) {
  layout_ = canopy.replica()->layout();
  const canopy::Layout& layout = layout_;
  thinForms();
  const std::vector<LeafedCrowns::Crown>& crowns = canopy.crowns().crowns();
  if (!layout.plants.empty())
    origin_ = layout.plants.front().position;
  else if (!crowns.empty())
    origin_ = crowns.front().box.low;
  extent_ = {origin_, origin_};
  node_->setPosition(static_cast<float>(origin_.x()), static_cast<float>(origin_.y()),
                     static_cast<float>(origin_.z()));
  for (const auto& [cell, plants] : cellsOf(layout)) add(patchOf(*canopy.replica(), plants));
  for (std::size_t i = 0; i < crowns.size(); ++i)
    add(std::make_unique<CanopyPatch>(layout, crowns[i], i, patchScene()));
  report_.plants = layout.plants.size();
  report_.crowns = crowns.size();
}

PatchScene CanopyVisual::patchScene() const {
  return {origin_,    node_, leaf_material_.name(), stem_material_.name(), to_sun_,
          &textures_, frame_};
}

// Leaf by leaf, plants that are read from files have together at most MOST_READ_LEAVES leaves,
// which are larger. Pictures show all.
void CanopyVisual::thinForms() {
  thinned_ = layout_;
  std::size_t leaves = 0;
  for (const canopy::Plant& plant : layout_.plants)
    if (isRead(layout_.kinds[plant.kind])) leaves += canopy::leafCount(layout_.kinds[plant.kind]);
  const std::size_t stride = 1 + leaves / MOST_READ_LEAVES;
  if (stride == 1) return;
  for (canopy::PlantKind& kind : thinned_.kinds) {
    if (!kind.form) continue;
    auto form = std::make_shared<canopy::Form>();
    form->radius = kind.form->radius;
    form->rigid = kind.form->rigid;
    form->looks = kind.form->looks;
    form->materials = kind.form->materials;
    for (std::size_t i = 0; i < kind.form->leaves.size(); i += stride) {
      form->leaves.push_back(kind.form->leaves[i]);
      form->leaves.back().side *= std::sqrt(static_cast<double>(stride));
    }
    kind.form = form;
  }
}

void CanopyVisual::add(std::unique_ptr<CanopyPatch> patch) {
  const Vec3 around = Vec3::Constant(patch->reach());
  extent_.low = extent_.low.cwiseMin(patch->middle() - around);
  extent_.high = extent_.high.cwiseMax(patch->middle() + around);
  report_.leaves += patch->leafCount();
  patches_.push_back(std::move(patch));
}

std::unique_ptr<CanopyPatch> CanopyVisual::patchOf(const canopy::Replica& canopy,
                                                   const std::vector<std::size_t>& plants) const {
  std::vector<double> heights;
  for (const std::size_t plant : plants) heights.push_back(canopy.cutHeight(plant));
  return std::make_unique<CanopyPatch>(thinned_, plants, heights, patchScene());
}

// Makes the patches anew in which plants have been cut, or are in other light.
void CanopyVisual::updatePatches(const canopy::Replica& canopy, bool relit) {
  for (std::unique_ptr<CanopyPatch>& patch : patches_) {
    const bool is_cut = patch->isOutdated(canopy);
    if (!is_cut && !(relit && patch->isInOtherLight())) continue;
    if (images_) images_->dropPatches();
    report_.leaves -= patch->leafCount();
    patch = patchOf(canopy, patch->plants());
    report_.leaves += patch->leafCount();
    if (is_cut) cut_areas_.push_back(shadowOf(*patch));
  }
}

// Returns the area that plants of a patch, cut or not, can shade. Ground that falls away from them
// makes shadows longer.
Extent CanopyVisual::shadowOf(const CanopyPatch& patch) const {
  const Vec3 around = Vec3::Constant(patch.reach() + SHADOW_MARGIN);
  const Vec3 shift = to_sun_ * (-2.0 * patch.tallest() / std::max(to_sun_.z(), LOWEST_SUN));
  const Vec3 low = patch.middle() - around, high = patch.middle() + around;
  return {low.cwiseMin(low + shift), high.cwiseMax(high + shift)};
}

CanopyVisual::~CanopyVisual() {
  images_.reset();
  patches_.clear();
  node_->getCreator()->destroySceneNode(node_);
}

void CanopyVisual::light(const Daylight& daylight, const Haze& haze) {
  leaf_material_.light(daylight, daylight.to_sun, haze);
  stem_material_.light(daylight, daylight.to_sun, haze);
  daylight_ = daylight;
  haze_ = haze;
  if (images_) images_->light(daylight, haze);
}

void CanopyVisual::repaint() {
  changes_ = -1;
  if (images_) images_->renderAgain();
}

// Returns for each layer whether a picture shows it; nothing if there are no pictures. Crowns hang
// on wood that moves, and bodies push plants as no picture shows it.
const std::vector<bool>& CanopyVisual::updatePictures(const canopy::Foliage& foliage,
                                                      const View& view,
                                                      const LayerImages::Options& options) {
  static const std::vector<bool> none;
  const bool wanted = options.tolerance > 0.0 && LayerImages::isSupported() &&
                      foliage.warp().method == canopy::WarpMethod::WARP;
  if (!wanted) {
    images_.reset();
    return none;
  }
  if (!images_) {
    images_ = std::make_unique<LayerImages>(*node_, layout_, origin_, leaf_texture_.name(),
                                            textures_, to_sun_);
    images_->light(daylight_, haze_);
  }
  std::vector<const CanopyPatch*> upright;
  for (const auto& patch : patches_)
    if (!patch->crown() && !patch->isBent(foliage)) upright.push_back(patch.get());
  images_->update(foliage, upright, view, ros::WallTime::now().toSec(), options);
  return images_->pictured();
}

// Returns the visible patches. Near ones come first because they hide others. Plants that bodies
// have pushed to the ground reach farther.
std::vector<CanopyPatch*> CanopyVisual::inPicture(const View& view, bool bent) const {
  std::vector<CanopyPatch*> out;
  for (const auto& patch : patches_)
    if (view.sees(patch->middle(), 1.3 * patch->reach() + (bent ? patch->tallest() : 0.0)))
      out.push_back(patch.get());
  std::sort(out.begin(), out.end(), [&](const CanopyPatch* a, const CanopyPatch* b) {
    return length(a->middle() - view.eye.position) < length(b->middle() - view.eye.position);
  });
  return out;
}

void CanopyVisual::update(SubscribedCanopy& canopy, Nanoseconds stamp, const View& view,
                          const Options& options) {
  const bool swayed = report_.crowns > 0 && stamp != stamp_;
  const bool fades = images_ && images_->isBusy();
  const bool relit = lights_ != SharedLight::changes();
  if (!swayed && !fades && !relit && changes_ == canopy.changes() && share_ == options.share &&
      length(eye_ - view.eye.position) < STILL && length(forward_ - view.forward) < STILL)
    return;
  changes_ = canopy.changes();
  share_ = options.share;
  stamp_ = stamp;
  eye_ = view.eye.position;
  forward_ = view.forward;
  lights_ = SharedLight::changes();
  updatePatches(*canopy.replica(), relit);
  const canopy::Foliage& foliage = canopy.replica()->foliage();
  const std::vector<bool>& pictured = updatePictures(foliage, view, options.pictures);
  const std::vector<CanopyPatch*> seen = inPicture(view, foliage.anyBent());
  double wanted = 0.0;
  for (const CanopyPatch* patch : seen) wanted += wantedOf(*patch, view, options.tolerance);
  const double share = options.share * std::min(1.0, static_cast<double>(options.most_leaves) /
                                                         std::max(1.0, wanted));
  report_.drawn = 0;
  int rank = 0;
  for (CanopyPatch* patch : seen) {
    patch->setRank(rank++);
    const auto count =
        static_cast<std::size_t>(share * wantedOf(*patch, view, options.tolerance) + 0.5);
    if (const auto& crown = patch->crown())
      patch->move(foliage, canopy.crowns().crowns()[*crown], canopy.wood(*crown, stamp), count);
    else
      patch->move(foliage, count, patch->isBent(foliage) ? std::vector<bool>() : pictured);
    report_.drawn += patch->drawn();
  }
  report_.layers = foliage.layers();
  report_.pictures = static_cast<int>(std::count(pictured.begin(), pictured.end(), true));
  report_.renderings = images_ ? images_->renderings() : 0;
  ++report_.rebuilds;
}

Plot CanopyVisual::plot() const {
  return plotAround(extent_);
}

Shade CanopyVisual::shadeOn(const Plot& plot, int edge, const Window& window,
                            const terrain::HeightMap& ground, const Vec3& to_sun) const {
  const double pixel = plot.edge / edge;
  const Vec3 corner(plot.x + pixel * window.column, plot.y + pixel * window.row, 0.0);
  const Extent seen{corner, corner + pixel * Vec3(window.columns, window.rows, 0.0)};
  std::vector<const CanopyPatch*> near;
  for (const auto& patch : patches_)
    if (patch->crown() || touch(shadowOf(*patch), seen)) near.push_back(patch.get());
  Shade out;
  out.sun = castShadows(plot, edge, window, ground, to_sun, [&](const ShadowDrop& drop) {
    for (const CanopyPatch* patch : near) patch->setShadows(drop);
  });
  // Light of the sky comes from the zenith, with soft shadows.
  const std::vector<float> zenith =
      castShadows(plot, edge, window, ground, Vec3::UnitZ(), [&](const ShadowDrop& drop) {
        for (const CanopyPatch* patch : near)
          patch->setShadows([&](const Vec3& at, double radius, double depth) {
            drop(at, 3.0 * radius, 0.1 * depth);
          });
      });
  out.sky = [plot, edge, window, zenith](const Vec3& at) {
    const auto pixelOf = [&](double x) { return static_cast<int>(x / plot.edge * edge); };
    const int column = std::clamp(pixelOf(at.x() - plot.x) - window.column, 0, window.columns - 1);
    const int row = std::clamp(pixelOf(at.y() - plot.y) - window.row, 0, window.rows - 1);
    return static_cast<double>(zenith[static_cast<std::size_t>(row * window.columns + column)]);
  };
  return out;
}

}  // namespace vegetation_sim::view
