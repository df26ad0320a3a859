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
  double tolerance{1.5};    ///< allowed omission of a model [pixel]
  double transition{0.5};   ///< time from one model to the next [s]
  double farthest{400.0};   ///< Beyond this distance grass is a texture [m].
  double most_blades{6e5};  ///< limit for the visible blades; the tolerance is coarsened to keep it
};
void describe(FieldVisitor& visitor, MeadowSettings& settings);

/// A tile whose model is not the texture, or that moves between models.
struct TileLevel {
  int row{0}, column{0};
  TileModelState tier;
};

/// State of the level of detail of a meadow (N6).
struct MeadowLodSnapshot {
  Nanoseconds stamp{0};
  double coarseness{1.0};         ///< factor on the tolerance that keeps the number of blades
  std::vector<TileLevel> levels;  ///< by row, then column
  std::vector<Viewpoint> viewpoints;
  void addTo(Hash& hash) const;
  std::uint64_t hash() const;
};

/// How one tile is drawn at one instant for one viewpoint.
struct TileView {
  int row{0}, column{0};
  Morph morph;
  int segments{LINKS};
  double share{1.0};      ///< share of the blades that is drawn
  double elevation{0.0};  ///< elevation angle from the tile to the viewpoint [rad]
  int layers{1};          ///< layers of a view from above (S2-W3)
};

/// Level of detail of the tiles of a meadow around the viewpoints. It does not own the trodden
/// ground. One thread at a time.
class MeadowLod {
 public:
  /// @throws InvalidInput with all faults.
  MeadowLod(std::shared_ptr<const FeatureMap> map,
            std::shared_ptr<const terrain::HeightMap> terrain, std::uint64_t seed,
            const MeadowSettings& settings);

  const FeatureMap& map() const { return *map_; }
  const terrain::HeightMap& terrain() const { return *terrain_; }
  std::uint64_t seed() const { return seed_; }

  /// Replaces the settings. @throws InvalidInput with all faults, then nothing is changed.
  void setSettings(const MeadowSettings& settings);
  void setViewpoints(std::vector<Viewpoint> viewpoints) { viewpoints_ = std::move(viewpoints); }
  /// Chooses levels at a stamp. If the stamp is before the last one, all tiles start as textures.
  void advance(Nanoseconds stamp);

  /// Returns the tiles that are drawn as more than a texture for a viewpoint.
  std::vector<TileView> viewOf(const Viewpoint& eye, Nanoseconds stamp) const;
  /// Returns the smallest window that contains all of these tiles.
  static TileWindow windowOf(const std::vector<TileView>& views);
  /// Makes a tile from its seed and fills `motion` with its wind and its trodden ground, for which
  /// `patch` is the memory. Requires that the window of `air` contains the tile.
  Tile tileAt(const TileView& view, const NodeWind& air, const TreadMap& tread, Nanoseconds stamp,
              CrushPatch& patch, TileMotion& motion) const;

  /// Allocation of the last advance(), over the tiles that are or want to be more than a texture:
  /// costs are numbers of blades, errors are omissions of the models.
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
    TileLevel level{};  ///< level before this advance()
    TileDetail detail{};
    double scale{0.0};                     ///< pixels per metre; 0: bare or beyond `farthest`
    TileModel wanted{TileModel::TEXTURE};  ///< model within the tolerance, without coarseness
    double blades{0.0};  ///< number of its blades; 0 if it wants none or is not visible
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
  std::vector<double> coarsest_;  ///< largest omission of a texture in each row of tiles [m]
  Nanoseconds stamp_{0};
  double coarseness_{1.0};
  TierAllocation balance_;
  std::vector<TileLevel> levels_;
  std::vector<Viewpoint> viewpoints_;
};

}  // namespace vegetation_sim::grass
