// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// The snapshot of a canopy as bytes.
#include "core/archive/archive.h"
#include "vegetation_sim/canopy/canopy.h"
#include "wind/field_archive.h"

namespace vegetation_sim::canopy {
namespace {

void archive(Archive& a, const char* name, int cells, PlaneField& field) {
  const std::size_t area = PlaneField(cells).area();
  a.numbers(name, field.u, area);
  a.numbers(name, field.v, area);
  if (field.u.size() != area || field.v.size() != area)
    Archive::reject(std::string(name) + ": cells = " + std::to_string(field.u.size()) + " and " +
                        std::to_string(field.v.size()),
                    "differ from those of the layout, " + std::to_string(area));
  if (a.reads()) field.size = cells;
}

void archive(Archive& a, CutView& view) {
  a.vector("view position", view.position);
  for (double* each :
       {&view.orientation.w, &view.orientation.x, &view.orientation.y, &view.orientation.z})
    a.number("view orientation", *each);
}

void archive(Archive& a, Driver& driver) {
  double share = driver.share();
  bool front = driver.front();
  a.number("driver share", share, {0.0, 1.0});
  a.flag("driver front", front);
  driver.restore(share, front);
}

void archive(Archive& a, std::optional<CutView>& viewer) {
  bool has = viewer.has_value();
  a.flag("has viewer", has);
  if (!has) return viewer.reset();
  if (!viewer) viewer.emplace();
  archive(a, *viewer);
}

}  // namespace

void Canopy::archive(Archive& a, Archived& state) const {
  CanopySnapshot& s = state.snapshot;
  const int cells = layout_.motion.fluid.cells;
  a.stamp("stamp", s.stamp);
  a.integer("ticks", s.ticks);
  canopy::archive(a, "flow", cells, s.fluid.flow);
  for (double& value : s.fluid.turbulence) a.number("turbulence", value);
  a.integer("fluid steps", s.fluid.steps);
  canopy::archive(a, "amplitude", cells, s.oscillator.amplitude);
  canopy::archive(a, "rate", cells, s.oscillator.rate);
  a.number("depth", s.oscillator.depth);
  a.number("depth rate", s.oscillator.depth_rate);
  if (a.reads()) s.history = History(cells, historyFrames(layout_.motion));
  s.history.archive(a);
  canopy::archive(a, s.driver);
  canopy::archive(a, s.cuts.now);
  canopy::archive(a, s.cuts.before);
  a.stamp("cuts since", s.cuts.since);
  a.flag("has cuts", s.has_cuts);
  archivePush(a, s.push);
  wind::archive(a, state.wind);
  canopy::archive(a, state.viewer);
}

std::string Canopy::archived() const {
  Archive a;
  Archived copy{memory_, wind_, viewer_};
  archive(a, copy);
  return a.takeBytes();
}

Canopy::Archived Canopy::readArchived(std::string bytes, Nanoseconds shift) const {
  Archive a = Archive::reading(std::move(bytes), shift);
  Archived out;
  archive(a, out);
  a.finish();
  return out;
}

}  // namespace vegetation_sim::canopy
