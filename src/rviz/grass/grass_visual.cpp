// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/grass/grass_visual.h"

#include <OgreSceneManager.h>

#include <algorithm>
#include <cmath>

#include "rviz/grass/blade_shade.h"
#include "rviz/grass/strip_cover.h"
#include "rviz/ground/blob_visual.h"
#include "rviz/ground/meadow_texture.h"
#include "rviz/render/batch.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::view {
namespace {

constexpr int STRIP_COLUMNS = 512, STRIP_ROWS = 128, STRIP_BLADES = 130, LAYER_EDGE = 128;
constexpr int ROWS = 3;                // of strips in a tile, each way
constexpr double STILL = 1e-4;         // [m], [rad] a viewer moves without effect
constexpr double LARGEST_FADE = 0.05;  // part of a transition between two updates
constexpr double FULLY_GROWN = 0.3;    // missing share with full strips
constexpr double BORDER = 0.07;  // part of the map over which strips get fewer towards its border
constexpr double LEAST_AT_BORDER = 0.2;  // share of the strips
constexpr double SIBLING_SPREAD = 0.6;   // per distance of neighbours

// Painted once per process.
const std::vector<Image>& sharedStrips() {
  static const std::vector<Image> pictures = stripPictures(STRIP_COLUMNS, STRIP_ROWS, STRIP_BLADES);
  return pictures;
}

const std::vector<Image>& sharedLayers() {
  static const std::vector<Image> pictures = layerPictures(LAYER_EDGE);
  return pictures;
}

Viewpoint eyeOf(const View& view) {
  Viewpoint out;
  out.position = view.eye.position;
  out.pixels_per_radian = view.eye.pixels_per_radian;
  out.forward = view.forward;
  out.cone_cosine = std::cos(view.half_angle);
  return out;
}

Vec3 originOf(const grass::MapLaw& law, const terrain::HeightMap& terrain) {
  const double x = law.origin_x + 0.5 * law.resolution * (law.columns - 1);
  const double y = law.origin_y + 0.5 * law.resolution * (law.rows - 1);
  return {x, y, terrain.height(x, y)};
}

// A tile between texture and blades passes strips, so its target must be compared.
bool haveArrived(const grass::MeadowLodSnapshot& memory, double transition) {
  return std::all_of(memory.levels.begin(), memory.levels.end(),
                     [&](const grass::TileLevel& level) {
                       return placeAt(level.tier, memory.stamp, transition) ==
                              static_cast<double>(level.tier.target);
                     });
}

// Blades slide where strips on edges take over from them (S2-12). Rows and layers are spread over
// the tile as the blades are: blades that only become narrower change the picture less than blades
// that also move, to the same picture in the end.
double slideOf(const grass::TileView& tile, const GrassVisual::Options& options) {
  if (!options.strips || !options.edge_strips) return 0.0;
  return tile.morph.slide * (1.0 - grass::layerWeight(tile.elevation));
}

double squareDistance(const grass::TileView& tile, const grass::MapLaw& law, const Vec3& eye) {
  const double x = law.origin_x + law.resolution * (tile.column + 0.5) - eye.x();
  const double y = law.origin_y + law.resolution * (tile.row + 0.5) - eye.y();
  return x * x + y * y;
}

// Returns the share of strips at a distance from the border of the map, where a meadow that looks
// cut off would look like an island.
double borderShare(const grass::TileView& tile, const grass::MapLaw& law) {
  const int column = std::min(tile.column, law.columns - 2 - tile.column);
  const int row = std::min(tile.row, law.rows - 2 - tile.row);
  const double inside = law.resolution * (std::min(column, row) + 0.5);
  const double border = BORDER * law.resolution * (std::min(law.columns, law.rows) - 1);
  return LEAST_AT_BORDER + (1.0 - LEAST_AT_BORDER) * saturate(inside / border);
}

void paint(grass::GrassMesh& mesh, std::uint8_t red, std::uint8_t blue) {
  for (std::size_t i = 0; i + 3 < mesh.colours.size(); i += 4) {
    mesh.colours[i] = std::max(mesh.colours[i], red);
    mesh.colours[i + 2] = std::max(mesh.colours[i + 2], blue);
  }
}

}  // namespace

