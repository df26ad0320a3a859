// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "nodes/shard_requests/shard_call.h"
#include "nodes/shard_requests/shard_registry.h"
#include "ros/services/service_replies.h"

namespace vegetation_sim {

/// The response of one shard; of one that does not answer, a refusal that says so.
template <class Response>
struct ShardReply {
  std::uint32_t shard{0};
  Response response;
};

/// Answers requests that may concern other shards: in threads of its own, so that the node's thread
/// never waits for another node, and two nodes that ask each other do not wait for ever. Each node
/// also has the services ~owned/NAME for its own shard alone, in the node's thread; requests of
/// other shards go there, so that none is passed on twice.
class ShardRequests {
 public:
  /// @param private_handle has the queue of the node's thread. @param own announcement of the node.
  /// @param time_limit within which another shard has to answer, wall time [s].
  ShardRequests(const ros::NodeHandle& private_handle, ShardNode own, double time_limit);
  ~ShardRequests() { stop(); }
  ShardRequests(const ShardRequests&) = delete;
  ShardRequests& operator=(const ShardRequests&) = delete;

  ShardRegistry& registry() { return registry_; }
  Shard shard() const { return registry_.shard(); }
  /// Handle of the services whose callbacks run in the threads of this class.
  ros::NodeHandle& workers() { return workers_; }
  /// Ends all waiting. To be called once the node's queue is closed and before the services of
  /// workers() end.
  void stop();

  // The following are for the threads of this class.

  /// Runs `body` in the node's thread, and waits for it. @throws what `body` throws, and
  /// InvalidInput if the node ends before.
  void runOnNode(const std::function<void()>& body);
  /// Sends a request to shards at once and waits for all. @param local answers for this shard, in
  /// the node's thread.
  template <class Request, class Response>
  std::vector<ShardReply<Response>> ask(const std::string& name,
                                        const std::vector<std::uint32_t>& shards,
                                        const Request& request, Repeat repeat,
                                        const std::function<void(Request&, Response&)>& local);
  /// Number of requests sent to other shards.
  std::uint64_t sent() const { return sent_; }

 private:
  using Clock = std::chrono::steady_clock;
  /// A call of another node, in a thread of its own, since roscpp sets no time limit to calls.
  struct Call {
    std::uint32_t shard{0};
    std::shared_ptr<ShardRegistry::Peer> peer;
    std::string name;
    std::promise<CallResult> result;
    std::atomic<bool> settled{false};  // it has ended or is overdue
  };
  std::shared_ptr<Call> begin(std::uint32_t shard, const std::string& name,
                              const std::function<bool(const std::string& service)>& call,
                              Repeat repeat);
  /// @throws InvalidInput unless the call is answered in time.
  void finish(Call& call, Clock::time_point deadline) const;

  ShardRegistry registry_;
  const std::chrono::duration<double> time_limit_;
  ros::CallbackQueueInterface& node_queue_;
  ros::CallbackQueue& queue_;
  ros::NodeHandle workers_;
  std::unique_ptr<ros::AsyncSpinner> spinner_;
  std::atomic<bool> stopped_{false};
  std::atomic<std::uint64_t> sent_{0};
};

template <class Request, class Response>
std::vector<ShardReply<Response>> ShardRequests::ask(
    const std::string& name, const std::vector<std::uint32_t>& shards, const Request& request,
    Repeat repeat, const std::function<void(Request&, Response&)>& local) {
  struct Asked {
    std::shared_ptr<Response> response{std::make_shared<Response>()};
    std::shared_ptr<Call> call;
    std::exception_ptr fault;
  };
  const auto deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(time_limit_);
  std::vector<Asked> asked(shards.size());
  for (std::size_t i = 0; i < shards.size(); ++i) {
    if (shards[i] == shard().index) continue;
    try {
      asked[i].call = begin(
          shards[i], name,
          [own = std::make_shared<Request>(request), response = asked[i].response](
              const std::string& service) { return ros::service::call(service, *own, *response); },
          repeat);
    } catch (const std::exception&) {
      asked[i].fault = std::current_exception();
    }
  }
  std::vector<ShardReply<Response>> out(shards.size());
  const auto wait_for = [&](std::size_t i) {
    Response response;
    answer(response, [&]() -> std::string {
      if (asked[i].fault) std::rethrow_exception(asked[i].fault);
      if (asked[i].call) {
        finish(*asked[i].call, deadline);
      } else {
        Request own = request;
        runOnNode([&] { local(own, *asked[i].response); });
      }
      return {};
    });
    const bool answered = response.success != 0;
    out[i] = {shards[i], answered ? *asked[i].response : response};
  };
  // This shard acts at once, however long the others take.
  for (const bool is_own : {true, false})
    for (std::size_t i = 0; i < shards.size(); ++i)
      if ((shards[i] == shard().index) == is_own) wait_for(i);
  return out;
}

}  // namespace vegetation_sim
