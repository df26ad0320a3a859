// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace vegetation_sim::bench {

/// A file of comma-separated values that `charts` draws from: named columns, one row at a time.
/// Nothing is written without a path.
class Table {
 public:
  /// @throws std::runtime_error if the file cannot be written.
  Table(const std::string& path, const std::string& columns) {
    if (path.empty()) return;
    file_ = std::fopen(path.c_str(), "w");
    if (!file_) throw std::runtime_error(path + ": cannot be written");
    std::fprintf(file_, "%s\n", columns.c_str());
  }
  Table(const Table&) = delete;
  Table& operator=(const Table&) = delete;
  ~Table() {
    if (file_) std::fclose(file_);
  }

  template <class... Values>
  void row(const Values&... values) {
    if (!file_) return;
    std::ostringstream line;
    line.precision(8);
    const char* comma = "";
    ((line << comma, add(line, values), comma = ","), ...);
    std::fprintf(file_, "%s\n", line.str().c_str());
    std::fflush(file_);  // completed rows survive a later failure
  }

 private:
  template <class Value>
  static void add(std::ostringstream& line, const Value& value) {
    if constexpr (std::is_convertible_v<Value, std::string>)
      line << '"' << std::string(value) << '"';  // the value may contain commas
    else
      line << value;
  }

  std::FILE* file_{nullptr};
};

/// Columns of a ladder: error and cost of each tier; `chosen` is 1 for the default.
constexpr const char* LADDER_COLUMNS = "ladder,tier,setting,cost,error,chosen";
/// Columns of cost against size.
constexpr const char* SIZE_COLUMNS = "series,size,seconds";

}  // namespace vegetation_sim::bench
