// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/ErrorCode.h>

#include <string>
#include <vector>

#include "nodes/shard_requests/shard_requests.h"

namespace vegetation_sim {

/// Returns the response of the only shard asked.
template <class Response>
Response takeFirst(const std::vector<ShardReply<Response>>& replies) {
  return replies.front().response;
}

/// Returns the response of several shards that all carry out a request. It is a refusal if one of
/// them is. Messages that differ are listed by shard.
template <class Response>
Response joinReplies(const std::vector<ShardReply<Response>>& replies) {
  const ShardReply<Response>* chosen = &replies.front();
  bool differs = false;
  std::string message;
  for (const ShardReply<Response>& reply : replies) {
    if (chosen->response.success && !reply.response.success) chosen = &reply;
    differs = differs || reply.response.message != replies.front().response.message;
    message += (message.empty() ? "shard " : "; shard ") + std::to_string(reply.shard) + ": " +
               reply.response.message;
  }
  Response out = chosen->response;
  if (differs) out.message = message;
  return out;
}

/// Returns the response with the smallest distance; any refusal other than that nothing is there
/// comes first.
template <class Response>
Response takeNearest(const std::vector<ShardReply<Response>>& replies) {
  const Response* best = nullptr;
  for (const ShardReply<Response>& reply : replies) {
    const Response& response = reply.response;
    if (response.success) {
      if (!best || response.distance < best->distance) best = &response;
    } else if (response.error_code != ErrorCode::NOTHING_FOUND) {
      return response;
    }
  }
  return best ? *best : replies.front().response;
}

}  // namespace vegetation_sim
