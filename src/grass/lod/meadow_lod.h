// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "core/lod/tier_allocation.h"
#include "grass/lod/node_wind.h"
#include "grass/lod/tile_level.h"
#include "vegetation_sim/core/lod/viewpoint.h"
#include "vegetation_sim/core/math/hash.h"
#include "vegetation_sim/grass/tread/tread_map.h"

namespace vegetation_sim::grass {

struct MeadowSettings {
  double tolerance{1.5};    ///< what a level may leave out [pixel]
  double transition{0.5};   ///< from one tier to the next [s]
  double farthest{400.0};   ///< beyond, grass is a texture [m]
  double most_blades{6e5};  ///< that the viewpoints see; for more, the tolerance is coarsened
};
void describe(FieldVisitor& visitor, MeadowSettings& settings);

/// A tile that is more than a texture, or is on its way to or from it.
struct TileLevel {
  int row{0}, column{0};
  TileModelState tier;
};

/// State of the level of detail of a meadow (N6): which tiles are drawn how.
struct MeadowLodSnapshot {
  Nanoseconds stamp{0};
  double coarseness{1.0};         ///< factor on the tolerance that keeps the number of blades
  std::vector<TileLevel> levels;  ///< by row, then column
  std::vector<Viewpoint> viewpoints;
  void addTo(Hash& hash) const;
  std::uint64_t hash() const;
};

/// What to draw of one tile at one instant, for one eye.
struct TileView {
  int row{0}, column{0};
  Morph morph;
  int segments{LINKS};
  double share{1.0};      ///< of the blades
  double elevation{0.0};  ///< from which the tile is seen [rad]
};

/// Level of detail of the tiles of a meadow around its viewers. The trodden ground belongs to
/// whoever simulates or replicates it. One thread at a time.
class MeadowLod {
 public:
  /// @throws InvalidInput with all faults.
  MeadowLod(std::shared_ptr<const FeatureMap> map,
            std::shared_ptr<const terrain::HeightMap> terrain, std::uint64_t seed,
            const MeadowSettings& settings);

  const FeatureMap& map() const { return *map_; }
  const terrain::HeightMap& terrain() const { return *terrain_; }
  std::uint64_t seed() const { return seed_; }

  /// Other settings from now on. @throws InvalidInput with all faults, then nothing is changed.
  void setSettings(const MeadowSettings& settings);
  void setViewpoints(std::vector<Viewpoint> viewpoints) { viewpoints_ = std::move(viewpoints); }
  /// Chooses levels at a stamp. If the stamp is before the last one, all tiles start as textures.
  void advance(Nanoseconds stamp);

  /// Tiles that an eye sees as more than a texture.
  std::vector<TileView> viewOf(const Viewpoint& eye, Nanoseconds stamp) const;
  /// Smallest window with all of these tiles.
  static TileWindow windowOf(const std::vector<TileView>& views);
  /// Makes a tile from its seed and fills `motion` with its wind and its trodden ground, for which
  /// `patch` is the memory. Requires that the window of `air` contains the tile.
  Tile tileAt(const TileView& view, const NodeWind& air, const TreadMap& tread, Nanoseconds stamp,
              CrushPatch& patch, TileMotion& motion) const;

  /// What was chosen at the last advance() for the tiles that are or want to be more than a
  /// texture: costs are blades, errors what tiers leave out.
  const TierAllocation& balance() const { return balance_; }

  MeadowLodSnapshot snapshot() const;
  void restore(MeadowLodSnapshot snapshot);
  /// Memory of the state [bytes].
  std::size_t bytes() const { return levels_.capacity() * sizeof(TileLevel); }

 private:
  double scaleOf(const Vec3& centre) const;
  bool isSeen(const Vec3& centre) const;
  Vec3 centreOf(int row, int column) const;
  /// A tile that is or wants to be more than a texture.
  struct Candidate {
    TileLevel level{};  ///< as it was
    TileDetail detail{};
    double scale{0.0};                     ///< pixels a metre; 0: bare, or too far off
    TileModel wanted{TileModel::TEXTURE};  ///< within the plain tolerance
    double blades{0.0};  ///< all that grow on it; 0 if it wants none or nobody sees it
  };
  Candidate candidateOf(const TileLevel& level) const;
  std::vector<Candidate> findCandidates() const;
  double bladesAt(const Candidate& tile, double coarseness) const;
  TileModel modelAt(const Candidate& tile, double coarseness) const;
  double coarsenessFor(const std::vector<Candidate>& tiles) const;
  void addToBalance(const Candidate& tile, TileModel tier);
  void chooseLevels(Nanoseconds stamp);
  std::pair<int, int> columnsIn(int row) const;
  double farthestOf(int row, const Viewpoint& eye) const;

  std::shared_ptr<const FeatureMap> map_;
  std::shared_ptr<const terrain::HeightMap> terrain_;
  std::uint64_t seed_;
  MeadowSettings settings_;
  std::vector<double> coarsest_;  ///< of each row of tiles: most that a texture leaves out [m]
  Nanoseconds stamp_{0};
  double coarseness_{1.0};
  TierAllocation balance_;
  std::vector<TileLevel> levels_;
  std::vector<Viewpoint> viewpoints_;
};

}  // namespace vegetation_sim::grass
