// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>

namespace vegetation_sim {

/// How much of what is limited is in use: by all, and by the one that asks for more.
struct SharedUse {
  std::size_t all{0}, own{0};
};

/// Returns how much of a limit one may use: a client half of what the others leave, so that none
/// takes all; the node itself, whose name is empty, all of that.
inline std::size_t shareOf(const std::string& client, std::size_t most, const SharedUse& use) {
  const std::size_t left = most - std::min(most, use.all - use.own);
  return client.empty() ? left : left / 2;
}

/// Returns how much more of a limit one may use.
inline std::size_t restOfShare(const std::string& client, std::size_t most, const SharedUse& use) {
  const std::size_t share = shareOf(client, most, use);
  return share - std::min(share, use.own);
}

/// Counts or adds up what waits, by the client that has sent it.
class ClientCounts {
 public:
  void clear() {
    all_ = 0;
    clients_.clear();
  }
  void add(const std::string& client, std::size_t amount = 1) {
    all_ += amount;
    clients_[client] += amount;
  }
  SharedUse useOf(const std::string& client) const {
    const auto found = clients_.find(client);
    return {all_, found == clients_.end() ? 0 : found->second};
  }

 private:
  std::size_t all_{0};
  std::map<std::string, std::size_t> clients_;
};

}  // namespace vegetation_sim
