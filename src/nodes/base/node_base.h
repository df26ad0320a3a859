// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "nodes/base/closable_queue.h"
#include "nodes/shard_requests/shard_merges.h"
#include "nodes/shard_requests/shard_requests.h"
#include "ros/services/diagnostics.h"
#include "ros/services/subscriptions.h"
#include "vegetation_sim/core/config/faults.h"
#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim {

/// Connections, diagnostics and the count of rejected inputs of a node. All callbacks come from one
/// queue and one thread, but in a nodelet manager not from the thread that constructs the node.
/// An exception is reported and ends in its callback, since it must not end a process of several
/// nodes.
class NodeBase {
 protected:
  using Status = diagnostic_updater::DiagnosticStatusWrapper;

  NodeBase(const std::string& name, const ros::NodeHandle& handle,
           const ros::NodeHandle& private_handle);
  virtual ~NodeBase() = default;

  /// When the callbacks of a topic run: as soon as they can, or in awaitInputs() only.
  enum class Delivery { AT_ONCE, AWAITED };
  template <class Node, class Message>
  ros::Subscriber subscribe(const char* topic, unsigned queue,
                            void (Node::*callback)(const Message&),
                            Delivery delivery = Delivery::AT_ONCE) {
    using Event = ros::MessageEvent<Message const>;
    const boost::function<void(const Event&)> guarded = [this, topic,
                                                         callback](const Event& event) {
      const ClientScope scope(client_, event.getPublisherName());
      acceptInput(topic, [&] { (static_cast<Node*>(this)->*callback)(*event.getMessage()); });
    };
    ros::NodeHandle handle = handle_;
    if (delivery == Delivery::AWAITED) handle.setCallbackQueue(&awaited_);
    subscribers_.push_back(subscribeWithoutDelay<Message>(handle, topic, queue, guarded));
    return subscribers_.back();
  }
  /// Runs the callbacks of awaited topics until `is_complete()` or the node ends. @param wait
  /// longest wall time [s]. @return is_complete()
  bool awaitInputs(double wait, const std::function<bool()>& is_complete);
  /// Subscribes to a topic that one node owns; diagnose with warnOfRivals().
  template <class Node, class Message>
  ros::Subscriber subscribeToOwner(const char* topic, unsigned queue,
                                   void (Node::*callback)(const Message&),
                                   Delivery delivery = Delivery::AT_ONCE) {
    subscribe(topic, queue, callback, delivery);
    owned_.push_back({subscribers_.back(), {}, 1});
    return subscribers_.back();
  }
  /// Subscribes to a topic that each shard publishes with the same content, or one node if there
  /// are no shards; diagnose with warnOfRivals(). @param shards topic on which they announce
  /// themselves.
  template <class Node, class Message>
  void subscribeToShardedOwner(const char* topic, unsigned queue,
                               void (Node::*callback)(const Message&), const char* shards) {
    subscribeToOwner(topic, queue, callback);
    countOwners(owned_.size() - 1, shards);
  }
  /// Subscribes to a topic of the node's shards. Messages of a shard from another process than its
  /// own are refused.
  template <class Node, class Message>
  ros::Subscriber subscribeToShards(const char* topic, unsigned queue,
                                    void (Node::*callback)(const Message&)) {
    using Event = ros::MessageEvent<Message const>;
    const boost::function<void(const Event&)> guarded = [this, topic,
                                                         callback](const Event& event) {
      acceptInput(topic, [&] {
        shards_->registry().checkSender(event.getMessage()->shard, event.getPublisherName());
        (static_cast<Node*>(this)->*callback)(*event.getMessage());
      });
    };
    return subscribeWithoutDelay<Message>(handle_, topic, queue, guarded);
  }
  /// Adds a service, whose response has `success` and `message`; refused requests are counted. It
  /// is advertised by openServices(), or at once after that.
  template <class Node, class Request, class Response>
  void serve(const std::string& name, bool (Node::*callback)(Request&, Response&)) {
    using Event = ros::ServiceEvent<Request, Response>;
    const boost::function<bool(Event&)> guarded = [call =
                                                       guardService(name, callback)](Event& event) {
      Request request = event.getRequest();
      return call(event.getCallerName(), request, event.getResponse());
    };
    closed_.push_back(
        [this, name, guarded] { return private_handle_.advertiseService<Event>(name, guarded); });
    if (open_) openServices();
  }
  /// Returns the indices of the shards that answer a request, which it may complete before it is
  /// sent to them. It runs in a thread of ShardRequests.
  template <class Request>
  using ShardRoute =
      typename std::common_type<std::function<std::vector<std::uint32_t>(Request&)>>::type;
  /// Makes one response of those of several shards.
  template <class Response>
  using ShardMerge =
      typename std::common_type<Response (*)(const std::vector<ShardReply<Response>>&)>::type;
  /// Adds a service that concerns the node's shard. In a node of several shards it passes requests
  /// on to those that `route` gives, and ~owned/NAME is the service of this shard alone. In any
  /// other node it is serve(). To be called after joinShards().
  template <class Node, class Request, class Response>
  void serveShared(const std::string& name, bool (Node::*callback)(Request&, Response&),
                   ShardRoute<Request> route, Repeat repeat,
                   ShardMerge<Response> merge = takeFirst<Response>) {
    serve(shards_ ? "owned/" + name : name, callback);
    if (!shards_) return;
    using Event = ros::ServiceEvent<Request, Response>;
    const boost::function<bool(Event&)> handle =
        [this, name, route, repeat, merge, call = guardService(name, callback)](Event& event) {
          Request request = event.getRequest();
          std::optional<Response> merged;
          answer(event.getResponse(), [&] {
            const std::vector<std::uint32_t> asked = route(request);
            const auto local = [&, client = event.getCallerName()](Request& own, Response& out) {
              call(client, own, out);
            };
            merged = merge(askShards<Request, Response>(name, asked, request, repeat, local));
            return std::string();
          });
          if (merged) event.getResponse() = *merged;
          return true;
        };
    closed_.push_back(
        [this, name, handle] { return shards_->workers().advertiseService<Event>(name, handle); });
    if (open_) openServices();
  }
  /// Sends a request to shards, this one among them. For the threads of ShardRequests.
  template <class Request, class Response, class Local>
  std::vector<ShardReply<Response>> askShards(const std::string& name,
                                              const std::vector<std::uint32_t>& shards,
                                              const Request& request, Repeat repeat, Local local) {
    return shards_->ask<Request, Response>(
        name, shards, request, repeat,
        [&](Request& own, Response& response) { local(own, response); });
  }
  /// Guards a callback against what it throws, counts refused requests, and tells whose they are.
  template <class Node, class Request, class Response>
  auto guardService(const std::string& name, bool (Node::*callback)(Request&, Response&)) {
    return [this, name, callback](const std::string& client, Request& request, Response& response) {
      const ClientScope scope(client_, client);
      bool answered = false;
      acceptInput(name,
                  [&] { answered = (static_cast<Node*>(this)->*callback)(request, response); });
      if (answered && !response.success) refused_requests_.add(name, response.message);
      return answered;
    };
  }
  /// Makes the node one of several that share a landscape. @param topic on which they announce
  /// themselves. @param own shard of the node, and what all shards have in common. @param
  /// time_limit for the answers of other nodes, wall time [s]. @throws InvalidInput that names a
  /// node which was there before and does not fit.
  void joinShards(const std::string& topic, ShardNode own, double time_limit);
  /// Refuses nodes of shards, since this node animates the whole: those that start later are
  /// reported. @param topic on which they announce themselves. @throws InvalidInput that names one
  /// which is there already.
  void refuseShards(const std::string& topic);
  /// Returns what passes requests on; null in a node without other shards.
  ShardRequests* shards() { return shards_.get(); }
  /// Warns of shards without a node and of silent ones, and adds how many requests were passed on.
  void addShards(Status& status);
  /// Advertises the services. A node calls it once time has begun for it, so that a client that
  /// waits for a service waits for that too.
  void openServices();
  template <class Node>
  void repeat(double rate, void (Node::*callback)(const ros::TimerEvent&)) {
    const auto guarded = [this, callback](const ros::TimerEvent& event) {
      acceptInput("timer", [&] { (static_cast<Node*>(this)->*callback)(event); });
    };
    timers_.push_back(handle_.createTimer(ros::Duration(1.0 / rate), guarded));
  }
  /// Publishes diagnostics once per second of wall time from now on.
  void startDiagnostics();
  /// Waits for the callback that runs, and lets none begin. To be called before anything that they
  /// use is destroyed.
  void stopCallbacks();
  /// Warns of the inputs and requests refused since the last report.
  void warnOfRefusals(Status& status);
  /// Adds how many inputs and requests were refused, and the memory in use.
  void addRefusals(Status& status) const;
  /// Warns of topics that have more publishers than owners.
  void warnOfRivals(Status& status) const;
  /// Warns of what has interrupted the node since the last report: a time without callbacks, as
  /// when its process is stopped, and a start that continues from a checkpoint.
  void warnOfInterruptions(Status& status);
  /// To be called when the node begins with a checkpoint of this stamp. The first reports say so:
  /// the very first may have no reader yet.
  void reportCheckpoint(Nanoseconds stamp) {
    continued_from_ = stamp;
    reports_of_start_ = 3;
  }

