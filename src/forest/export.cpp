// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/export.h"

#include <algorithm>
#include <cmath>
#include <ostream>

#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/tree/motion/pose.h"

namespace vegetation_sim::forest {
namespace {

// Roll, pitch and yaw that turn z onto an axis; a cylinder needs no more.
struct Turn {
  double pitch, yaw;
};
Turn turnOnto(const Vec3& axis) {
  const double across = std::sqrt(axis.x() * axis.x() + axis.y() * axis.y());
  return {arcTangent(across, axis.z()), arcTangent(axis.y(), axis.x())};
}

constexpr char SOIL[] = "<material><diffuse>0.30 0.33 0.17 1</diffuse></material>";
constexpr char BARK[] = "<material><diffuse>0.36 0.27 0.19 1</diffuse></material>";

struct Element {
  const char *name, *look;
};

void writeCylinder(const Element& element, std::size_t number, const Branch& of,
                   std::ostream& out) {
  const Vec3 axis = axisZ(of.rest.orientation);
  const Vec3 middle = of.rest.position + 0.5 * of.length * axis;
  const Turn turn = turnOnto(axis);
  out << "      <" << element.name << " name=\"" << element.name << '_' << number << "\"><pose>"
      << middle.x() << ' ' << middle.y() << ' ' << middle.z() << " 0 " << turn.pitch << ' '
      << turn.yaw << "</pose><geometry><cylinder><radius>" << 0.5 * (of.base_radius + of.tip_radius)
      << "</radius><length>" << of.length << "</length></cylinder></geometry>" << element.look
      << "</" << element.name << ">\n";
}

std::uint64_t writeTree(const Tree& tree, std::uint32_t id, double thinnest, std::ostream& out) {
  std::uint64_t written = 0;
  out << "    <link name=\"tree_" << id << "\"><pose>" << tree.foot.x() << ' ' << tree.foot.y()
      << ' ' << tree.foot.z() << " 0 0 0</pose>\n";
  for (std::size_t i = 0; i < tree.skeleton.branches.size(); ++i) {
    const Branch& branch = tree.skeleton.branches[i];
    if (i > 0 && branch.base_radius < thinnest) continue;
    writeCylinder({"collision", ""}, i, branch, out);
    writeCylinder({"visual", BARK}, i, branch, out);
    ++written;
  }
  out << "    </link>\n";
  return written;
}

void writeTerrainLink(const std::string& model, std::ostream& out) {
  const std::string mesh =
      "<geometry><mesh><uri>model://" + model + "/terrain.obj</uri></mesh></geometry>";
  out << "    <link name=\"terrain\">\n      <collision name=\"collision\">" << mesh
      << "</collision>\n      <visual name=\"visual\">" << mesh << SOIL
      << "</visual>\n    </link>\n";
}

// Names are free text: as RFC 4180 has it.
std::string csvField(const std::string& text) {
  if (text.find_first_of("\",\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

}  // namespace

void check(const ExportRule& rule, Faults& faults) {
  if (rule.name.empty() || rule.name.find_first_of("<>&\"'/") != std::string::npos)
    faults.add("name = " + inQuotes(rule.name) + " is empty or has one of <>&\"'/");
  if (!(rule.thinnest >= 0.001 && rule.thinnest <= 10.0))
    faults.add("thinnest = " + std::to_string(rule.thinnest) + " m is outside [0.001, 10]");
}

std::uint64_t writeSdf(const Layout& layout, const terrain::HeightMap& terrain,
                       const ExportRule& rule, std::ostream& out) {
  std::uint64_t written = 0;
  out.precision(9);
  out << "<?xml version=\"1.0\"?>\n<sdf version=\"1.6\">\n  <model name=\"" << rule.name
      << "\">\n    <static>true</static>\n";
  for (std::uint32_t id = 0; id < layout.treeCount(); ++id) {
    written += writeTree(growTree(layout, id, terrain), id, rule.thinnest, out);
    if (written > rule.most_branches)
      throw InvalidInput("the model has more than " + std::to_string(rule.most_branches) +
                         " branches at tree " + std::to_string(id) + " of " +
                         std::to_string(layout.treeCount()) + ": ask for thicker ones");
  }
  if (!terrain.isFlat()) writeTerrainLink(rule.name, out);
  out << "  </model>\n</sdf>\n";
  return written;
}

double writeTerrain(const terrain::HeightMap& terrain, std::uint64_t most, std::ostream& out) {
  const terrain::Bounds bounds = terrain.bounds();
  const auto cells = [&](double from, double to) {
    return static_cast<std::uint64_t>(std::llround((to - from) / terrain.resolution()));
  };
  const std::uint64_t columns = cells(bounds.min_x, bounds.max_x);
  const std::uint64_t rows = cells(bounds.min_y, bounds.max_y);
  std::uint64_t step = 1;
  const auto count = [&](std::uint64_t along) { return (along + step - 1) / step + 1; };
  while (count(columns) * count(rows) > most && step < std::max(columns, rows)) ++step;
  const std::uint64_t across = count(columns), up = count(rows);
  const auto place = [&](double from, std::uint64_t i, std::uint64_t last) {
    return from + terrain.resolution() * static_cast<double>(std::min(i * step, last));
  };
  out.precision(9);
  for (std::uint64_t row = 0; row < up; ++row)
    for (std::uint64_t column = 0; column < across; ++column) {
      const double x = place(bounds.min_x, column, columns), y = place(bounds.min_y, row, rows);
      out << "v " << x << ' ' << y << ' ' << terrain.height(x, y) << '\n';
    }
  for (std::uint64_t row = 0; row + 1 < up; ++row)
    for (std::uint64_t column = 0; column + 1 < across; ++column) {
      const std::uint64_t first = row * across + column + 1;  // vertices are counted from 1
      out << "f " << first << ' ' << first + 1 << ' ' << first + across + 1 << '\n'
          << "f " << first << ' ' << first + across + 1 << ' ' << first + across << '\n';
    }
  return terrain.resolution() * static_cast<double>(step);
}

void writeTable(const Layout& layout, const terrain::HeightMap& terrain, std::ostream& out) {
  out.precision(9);
  out << "tree,species,x,y,z,trunk_radius,height\n";
  for (std::uint32_t id = 0; id < layout.treeCount(); ++id) {
    const Tree tree = growTree(layout, id, terrain);
    out << id << ',' << csvField(layout.species[seedOf(layout, id).species].name) << ','
        << tree.foot.x() << ',' << tree.foot.y() << ',' << tree.foot.z() << ','
        << tree.skeleton.branches.front().base_radius << ',' << tree.skeleton.height << '\n';
  }
}

}  // namespace vegetation_sim::forest
