// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/sensors/scanner_options.h"

#include <filesystem>
#include <set>

#include "ros/params/parameters.h"
#include "ros/params/resources.h"
#include "vegetation_sim/core/config/yaml.h"

namespace vegetation_sim {

void describe(FieldVisitor& v, ScanOptions& o) {
  describe(v, static_cast<SensorOptions&>(o));
  v.choice("motion", o.motion, {"none", "deskewed", "raw"});
  v.number("sky_range", o.sky_range, "m", {1.0, 500.0});
  describe(v, o.lidar);
}

namespace {

constexpr std::size_t MOST_SKY_FRAMES = 16;

// Returns the names of the presets, with commas.
std::string namesOfPresets(const std::string& folder) {
  std::set<std::string> names;
  std::error_code error;
  for (const auto& file : std::filesystem::directory_iterator(folder, error))
    if (file.path().extension() == ".yaml") names.insert(file.path().stem().string());
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ", ") + name;
  return out;
}

// Reads the preset that a parameter names.
void readPreset(Parameters& parameters, scan::Lidar& lidar) {
  std::string preset;
  parameters.text("preset", preset);
  if (preset.empty()) return;
  try {
    const std::string folder = resolveFile("package://vegetation_sim/config/sensors");
    const bool named = preset.find_first_of("/.") == std::string::npos;
    const std::string file = named ? folder + "/" + preset + ".yaml" : resolveFile(preset);
    if (named && !std::filesystem::exists(file))
      return parameters.fault("preset", "= " + inQuotes(preset) + " is none of " +
                                            namesOfPresets(folder) + ", and no path of a file");
    YamlSection section(loadYamlFile(file), file, parameters.faults());
    describe(section, lidar);
    section.finish();
  } catch (const InvalidInput& error) {
    parameters.fault("preset", "= " + inQuotes(preset) + ": " + error.what());
  }
}

}  // namespace

ScanOptions loadScanOptions(const ros::NodeHandle& private_handle) {
  ScanOptions out;
  Parameters parameters(private_handle);
  readNames(parameters, out);
  parameters.frame("lidar_frame", out.lidar_frame, true);
  parameters.frames("sky_frames", out.sky_frames, MOST_SKY_FRAMES);
  readPreset(parameters, out.lidar);
  describe(parameters, out);
  scan::check(out.lidar, private_handle.getNamespace() + "/", parameters.faults());
  parameters.finish();
  out.rate = out.lidar.rate;
  return out;
}

}  // namespace vegetation_sim
