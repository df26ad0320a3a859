// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/world.h"

#include "sensors/sensor_scene.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::scenes {

World::World(const std::string& scenario, int threads)
    : scenario_(loadScenario(scenario)),
      threads_(threads),
      grid_(scenario_.rate),
      first_(grid_.tickAt(START)) {
  if (scenario_.forest) forest = std::make_unique<ForestPart>(scenario_, threads);
  if (scenario_.grass) grass = std::make_unique<GrassPart>(scenario_);
  if (scenario_.canopy) canopy = std::make_unique<CanopyPart>(scenario_);
  if (scenario_.crowd) crowd = std::make_unique<CrowdPart>(scenario_, threads);
}

void World::advance() {
  ++tick_;
  const bool key_frame = tick_ % scenario_.rate == 1;
  if (crowd) crowd->advance(now());
  if (forest) forest->advance(now(), key_frame);
  if (grass) grass->advance(now(), key_frame);
  if (canopy) canopy->advance(now());
}

void World::changeWind() {
  if (forest) forest->setWind(scenario_.later_wind);
  if (grass) grass->setWind(scenario_.later_wind);
  if (canopy) canopy->setWind(scenario_.later_wind);
}

void World::setCamera(const Vec3& from, double yaw) {
  const SinCos turn = sinCos(yaw), half = sinCos(0.5 * yaw);
  Viewpoint eye;
  eye.position = from;
  eye.forward = Vec3(turn.cos, turn.sin, 0.0);
  eye.cone_cosine = 0.7;
  if (forest) forest->setEye(eye);
  if (grass) grass->setEye(eye);
  if (canopy) canopy->setView(canopy::CutView{from, Quat{half.cos, 0.0, 0.0, half.sin}});
}

void World::setSensor(const Vec3& place, double range, double tolerance) {
  if (forest) forest->forest().setSensor({"sensor", place, range, tolerance, next()});
}

void World::addTo(Hashes& hashes) {
  if (forest) forest->addTo(hashes);
  if (grass) grass->addTo(hashes);
  if (canopy) canopy->addTo(hashes);
  if (crowd) crowd->addTo(hashes);
  if (scenario_.scan) addScan(hashes.display);
}

void World::addScan(Hash& hash) {
  const Vec3 sensor(0.0, 0.0, scenario_.terrain->height(0.0, 0.0) + 1.2);
  const double reach = scenario_.scan->beams.range_max;
  scan::Scene scene;
  scene.ground = scenario_.terrain;
  if (forest) scene.trees.update(forest->replica(), sensor, reach, now());
  if (grass)
    scene.grass.update(grass->layout(), grass->shownTread(), scenario_.terrain, grass->wind(),
                       sensor, reach, now());
  if (crowd) {
    std::vector<scan::People::Person> people;
    for (const crowd::Skeleton& body : crowd->bodies())
      people.push_back({static_cast<std::uint32_t>(people.size()), body});
    scene.people.set(people);
  }
  Pose pose;
  pose.position = sensor;
  const scan::NoiseKeys noise{scenario_.seed, static_cast<std::uint64_t>(tick_), 1};
  for (const scan::Return& beam : scan::sweep(scene, *scenario_.scan, pose, noise, threads_)) {
    hash.add(beam.range);
    hash.add(static_cast<std::uint64_t>(beam.hit.label));
  }
}

}  // namespace vegetation_sim::scenes
