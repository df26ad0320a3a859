// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Exports the trees of a scenario for simulators and planners: an SDF model and a table.
// usage: export_forest SCENARIO FOLDER [THINNEST]
#include <filesystem>
#include <fstream>
#include <iostream>

#include "core/config/numbers.h"
#include "forest/export.h"
#include "nodes/forest/forest_options.h"

namespace {

using namespace vegetation_sim;

constexpr char CONFIGURATION[] =
    "<?xml version=\"1.0\"?>\n<model>\n  <name>forest</name>\n  <version>1.0</version>\n"
    "  <sdf version=\"1.6\">model.sdf</sdf>\n"
    "  <description>Trees at rest, exported by vegetation_sim</description>\n</model>\n";

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

double readRadius(const std::string& text) {
  if (const auto radius = parseNumber(text)) return *radius;
  throw InvalidInput("THINNEST = '" + text + "' is no number of metres");
}

int exportForest(int argc, char** argv) {
  if (argc < 3 || argc > 4) throw InvalidInput("usage: export_forest SCENARIO FOLDER [THINNEST]");
  forest::ExportRule rule;
  if (argc == 4) rule.thinnest = readRadius(argv[3]);
  Faults faults;
  check(rule, faults);
  faults.throwIfAny();
  const ForestScene scene = loadForestScene(argv[1]);
  const std::filesystem::path folder = argv[2];
  std::filesystem::create_directories(folder);
  std::uint64_t written = 0;
  writeWhole(folder / "model.sdf", [&](std::ostream& out) {
    written = writeSdf(scene.layout, *scene.terrain, rule, out);
  });
  writeWhole(folder / "trees.csv",
             [&](std::ostream& out) { writeTable(scene.layout, *scene.terrain, out); });
  writeWhole(folder / "model.config", [](std::ostream& out) { out << CONFIGURATION; });
  std::cout << scene.layout.treeCount() << " trees with " << written << " branches in " << folder
            << '\n';
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
