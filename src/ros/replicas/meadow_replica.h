// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/GrassLayout.h>

#include <memory>

#include "vegetation_sim/grass/grass_layout.h"
#include "vegetation_sim/grass/tread/tread_update.h"
#include "vegetation_sim/terrain/height_map.h"

namespace vegetation_sim {

/// A copy of a meadow as it is told: empty until there is a layout.
struct MeadowReplica {
  MeadowReplica() = default;
  /// Untrodden, on the terrain that the layout names.
  /// @throws InvalidInput for a layout that cannot be, or a terrain with other heights.
  explicit MeadowReplica(const GrassLayout& message);

  bool ready() const { return tread != nullptr; }
  /// Time went back to `now`: what was trodden later is void until the next key frame. One of after
  /// the jump that has come already is kept. True if something was void.
  bool forgetLater(Nanoseconds now);

  grass::Layout layout;
  std::uint64_t hash{0};
  std::shared_ptr<const terrain::HeightMap> terrain;
  std::unique_ptr<grass::TreadMap> tread;
  grass::TreadReplica replica;
};

}  // namespace vegetation_sim