GrassVisual::GrassVisual(Ogre::SceneNode& parent, const SubscribedMeadow& meadow)
    : node_(parent.createChildSceneNode()),
      origin_(originOf(meadow.layout().map->law(), *meadow.terrain())),
      levels_(meadow.layout().map, meadow.terrain(), meadow.layout().seed, grass::MeadowSettings()),
      full_density_(fullDensity(*meadow.layout().map)),
      strip_texture_(uniqueName("strip_picture"), sharedStrips()),
      layer_texture_(uniqueName("layer_picture"), sharedLayers()),
      blade_material_(Material::Kind::BLADES, uniqueName("blade_material"), {}),
      strip_material_(Material::Kind::STRIPS, uniqueName("strip_material"),
                      {strip_texture_.name()}),
      layer_material_(Material::Kind::STRIPS, uniqueName("layer_material"),
                      {layer_texture_.name()}),
      blades_(uniqueName("blades"), blade_material_.name(), 0),
      strips_(uniqueName("strips"), strip_material_.name(), 1),
      layers_(uniqueName("layers"), layer_material_.name(), 2) {
  node_->setPosition(static_cast<float>(origin_.x()), static_cast<float>(origin_.y()),
                     static_cast<float>(origin_.z()));
  for (GrassBatch* batch : {&blades_, &strips_, &layers_}) node_->attachObject(batch);
  for (grass::GrassMesh* mesh : {&blade_mesh_, &strip_mesh_, &layer_mesh_}) mesh->origin = origin_;
  report_.tiles = static_cast<std::size_t>(levels_.map().tileColumns()) *
                  static_cast<std::size_t>(levels_.map().tileRows());
}

GrassVisual::~GrassVisual() {
  node_->detachAllObjects();
  node_->getCreator()->destroySceneNode(node_);
}

void GrassVisual::light(const Daylight& daylight, const Haze& haze) {
  light_ = grassLight(daylight);
  for (Material* material : {&blade_material_, &strip_material_, &layer_material_})
    material->light(daylight, daylight.to_sun, haze);
  repaint();
}

bool GrassVisual::isDrawn(const Drawn& wanted) const {
  return drawn_.settled && drawn_.stamp == wanted.stamp && drawn_.changes == wanted.changes &&
         length(drawn_.eye - wanted.eye) < STILL && length(drawn_.forward - wanted.forward) < STILL;
}

void GrassVisual::update(const SubscribedMeadow& meadow, Nanoseconds stamp, double wall,
                         const View& view, const Options& options) {
  Drawn wanted{stamp, meadow.changes(), view.eye.position, view.forward, 0, true};
  if (isDrawn(wanted)) return;
  const Viewpoint eye = eyeOf(view);
  levels_.setSettings(options.levels);
  levels_.setViewpoints({eye});
  const Nanoseconds now = levelClock(wall, options.levels.transition);
  levels_.advance(now);
  const std::vector<grass::TileView> tiles = levels_.viewOf(eye, now);
  wanted.settled = haveArrived(levels_.snapshot(), options.levels.transition);
  build(meadow, stamp, view, tiles, options);
  // The picture is settled only if the number of blades has not changed either.
  wanted.blades = report_.blades;
  const std::size_t gap =
      std::max(drawn_.blades, wanted.blades) - std::min(drawn_.blades, wanted.blades);
  wanted.settled = wanted.settled && drawn_.stamp == stamp && drawn_.eye == wanted.eye &&
                   500 * gap <= wanted.blades;
  drawn_ = wanted;
  ++report_.rebuilds;
}

// The clock is wall time, but slower at a low frame rate, to avoid steps.
Nanoseconds GrassVisual::levelClock(double wall, double transition) {
  const double passed = std::max(wall - wall_, 0.0);
  clock_ += transition > 0.0 ? std::min(passed, LARGEST_FADE * transition) : passed;
  wall_ = wall;
  return fromSeconds(clock_);
}

