// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/canopy/layers/layer_delay.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "canopy/layers/layer_pass.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::canopy {
namespace {

constexpr double LONGEST_DELAY = 1e4;  // [s] limit of the printed form at its pole
constexpr double STILL = 1e-6;         // [m/s] slower motion has no direction

/// Motion of one cell of one layer with one of the two drivers.
class Lookup {
 public:
  Lookup(const LayerView& view, double distance, double delay_speed, double sign)
      : view_(view), distance_(distance), delay_speed_(delay_speed), sign_(sign) {}

  PlaneMotion at(std::size_t cell, const PlaneMotion& now) const {
    const LayerSettings& s = *view_.settings;
    const double vz = dot(view_.towards, Vec3(now.u, now.v, now.depth));
    double delay = layerDelay(distance_, vz, delay_speed_, s.delay == Formula::PRINTED);
    if (s.delay == Formula::DERIVED) delay = std::fabs(delay);  // the driver determines the sign
    if (s.model == LayerModel::HISTORY) return view_.history->at(cell, delay / view_.tick);
    return elsewhere(cell, now, sign_ * delay);
  }

 private:
  PlaneMotion elsewhere(std::size_t cell, const PlaneMotion& now, double delay) const {
    const double speed = std::sqrt(now.u * now.u + now.v * now.v);
    if (speed < STILL) return now;
    const LayerSettings& s = *view_.settings;
    const double unit = s.direction == LookupDirection::UNIT ? 1.0 / speed : 1.0;
    const double cells = delay * s.wave_speed * unit / view_.cell;
    const int size = view_.history->size();
    const int column = static_cast<int>(cell) & (size - 1), row = static_cast<int>(cell) / size;
    const auto bounded = [](double x) { return std::min(1e6, std::max(-1e6, x)); };
    return view_.history->newestAt(column + bounded(cells * now.u), row + bounded(cells * now.v));
  }

  const LayerView& view_;
  double distance_, delay_speed_, sign_;
};

/// The default, from the history with the derived delay, for many cells at once.
class FastLayer {
 public:
  FastLayer(const LayerView& view, double delay_speed) : pass_() {
    for (int age = 0; age < view.history->frames(); ++age) {
      const MotionFrame& frame = view.history->frame(age);
      frames_.u.push_back(frame.u.data());
      frames_.v.push_back(frame.v.data());
      frames_.depth.push_back(static_cast<float>(fromHalf(frame.depth)));
    }
    pass_.frames = &frames_;
    for (std::size_t i = 0; i < 3; ++i)
      pass_.towards[i] = static_cast<float>(view.towards[static_cast<int>(i)]);
    pass_.delay_speed = static_cast<float>(delay_speed);
    pass_.rate = static_cast<float>(1.0 / view.tick);
    pass_.u = &u_;
    pass_.v = &v_;
    pass_.depth = &depth_;
  }

  void write(LayerMotion& out, double distance) {
    evaluate(out, distance, [](float from, double& to) { to = static_cast<double>(from); });
  }
  void mix(LayerMotion& out, double distance, double share) {
    evaluate(out, distance, [share](float from, double& to) {
      to = (1.0 - share) * to + share * static_cast<double>(from);
    });
  }

 private:
  template <class Put>
  void evaluate(LayerMotion& out, double distance, Put put) {
    pass_.distance = static_cast<float>(distance);
    for (pass_.begin = 0; pass_.begin < out.depth.size(); pass_.begin += PASS) {
      samplePast(pass_);
      for (std::size_t i = 0; i < PASS; ++i) {
        put(u_[i], out.plane.u[pass_.begin + i]);
        put(v_[i], out.plane.v[pass_.begin + i]);
        put(depth_[i], out.depth[pass_.begin + i]);
      }
    }
  }

  FramesByAge frames_;
  LayerPass pass_;
  std::array<float, PASS> u_, v_, depth_;
};

}  // namespace

void describe(FieldVisitor& v, LayerSettings& s) {
  v.choice("model", s.model, {"history", "lookup"});
  v.choice("delay", s.delay, {"right", "printed"});
  v.choice("direction", s.direction, {"unit", "printed"});
  v.number("delay_speed", s.delay_speed, "m/s", {0.01, 100.0});
  v.number("spread", s.spread, "", {0.0, 0.9});
  v.number("wave_speed", s.wave_speed, "m/s", {0.0, 20.0});
  v.number("fade", s.fade, "s", {0.01, 60.0});
  v.number("hysteresis", s.hysteresis, "m/s", {0.0, 10.0});
  v.number("memory", s.memory, "s", {0.05, 10.0});
}

double layerDelay(double distance, double vz, double delay_speed, bool printed) {
  if (!printed) {
    const double size = distance / (std::fabs(vz) + delay_speed);
    return vz > 0.0 ? -size : size;
  }
  const double delay = distance / (delay_speed - vz);
  return std::isfinite(delay) ? std::min(LONGEST_DELAY, std::max(-LONGEST_DELAY, delay)) : 0.0;
}

double delaySpeedOf(const LayerSettings& settings, std::uint64_t seed, int layer) {
  const double draw = Random(seed).uniform(static_cast<std::uint64_t>(layer), -1.0, 1.0);
  return settings.delay_speed * (1.0 + settings.spread * draw);
}

void Driver::advance(double dt, double mean_vz, const LayerSettings& settings) {
  if (front_ ? mean_vz > settings.hysteresis : mean_vz < -settings.hysteresis) front_ = !front_;
  const double way = dt / settings.fade;
  share_ = saturate(front_ ? share_ + way : share_ - way);
}

void layerMotion(const LayerView& view, double distance, double last, double delay_speed,
                 LayerMotion& out) {
  const int size = view.history->size();
  if (out.plane.size != size) out.plane = PlaneField(size);
  out.depth.resize(out.plane.area());
  const double share =
      view.settings->delay == Formula::PRINTED ? 1.0 : smoothStep(view.front_share);
  if (view.settings->model == LayerModel::HISTORY && view.settings->delay == Formula::DERIVED) {
    FastLayer layer(view, delay_speed);
    layer.write(out, distance);
    if (share < 1.0) layer.mix(out, last - distance, 1.0 - share);
    return;
  }
  const Lookup front(view, distance, delay_speed, 1.0);
  // Equation 5 looks up against the motion for a layer that is ahead. The history has no future, so
  // there the last layer drives and the others follow it.
  const bool ahead = view.settings->model == LayerModel::LOOKUP;
  const Lookup back(view, ahead ? distance : last - distance, delay_speed, -1.0);
  for (std::size_t cell = 0; cell < out.depth.size(); ++cell) {
    const PlaneMotion now = view.history->at(cell, 0.0);
    PlaneMotion value;
    if (share > 0.0) value = front.at(cell, now);
    if (share < 1.0) {
      const PlaneMotion other = back.at(cell, now);
      value.u = share * value.u + (1.0 - share) * other.u;
      value.v = share * value.v + (1.0 - share) * other.v;
      value.depth = share * value.depth + (1.0 - share) * other.depth;
    }
    out.plane.u[cell] = value.u;
    out.plane.v[cell] = value.v;
    out.depth[cell] = value.depth;
  }
}

}  // namespace vegetation_sim::canopy