  /// Runs `body`; what it throws is counted and reported as a rejected `what`.
  template <class Body>
  void acceptInput(const std::string& what, Body body) {
    try {
      body();
    } catch (const std::exception& error) {  // also for lack of memory
      refusals_.add(what, error.what());
    }
  }

  /// Name of the node whose message or request the callback that runs handles: of one that another
  /// shard has passed on, that shard. Empty in all other callbacks.
  const std::string& client() const { return client_; }

  const std::string name_;

 private:
  /// Tells client() while it exists.
  class ClientScope {
   public:
    ClientScope(std::string& client, const std::string& name)
        : client_(client), before_(std::exchange(client, name.empty() ? "unknown" : name)) {}
    ~ClientScope() { client_ = before_; }
    ClientScope(const ClientScope&) = delete;
    ClientScope& operator=(const ClientScope&) = delete;

   private:
    std::string& client_;
    std::string before_;
  };

  std::string client_;
  ClosableQueue& callbacks_;

 protected:
  ros::NodeHandle handle_, private_handle_;  // of the callbacks that stopCallbacks() ends
  Refusals refusals_, refused_requests_;
  diagnostic_updater::Updater diagnostics_;

 private:
  using SteadyTime = std::chrono::steady_clock::time_point;
  struct OwnedTopic {
    ros::Subscriber subscriber, shards;  // shards: none if one node owns the topic
    std::uint32_t announced;             // number of shards
  };
  /// Learns from announcements of shards how many owners the topic of this index has.
  void countOwners(std::size_t topic, const std::string& shards);
  /// Measures how long callbacks have waited.
  void beat();
  void announceShard();

  ros::CallbackQueue awaited_;  // outlives the subscribers
  std::atomic<bool> is_ending_{false};
  std::vector<ros::Subscriber> subscribers_;
  std::vector<OwnedTopic> owned_;
  std::unique_ptr<ShardRequests> shards_;
  ros::Publisher shard_publisher_;
  std::vector<std::function<ros::ServiceServer()>> closed_;  // services that wait for time to begin
  bool open_{false};
  std::vector<ros::ServiceServer> services_;
  std::vector<ros::Timer> timers_;
  ros::WallTimer diagnostics_timer_, beat_timer_;
  std::optional<SteadyTime> last_beat_;
  double longest_wait_{0.0};       // of callbacks since the last report [s of wall time]
  Nanoseconds continued_from_{0};  // stamp of the checkpoint
  int reports_of_start_{0};        // that are still to name continued_from_
};

}  // namespace vegetation_sim
