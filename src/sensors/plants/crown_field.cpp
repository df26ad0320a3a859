// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/plants/crown_field.h"

#include <utility>

namespace vegetation_sim::scan {

void Crowns::update(const std::vector<CrownSource>& sources, int version,
                    const canopy::Foliage& foliage, const Vec3& origin, ThreadPool& threads) {
  auto known = crowns_.take();
  if (version_ != version) known.clear();
  version_ = version;
  leaves_ = 0;
  std::vector<std::shared_ptr<PosedCrown>> crowns;
  for (const CrownSource& source : sources) {
    if (!crowns.empty() && leaves_ + source.leaves->size() > most_leaves_) break;
    leaves_ += source.leaves->size();
    crowns.push_back(std::move(known[source.tree]));
  }
  left_out_ = sources.size() - crowns.size();
  const std::size_t parts = threads.size();
  threads.run(parts, [&](std::size_t first) {
    for (std::size_t i = first; i < crowns.size(); i += parts) {
      if (!crowns[i]) crowns[i] = std::make_shared<PosedCrown>(sources[i]);
      crowns[i]->pose(sources[i], foliage);
    }
  });
  crowns_.set(std::move(crowns), origin);
}

}  // namespace vegetation_sim::scan
