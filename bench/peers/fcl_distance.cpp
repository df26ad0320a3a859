// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Built for the plain processor: Debian's libfcl and a caller for wider vectors silently disagree
// about the layout of Eigen's types.
#include <fcl/fcl.h>

#include <memory>

#include "crowd/peer_distance.h"

namespace vegetation_sim::crowd::bench {
namespace {

using Object = std::shared_ptr<fcl::CollisionObjectd>;

Object objectOf(const Box& box) {
  std::shared_ptr<fcl::CollisionGeometryd> shape;
  if (box.radius > 0.0)
    shape = std::make_shared<fcl::Capsuled>(box.radius, 2.0 * box.half.z());
  else
    shape = std::make_shared<fcl::Boxd>(2.0 * box.half);
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.translation() = box.centre;
  pose.linear() << box.axes[0], box.axes[1], box.axes[2];
  return std::make_shared<fcl::CollisionObjectd>(shape, pose);
}

PeerDistance make(const char* name, fcl::GJKSolverType solver, const std::vector<Object>& first,
                  const std::vector<Object>& second) {
  return {name, [=](std::size_t i) {
            fcl::DistanceRequestd request;
            request.gjk_solver_type = solver;
            request.enable_signed_distance = false;
            fcl::DistanceResultd result;
            return fcl::distance(first[i].get(), second[i].get(), request, result);
          }};
}

}  // namespace

std::vector<PeerDistance> fclDistances(const std::vector<Box>& first,
                                       const std::vector<Box>& second) {
  std::vector<Object> a, b;
  for (const Box& box : first) a.push_back(objectOf(box));
  for (const Box& box : second) b.push_back(objectOf(box));
  return {make("FCL, libccd", fcl::GST_LIBCCD, a, b), make("FCL, own", fcl::GST_INDEP, a, b)};
}

}  // namespace vegetation_sim::crowd::bench
