// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/body/bvh_clip.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "vegetation_sim/core/config/fields.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::crowd {
namespace {

constexpr double SHORTEST_CYCLE = 0.5;  // of walking [s]
constexpr Range TURN_RATES{0.1, 10.0};

/// Indices of the joints of a body.
struct BodyJoints {
  std::size_t neck, head;
  std::array<std::size_t, 2> thigh, shank, foot, toe, upper_arm, forearm, hand;
};

// Returns a name in small letters without the prefix of a program and without separators.
std::string plainName(const std::string& name) {
  const std::size_t colon = name.rfind(':');
  std::string out;
  for (const char c : colon == std::string::npos ? name : name.substr(colon + 1)) {
    if (c >= 'A' && c <= 'Z') out += static_cast<char>(c - 'A' + 'a');
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')) out += c;
  }
  return out;
}

/// Finds joints by names, of which the first one that exists counts.
class JointFinder {
 public:
  JointFinder(const BvhMotion& motion, const std::string& file) : motion_(motion), file_(file) {
    for (const BvhMotion::Joint& joint : motion.joints) names_.push_back(plainName(joint.name));
  }

  std::size_t find(const std::vector<std::string>& names) const {
    for (const std::string& name : names) {
      const auto found = std::find(names_.begin(), names_.end(), name);
      if (found != names_.end()) return static_cast<std::size_t>(found - names_.begin());
    }
    throw InvalidInput(file_ + ": no joint '" + names.front() + "' or " + names.back());
  }

  std::array<std::size_t, 2> findPair(const std::vector<std::string>& names) const {
    std::array<std::size_t, 2> out{};
    for (std::size_t side = 0; side < 2; ++side) {
      std::vector<std::string> all;
      for (const char* prefix : side == 0 ? std::array<const char*, 2>{"left", "l"}
                                          : std::array<const char*, 2>{"right", "r"})
        for (const std::string& name : names) all.push_back(prefix + name);
      out[side] = find(all);
    }
    return out;
  }

  // Returns the first child, or the joint itself if it has none.
  std::size_t endOf(std::size_t joint) const {
    for (std::size_t i = joint + 1; i < motion_.joints.size(); ++i)
      if (motion_.joints[i].parent == static_cast<int>(joint)) return i;
    return joint;
  }

 private:
  const BvhMotion& motion_;
  const std::string& file_;
  std::vector<std::string> names_;
};

BodyJoints findJoints(const BvhMotion& motion, const std::string& file) {
  const JointFinder finder(motion, file);
  BodyJoints out{};
  out.thigh = finder.findPair({"upleg", "hip", "thigh", "upperleg", "hipjoint", "femur"});
  out.shank = finder.findPair({"leg", "knee", "shin", "lowerleg", "lowleg", "tibia", "calf"});
  out.foot = finder.findPair({"foot", "ankle"});
  out.upper_arm = finder.findPair({"arm", "uparm", "upperarm", "humerus", "shldr", "shoulder"});
  out.forearm = finder.findPair({"forearm", "elbow", "lowarm", "lowerarm", "radius"});
  out.hand = finder.findPair({"hand", "wrist"});
  out.neck = finder.find({"neck", "neck1", "head"});
  out.head = finder.endOf(finder.find({"head", "neck1", "neck"}));
  for (std::size_t side = 0; side < 2; ++side) out.toe[side] = finder.endOf(out.foot[side]);
  return out;
}

// Axes x to the front, y to the left, z up, where the file has y up.
Vec3 turnUpright(const Vec3& v) {
  return {v.z(), v.x(), v.y()};
}

/// Measures the angles of a body in frames.
class AngleMeter {
 public:
  AngleMeter(const BvhMotion& motion, const std::string& file)
      : motion_(motion), joints_(findJoints(motion, file)) {
    const std::vector<Vec3> rest = restPositions();
    setHeading(acrossHips(rest));
    for (std::size_t side = 0; side < 2; ++side) rest_pitch_[side] = pitchOfFoot(rest, side);
  }

  std::vector<Vec3> positionsAt(std::size_t frame) const {
    std::vector<Vec3> out = jointPositions(motion_, frame);
    for (Vec3& place : out) place = turnUpright(place);
    return out;
  }

