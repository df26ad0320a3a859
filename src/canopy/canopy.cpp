// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/canopy/canopy.h"

#include <utility>

#include "canopy/contact/plant_pusher.h"
#include "canopy/plants/stubble.h"
#include "forest/contact/contact_body.h"

namespace vegetation_sim::canopy {
namespace {

const Layout& checked(const Layout& layout) {
  Faults faults;
  check(layout, faults);
  faults.throwIfAny();
  return layout;
}

CutView viewOfPlane(const Layout& layout) {
  return {layout.motion.plane.camera, orientationOf(layout.motion.plane)};
}

bool fits(const Layout& layout, std::uint32_t plant, const std::vector<Cluster>& clusters) {
  if (plant >= layout.plants.size()) return false;
  const PlantKind& kind = layout.kinds[layout.plants[plant].kind];
  return kind.push.stiffness > 0.0 &&
         clusters.size() == fibresOf(kind, layout.plants[plant]).cells();
}

void checkPush(const PushState& push, const Layout& layout) {
  Faults faults;
  std::size_t cells = 0;
  for (const auto& [id, clusters] : push.plants) {
    if (!fits(layout, id, clusters))
      faults.add("snapshot: plant " + std::to_string(id) + " with " +
                 std::to_string(clusters.size()) + " cells belongs to another layout");
    cells += clusters.size();
  }
  if (cells > MOST_CLUSTERS)
    faults.add("snapshot: " + std::to_string(cells) + " cells lean, allowed are " +
               std::to_string(MOST_CLUSTERS));
  for (const auto& entry : push.bodies) forest::check(entry.second, faults);
  faults.throwIfAny();
}

PlaneMotion meanOf(const PlaneField& motion) {
  PlaneMotion out;
  for (std::size_t i = 0; i < motion.u.size(); ++i) {
    out.u += motion.u[i];
    out.v += motion.v[i];
  }
  const auto cells = static_cast<double>(motion.u.size());
  return {out.u / cells, out.v / cells, 0.0};
}

}  // namespace

std::uint64_t CanopySnapshot::hash() const {
  Hash hash;
  hash.add(static_cast<std::uint64_t>(stamp));
  hash.add(ticks);
  fluid.addTo(hash);
  oscillator.addTo(hash);
  hash.add(history.hash());
  push.addTo(hash);
  return hash.value();
}

Canopy::Canopy(const Layout& layout)
    : layout_(checked(layout)),
      layout_hash_(layout.hash()),
      plane_(layout.motion.plane),
      fluid_(fluidOf(layout.motion), layout.motion.sources, layout.seed),
      oscillator_(layout.motion.oscillator, layout.motion.fluid.cells, plane_.width),
      foliage_(layout_),
      pusher_(std::make_unique<PlantPusher>(layout_.kinds, layout_.plants)) {
  foliage_.setStubble(memory_.push.stubble);
  reset();
}

Canopy::~Canopy() = default;

void Canopy::reset() {
  fluid_.reset();
  oscillator_.reset();
  memory_ = CanopySnapshot();
  memory_.history = History(layout_.motion.fluid.cells, historyFrames(layout_.motion));
  memory_.fluid = fluid_.state();
  memory_.oscillator = oscillator_.state();
  push_forces_.clear();
  stale_ = true;
}

void Canopy::restore(const CanopySnapshot& memory) {
  if (memory.history.size() != layout_.motion.fluid.cells ||
      memory.history.frames() != historyFrames(layout_.motion))
    throw InvalidInput("snapshot: the history belongs to another layout");
  checkPush(memory.push, layout_);
  checkStubble(memory.push.stubble, layout_.plants.size(), "snapshot: ");
  Fluid fluid = fluid_;
  fluid.restore(memory.fluid);
  oscillator_.restore(memory.oscillator);
  fluid_ = std::move(fluid);
  memory_ = memory;
  push_forces_.clear();
  stale_ = true;
}

void Canopy::setMotion(const Motion& motion) {
  Layout next = layout_;
  next.motion = motion;
  checked(next);
  const Motion& now = layout_.motion;
  Motion same = motion;  // copies what may change
  same.sources = now.sources;
  same.cuts = now.cuts;
  same.warp = now.warp;
  same.oscillator = now.oscillator;
  same.oscillator.integrator = motion.oscillator.integrator;
  same.layers = now.layers;
  same.layers.memory = motion.layers.memory;
  next.motion = same;
  if (next.hash() != layout_hash_)
    throw InvalidInput(
        "motion: plane, fluid, integrator, memory and rate cannot be changed while leaves move");
  layout_.motion = motion;
  layout_hash_ = layout_.hash();
  fluid_.setSources(Sources(motion.sources, motion.fluid.cells, layout_.seed));
  oscillator_ = Oscillator(motion.oscillator, motion.fluid.cells, plane_.width);
  oscillator_.restore(memory_.oscillator);
  stale_ = true;
}

void Canopy::setBody(const forest::Body& body) {
  Faults faults;
  forest::check(body, faults);
  if (!bodies().count(body.id) && bodies().size() >= MOST_PUSHING)
    faults.add("body " + inQuotes(body.id) + " is one more than the " +
               std::to_string(MOST_PUSHING) + " allowed");
  faults.throwIfAny();
  memory_.push.bodies[body.id] = body;
}

void Canopy::removeBody(const std::string& id) {
  if (memory_.push.bodies.erase(id) == 0)
    throw InvalidInput("body " + inQuotes(id) + " is unknown", FaultCode::UNKNOWN);
}

bool Canopy::isNear(const forest::Body& body) const {
  return pusher_->isNear(memory_.push, body, memory_.stamp);
}

std::uint64_t Canopy::refusedPushes() const {
  return pusher_->refused();
}

void Canopy::setCrowns(std::vector<LeafBox> crowns) {
  foliage_.setCrowns(std::move(crowns));
  stale_ = true;
}

CutView Canopy::view() const {
  return viewer_ ? *viewer_ : viewOfPlane(layout_);
}

PlaneAir Canopy::airAt(Nanoseconds stamp) const {
  const wind::Instant instant = wind_.at(stamp);
  PlaneAir out;
  for (int j = 0; j < AIR_NODES; ++j)
    for (int i = 0; i < AIR_NODES; ++i) {
      const double right = plane_.width * (i / (AIR_NODES - 1.0) - 0.5);
      const double up = plane_.width * (j / (AIR_NODES - 1.0) - 0.5);
      const Vec3 there = (plane_.centre + plane_.axes.right * right) + plane_.axes.up * up;
      const Vec3 air = into(plane_.axes, instant.velocity(there));
      out.nodes[static_cast<std::size_t>(j * AIR_NODES + i)] = {air.x(), air.y()};
      out.depth += air.z() / (AIR_NODES * AIR_NODES);
    }
  return out;
}

void Canopy::advance(Nanoseconds stamp) {
  if (stamp <= memory_.stamp) return;
  const double dt = memory_.stamp == 0 ? 0.0 : secondsBetween(memory_.stamp, stamp);
  push_forces_.clear();
  if (dt > 0.0 && dt <= LONGEST_GAP) {
    step(stamp, dt);
    push_forces_ = pusher_->advance(memory_.push, memory_.stamp, stamp);
  }
  memory_.stamp = stamp;
  ++memory_.ticks;
  memory_.history.push(toFrame(oscillator_.motion(), oscillator_.depth()));
  updateCuts(stamp);
  const PlaneMotion mean = meanOf(oscillator_.motion());
  const Vec3 towards = PlaneToView(plane_.axes, axesOf(memory_.cuts.now.orientation)).out;
  memory_.driver.advance(dt, dot(towards, Vec3(mean.u, mean.v, oscillator_.depth())),
                         layout_.motion.layers);
  memory_.fluid = fluid_.state();
  memory_.oscillator = oscillator_.state();
  stale_ = true;
}

// Phases of the swell count from the epoch of ROS time, so that they do not depend on the start.
void Canopy::step(Nanoseconds stamp, double dt) {
  const PlaneAir air = airAt(stamp);
  fluid_.advance(secondsBetween(0, memory_.stamp), dt, &air);
  oscillator_.advance(dt, fluid_.state().flow, layout_.motion.sources.law_gain * air.depth);
}

// Cuts the layers again if the view differs enough from theirs, one transition at a time.
void Canopy::updateCuts(Nanoseconds stamp) {
  const CutView now = view();
  CutState& cuts = memory_.cuts;
  if (!memory_.has_cuts) {
    const Nanoseconds fade = fromSeconds(layout_.motion.cuts.cross_fade);
    cuts = {now, now, stamp > fade ? stamp - fade : 0};
    memory_.has_cuts = true;
    return;
  }
  if (cutShare(cuts, layout_.motion.cuts, stamp) < 1.0) return;
  if (!foliage_.cutOfPlants(cuts.now).leftBy(now, layout_.motion.cuts)) return;
  cuts = {now, cuts.now, stamp};
}

const Foliage& Canopy::foliage() {
  if (stale_) {
    foliage_.update(memory_.history, memory_.driver.share(), memory_.cuts, memory_.stamp);
    foliage_.setBent(bentCells(memory_.push));
  }
  stale_ = false;
  return foliage_;
}

StateUpdate Canopy::update(bool hashed, bool with_stubble) const {
  StateUpdate out{memory_.stamp,
                  memory_.ticks,
                  memory_.history.frame(0),
                  memory_.driver.share(),
                  memory_.cuts,
                  bentCells(memory_.push),
                  std::nullopt,
                  layout_hash_,
                  wind_.hash(),
                  hashed ? memory_.hash() : 0};
  if (with_stubble) out.stubble = memory_.push.stubble;
  return out;
}

Replica::Replica(const Layout& layout)
    : layout_(checked(layout)),
      layout_hash_(layout.hash()),
      history_(layout.motion.fluid.cells, historyFrames(layout.motion)),
      foliage_(layout_),
      plane_foliage_(layout_) {
  foliage_.setStubble(stubble_);
  plane_foliage_.setStubble(stubble_);
}

void Replica::apply(const StateUpdate& update) {
  if (update.layout_hash != layout_hash_)
    throw InvalidInput("state: layout_hash = " + std::to_string(update.layout_hash) +
                       " is not that of the layout, " + std::to_string(layout_hash_));
  foliage_.checkBent(update.bent);
  if (update.stubble) checkStubble(*update.stubble, layout_.plants.size(), "state: ");
  const bool next = received_ > 0 && update.sequence == last_.sequence + 1;
  const bool first = update.sequence <= 1;
  if (!next || first) {
    History fresh(history_.size(), history_.frames());
    fresh.push(update.frame);
    history_ = std::move(fresh);
    received_ = first ? history_.frames() : 1;  // before the first tick everything is at rest
  } else {
    history_.push(update.frame);
    ++received_;
  }
  // Before the first tick no plant has been cut. A lost message may have had others.
  if (first || update.stubble) stubble_ = update.stubble.value_or(Stubble());
  knows_stubble_ = first || update.stubble || (next && knows_stubble_);
  last_ = update;
  last_.stubble.reset();
  stale_ = plane_stale_ = true;
}

void Replica::setCrowns(std::vector<LeafBox> crowns) {
  foliage_.setCrowns(std::move(crowns));
  stale_ = true;
}

const Foliage& Replica::foliage() {
  if (stale_) {
    foliage_.update(history_, last_.front_share, last_.cuts, last_.stamp);
    foliage_.setBent(last_.bent);
  }
  stale_ = false;
  return foliage_;
}

const Foliage& Replica::foliageOfPlane() {
  const CutView view = viewOfPlane(layout_);
  if (plane_stale_) {
    plane_foliage_.update(history_, 1.0, {view, view, 0}, last_.stamp);
    plane_foliage_.setBent(last_.bent);
  }
  plane_stale_ = false;
  return plane_foliage_;
}

}  // namespace vegetation_sim::canopy
