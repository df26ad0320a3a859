// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/body/bvh.h"

#include <algorithm>
#include <cmath>

#include "core/config/numbers.h"
#include "vegetation_sim/core/config/faults.h"
#include "vegetation_sim/core/config/fields.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::crowd {
namespace {

constexpr std::size_t MOST_JOINTS = 256, MOST_DEPTH = 64, MOST_VALUES = 2000000;
constexpr std::size_t LONGEST_WORD = 80;
constexpr Range OFFSETS{-1e5, 1e5}, VALUES{-1e6, 1e6}, FRAME_TIMES{1e-3, 1.0};
constexpr Range FRAMES{2.0, 100000.0};
const std::string END_SITE = "End Site";

/// The words of a text, and the line of each.
class BvhReader {
 public:
  BvhReader(const std::string& text, const std::string& name) : text_(text), name_(name) {
    if (text.size() > LARGEST_BVH)
      throw InvalidInput(name + ": " + std::to_string(text.size()) + " bytes, allowed are " +
                         std::to_string(LARGEST_BVH));
  }

  BvhMotion read() {
    expect("HIERARCHY");
    expect("ROOT");
    readJoint(-1, 1);
    expect("MOTION");
    expect("Frames:");
    const double frames = readNumber("number of frames", FRAMES, "");
    if (frames != std::floor(frames)) fail("number of frames = " + word_ + " is no whole number");
    expect("Frame");
    expect("Time:");
    out_.frame_time = readNumber("frame time", FRAME_TIMES, "s");
    readFrames(static_cast<std::size_t>(frames));
    if (advance()) fail("'" + shown() + "' after the last frame");
    return std::move(out_);
  }

 private:
  [[noreturn]] void fail(const std::string& fault) const {
    throw InvalidInput(name_ + ":" + std::to_string(line_) + ": " + fault);
  }

  // Control characters and the rest of long words are not shown.
  std::string shown() const {
    std::string out = word_.substr(0, LONGEST_WORD);
    std::replace_if(
        out.begin(), out.end(), [](unsigned char c) { return c < 32 || c > 126; }, '?');
    return out;
  }

  /// Returns false at the end of the text.
  bool advance() {
    const auto isSpace = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; };
    for (; at_ < text_.size() && isSpace(text_[at_]); ++at_) line_ += text_[at_] == '\n';
    const std::size_t first = at_;
    while (at_ < text_.size() && !isSpace(text_[at_])) ++at_;
    word_.assign(text_, first, at_ - first);
    return !word_.empty();
  }

  void next(const char* what) {
    if (!advance()) fail(std::string("the text ends, expected ") + what);
  }

  void expect(const char* word) {
    next(word);
    if (word_ != word) fail("'" + shown() + "', expected " + word);
  }

  double readNumber(const char* what, Range range, const char* unit) {
    next(what);
    const auto value = word_.size() <= LONGEST_WORD ? parseNumber(word_) : std::nullopt;
    if (!value) fail(std::string(what) + " = '" + shown() + "' is no number");
    if (!range.contains(*value)) {
      double rejected = *value;
      Faults faults;
      FieldChecker(name_ + ":" + std::to_string(line_) + ": ", faults)
          .number(what, rejected, unit, range);
      faults.throwIfAny();
    }
    return *value;
  }

  void readOffset(BvhMotion::Joint& joint) {
    for (int axis = 0; axis < 3; ++axis) joint.offset[axis] = readNumber("OFFSET", OFFSETS, "");
  }

  void readChannels(BvhMotion::Joint& joint) {
    const double count = readNumber("CHANNELS", {0.0, 6.0}, "");
    if (count != std::floor(count)) fail("CHANNELS = " + word_ + " is no whole number");
    static const char* const NAMES[] = {"Xposition", "Yposition", "Zposition",
                                        "Xrotation", "Yrotation", "Zrotation"};
    for (int i = 0; i < static_cast<int>(count); ++i) {
      next("a channel");
      const auto found = std::find(std::begin(NAMES), std::end(NAMES), word_);
      if (found == std::end(NAMES))
        fail("channel '" + shown() + "' is none of Xposition to Zrotation");
      const auto channel = static_cast<int>(found - std::begin(NAMES));
      if (std::find(joint.channels.begin(), joint.channels.end(), channel) != joint.channels.end())
        fail("channel " + word_ + " twice in joint '" + joint.name + "'");
      joint.channels.push_back(channel);
    }
    out_.channels += joint.channels.size();
  }

  // The word before the name has been read.
  void readJoint(int parent, std::size_t depth) {
    if (depth > MOST_DEPTH)
      fail("joints in joints, allowed are " + std::to_string(MOST_DEPTH) + " levels");
    if (out_.joints.size() >= MOST_JOINTS)
      fail("more than " + std::to_string(MOST_JOINTS) + " joints");
    const bool ends = word_ == "End";
    BvhMotion::Joint joint;
    joint.parent = parent;
    if (ends)
      expect("Site");
    else
      next("the name of a joint");
    joint.name = ends ? END_SITE : shown();
    expect("{");
    expect("OFFSET");
    readOffset(joint);
    if (!ends) {
      expect("CHANNELS");
      readChannels(joint);
    }
    const auto index = static_cast<int>(out_.joints.size());
    out_.joints.push_back(std::move(joint));
    for (next("}"); word_ != "}"; next("}")) {
      if (ends || (word_ != "JOINT" && word_ != "End"))
        fail("'" + shown() + "', expected " + (ends ? "}" : "JOINT, End or }"));
      readJoint(index, depth + 1);
    }
  }

  void readFrames(std::size_t frames) {
    if (out_.channels == 0) fail("the joints have no channels");
    const std::size_t size = frames * std::max(out_.channels, out_.joints.size());
    if (size > MOST_VALUES)
      fail(std::to_string(size) + " numbers or joints in all frames, allowed are " +
           std::to_string(MOST_VALUES));
    for (std::size_t i = 0; i < frames * out_.channels; ++i)
      out_.values.push_back(readNumber("value of a channel", VALUES, ""));
  }

  const std::string& text_;
  const std::string& name_;
  std::size_t at_{0};
  int line_{1};
  std::string word_;
  BvhMotion out_;
};

Quat rotationAbout(int axis, double degrees) {
  const SinCos half = sinCosTurns(degrees / 720.0);
  return {half.cos, axis == 0 ? half.sin : 0.0, axis == 1 ? half.sin : 0.0,
          axis == 2 ? half.sin : 0.0};
}

}  // namespace

BvhMotion parseBvh(const std::string& text, const std::string& name) {
  return BvhReader(text, name).read();
}

// Positions replace the offset of their joint.
std::vector<Vec3> jointPositions(const BvhMotion& motion, std::size_t frame) {
  std::vector<Vec3> out;
  std::vector<Quat> turns;
  std::size_t at = frame * motion.channels;
  for (const BvhMotion::Joint& joint : motion.joints) {
    Vec3 place = joint.offset;
    Quat turn;
    for (const int channel : joint.channels) {
      const double value = motion.values[at++];
      if (channel < BvhMotion::FIRST_ROTATION)
        place[channel] = value;
      else
        turn = turn * rotationAbout(channel - BvhMotion::FIRST_ROTATION, value);
    }
    if (joint.parent >= 0) {
      const auto parent = static_cast<std::size_t>(joint.parent);
      place = out[parent] + rotate(turns[parent], place);
      turn = turns[parent] * turn;
    }
    out.push_back(place);
    turns.push_back(turn);
  }
  return out;
}

}  // namespace vegetation_sim::crowd
