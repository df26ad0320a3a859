// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/canopy/layer_images.h"

#include <OgreRenderSystem.h>
#include <OgreRoot.h>
#include <OgreSceneManagerEnumerator.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "rviz/render/ogre_vectors.h"
#include "rviz/render/texture.h"

namespace vegetation_sim::view {
namespace {

constexpr int COLUMNS = 64, ROWS = 48;                // cells of a grid
constexpr double PICTURE_MARGIN = 1.35;               // of a picture, relative to the view
constexpr double FADE = 0.4;                          // [s]
constexpr double SHORTEST_INTERVAL = 0.3;             // [s] between renderings for another eye
constexpr double NEAR_CLIP = 0.1, FAR_CLIP = 2000.0;  // [m]
constexpr double LONGEST_PART = 80.0;                 // [pixel] of a leaf between two points
constexpr double MOST_PARTS = 9.0;                    // of a leaf
constexpr std::size_t MOST_POINTS = 60000;            // leaves that all grids follow from
constexpr std::size_t TRIANGLES_AT_ONCE = 200000;
// Triangles for each pixel of a plant that shares them: further ones are hidden behind these.
constexpr double TRIANGLES_PER_PIXEL = 4.0;

canopy::ImageFrame frameOf(const View& view) {
  canopy::ImageFrame out;
  out.eye = view.eye.position;
  const Vec3 side = cross(view.forward, Vec3::UnitZ());
  const double size = length(side);
  out.axes.right = size > 1e-6 ? Vec3(side / size) : Vec3(-Vec3::UnitY());
  out.axes.out = -view.forward;
  out.axes.up = cross(out.axes.out, out.axes.right);
  out.half_width = PICTURE_MARGIN * view.half_width;
  out.half_height = PICTURE_MARGIN * view.half_height;
  return out;
}

// Returns whether a picture shows all that the view shows, but for its corners.
bool covers(const canopy::ImageFrame& frame, const View& view) {
  const Vec3 ahead = canopy::into(frame.axes, view.forward);
  if (!(ahead.z() < -0.5)) return false;
  const double x = std::fabs(ahead.x() / ahead.z()), y = std::fabs(ahead.y() / ahead.z());
  return x + view.half_width < frame.half_width && y + view.half_height < frame.half_height;
}

}  // namespace

bool LayerImages::isSupported() {
  const Ogre::RenderSystemCapabilities& can =
      *Ogre::Root::getSingleton().getRenderSystem()->getCapabilities();
  return can.hasCapability(Ogre::RSC_VERTEX_PROGRAM) &&
         can.hasCapability(Ogre::RSC_FRAGMENT_PROGRAM) &&
         can.hasCapability(Ogre::RSC_HWRENDER_TO_TEXTURE);
}

LayerImages::LayerImages(Ogre::SceneNode& node, const canopy::Layout& layout, const Vec3& origin,
                         const std::string& leaf_texture, const PlantTextures& textures,
                         const Vec3& to_sun)
    : node_(&node),
      origin_(origin),
      scene_(Ogre::Root::getSingleton().createSceneManager(
          Ogre::DefaultSceneManagerFactory::FACTORY_TYPE_NAME, uniqueName("layers"))),
      camera_(scene_->createCamera(uniqueName("layer_camera"))),
      camera_node_(scene_->getRootSceneNode()->createChildSceneNode()),
      material_(Material::Kind::LEAVES, uniqueName("layered_leaves"), {leaf_texture},
                Material::Variant::LAYERED),
      leaves_(std::make_unique<LeavesAtRest>(*scene_, layout, origin, material_.name(), textures,
                                             to_sun)) {
  camera_node_->attachObject(camera_);
  camera_->setNearClipDistance(static_cast<float>(NEAR_CLIP));
  camera_->setFarClipDistance(static_cast<float>(FAR_CLIP));
}

LayerImages::~LayerImages() {
  for (Pictures* all : {&pictures_, &before_, &coming_}) all->clear();
  leaves_.reset();
  Ogre::Root::getSingleton().destroySceneManager(scene_);
}

void LayerImages::light(const Daylight& daylight, const Haze& haze) {
  material_.light(daylight, daylight.to_sun, haze);
  outdated_ = true;
}

bool LayerImages::isStale(const canopy::Foliage& foliage, const View& view,
                          const Options& options) const {
  if (outdated_) return true;
  if (begun_) return false;
  if (foliage.cutSince() != cut_since_ || foliage.layers() != layers_ || !covers(frame_, view))
    return true;
  return std::any_of(pictures_.begin(), pictures_.end(), [&](const auto& picture) {
    return view.eye.pixels_per_radian * picture->grid().predictedError(view.eye.position) >
           options.tolerance;
  });
}

void LayerImages::update(const canopy::Foliage& foliage,
                         const std::vector<const CanopyPatch*>& patches, const View& view,
                         double now, const Options& options) {
  if (leaves_->choose(patches)) outdated_ = true;
  stale_ = isStale(foliage, view, options);
  if (stale_ && (outdated_ || now - begun_at_ >= SHORTEST_INTERVAL)) {
    begin(foliage, view, options);
    begun_at_ = now;
    stale_ = false;
  }
  if (begun_) work();
  if (begun_ && jobs_.empty()) finish(now);
  for (const Pictures* all : {&pictures_, &before_})
    for (const auto& picture : *all) picture->move(foliage);
  fade(now);
}

void LayerImages::setCamera(const canopy::ImageFrame& frame) {
  Ogre::Quaternion turn;
  turn.FromAxes(toOgre(frame.axes.right), toOgre(frame.axes.up), toOgre(frame.axes.out));
  camera_node_->setPosition(toOgre(frame.eye - origin_));
  camera_node_->setOrientation(turn);
  camera_->setFOVy(Ogre::Radian(2.f * std::atan(static_cast<float>(frame.half_height))));
  camera_->setAspectRatio(static_cast<float>(frame.half_width / frame.half_height));
}

LayerImages::Pictures LayerImages::makePictures(const canopy::Foliage& foliage, const View& view,
                                                const Options& options) {
  std::vector<canopy::LayerGrid> grids(static_cast<std::size_t>(foliage.layers()),
                                       canopy::LayerGrid(frame_, COLUMNS, ROWS));
  const std::size_t stride = 1 + leaves_->leafCount() / MOST_POINTS;
  std::vector<std::size_t> leaves(grids.size(), 0);
  leaves_->eachLeaf(stride, [&](const canopy::Leaf& leaf, std::size_t plant) {
    const auto layer = static_cast<std::size_t>(foliage.layerAt(leaf.anchor));
    leaves[layer] += stride;
    const double pixels = length(leaf.tip - leaf.root) * view.eye.pixels_per_radian /
                          std::max(NEAR_CLIP, frame_.depthOf(leaf.root));
    const int parts = 1 + static_cast<int>(std::min(pixels / LONGEST_PART, MOST_PARTS));
    for (int i = 0; i <= parts; ++i) {
      const Vec3 at = leaf.root + (leaf.tip - leaf.root) * i / parts;
      grids[layer].add({at, leaf.anchor, foliage.freedomOf(at, plant)});
    }
  });
  Pictures out;
  for (std::size_t layer = 0; layer < grids.size(); ++layer) {
    if (leaves[layer] < options.fewest_leaves) continue;
    grids[layer].finish();
    grids[layer].move(foliage);
    if (view.eye.pixels_per_radian * grids[layer].predictedError(view.eye.position) >
        options.tolerance)
      continue;
    out.push_back(std::make_unique<LayerPicture>(std::move(grids[layer]), static_cast<int>(layer),
                                                 origin_, *node_));
  }
  return out;
}

void LayerImages::begin(const canopy::Foliage& foliage, const View& view, const Options& options) {
  frame_ = frameOf(view);
  cut_ = foliage.layerCut();
  cut_since_ = foliage.cutSince();
  layers_ = foliage.layers();
  outdated_ = false;
  begun_ = true;
  jobs_.clear();
  coming_ = makePictures(foliage, view, options);
  for (const auto& picture : coming_) {
    picture->open(view.eye.pixels_per_radian, *camera_);
    addJobs(cut_, *picture, view.eye.pixels_per_radian);
  }
  std::reverse(jobs_.begin(), jobs_.end());
}

// A picture without leaves in it is rendered, too, since it must be cleared.
void LayerImages::addJobs(const canopy::LayerCut& cut, LayerPicture& picture,
                          double pixels_per_radian) {
  const std::array<double, 2> depths = cut.depthsOf(picture.layer());
  std::size_t triangles = TRIANGLES_AT_ONCE;
  for (const LeavesAtRest::Part& part : leaves_->parts()) {
    const double depth = cut.depthOf(part.middle);
    if (depth + part.reach < depths[0] || depth - part.reach >= depths[1]) continue;
    std::size_t most = part.batch->triangleCount();
    if (part.area > 0.0) {
      const double near = std::max(NEAR_CLIP, frame_.depthOf(part.middle) - part.reach);
      const double pixels = part.area * std::pow(pixels_per_radian / near, 2);
      most = std::min(most, static_cast<std::size_t>(TRIANGLES_PER_PIXEL * pixels) + 100);
      part.batch->limit(most);
    }
    if (jobs_.empty() || jobs_.back().picture != &picture || triangles + most > TRIANGLES_AT_ONCE) {
      jobs_.push_back({&picture, {}});
      triangles = 0;
    }
    triangles += most;
    jobs_.back().parts.push_back(part.batch);
  }
  if (jobs_.empty() || jobs_.back().picture != &picture) jobs_.push_back({&picture, {}});
}

// Renders for one update.
void LayerImages::work() {
  setCamera(frame_);
  for (const LeavesAtRest::Part& part : leaves_->parts()) part.batch->setVisible(false);
  std::size_t triangles = 0;
  while (!jobs_.empty() && triangles < TRIANGLES_AT_ONCE) {
    const Job job = std::move(jobs_.back());
    jobs_.pop_back();
    material_.setLayer(-cut_.axes().out, cut_.depthOf(origin_),
                       cut_.depthsOf(job.picture->layer()));
    for (Batch* part : job.parts) {
      part->setVisible(true);
      triangles += part->triangleCount();
    }
    job.picture->render();
    for (Batch* part : job.parts) part->setVisible(false);
  }
}

void LayerImages::finish(double now) {
  begun_ = false;
  fade_from_ = now;
  ++renderings_;
  before_ = std::exchange(pictures_, std::exchange(coming_, {}));
  pictured_.assign(static_cast<std::size_t>(layers_), false);
  // The layers may be cut for an eye on the other side, so that its last layer is the first here.
  const bool turned = cut_.depthOf(frame_.eye - frame_.axes.out) < cut_.depthOf(frame_.eye);
  for (const auto& picture : pictures_) {
    picture->finish(turned ? picture->layer() : layers_ - 1 - picture->layer());
    pictured_[static_cast<std::size_t>(picture->layer())] = true;
  }
}

void LayerImages::fade(double now) {
  if (before_.empty()) return;
  const double part = (now - fade_from_) / FADE;
  if (part >= 1.0 || pictures_.empty()) before_.clear();
  const auto shown = before_.empty() ? 1.f : static_cast<float>(std::max(0.0, part));
  for (const auto& picture : pictures_) picture->show(shown);
}

}  // namespace vegetation_sim::view