// Near tiles are drawn first because they hide others.
void GrassVisual::build(const SubscribedMeadow& meadow, Nanoseconds stamp, const View& view,
                        const std::vector<grass::TileView>& tiles, const Options& options) {
  std::vector<grass::TileView> sorted = tiles;
  const Vec3& eye = view.eye.position;
  const grass::MapLaw& law = levels_.map().law();
  std::sort(sorted.begin(), sorted.end(), [&](const auto& a, const auto& b) {
    return squareDistance(a, law, eye) < squareDistance(b, law, eye);
  });
  std::vector<grass::TilePlace> places;
  places.reserve(sorted.size());
  for (const grass::TileView& tile : sorted) places.push_back({tile.column, tile.row});
  grass::NodeWind air(levels_.map(), levels_.terrain());
  air.update(meadow.wind().at(stamp), meadow.colours().at(stamp),
             grass::MeadowLod::windowOf(sorted), &places);
  for (grass::GrassMesh* mesh : {&blade_mesh_, &strip_mesh_, &layer_mesh_}) mesh->clear();
  report_.blades = report_.bladed = report_.stripped = 0;
  reach_ = 0.f;
  const BladeShade shade(law, BlobVisual::shadowsOf(node_->getCreator(), meadow.frame()));
  for (const grass::TileView& tile_view : sorted) {
    grass::TileMotion motion;
    const grass::Tile tile = levels_.tileAt(tile_view, air, meadow.tread(), stamp, patch_, motion);
    motion.model = meadow.layout().blade_model;
    const double distance = std::sqrt(squareDistance(tile_view, law, eye));
    const BladeWidths widths = widthsOf(tile_view, distance, options.strips);
    const bool bladed = tile_view.morph.blades && options.blades;
    if (bladed) {
      const std::size_t first = blade_mesh_.vertexCount();
      addBlades(tile, motion, tile_view, widths, eye, options);
      shade.darken(tile_view.column, tile_view.row, first, blade_mesh_);
      reach_ = std::max(reach_, static_cast<float>(distance * (1.0 - tile_view.morph.strip)));
    }
    if (options.strips) addFlat(tile, motion, tile_view, bladed ? widths.missing : 0.0, options);
  }
  if (options.colour_by_level) tint(options);
  blades_.fill(blade_mesh_);
  strips_.fill(strip_mesh_);
  layers_.fill(layer_mesh_);
  report_.trodden = meadow.tread().state().blocks.size();
  report_.triangles =
      (blade_mesh_.indices.size() + strip_mesh_.indices.size() + layer_mesh_.indices.size()) / 3;
}

void GrassVisual::addBlades(const grass::Tile& tile, const grass::TileMotion& motion,
                            const grass::TileView& view, const BladeWidths& widths, const Vec3& eye,
                            const Options& options) {
  const int count = static_cast<int>(std::lround(tile.blades * view.share * widths.kept));
  blocks_.resize(static_cast<std::size_t>(grass::blocksFor(count)));
  poseBlades(tile, motion, count, blocks_.data());
  grass::RibbonStyle style;
  style.segments = view.segments;
  style.leaving = widths.leaving;
  // They have width 0 where strips are fully grown.
  const double left = 1.0 - view.morph.strip * view.morph.strip;
  style.width = widths.own * left;
  style.slide = slideOf(view, options);
  style.eye = eye;
  style.light = &light_;
  style.crush = motion.crush;
  style.variety = options.variety;
  if (widths.beside > 0.0) style.segments = std::max(2, style.segments - 1);
  appendRibbons(levels_.map(), tile, blocks_.data(), count, style, blade_mesh_);
  if (widths.beside > 0.0) {
    style.width = widths.beside * left;
    style.segments = std::max(1, std::min(2, style.segments - 1));
    style.spread = SIBLING_SPREAD * tile.size / std::sqrt(std::max(1, count));
    style.sibling = 1;
    appendRibbons(levels_.map(), tile, blocks_.data(), count, style, blade_mesh_);
  }
  report_.blades += static_cast<std::size_t>(count);
  ++report_.bladed;
}

// Adds strips for a view from the side, and layers for a view from above. Among blades, strips grow
// with the share of the grass that these do not cover.
void GrassVisual::addFlat(const grass::Tile& tile, const grass::TileMotion& motion,
                          const grass::TileView& view, double missing, const Options& options) {
  const double from_above = grass::layerWeight(view.elevation);
  // Without single blades strips take their place.
  const double strip = view.morph.blades && !options.blades ? 1.0 : view.morph.strip;
  const double beside = smoothStep(missing / FULLY_GROWN);
  const double upright = (strip + beside * (1.0 - strip)) * (1.0 - from_above);
  const StripsBegin begin(strip_mesh_);
  if (upright > 0.0 && options.edge_strips)
    appendStrips(levels_.map(), tile, motion, upright, full_density_, strip_mesh_, &light_);
  else if (upright > 0.0)
    appendRows(levels_.map(), tile, motion, ROWS, upright, full_density_, strip_mesh_, &light_);
  varyStrips(tile, begin, strip_mesh_);
  const double share = 1.0 - beside * (1.0 - missing) * (1.0 - strip);
  thinStrips(tile, begin, share * borderShare(view, levels_.map().law()), strip_mesh_);
  if (from_above > 0.0 && strip > 0.0)
    appendLayers(levels_.map(), tile, motion, view.layers, strip * from_above, full_density_,
                 layer_mesh_, &light_);
  if (strip > 0.0) ++report_.stripped;
}

void GrassVisual::tint(const Options&) {
  paint(blade_mesh_, 230, 0);
  paint(strip_mesh_, 0, 230);
  paint(layer_mesh_, 120, 230);
}

}  // namespace vegetation_sim::view
