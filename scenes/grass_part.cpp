// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/grass_part.h"

#include <algorithm>

#include "grass/tread/tread_recovery.h"
#include "reference/grass/blade_plain.h"

namespace vegetation_sim::scenes {

GrassPart::GrassPart(const Scenario& scenario)
    : tread_(scenario.grass->layout.map->law(), scenario.grass->treading),
      field_(scenario.grass->layout, scenario.terrain, scenario.grass->treading, tread_),
      meadow_(scenario.grass->layout.map, scenario.terrain, scenario.grass->layout.seed,
              scenario.grass_levels),
      shown_tread_(scenario.grass->layout.map->law(), scenario.grass->treading),
      wind_(scenario.wind) {}

grass::TreadInput GrassPart::inputOf(const std::string& source, grass::TreadAction action) const {
  grass::TreadInput out;
  out.source = source;
  out.action = action;
  out.law = field_.layout().tread;
  out.body_frame = source + "_link";
  return out;
}

void GrassPart::tread(const std::string& source, double x, double y, Nanoseconds stamp) {
  grass::TreadInput input = inputOf(source, grass::TreadAction::MOVE);
  input.position = Vec3(x, y, field_.terrain().height(x, y));
  field_.apply(input, stamp);
}

void GrassPart::stroke(const std::string& source, const Vec3& from, const Vec3& to,
                       Nanoseconds stamp) {
  grass::TreadInput input = inputOf(source, grass::TreadAction::STROKE);
  input.start = from;
  input.position = to;
  field_.apply(input, stamp);
}

void GrassPart::lift(const std::string& source, Nanoseconds stamp) {
  field_.apply(inputOf(source, grass::TreadAction::LIFT), stamp);
}

void GrassPart::advance(Nanoseconds stamp, bool key_frame) {
  const bool is_new_second = stamp / NANOSECONDS_PER_SECOND != stamp_ / NANOSECONDS_PER_SECOND;
  stamp_ = stamp;
  field_.advance(stamp);
  replica_.apply(field_.update(key_frame), shown_tread_);
  meadow_.setViewpoints({eye_});
  meadow_.advance(stamp);
  if (is_new_second) shown_tread_.prune(stamp);
}

void GrassPart::addTo(Hashes& hashes) {
  hashes.state.add(field_.snapshot().hash());
  Hash display;
  meadow_.snapshot().addTo(display);
  display.add(shown_tread_.state().hash());
  hashes.display.add(display.value());
  for (const grass::Drag& drag : field_.drags()) hashes.reference.add(drag.force);
  std::vector<grass::TileView> views = meadow_.viewOf(eye_, stamp_);
  std::vector<grass::TilePlace> tiles;
  for (const grass::TileView& view : views) tiles.push_back({view.column, view.row});
  grass::NodeWind air(meadow_.map(), meadow_.terrain());
  air.update(wind_.at(stamp_), {}, grass::MeadowLod::windowOf(views), &tiles);
  mesh_.clear();
  for (const grass::TileView& view : views) draw(view, air, hashes);
  addFloats(mesh_.positions.data(), mesh_.positions.size(), hashes.display);
}

void GrassPart::draw(const grass::TileView& view, const grass::NodeWind& air, Hashes& hashes) {
  grass::TileMotion motion;
  grass::CrushPatch patch;
  const grass::Tile tile = meadow_.tileAt(view, air, shown_tread_, stamp_, patch, motion);
  if (view.morph.blades) {
    const int count = static_cast<int>(tile.blades * view.share);
    blocks_.resize(static_cast<std::size_t>(grass::blocksFor(count)));
    grass::poseBlades(tile, motion, count, blocks_.data());
    grass::RibbonStyle style;
    style.segments = view.segments;
    style.slide = view.morph.slide;
    style.width = 1.0 / view.share;
    style.eye = eye_.position;
    grass::appendRibbons(meadow_.map(), tile, blocks_.data(), count, style, mesh_);
    for (int blade = 0; blade < std::min(count, 3); ++blade)
      for (const double x : grass::poseReference(tile, motion, blade).x) hashes.reference.add(x);
  }
  if (view.morph.strip > 0.0)
    grass::appendStrips(meadow_.map(), tile, motion, view.morph.strip, 1000.0, mesh_);
}

double GrassPart::crushedArea() const {
  std::size_t nodes = 0;
  for (const auto& [place, block] : tread_.state().blocks)
    for (const grass::TreadNode& node : block.nodes) nodes += grass::tiltAt(node, stamp_) > 0.5F;
  return static_cast<double>(nodes) * tread_.spacing() * tread_.spacing();
}

}  // namespace vegetation_sim::scenes
