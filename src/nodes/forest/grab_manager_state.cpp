// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// What continues with a saved state of the node.
#include <algorithm>

#include "nodes/base/event_inputs.h"
#include "nodes/forest/grab_manager.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr std::size_t MOST_REQUESTS = 4096, REQUEST_BYTES = 22, LARGEST_STATUS = 1u << 16;

void archive(Archive& a, GrabHistory::State& state) {
  a.map(
      "grabs held", state.since, MOST_REQUESTS, sizeof(std::uint32_t) + sizeof(Nanoseconds),
      [&a](std::uint32_t& id) { a.integer("grab held", id); },
      [&a](std::uint32_t, Nanoseconds& since) { a.stamp("held since", since); });
  std::vector<std::string> ended;
  for (const GrabStatus& status : state.ended) ended.push_back(bytesOf(status));
  a.list("grabs ended", ended, GrabHistory::MOST_ENDED, sizeof(std::uint32_t),
         [&a](std::string& bytes) { a.text("grab ended", bytes, LARGEST_STATUS); });
  if (!a.reads()) return;
  for (std::string& bytes : ended) state.ended.push_back(messageOf<GrabStatus>(std::move(bytes)));
}

}  // namespace

void GrabManager::archive(Archive& a, State& state) {
  a.map(
      "requests", state.requests, MOST_REQUESTS, REQUEST_BYTES,
      [&a](std::uint32_t& id) { a.integer("request", id); },
      [&a](std::uint32_t, Request& request) {
        a.flag("keep_offset", request.keep_offset);
        a.stamp("request begins", request.begins);
        Nanoseconds published = fromMsg(request.published);
        a.stamp("transform of a request", published);
        if (a.reads()) request.published = toStamp(published);
        a.flag("request has begun", request.begun);
      });
  vegetation_sim::archive(a, state.history);
  a.integer("last grab", state.last_id);
}

void GrabManager::restore(const State& state) {
  requests_ = state.requests;
  last_id_ = state.last_id;
  silent_ = 0;
  history_.restore(state.history, node_.forest.grabs());
}

void GrabManager::addRequest(std::uint32_t id) {
  requests_.emplace(id, Request());
  last_id_ = std::max(last_id_, id);
}

}  // namespace vegetation_sim
