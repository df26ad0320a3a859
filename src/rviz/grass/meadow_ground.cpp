// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/grass/meadow_ground.h"

#include <algorithm>
#include <cmath>

namespace vegetation_sim::view {
namespace {

constexpr double STEP_OF_COLOURS = 0.25;  // way of a disc before it is painted anew [tiles]
constexpr int PRESSED_A_TIME = 8, IN_TURN_A_TIME = 2;  // tiles painted in one update

}  // namespace

MeadowGround::MeadowGround(Ogre::SceneNode& parent, const SubscribedMeadow& meadow,
                           const Daylight& daylight, const Rgba& tint)
    : map_(meadow.layout().map), terrain_(meadow.terrain()), daylight_(daylight) {
  painter_ = std::make_unique<MeadowPainter>(*map_, *terrain_, daylight_, tint);
  const Image picture = painter_->whole();
  const Plot& plot = painter_->plot();
  const double x = plot.x + 0.5 * plot.edge, y = plot.y + 0.5 * plot.edge;
  Land land{plot, picture, *terrain_, Vec3(x, y, terrain_->height(x, y)), 1.0, tint};
  if (!terrain_->isFlat()) land.cell = terrain_->resolution();
  ground_ = std::make_unique<GroundVisual>(parent, land, daylight);
}

void MeadowGround::light(const Daylight& daylight, const Haze& haze) {
  ground_->light(daylight, daylight.to_sun, haze);
}

void MeadowGround::paint(const SubscribedMeadow& meadow, std::pair<int, int> tile,
                         Nanoseconds stamp) {
  const auto [row, column] = tile;
  meadow.tread().patch(column, row, stamp, patch_);
  ground_->repaint(painter_->left(column), painter_->top(row),
                   painter_->tile(column, row, &patch_));
  if (patch_.cells > 0)
    tracks_.insert(tile);
  else
    tracks_.erase(tile);
}

// Collects all tiles that have tracks now, or had them when they were painted.
void MeadowGround::collect(const SubscribedMeadow& meadow) {
  std::set<std::pair<int, int>> all = tracks_;
  const double cells = map_->law().resolution / meadow.tread().spacing();
  constexpr int SIDE = grass::TreadBlock::SIDE;
  const auto tileOf = [&](int node, int most) {
    return std::min(most - 1, static_cast<int>(node / cells));
  };
  const auto add = [&](const std::pair<int, int>& place) {
    for (int row = tileOf(place.first * SIDE, map_->tileRows());
         row <= tileOf(place.first * SIDE + SIDE - 1, map_->tileRows()); ++row)
      for (int column = tileOf(place.second * SIDE, map_->tileColumns());
           column <= tileOf(place.second * SIDE + SIDE - 1, map_->tileColumns()); ++column)
        all.insert({row, column});
  };
  for (const auto& entry : meadow.tread().state().blocks) add(entry.first);
  for (const auto& entry : meadow.tread().cuts().state().blocks) add(entry.first);
  round_.assign(all.begin(), all.end());
}

void MeadowGround::addTilesUnder(const std::vector<grass::ColourMask>& masks) {
  const grass::MapLaw& law = map_->law();
  const auto isIn = [&](int tile, double origin, double centre, double radius) {
    const double low = origin + tile * law.resolution;
    return centre + radius >= low && centre - radius <= low + law.resolution;
  };
  for (int row = 0; row < map_->tileRows(); ++row)
    for (int column = 0; column < map_->tileColumns(); ++column)
      if (std::any_of(masks.begin(), masks.end(), [&](const grass::ColourMask& m) {
            return isIn(row, law.origin_y, m.centre.y, m.radius) &&
                   isIn(column, law.origin_x, m.centre.x, m.radius);
          }))
        pressed_.insert({row, column});
}

// Repaints below discs that moved by a share of a tile, where they were and where they are.
void MeadowGround::followColours(const SubscribedMeadow& meadow, Nanoseconds stamp) {
  std::vector<grass::ColourMask> now = meadow.colours().at(stamp);
  const double step = STEP_OF_COLOURS * map_->law().resolution;
  const auto isNear = [&](const grass::ColourMask& a, const grass::ColourMask& b) {
    return std::hypot(a.centre.x - b.centre.x, a.centre.y - b.centre.y) < step &&
           a.radius == b.radius && a.colour == b.colour && a.weight == b.weight;
  };
  if (std::equal(now.begin(), now.end(), masks_.begin(), masks_.end(), isNear)) return;
  addTilesUnder(masks_);
  addTilesUnder(now);
  painter_->setColours(now);
  masks_ = std::move(now);
}

void MeadowGround::update(const SubscribedMeadow& meadow,
                          const std::set<std::pair<int, int>>& pressed, Nanoseconds stamp) {
  pressed_.insert(pressed.begin(), pressed.end());
  followColours(meadow, stamp);
  for (int i = 0; i < PRESSED_A_TIME && !pressed_.empty(); ++i) {
    // All have their turn, also while moving discs add the same ones again and again.
    auto next = pressed_.upper_bound(painted_);
    if (next == pressed_.end()) next = pressed_.begin();
    painted_ = *next;
    pressed_.erase(next);
    paint(meadow, painted_, stamp);
  }
  if (round_.empty()) collect(meadow);
  for (int i = 0; i < IN_TURN_A_TIME && !round_.empty(); ++i) {
    paint(meadow, round_.back(), stamp);
    round_.pop_back();
  }
}

}  // namespace vegetation_sim::view
