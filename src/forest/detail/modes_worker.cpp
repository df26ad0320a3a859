// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/detail/modes_worker.h"

#include <algorithm>
#include <chrono>
#include <system_error>

namespace vegetation_sim::forest {
namespace {

const BrokenBranches& brokenNow(const ModalContext& at, std::uint32_t tree) {
  static const BrokenTrees NONE;
  return brokenOf(at.broken ? *at.broken : NONE, tree);
}

template <class Result>
bool isRunning(const Result& result) {
  return result.wait_for(std::chrono::seconds(0)) == std::future_status::timeout;
}

}  // namespace

void ModesWorker::begin(const ModalContext& at, const Key& key) {
  const BrokenBranches& broken = brokenNow(at, key.first);
  const auto found = computations_.find(key);
  if (found != computations_.end() && found->second.broken == broken) return;
  // Without another thread it is computed when it is needed.
  const auto begin = [&](std::launch policy) {
    return std::async(policy, [compute = ModalForest::prepareModes(at, key.first, key.second)] {
      return std::make_shared<const ModalTreeState>(compute());
    });
  };
  Computation now{broken, {}};
  try {
    now.result = begin(std::launch::async).share();
  } catch (const std::system_error&) {
    now.result = begin(std::launch::deferred).share();
  }
  if (found != computations_.end()) forgotten_.push_back(std::move(found->second.result));
  computations_[key] = std::move(now);
}

const ModalTreeState* ModesWorker::find(const ModalContext& at, const Key& key) {
  const auto found = computations_.find(key);
  if (found == computations_.end()) return nullptr;
  if (!(found->second.broken == brokenNow(at, key.first))) return nullptr;
  return found->second.result.get().get();
}

bool ModesWorker::isIdle() const {
  return std::none_of(forgotten_.begin(), forgotten_.end(), isRunning<Result>) &&
         std::none_of(computations_.begin(), computations_.end(),
                      [](const auto& entry) { return isRunning(entry.second.result); });
}

// The last owner of a result waits for its end.
void ModesWorker::retain(const std::set<Key>& keys) {
  for (auto it = computations_.begin(); it != computations_.end();) {
    if (keys.count(it->first)) {
      ++it;
      continue;
    }
    forgotten_.push_back(std::move(it->second.result));
    it = computations_.erase(it);
  }
  forgotten_.erase(std::remove_if(forgotten_.begin(), forgotten_.end(),
                                  [](const Result& result) { return !isRunning(result); }),
                   forgotten_.end());
}

}  // namespace vegetation_sim::forest
