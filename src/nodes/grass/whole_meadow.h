// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <vegetation_sim/GrassState.h>

#include <boost/function.hpp>
#include <memory>

#include "grass/tread_simulation.h"
#include "vegetation_sim/grass/tread/tread_update.h"

namespace vegetation_sim {

/// The ground of all shards of a meadow, from their states. It receives them only while it is
/// wanted, since they cost one node as much as the whole meadow.
class WholeMeadow {
 public:
  WholeMeadow(const grass::Layout& layout, std::shared_ptr<const terrain::HeightMap> terrain,
              const grass::TreadSettings& treading);

  grass::TreadSimulation& field() { return field_; }
  const grass::TreadSimulation& field() const { return field_; }
  /// Begins or ends to receive states. @param guarded calls apply() with a message.
  void follow(bool is_wanted, ros::NodeHandle& handle,
              const boost::function<void(const GrassState&)>& guarded);
  /// @throws InvalidInput for a message that fromMsg() or TreadReplica refuses.
  void apply(const GrassState& message);
  /// Discards the ground, after another layout or a jump back in time.
  void reset();

 private:
  grass::TreadMap tread_;
  grass::TreadSimulation field_;
  grass::TreadReplica replica_;
  ros::Subscriber states_;
};

}  // namespace vegetation_sim
