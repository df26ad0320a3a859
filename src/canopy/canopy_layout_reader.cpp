// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "canopy/canopy_layout_reader.h"

#include <map>

#include "core/config/base_file.h"
#include "core/math/growth_stage.h"
#include "terrain/plant_rows.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::canopy {
namespace {

constexpr Range SCALES{0.05, 20.0};

void readMotion(YamlSection& section, Motion& motion) {
  const auto group = [&](const char* name, auto& settings) {
    YamlSection part = section.section(name);
    describe(part, settings);
    part.finish();
  };
  group("plane", motion.plane);
  group("fluid", motion.fluid);
  group("sources", motion.sources);
  group("oscillator", motion.oscillator);
  group("layers", motion.layers);
  group("cuts", motion.cuts);
  group("warp", motion.warp);
  section.integer("rate", motion.rate, "Hz", {1, 240});
}

void readKindKeys(YamlSection& entry, PlantKind& kind) {
  entry.text("name", kind.name);
  entry.text("file", kind.file);
  const PlantShape before = kind.shape;
  describe(entry, kind);
  if (kind.shape == PlantShape::MESH) entry.text("rigid", kind.rigid);
  if (kind.shape == PlantShape::TRELLIS && before != kind.shape) kind.push.stiffness = 0.0;
  describe(entry, kind.push);
}

/// @param folder of the scenario; empty: kinds have no `base`, since the text is of a message.
void readKinds(YamlSection& section, const std::string& folder, std::vector<PlantKind>& kinds) {
  for (YamlSection& entry : section.sections("kinds", MOST_KINDS)) {
    PlantKind kind;
    if (!folder.empty())
      readBase(entry, folder + "/../plants", [&](YamlSection& base) { readKindKeys(base, kind); });
    readKindKeys(entry, kind);
    double stage = GROWN;
    entry.number("stage", stage, "", {SEEDLING, GROWN});
    entry.finish();
    kind = applyStage(kind, stage);
    for (const PlantKind& other : kinds)
      if (other.name == kind.name)
        entry.fault("name", "= " + inQuotes(kind.name) + " is defined twice");
    kinds.push_back(kind);
  }
}

std::uint16_t readKind(YamlSection& section, const std::vector<PlantKind>& kinds) {
  std::string name, known;
  section.text("kind", name);
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    if (kinds[i].name == name) return static_cast<std::uint16_t>(i);
    if (known.size() < LONGEST_ERROR) known += (i ? ", " : "") + kinds[i].name;
  }
  section.fault("kind", "= " + inQuotes(name) + " is none of " + known);
  return 0;
}

void readCrowns(YamlSection& section, Layout& layout) {
  for (YamlSection& entry : section.sections("crowns")) {
    CrownRule crown;
    crown.kind = readKind(entry, layout.kinds);
    describe(entry, crown);
    entry.finish();
    layout.crowns.push_back(crown);
  }
}

class LayoutReader {
 public:
  LayoutReader(YamlSection section, std::string folder, const terrain::HeightMap& terrain,
               std::uint64_t seed, Faults& faults)
      : section_(std::move(section)),
        folder_(std::move(folder)),
        terrain_(terrain),
        seed_(seed),
        faults_(faults) {
    out_.seed = seed;
  }

  Layout read() {
    readMotion(section_, out_.motion);
    readKinds(section_, folder_, out_.kinds);
    readCrowns(section_, out_);
    for (YamlSection& plant : section_.sections("plants")) readPlant(plant);
    for (YamlSection& bed : section_.sections("beds")) readBed(bed);
    for (YamlSection& rows : section_.sections("rows")) readRows(rows);
    section_.finish();
    Faults of_the_whole;
    if (faults_.empty()) check(out_, of_the_whole);
    for (const std::string& fault : of_the_whole.list()) section_.fault(fault);
    return std::move(out_);
  }

 private:
  std::uint64_t nextSeed() { return Random(seed_).bits(drawn_++); }

  void add(Plant plant) {
    plant.position.z() += terrain_.height(plant.position.x(), plant.position.y());
    out_.plants.push_back(plant);
  }

  void readPlant(YamlSection& section) {
    Plant plant;
    plant.seed = nextSeed();
    plant.kind = readKind(section, out_.kinds);
    section.seed("seed", plant.seed);
    section.vector("position", plant.position, "m", PLANT_COORDINATES);
    section.number("yaw", plant.yaw, "rad", {-1000.0, 1000.0});
    section.number("scale", plant.scale, "", SCALES);
    section.finish();
    add(plant);
  }

