// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/shard_requests/shard_call.h"

#include <ros/console.h>
#include <ros/ros.h>

#include <atomic>
#include <memory>
#include <system_error>
#include <thread>
#include <utility>

#include "core/shards/shard_split.h"

namespace vegetation_sim {
namespace {

constexpr int MOST_CALLS = MOST_SHARDS;  // of other nodes at once, from this process
constexpr int ATTEMPTS = 3;              // to connect

/// One of the calls that run, until it is destroyed.
class RunningCall {
 public:
  RunningCall() {
    if (++running < MOST_CALLS + 1) return;
    --running;
    throw InvalidInput("requests to other shards = " + std::to_string(MOST_CALLS + 1) +
                           " is outside 0 to " + std::to_string(MOST_CALLS),
                       FaultCode::NO_ROOM);
  }
  ~RunningCall() { --running; }
  RunningCall(const RunningCall&) = delete;
  RunningCall& operator=(const RunningCall&) = delete;

 private:
  static std::atomic<int> running;
};

std::atomic<int> RunningCall::running{0};

CallResult resultOf(const std::function<CallResult()>& call) {
  try {
    return call();
  } catch (const std::exception& error) {
    ROS_ERROR("A request to another shard failed: %s", error.what());
    return CallResult::BROKEN;
  }
}

}  // namespace

CallResult callService(const std::string& service,
                       const std::function<bool(const std::string& service)>& call, Repeat repeat) {
  CallResult out = CallResult::NOT_REACHED;
  for (int i = 0; i < ATTEMPTS && out != CallResult::ANSWERED && ros::ok(); ++i) {
    if (!ros::service::exists(service, false)) continue;
    out = call(service) ? CallResult::ANSWERED : CallResult::BROKEN;
    if (repeat == Repeat::FORBIDDEN) break;
  }
  return out;
}

void startCall(std::function<CallResult()> call, std::function<void(CallResult)> finish) {
  auto running = std::make_unique<RunningCall>();
  try {
    std::thread([running = std::move(running), call = std::move(call),
                 finish = std::move(finish)]() mutable {
      const CallResult result = resultOf(call);
      running.reset();  // before anybody knows the result and asks again
      finish(result);
    }).detach();
  } catch (const std::system_error& error) {
    throw InvalidInput(
        std::string("no thread can start for a request to another shard: ") + error.what(),
        FaultCode::NO_ROOM);
  }
}

}  // namespace vegetation_sim
