// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdio>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace vegetation_sim::bench {

/// Options of every bench: [ROUNDS] [--quick | --full] [--part NAME,..] [--csv FILE].
struct Options {
  int rounds{15};     ///< rounds of interleaved timing; fewer with --quick
  bool quick{false};  ///< smaller scenes, fewer points
  bool full{false};   ///< up to the largest sizes
  std::string csv;    ///< file for the numbers of charts
  std::vector<std::string> parts;

  bool wants(const std::string& part) const {
    return std::find(parts.begin(), parts.end(), part) != parts.end();
  }
};

/// @param parts are the names that --part may take; without it all of them are run.
/// @throws std::invalid_argument that names the fault.
inline Options readOptions(int argc, char** argv, const std::vector<std::string>& parts) {
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);  // each line appears at once
  Options out;
  out.parts = parts;
  for (int i = 1; i < argc; ++i) {
    const std::string key = argv[i];
    if (key == "--quick") {
      out.quick = true;
      out.rounds = 5;
    } else if (key == "--full") {
      out.full = true;
    } else if (!key.empty() && key.find_first_not_of("0123456789") == key.npos) {
      out.rounds = std::max(1, std::stoi(key));
    } else if (key != "--csv" && key != "--part") {
      throw std::invalid_argument(key + ": unknown option");
    } else if (++i == argc) {
      throw std::invalid_argument(key + ": its value is missing");
    } else if (key == "--csv") {
      out.csv = argv[i];
    } else {
      out.parts.clear();
      std::istringstream names(argv[i]);
      for (std::string name; std::getline(names, name, ','); out.parts.push_back(name))
        if (std::find(parts.begin(), parts.end(), name) == parts.end())
          throw std::invalid_argument("--part " + name + ": unknown part");
    }
  }
  return out;
}

}  // namespace vegetation_sim::bench