  // Scatters plants over a rectangle, each with its own yaw and scale.
  void readBed(YamlSection& section) {
    std::uint64_t seed = nextSeed();
    const std::uint16_t kind = readKind(section, out_.kinds);
    Vec3 corner = Vec3::Zero();
    double width = 10.0, depth = 10.0, smallest = 0.8, largest = 1.2;
    int count = 0;
    section.seed("seed", seed);
    section.vector("corner", corner, "m", PLANT_COORDINATES);
    section.number("width", width, "m", {0.0, 1e5});
    section.number("depth", depth, "m", {0.0, 1e5});
    section.number("smallest", smallest, "", SCALES);
    section.number("largest", largest, "", SCALES);
    section.integer("count", count, "", {0, static_cast<int>(MOST_PLANTS)});
    section.finish();
    for (int i = 0; i < count; ++i) {
      const Random random = Random(seed).child(static_cast<std::uint64_t>(i));
      Plant plant;
      plant.seed = random.bits(0);
      plant.kind = kind;
      plant.position = corner + Vec3(width * random.uniform(1), depth * random.uniform(2), 0.0);
      plant.yaw = 2.0 * PI * random.uniform(3);
      plant.scale = random.uniform(4, smallest, largest);
      add(plant);
    }
  }

  void readRows(YamlSection& section) {
    std::uint64_t seed = nextSeed();
    const std::uint16_t kind = readKind(section, out_.kinds);
    section.seed("seed", seed);
    const terrain::RowLaw law = terrain::readRowLaw(section);
    section.finish();
    if (!faults_.empty()) return;
    const int room = terrain::MOST_ROW_PLANTS - planted_;
    for (const terrain::RowPlant& plant :
         terrain::placeInRows(law, terrain_, seed, room, section)) {
      add({plant.seed, kind, plant.position, plant.yaw, plant.scale});
      ++planted_;
    }
  }

  YamlSection section_;
  std::string folder_;
  const terrain::HeightMap& terrain_;
  std::uint64_t seed_, drawn_{0};
  int planted_{0};  // in rows
  Faults& faults_;
  Layout out_;
};

}  // namespace

Layout readLayout(YamlSection section, const std::string& folder, const terrain::HeightMap& terrain,
                  std::uint64_t seed, Faults& faults) {
  return LayoutReader(std::move(section), folder, terrain, seed, faults).read();
}

Layout readLayout(YamlSection section, const terrain::HeightMap& terrain, std::uint64_t seed,
                  Faults& faults) {
  return readLayout(std::move(section), "", terrain, seed, faults);
}

std::string writeLaw(const Layout& layout) {
  Layout copy = layout;
  YAML::Emitter out;
  YamlFieldWriter writer(out);
  bool open = false;
  out << YAML::BeginMap;
  describe(writer, copy.motion, [&](const char* name) {
    if (open) out << YAML::EndMap;
    open = true;
    out << YAML::Key << name << YAML::Value << YAML::BeginMap;
  });
  out << YAML::EndMap;
  out << YAML::Key << "rate" << YAML::Value << copy.motion.rate;
  out << YAML::Key << "kinds" << YAML::Value << YAML::BeginSeq;
  for (PlantKind& kind : copy.kinds) {
    out << YAML::BeginMap << YAML::Key << "name" << YAML::Value << YAML::DoubleQuoted << kind.name;
    if (!kind.file.empty())
      out << YAML::Key << "file" << YAML::Value << YAML::DoubleQuoted << kind.file;
    describe(writer, kind);
    if (kind.shape == PlantShape::MESH && kind.rigid != RIGID_WORDS)
      out << YAML::Key << "rigid" << YAML::Value << YAML::DoubleQuoted << kind.rigid;
    describe(writer, kind.push);
    out << YAML::EndMap;
  }
  out << YAML::EndSeq << YAML::Key << "crowns" << YAML::Value << YAML::BeginSeq;
  for (CrownRule& crown : copy.crowns) {
    out << YAML::BeginMap << YAML::Key << "kind" << YAML::Value << YAML::DoubleQuoted
        << copy.kinds[crown.kind].name;
    describe(writer, crown);
    out << YAML::EndMap;
  }
  out << YAML::EndSeq << YAML::EndMap;
  return out.c_str();
}

Layout parseLaw(const std::string& text, const std::string& name) {
  Faults faults;
  const YAML::Node node = parseYaml(text, name);
  YamlSection section(node, name, faults);
  Layout out;
  readMotion(section, out.motion);
  readKinds(section, "", out.kinds);
  readCrowns(section, out);
  section.finish();
  faults.throwIfAny();
  return out;
}

}  // namespace vegetation_sim::canopy
