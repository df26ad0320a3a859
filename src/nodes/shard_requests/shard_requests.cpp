// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/shard_requests/shard_requests.h"

#include <boost/make_shared.hpp>
#include <cstdio>
#include <utility>

namespace vegetation_sim {
namespace {

constexpr std::uint32_t THREADS = 4;           // that answer requests
constexpr std::chrono::milliseconds POLL{20};  // of stop()

/// A function that runs once in the thread of a queue.
class QueuedBody final : public ros::CallbackInterface {
 public:
  explicit QueuedBody(const std::function<void()>& body) : task_(body) {}
  CallResult call() override {
    task_();
    return Success;
  }
  std::future<void> result() { return task_.get_future(); }

 private:
  std::packaged_task<void()> task_;
};

InvalidInput endOfNode() {
  return InvalidInput("the node ends", FaultCode::NOT_AVAILABLE);
}

std::string formatSeconds(double seconds) {
  char out[32];
  std::snprintf(out, sizeof out, "%g s", seconds);
  return out;
}

}  // namespace

// The queue stays, since threads of roscpp may still refer to that of a node that has ended.
ShardRequests::ShardRequests(const ros::NodeHandle& private_handle, ShardNode own,
                             double time_limit)
    : registry_(std::move(own)),
      time_limit_(time_limit),
      node_queue_(*private_handle.getCallbackQueue()),
      queue_(*new ros::CallbackQueue),
      workers_(private_handle) {
  workers_.setCallbackQueue(&queue_);
  spinner_ = std::make_unique<ros::AsyncSpinner>(THREADS, &queue_);
  spinner_->start();
}

void ShardRequests::stop() {
  stopped_ = true;
  queue_.disable();
  spinner_->stop();
  queue_.clear();
}

void ShardRequests::runOnNode(const std::function<void()>& body) {
  std::future<void> result;
  {
    const auto queued = boost::make_shared<QueuedBody>(body);
    result = queued->result();
    node_queue_.addCallback(queued, 0);
  }
  // Once the node's queue is closed, no callback of it runs any more.
  while (result.wait_for(POLL) != std::future_status::ready)
    if (stopped_) throw endOfNode();
  result.get();
}

std::shared_ptr<ShardRequests::Call> ShardRequests::begin(
    std::uint32_t shard, const std::string& name,
    const std::function<bool(const std::string&)>& call, Repeat repeat) {
  auto out = std::make_shared<Call>();
  out->shard = shard;
  out->name = name;
  out->peer = registry_.find(shard);
  if (out->peer->overdue > 0)
    throw InvalidInput(describeShard(shard, registry_.shard().count) + ", " + out->peer->node +
                           ", has not answered an earlier request yet",
                       FaultCode::NOT_AVAILABLE);
  const std::string service = out->peer->node + "/owned/" + name;
  startCall([=] { return callService(service, call, repeat); },
            [out](CallResult result) {
              if (out->settled.exchange(true)) --out->peer->overdue;
              out->result.set_value(result);
            });
  ++sent_;
  return out;
}

void ShardRequests::finish(Call& call, Clock::time_point deadline) const {
  std::future<CallResult> result = call.result.get_future();
  while (result.wait_until(std::min(deadline, Clock::now() + POLL)) != std::future_status::ready) {
    if (stopped_) throw endOfNode();
    if (Clock::now() >= deadline) break;
  }
  const std::string who = describeShard(call.shard, registry_.shard().count) + ", " +
                          call.peer->node + ", does not answer";
  if (result.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
    ++call.peer->overdue;
    if (call.settled.exchange(true)) --call.peer->overdue;
    throw InvalidInput(who + " ~" + call.name + " within " + formatSeconds(time_limit_.count()) +
                           "; it may still carry out the request",
                       FaultCode::NOT_AVAILABLE);
  }
  switch (result.get()) {
    case CallResult::NOT_REACHED:
      throw InvalidInput(who + " ~" + call.name + ": it cannot be reached",
                         FaultCode::NOT_AVAILABLE);
    case CallResult::BROKEN:
      throw InvalidInput(
          who + " ~" + call.name + ": the connection broke; it may have carried out the request",
          FaultCode::NOT_AVAILABLE);
    case CallResult::ANSWERED:
      break;
  }
}

}  // namespace vegetation_sim
