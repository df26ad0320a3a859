// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <fstream>
#include <sstream>

#include "core/config/scenario.h"
#include "crowd/agents/crowd_scene.h"
#include "crowd/body/body_skeleton.h"
#include "crowd/body/bvh_clip.h"
#include "forest/contact/contact_body.h"
#include "forest/forest.h"
#include "fuzz/targets/decoding.h"
#include "fuzz/targets/target_lists.h"
#include "fuzz/targets/usage.h"
#include "nodes/bodies/robot_bodies.h"
#include "package_folder.h"
#include "scenes/forest/forest_fixture.h"
#include "vegetation_sim/canopy/canopy_layout.h"
#include "vegetation_sim/grass/grass_layout.h"
#include "vegetation_sim/tree/growth/forest_layout.h"
#include "wind/wind_reader.h"

namespace vegetation_sim::fuzz {
namespace {

const std::string SCENARIOS = PACKAGE_FOLDER "/config/scenarios";

std::string textOf(const std::string& file) {
  std::ostringstream out;
  out << std::ifstream(file).rdbuf();
  return out.str();
}

// Reads the sections of all nodes.
void readSections(Scenario& scenario) {
  std::uint64_t seed = 1;
  std::string text;
  scenario.top().text("frame_id", text);
  scenario.top().text("terrain", text);
  scenario.top().seed("seed", seed);
  const terrain::HeightMap flat;
  forest::readLayout(scenario.section("forest"), SCENARIOS, flat, seed, scenario.faults());
  YamlSection physics = scenario.section("physics");
  forest::PhysicsSettings settings;
  describe(physics, settings);
  physics.finish();
  YamlSection grass = scenario.section("grass");
  grass::readScene(grass, SCENARIOS, seed, scenario.faults());
  grass.finish();
  canopy::readLayout(scenario.section("canopy"), flat, seed, scenario.faults());
  YamlSection crowd = scenario.section("crowd");
  crowd::obstaclesOf(crowd::readScene(crowd, seed, scenario.faults()).walls);
  crowd.finish();
  YamlSection wind = scenario.section("wind");
  wind::readWind(wind, seed);
  scenario.finish();
}

void runScenario(std::string_view input) {
  try {
    Scenario scenario = Scenario::parse(std::string(input), "scenario");
    readSections(scenario);
  } catch (const InvalidInput&) {
  }
}

std::vector<std::string> scenarioSeeds() {
  std::vector<std::string> out;
  for (const char* name :
       {"forest", "meadow", "crowd", "hills", "grove", "demo", "vineyard", "maize"})
    out.push_back(textOf(SCENARIOS + "/" + name + ".yaml"));
  return out;
}

void runSpecies(std::string_view input) {
  try {
    const forest::Species species = forest::parseSpecies(std::string(input), "species");
    forest::parseSpecies(forest::writeSpecies(species), "written species");
    if (!(forest::expectedBranches(species) < 3000.0)) return;
    const forest::Tree tree = forest::growTree(forest::TreeSeed(), species, {});
    requireFinite(forest::poseBranches(tree, wind::Instant(), forest::fullWeights()),
                  "pose of a branch");
  } catch (const InvalidInput&) {
  }
}

std::vector<std::string> speciesSeeds() {
  std::vector<std::string> out;
  for (const std::string& name : forest::speciesNames())
    out.push_back(textOf(PACKAGE_FOLDER "/config/species/" + name + ".yaml"));
  return out;
}

void runUrdf(std::string_view input) {
  Faults faults;
  const auto read = [](const std::string&) {
    return forest::Triangles{{{0, 0, 0}, {1, 0, 0}, {0, 1, 2}}, {{0, 1, 2}}};
  };
  for (const forest::Body& part : partsOfUrdf(std::string(input), "robot/", faults, read).parts)
    forest::check(part, faults);
}

// Bodies of the three clips are built.
void runBvh(std::string_view input) {
  try {
    const crowd::BvhMotion motion = crowd::parseBvh(std::string(input), "motion");
    crowd::MotionStyles styles = crowd::ownStyles();
    styles.resize(1);
    styles[0].walk = crowd::makeClip(motion, crowd::ClipKind::WALK, "motion");
    styles[0].stand = crowd::makeClip(motion, crowd::ClipKind::STAND, "motion");
    try {
      styles[0].turn = crowd::makeClip(motion, crowd::ClipKind::TURN, "motion");
    } catch (const InvalidInput&) {  // it does not turn
    }
    Faults faults;
    crowd::check(styles, faults);
    if (!faults.empty()) throw BrokenPromise("a clip out of range: " + faults.text());
    crowd::Walker walker;
    walker.velocity = {1.3, 0.0};
    walker.turn_rate = 1.0;
    for (const crowd::Limb& limb :
         crowd::skeletonOf(walker, terrain::HeightMap(), styles, walker.gait))
      requireFinite(limb.to, "end of a limb");
  } catch (const InvalidInput&) {
  }
}

std::vector<std::string> bvhSeeds() {
  std::vector<std::string> out;
  for (const char* name : {"march_walk", "march_turn"})
    out.push_back(textOf(PACKAGE_FOLDER "/config/motions/" + std::string(name) + ".bvh"));
  return out;
}

std::vector<std::string> urdfSeeds() {
  const auto link = [](const std::string& shape) {
    return "<robot name=\"r\"><link name=\"a\"><collision><origin xyz=\"0 0 1\" rpy=\"0 0.5 0\"/>"
           "<geometry>" +
           shape + "</geometry></collision></link></robot>";
  };
  return {link("<sphere radius=\"0.1\"/>"), link("<box size=\"1 2 3\"/>"),
          link("<cylinder radius=\"0.1\" length=\"1\"/>"), link("<mesh filename=\"a.stl\"/>")};
}

}  // namespace

std::vector<Target> textTargets() {
  return {{"scenario", "all sections of a scenario file", runScenario, scenarioSeeds},
          {"species", "a species file; a tree is grown", runSpecies, speciesSeeds},
          {"urdf", "the bodies of a URDF", runUrdf, urdfSeeds},
          {"bvh", "motion data of people; a body moves", runBvh, bvhSeeds}};
}

}  // namespace vegetation_sim::fuzz
