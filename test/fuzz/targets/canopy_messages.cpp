// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/targets/decoding.h"
#include "fuzz/targets/target_lists.h"
#include "fuzz/targets/usage.h"
#include "vegetation_sim/canopy/canopy.h"
#include "vegetation_sim/ros/conversions/canopy_conversions.h"

namespace vegetation_sim::fuzz {
namespace {

enum PieceKind { LAYOUT, STATE, JUMP_BACK, KINDS };

/// Moves the leaves of the first plant, as CanopyDisplay does.
void use(canopy::Replica& replica) {
  const canopy::Layout& layout = replica.layout();
  const canopy::Foliage& foliage = replica.foliage();
  if (foliage.layers() > 0) requireFinite(foliage.sheet(0), "motion of a layer");
  if (layout.plants.empty()) return;
  const canopy::Plant& plant = layout.plants.front();
  const canopy::PlantKind& kind = layout.kinds[plant.kind];
  if (canopy::leafCount(kind) > 5000) return;
  const std::vector<canopy::Leaf> leaves = canopy::grow(kind, plant).leaves;
  for (std::size_t i = 0; i < leaves.size(); i += 7)
    requireFinite(foliage.move(leaves[i], 0).tip, "tip of a leaf");
}

// As SubscribedCanopy does; that needs a master.
void receive(const Piece& piece, std::unique_ptr<canopy::Replica>& plants) {
  switch (piece.kind % KINDS) {
    case LAYOUT:
      if (CanopyLayout layout; decode(piece.bytes, layout)) {
        repairHash(layout);
        plants = std::make_unique<canopy::Replica>(fromMsg(layout, {}));
      }
      break;
    case STATE:
      if (CanopyState state; plants && decode(piece.bytes, state)) {
        state.layout_hash = plants->layout().hash();
        plants->apply(fromMsg(state));
      }
      break;
    default:
      if (plants) plants = std::make_unique<canopy::Replica>(canopy::Layout(plants->layout()));
  }
}

void run(std::string_view input) {
  std::unique_ptr<canopy::Replica> plants;
  for (const Piece& piece : splitPieces(input)) try {
      receive(piece, plants);
    } catch (const InvalidInput&) {
    }
  if (plants) use(*plants);
}

canopy::Layout twoPlants(canopy::PlantShape shape) {
  canopy::Layout out;
  out.motion.fluid.cells = 32;
  out.kinds.resize(1);
  out.kinds[0].shape = shape;
  out.kinds[0].leaves = 40;
  out.plants.resize(2);
  out.plants[1].position = Vec3(2.0, 0.0, 0.0);
  return out;
}

std::string movingPlants(canopy::PlantShape shape) {
  canopy::Canopy plants(twoPlants(shape));
  std::string out = pieceOf(LAYOUT, encode(toMsg(plants.layout())));
  for (int tick = 1; tick <= 2; ++tick) {
    if (tick == 2) plants.cut({1}, 0.3);
    plants.advance(START + tick * NANOSECONDS_PER_SECOND / 30);
    CanopyState state = toMsg(plants.update(false));
    out += pieceOf(STATE, encode(state));
  }
  return out;
}

std::vector<std::string> seeds() {
  return {pieceOf(LAYOUT, encode(toMsg(twoPlants(canopy::PlantShape::CROWN)))),
          movingPlants(canopy::PlantShape::SHRUB), movingPlants(canopy::PlantShape::KELP),
          movingPlants(canopy::PlantShape::REED) + pieceOf(JUMP_BACK, std::string("\x01\x00", 2))};
}

}  // namespace

std::vector<Target> canopyMessageTargets() {
  return {{"canopy", "CanopyLayout, CanopyState; layers and moved leaves", run, seeds}};
}

}  // namespace vegetation_sim::fuzz