  /// Sets the direction to the left of the body; the front is at a right angle to it.
  void setHeading(Vec3 left) {
    left.z() = 0.0;
    const double size = length(left);
    left_ = size > 1e-9 ? Vec3(left / size) : Vec3(Vec3::UnitY());
    front_ = cross(left_, Vec3::UnitZ());
  }
  Vec3 acrossHips(const std::vector<Vec3>& p) const {
    return p[joints_.thigh[0]] - p[joints_.thigh[1]];
  }
  /// Angle of a line to the left of the body from that of setHeading(), to the left positive.
  double yawOf(const Vec3& across) const {
    return arcTangent(-dot(across, front_), dot(across, left_));
  }
  /// How far the left ankle is in front of its hip.
  double strideOf(const std::vector<Vec3>& p) const {
    return dot(p[joints_.foot[0]] - p[joints_.thigh[0]], front_);
  }

  ChannelAngles anglesOf(const std::vector<Vec3>& p) const {
    ChannelAngles out{};
    const Vec3 hips = acrossHips(p), hip = 0.5 * (p[joints_.thigh[0]] + p[joints_.thigh[1]]);
    const Vec3 shoulders = p[joints_.upper_arm[0]] - p[joints_.upper_arm[1]];
    const Vec3 spine = p[joints_.neck] - hip, head = p[joints_.head] - p[joints_.neck];
    out[indexOf(Channel::PELVIS_YAW)] = yawOf(hips);
    out[indexOf(Channel::PELVIS_ROLL)] = rollOf(hips);
    out[indexOf(Channel::TRUNK_YAW)] = yawOf(shoulders);
    out[indexOf(Channel::TRUNK_ROLL)] = -arcTangent(dot(spine, left_), spine.z());
    out[indexOf(Channel::TRUNK_PITCH)] = arcTangent(dot(spine, front_), spine.z());
    out[indexOf(Channel::HEAD_PITCH)] = arcTangent(dot(head, front_), head.z());
    for (int side = 0; side < 2; ++side) putSide(p, side, out);
    return out;
  }

 private:
  std::vector<Vec3> restPositions() const {
    std::vector<Vec3> out;
    for (const BvhMotion::Joint& joint : motion_.joints)
      out.push_back(
          turnUpright(joint.offset) +
          (joint.parent < 0 ? Vec3(Vec3::Zero()) : out[static_cast<std::size_t>(joint.parent)]));
    return out;
  }

  double rollOf(const Vec3& across) const { return arcTangent(across.z(), dot(across, left_)); }
  // Angle of a hanging limb, forward positive.
  double swingOf(const Vec3& limb) const { return arcTangent(dot(limb, front_), -limb.z()); }
  double pitchOfFoot(const std::vector<Vec3>& p, std::size_t side) const {
    const Vec3 foot = p[joints_.toe[side]] - p[joints_.foot[side]];
    return arcTangent(foot.z(), dot(foot, front_));
  }

  void putSide(const std::vector<Vec3>& p, int side, ChannelAngles& out) const {
    const auto i = static_cast<std::size_t>(side);
    const Vec3 upper = p[joints_.forearm[i]] - p[joints_.upper_arm[i]];
    const double hip = swingOf(p[joints_.shank[i]] - p[joints_.thigh[i]]);
    const double shank = swingOf(p[joints_.foot[i]] - p[joints_.shank[i]]);
    const double shoulder = swingOf(upper);
    out[indexOf(Channel::HIP, side)] = hip;
    out[indexOf(Channel::KNEE, side)] = std::remainder(hip - shank, 2.0 * PI);
    out[indexOf(Channel::ANKLE, side)] =
        std::remainder(pitchOfFoot(p, i) - rest_pitch_[i] - shank, 2.0 * PI);
    out[indexOf(Channel::SHOULDER, side)] = shoulder;
    out[indexOf(Channel::ELBOW, side)] =
        std::remainder(swingOf(p[joints_.hand[i]] - p[joints_.forearm[i]]) - shoulder, 2.0 * PI);
    out[indexOf(Channel::ARM_OUT, side)] =
        arcTangent((side == 0 ? 1.0 : -1.0) * dot(upper, left_), -upper.z());
  }

