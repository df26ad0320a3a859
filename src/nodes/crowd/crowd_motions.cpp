// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/crowd/crowd_motions.h"

#include "core/config/files.h"
#include "crowd/body/bvh_clip.h"
#include "ros/params/resources.h"

namespace vegetation_sim {
namespace {

// Reads a file. Returns its duration [s], or 0 without one.
double readClip(YamlSection& section, const char* key, crowd::ClipKind kind, crowd::Clip& clip) {
  std::string name;
  section.text(key, name);
  if (name.empty()) return 0.0;
  try {
    const std::string file = findPublishedFile(name, resourceFolders());
    const crowd::BvhMotion motion = crowd::parseBvh(readFile(file, crowd::LARGEST_BVH), name);
    clip = crowd::makeClip(motion, kind, name);
    return static_cast<double>(motion.frames() - 1) * motion.frame_time;
  } catch (const InvalidInput& error) {
    section.fault(key, std::string(": ") + error.what());
  }
  return 0.0;
}

}  // namespace

crowd::MotionStyles readMotions(YamlSection& section) {
  crowd::MotionStyles out;
  std::vector<YamlSection> entries = section.sections("motions");
  if (entries.size() > crowd::MOST_STYLES) {
    section.fault("motions", "has " + std::to_string(entries.size()) + " styles, allowed are " +
                                 std::to_string(crowd::MOST_STYLES));
    return crowd::ownStyles();
  }
  for (YamlSection& entry : entries) {
    crowd::MotionStyle style = crowd::ownStyles().front();
    style.name = "style " + std::to_string(out.size() + 1);
    entry.text("name", style.name);
    readClip(entry, "walk", crowd::ClipKind::WALK, style.walk);
    readClip(entry, "turn", crowd::ClipKind::TURN, style.turn);
    const double period = readClip(entry, "stand", crowd::ClipKind::STAND, style.stand);
    if (period > 0.0) style.stand_period = period;
    entry.finish();
    out.push_back(style);
  }
  if (out.empty()) return crowd::ownStyles();
  Faults faults;
  crowd::check(out, faults);
  for (const std::string& fault : faults.list()) section.fault(fault);
  return out;
}

}  // namespace vegetation_sim
