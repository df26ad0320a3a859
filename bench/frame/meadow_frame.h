// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "frame/laps.h"
#include "frame/scene.h"
#include "grass/lod/meadow_lod.h"
#include "grass/mesh/grass_geometry.h"

namespace vegetation_sim::grass {

/// The grass of a scenario: a stone rolls through it, and everything in view is drawn again.
class MeadowFrame {
 public:
  explicit MeadowFrame(const bench::Scene& scene, const MeadowSettings& settings = {})
      : wind_(scene.wind),
        tread_(scene.grass->layout.tread),
        viewer_(bench::frameViewpoint(scene)),
        meadow_(scene.grass->layout.map, scene.terrain, scene.grass->layout.seed, settings),
        treads_(scene.grass->layout.map->law(), scene.grass->treading) {
    viewer_.position.z() -= 1.4;  // height of a walking person
    for (int i = 0; i < 2 * bench::FRAME_RATE; ++i) {
      bench::Laps unused;
      frame(unused);
    }
  }

  void frame(bench::Laps& laps) {
    const Nanoseconds stamp =
        bench::FRAME_START + fromSeconds(++frame_ / double{bench::FRAME_RATE});
    const double turn = 0.02 * frame_;
    treads_.tread(1, tread_, {6.0 * std::cos(turn), 6.0 * std::sin(turn)}, stamp);
    laps.lap("treading");
    meadow_.setViewpoints({viewer_});
    meadow_.advance(stamp);
    const auto views = meadow_.viewOf(viewer_, stamp);
    laps.lap("grass levels");
    NodeWind air(meadow_.map(), meadow_.terrain());
    std::vector<TilePlace> tiles;
    for (const TileView& view : views) tiles.push_back({view.column, view.row});
    air.update(wind_.at(stamp), {}, MeadowLod::windowOf(views), &tiles);
    laps.lap("air on the grass");
    draw(views, air, stamp);
    laps.lap("blades and strips");
  }

  /// Returns the largest omission of the models of visible tiles [pixel].
  double omission() const { return meadow_.balance().largest; }

 private:
  void draw(const std::vector<TileView>& views, const NodeWind& air, Nanoseconds stamp) {
    mesh_.clear();
    CrushPatch patch;
    for (const TileView& view : views) {
      TileMotion motion;
      const Tile tile = meadow_.tileAt(view, air, treads_, stamp, patch, motion);
      if (view.morph.blades) {
        const int count = static_cast<int>(tile.blades * view.share);
        blocks_.resize(static_cast<std::size_t>(blocksFor(count)));
        poseBlades(tile, motion, count, blocks_.data());
        RibbonStyle style;
        style.segments = view.segments;
        style.slide = view.morph.slide;
        style.width = 1.0 / view.share;
        style.eye = viewer_.position;
        appendRibbons(meadow_.map(), tile, blocks_.data(), count, style, mesh_);
      }
      if (view.morph.strip > 0.0)
        appendStrips(meadow_.map(), tile, motion, view.morph.strip, 1000.0, mesh_);
    }
  }

  wind::Field wind_;
  TreadLaw tread_;
  Viewpoint viewer_;
  MeadowLod meadow_;
  TreadMap treads_;
  std::vector<BladeBlock> blocks_;
  GrassMesh mesh_;
  int frame_{0};
};

}  // namespace vegetation_sim::grass