  const BvhMotion& motion_;
  BodyJoints joints_;
  Vec3 front_{Vec3::UnitX()}, left_{Vec3::UnitY()};
  std::array<double, 2> rest_pitch_{};
};

/// First frame and number of frames of a cycle.
struct Cycle {
  std::size_t first, frames;
};

// The left heel strikes where its ankle is farthest in front. Without two strikes the whole file is
// one cycle that begins at the one.
Cycle findCycle(const std::vector<double>& stride, double frame_time) {
  const std::size_t frames = stride.size();
  const auto farthest = std::max_element(stride.begin(), stride.end());
  const auto apart = static_cast<std::size_t>(std::max(1.0, SHORTEST_CYCLE / frame_time));
  std::vector<std::size_t> strikes;
  for (std::size_t i = 1; i + 1 < frames; ++i) {
    const bool top = stride[i] >= stride[i - 1] && stride[i] > stride[i + 1];
    if (!top || stride[i] < 0.6 * *farthest) continue;
    if (!strikes.empty() && i - strikes.back() < apart) continue;
    strikes.push_back(i);
  }
  if (strikes.size() >= 2) return {strikes[0], strikes[1] - strikes[0]};
  return {static_cast<std::size_t>(farthest - stride.begin()), frames - 1};
}

// Keys of a cycle of frames, wrapped around the end of the file. The gap between its ends is spread
// over it.
Clip resample(const std::vector<ChannelAngles>& frames, const Cycle& cycle) {
  Clip::Keys keys;
  const std::size_t loop = frames.size() - 1;
  const bool wraps = cycle.first + cycle.frames >= frames.size();
  const ChannelAngles &begin = frames[wraps ? 0 : cycle.first],
                      &end = frames[wraps ? loop : cycle.first + cycle.frames];
  for (std::size_t k = 0; k < Clip::KEYS; ++k) {
    const double at = static_cast<double>(k * cycle.frames) / Clip::KEYS;
    const auto whole = static_cast<std::size_t>(at);
    const double part = at - static_cast<double>(whole);
    const std::size_t i = wraps ? (cycle.first + whole) % loop : cycle.first + whole;
    // Share of the way from the frame that has the one end to that which has the other.
    const double way =
        wraps ? std::fmod(static_cast<double>(cycle.first) + at, static_cast<double>(loop)) /
                    static_cast<double>(loop)
              : at / static_cast<double>(cycle.frames);
    for (std::size_t c = 0; c < CHANNELS; ++c)
      keys[k][c] = std::clamp(frames[i][c] + part * (frames[i + 1][c] - frames[i][c]) -
                                  (way - 0.5) * (end[c] - begin[c]),
                              -LARGEST_ANGLE, LARGEST_ANGLE);
  }
  return Clip(keys);
}

// Returns what turning left at 1 rad/s adds. Legs follow the feet, so the means of yaw and roll of
// the trunk remain.
Clip clipOfTurn(const std::vector<ChannelAngles>& frames, double rate, const std::string& name) {
  Faults faults;
  double size = std::fabs(rate);
  FieldChecker(name + ": ", faults).number("turn", size, "rad/s", TURN_RATES);
  faults.throwIfAny();
  Clip::Keys keys{};
  for (const Channel channel : {Channel::PELVIS_ROLL, Channel::TRUNK_YAW, Channel::TRUNK_ROLL}) {
    double sum = 0.0;
    for (const ChannelAngles& angles : frames) sum += angles[indexOf(channel)];
    const double mean = sum / static_cast<double>(frames.size()) / rate;
    for (ChannelAngles& key : keys)
      key[indexOf(channel)] = std::clamp(mean, -LARGEST_ANGLE, LARGEST_ANGLE);
  }
  return Clip(keys);
}

}  // namespace

Clip makeClip(const BvhMotion& motion, ClipKind kind, const std::string& name) {
  AngleMeter meter(motion, name);
  Vec3 left = Vec3::Zero();
  for (std::size_t i = 0; i < motion.frames(); ++i) left += meter.acrossHips(meter.positionsAt(i));
  meter.setHeading(left);
  std::vector<ChannelAngles> frames;
  std::vector<double> stride;
  double turned = 0.0;
  for (std::size_t i = 0; i < motion.frames(); ++i) {
    const std::vector<Vec3> p = meter.positionsAt(i);
    if (kind == ClipKind::TURN) {
      if (!frames.empty()) turned += meter.yawOf(meter.acrossHips(p));
      meter.setHeading(meter.acrossHips(p));
    }
    frames.push_back(meter.anglesOf(p));
    stride.push_back(meter.strideOf(p));
  }
  const std::size_t steps = motion.frames() - 1;
  if (kind == ClipKind::TURN)
    return clipOfTurn(frames, turned / (static_cast<double>(steps) * motion.frame_time), name);
  if (kind == ClipKind::WALK) return resample(frames, findCycle(stride, motion.frame_time));
  return resample(frames, {0, steps});
}

}  // namespace vegetation_sim::crowd
