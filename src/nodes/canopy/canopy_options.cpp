// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/canopy/canopy_options.h"

#include <map>

#include "canopy/canopy_layout_reader.h"
#include "core/config/field_values.h"
#include "nodes/canopy/pushing_bodies.h"
#include "ros/params/plant_files.h"
#include "ros/services/frame_lookup.h"

namespace vegetation_sim {
void describe(FieldVisitor& v, CanopyTuning& t) {
  constexpr std::array<const char*, canopy::SIDES> SIDE{"rightward", "leftward", "upward",
                                                        "downward"};
  constexpr std::array<const char*, canopy::SIDES> SWELL{
      "rightward_frequency", "leftward_frequency", "upward_frequency", "downward_frequency"};
  for (std::size_t i = 0; i < canopy::SIDES; ++i) {
    v.number(SIDE[i], t.sources.sides[i].strength, "m/s", {0.0, 50.0});
    v.number(SWELL[i], t.sources.sides[i].frequency, "Hz", {0.0, 100.0});
  }
  v.number("turbulence", t.sources.turbulence, "", {0.0, 1.0});
  v.number("law_gain", t.sources.law_gain, "", {0.0, 10.0});
  v.number("frequency", t.oscillator.frequency, "Hz", {0.05, 20.0});
  v.number("damping", t.oscillator.damping, "", {0.0, 50.0});
  v.number("speed", t.oscillator.speed, "m/s", {0.0, 20.0});
  v.number("reference_time", t.warp.reference_time, "s", {0.0, 1.0});
  v.number("rigidity", t.warp.rigidity, "", {0.0, 10.0});
  v.number("delay_speed", t.layers.delay_speed, "m/s", {0.01, 100.0});
  v.number("depth_loss", t.warp.depth_loss, "", {0.0, 1.0});
  v.integer("near_layers", t.cuts.near_layers, "", {0, canopy::MOST_LAYERS});
  v.integer("mid_layers", t.cuts.mid_layers, "", {0, canopy::MOST_LAYERS});
  v.integer("far_layers", t.cuts.far_layers, "", {0, canopy::MOST_LAYERS});
}

CanopyTuning tuningOf(const canopy::Motion& motion) {
  return {motion.sources, motion.oscillator, motion.layers, motion.cuts, motion.warp};
}

canopy::Motion withTuning(canopy::Motion motion, const CanopyTuning& tuning) {
  CanopyTuning all = tuningOf(motion), named = tuning;
  std::map<std::string, double> values;
  FieldCopier reader(values, true), writer(values, false);
  describe(reader, named);
  describe(writer, all);
  motion.sources = all.sources;
  motion.oscillator = all.oscillator;
  motion.layers = all.layers;
  motion.cuts = all.cuts;
  motion.warp = all.warp;
  return motion;
}

CanopyTuning fromConfig(const CanopyAnimatorConfig& config) {
  CanopyTuning out;
  out.sources.sides = {{{config.rightward, config.rightward_frequency},
                        {config.leftward, config.leftward_frequency},
                        {config.upward, config.upward_frequency},
                        {config.downward, config.downward_frequency}}};
  out.sources.turbulence = config.turbulence;
  out.sources.law_gain = config.law_gain;
  out.oscillator.frequency = config.frequency;
  out.oscillator.damping = config.damping;
  out.oscillator.speed = config.speed;
  out.warp.reference_time = config.reference_time;
  out.warp.rigidity = config.rigidity;
  out.layers.delay_speed = config.delay_speed;
  out.warp.depth_loss = config.depth_loss;
  out.cuts.near_layers = config.near_layers;
  out.cuts.mid_layers = config.mid_layers;
  out.cuts.far_layers = config.far_layers;
  return out;
}

void toConfig(const CanopyTuning& tuning, CanopyAnimatorConfig& config) {
  const auto& sides = tuning.sources.sides;
  config.rightward = sides[0].strength;
  config.rightward_frequency = sides[0].frequency;
  config.leftward = sides[1].strength;
  config.leftward_frequency = sides[1].frequency;
  config.upward = sides[2].strength;
  config.upward_frequency = sides[2].frequency;
  config.downward = sides[3].strength;
  config.downward_frequency = sides[3].frequency;
  config.turbulence = tuning.sources.turbulence;
  config.law_gain = tuning.sources.law_gain;
  config.frequency = tuning.oscillator.frequency;
  config.damping = tuning.oscillator.damping;
  config.speed = tuning.oscillator.speed;
  config.reference_time = tuning.warp.reference_time;
  config.rigidity = tuning.warp.rigidity;
  config.delay_speed = tuning.layers.delay_speed;
  config.depth_loss = tuning.warp.depth_loss;
  config.near_layers = tuning.cuts.near_layers;
  config.mid_layers = tuning.cuts.mid_layers;
  config.far_layers = tuning.cuts.far_layers;
}

void describe(FieldVisitor& v, CanopyOptions& o) {
  v.integer("marker_points", o.marker_points, "", {600, 3000000});
  v.number("tolerance", o.tolerance, "pixel", {0.01, 1000.0});
  v.number("frame_wait", o.frame_wait, "s", {0.0, FrameLookup::LONGEST_WAIT});
  v.number("cover_resolution", o.cover_resolution, "m", {0.02, 100.0});
}

CanopyScene loadCanopyScene(const std::string& name) {
  CanopyScene out;
  if (name.empty()) return out;
  SceneFile file(name, out);
  file.loadTerrain();
  if (file.has("canopy")) {
    YamlSection section = file.section("canopy");
    out.cutters = readCutters(section);
    out.layout = canopy::readLayout(std::move(section), file.folder(), *out.terrain, out.seed,
                                    file.faults());
    Faults forms;
    loadForms(out.layout, file.folder(), forms);
    if (forms.empty() && file.faults().empty()) canopy::check(out.layout, forms);
    for (const std::string& fault : forms.list()) file.faults().add(file.path() + ": " + fault);
  }
  file.finish();
  return out;
}

CanopyOptions loadCanopyOptions(const ros::NodeHandle& private_handle) {
  CanopyOptions out;
  Parameters parameters(private_handle);
  readScenario(parameters, out, loadCanopyScene);
  parameters.text("viewer_id", out.viewer_id);
  parameters.frame("viewer_frame", out.viewer_frame, true);
  parameters.flag("walkers", out.walkers);
  describe(parameters, out);
  out.robot = readRobotParts(private_handle, parameters);
  for (const forest::Body& part : out.robot.parts)
    if (part.id.rfind(WALKER_PREFIX, 0) == 0)
      parameters.faults().add("~bodies: id = " + part.id + " begins with " + WALKER_PREFIX +
                              ", as the ids of people do");
  out.cutters = out.scene.cutters;
  if (YAML::Node list; parameters.list("cutters", list)) {
    YamlSection section(list, private_handle.getNamespace(), parameters.faults());
    out.cutters = readCutters(section);
  }
  canopy::Layout& layout = out.scene.layout;
  CanopyTuning tuning = tuningOf(layout.motion);
  describe(parameters, tuning);
  layout.motion = withTuning(layout.motion, tuning);
  if (parameters.faults().empty()) canopy::check(layout, parameters.faults());
  parameters.finish();
  out.state_rate = layout.motion.rate;
  return out;
}

}  // namespace vegetation_sim
