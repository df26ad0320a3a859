// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Exports the trees of a scenario for simulators and planners: an SDF model, an OctoMap and a
// table. usage: export_forest SCENARIO FOLDER [THINNEST [RESOLUTION]]
#include <filesystem>
#include <fstream>
#include <iostream>

#include "core/config/numbers.h"
#include "forest/export.h"
#include "nodes/forest/forest_options.h"
#include "tools/octomap_writer.h"

namespace {

using namespace vegetation_sim;

constexpr std::uint64_t MOST_VERTICES = 1'000'000;  // of the ground

std::string configurationOf(const std::string& name) {
  return "<?xml version=\"1.0\"?>\n<model>\n  <name>" + name +
         "</name>\n  <version>1.0</version>\n  <sdf version=\"1.6\">model.sdf</sdf>\n"
         "  <description>Trees at rest, exported by vegetation_sim</description>\n</model>\n";
}

// Renames the file when it is complete, so that no partial file has the final name.
template <typename Write>
void writeWhole(const std::filesystem::path& file, const Write& write) {
  std::filesystem::path part = file;
  part += ".part";
  try {
    std::ofstream out(part);
    write(out);
    if (!out.flush()) throw InvalidInput("cannot write " + part.string());
    out.close();
    std::filesystem::rename(part, file);
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    throw;
  }
}

double readMetres(const std::string& name, const std::string& text) {
  if (const auto metres = parseNumber(text)) return *metres;
  throw InvalidInput(name + " = " + inQuotes(text) + " is no number of metres");
}

int exportForest(int argc, char** argv) {
  if (argc < 3 || argc > 5)
    throw InvalidInput("usage: export_forest SCENARIO FOLDER [THINNEST [RESOLUTION]]");
  const std::filesystem::path folder = argv[2];
  forest::ExportRule rule;
  forest::OctomapRule octomap;
  if (argc > 3) rule.thinnest = octomap.thinnest = readMetres("THINNEST", argv[3]);
  if (argc > 4) octomap.resolution = readMetres("RESOLUTION", argv[4]);
  rule.name = std::filesystem::absolute(folder / "").parent_path().filename().string();
  Faults faults;
  check(rule, faults);
  check(octomap, faults);
  faults.throwIfAny();
  const ForestScene scene = loadForestScene(argv[1]);
  std::filesystem::create_directories(folder);
  std::uint64_t written = 0, cells = 0;
  writeWhole(folder / "model.sdf", [&](std::ostream& out) {
    written = writeSdf(scene.layout, *scene.terrain, rule, out);
  });
  writeWhole(folder / "trees.csv",
             [&](std::ostream& out) { writeTable(scene.layout, *scene.terrain, out); });
  if (!scene.terrain->isFlat())
    writeWhole(folder / "terrain.obj", [&](std::ostream& out) {
      forest::writeTerrain(*scene.terrain, MOST_VERTICES, out);
    });
  writeWhole(folder / "wood.bt", [&](std::ostream& out) {
    cells = writeOctomap(scene.layout, *scene.terrain, octomap, out);
  });
  writeWhole(folder / "model.config",
             [&](std::ostream& out) { out << configurationOf(rule.name); });
  std::cout << scene.layout.treeCount() << " trees with " << written << " branches and " << cells
            << " cells of an octree in " << folder << '\n';
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return exportForest(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
}
