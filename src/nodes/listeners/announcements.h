// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "vegetation_sim/core/config/faults.h"
#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim {

/// Announcements of listeners, by id, until they are silent.
template <class Value>
class Announcements {
 public:
  static constexpr std::size_t MOST = 32;
  static constexpr double LIFE = 3.0;  ///< of a listener without messages [s]

  /// @param kind of listener, for the error. @param stamp of the node's clock, 0 before it has
  /// begun. @throws InvalidInput for more than MOST listeners.
  void put(const std::string& kind, const std::string& id, const Value& value, Nanoseconds stamp) {
    if (entries_.size() >= MOST && !entries_.count(id))
      throw InvalidInput(kind + " " + inQuotes(id) + " is one more than the " +
                         std::to_string(MOST) + " allowed at once");
    entries_[id] = {value, stamp};
  }
  /// Returns the values in order of ids. Forgets listeners without messages for LIFE.
  std::vector<Value> at(Nanoseconds stamp) {
    std::vector<Value> out;
    for (auto entry = entries_.begin(); entry != entries_.end();) {
      if (entry->second.stamp == 0) entry->second.stamp = stamp;  // was before the first tick
      if (secondsBetween(entry->second.stamp, stamp) > LIFE) {
        entry = entries_.erase(entry);
        continue;
      }
      out.push_back(entry->second.value);
      ++entry;
    }
    return out;
  }
  std::size_t size() const { return entries_.size(); }
  void clear() { entries_.clear(); }

 private:
  struct Entry {
    Value value;
    Nanoseconds stamp{0};
  };
  std::map<std::string, Entry> entries_;
};

}  // namespace vegetation_sim
