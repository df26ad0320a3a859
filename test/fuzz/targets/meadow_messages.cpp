// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/targets/decoding.h"
#include "fuzz/targets/target_lists.h"
#include "fuzz/targets/usage.h"
#include "grass/lod/meadow_lod.h"
#include "grass/mesh/grass_geometry.h"
#include "grass/tread_simulation.h"
#include "nodes/grass/cover/cover_join.h"
#include "ros/replicas/subscribed_meadow.h"
#include "vegetation_sim/ros/conversions/grass_conversions.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim::fuzz {
namespace {

enum PieceKind { LAYOUT, STATE, JUMP_BACK, PRUNE, NEAR, COVER, KINDS };

/// Draws what a viewer above the south-west corner sees, as GrassDisplay does.
void draw(const SubscribedMeadow& meadow, Nanoseconds stamp) {
  grass::MeadowSettings settings;
  settings.farthest = 8.0;
  settings.most_blades = 2000.0;
  const grass::Layout& layout = meadow.layout();
  grass::MeadowLod lod(layout.map, meadow.terrain(), layout.seed, settings);
  Viewpoint eye;
  eye.position = Vec3(layout.map->law().origin_x, layout.map->law().origin_y, 1.0);
  lod.setViewpoints({eye});
  lod.advance(stamp);
  lod.advance(stamp + NANOSECONDS_PER_SECOND);
  const std::vector<grass::TileView> views = lod.viewOf(eye, stamp + NANOSECONDS_PER_SECOND);
  if (views.empty()) return;
  grass::NodeWind air(lod.map(), lod.terrain());
  air.update(meadow.wind().at(stamp), {}, grass::MeadowLod::windowOf(views));
  grass::GrassMesh mesh;
  for (std::size_t i = 0; i < std::min<std::size_t>(views.size(), 4); ++i) {
    grass::CrushPatch patch;
    grass::TileMotion motion;
    const grass::Tile tile = lod.tileAt(views[i], air, meadow.tread(), stamp, patch, motion);
    const int count = std::min(200, tile.blades);
    std::vector<grass::BladeBlock> blocks(static_cast<std::size_t>(grass::blocksFor(count)));
    grass::poseBlades(tile, motion, count, blocks.data());
    grass::appendRibbons(lod.map(), tile, blocks.data(), count, grass::RibbonStyle(), mesh);
    grass::appendStrips(lod.map(), tile, motion, 1.0, 50.0, mesh);
  }
  requireFinite(std::vector<float>(mesh.positions.begin(), mesh.positions.end()),
                "vertex of grass");
}

/// Four untrodden cells, as shard 0 of two knows them.
GrassCover untrodden(Nanoseconds stamp) {
  GrassCover out;
  out.header.stamp = toStamp(stamp);
  out.info.width = out.info.height = 2;
  out.info.resolution = 0.5F;
  out.density = out.height = {1.F, 1.F, 1.F, 1.F};
  out.crush.assign(4, 0.F);
  out.age.assign(4, -1.F);
  return out;
}

void joinCover(const GrassCoverPart& part) {
  CoverJoin join(2);
  const Nanoseconds stamp = fromMsg(part.header.stamp);
  join.begin(untrodden(stamp), 1.0);
  try {
    join.add(part);
  } catch (const InvalidInput&) {
    return;
  }
  if (const auto map = join.take()) requireFinite(map->resistance, "resistance of grass");
}

GrassCoverPart troddenCell() {
  GrassCoverPart out;
  out.shard = 1;
  out.info = untrodden(START).info;
  out.cells = {2};
  out.crush = {0.5F};
  out.age = {1.F};
  return out;
}

void use(SubscribedMeadow& meadow) {
  if (!meadow.ready()) return;
  const Nanoseconds stamp = START + NANOSECONDS_PER_SECOND;
  draw(meadow, stamp);
  scan::Scene scene;
  scene.ground = meadow.terrain();
  scene.grass.update(meadow.layout(), meadow.tread(), meadow.terrain(), meadow.wind(), SENSOR_PLACE,
                     SENSOR_RANGE, stamp);
  sweepOnce(scene);
}

void receive(const Piece& piece, SubscribedMeadow& meadow) {
  const Nanoseconds stamp = START + Numbers(piece.bytes).word() * NANOSECONDS_PER_SECOND / 100;
  switch (piece.kind % KINDS) {
    case LAYOUT:
      if (GrassLayout layout; decode(piece.bytes, layout)) {
        if (layout.terrain.empty()) layout.terrain_hash = terrain::HeightMap().hash();
        repairHash(layout);
        meadow.setLayout(layout);
      }
      break;
    case STATE:
      if (GrassState state; decode(piece.bytes, state)) {
        if (meadow.ready()) state.layout_hash = meadow.layout().hash();
        meadow.apply(state);
      }
      break;
    case NEAR:
      if (NearGrass near; decode(piece.bytes, near)) {
        if (meadow.ready()) near.state.layout_hash = meadow.layout().hash();
        meadow.apply(near);
        meadow.covers(SENSOR_PLACE, SENSOR_RANGE, stamp);
      }
      break;
    case COVER:
      if (GrassCoverPart part; decode(piece.bytes, part)) joinCover(part);
      break;
    case JUMP_BACK:
      meadow.forgetLater(stamp);
      break;
    default:
      if (meadow.ready()) meadow.prune(stamp);
  }
}

void run(std::string_view input) {
  SubscribedMeadow meadow;
  for (const Piece& piece : splitPieces(input)) receive(piece, meadow);
  use(meadow);
}

grass::Layout lawn(bool picture) {
  grass::MapInput input;
  input.law.columns = input.law.rows = 4;
  input.height.value = 0.3;
  input.density.value = 40.0;
  if (picture) {
    input.height.image = {4, 4, 255, {}};
    for (std::uint16_t i = 0; i < 16; ++i) input.height.image.samples.push_back(10 * i);
    input.species.resize(1);
    input.species[0].species.name = "clover";
  }
  grass::Layout out;
  out.map = std::make_shared<const grass::FeatureMap>(input);
  out.terrain_hash = terrain::HeightMap().hash();
  return out;
}

/// A track across a lawn: the layout, a key frame and two deltas.
std::string track(bool picture, bool is_near = false) {
  const grass::Layout layout = lawn(picture);
  grass::TreadSettings settings;
  settings.spacing = layout.tread_spacing;
  grass::TreadMap map(layout.map->law(), settings);
  grass::TreadSimulation simulation(layout, std::make_shared<const terrain::HeightMap>(), settings,
                                    map);
  std::string out = pieceOf(LAYOUT, encode(toMsg(layout)));
  for (int tick = 0; tick < 3; ++tick) {
    const Nanoseconds stamp = START + tick * NANOSECONDS_PER_SECOND / 10;
    grass::TreadInput input;
    input.source = "boot";
    input.position = Vec3(1.0 + 0.2 * tick, 1.0, 0.0);
    input.law.radius = input.law.reach = 0.1;
    simulation.apply(input, stamp);
    if (tick == 1)
      simulation.cut({{{1.0, 1.5}}, 0.5, 0.05, {{{1.0, 2.0}, {2.0, 2.0}, {2.0, 3.0}}}});
    simulation.advance(stamp);
    const GrassState state = toMsg(simulation.update(tick == 0));
    NearGrass near;
    near.state = state;
    near.discs.resize(1);
    near.discs[0].radius = 30.0F;
    out += pieceOf(is_near ? NEAR : STATE, is_near ? encode(near) : encode(state));
  }
  return out;
}

std::vector<std::string> seeds() {
  const std::string jump = pieceOf(JUMP_BACK, std::string("\x04\x00", 2));
  return {pieceOf(LAYOUT, encode(toMsg(lawn(false)))),
          track(false),
          track(true),
          track(false, true),
          pieceOf(COVER, encode(troddenCell())),
          track(false) + jump + pieceOf(PRUNE, std::string("\xff\xff", 2))};
}

}  // namespace

std::vector<Target> meadowMessageTargets() {
  return {{"grass", "GrassLayout, GrassState, NearGrass, GrassCoverPart; blades, strips, a sweep",
           run, seeds}};
}

}  // namespace vegetation_sim::fuzz
