// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "nodes/base/event_queue.h"
#include "nodes/base/node_base.h"
#include "nodes/base/node_options.h"
#include "nodes/snapshots/event_inputs.h"
#include "nodes/snapshots/node_snapshots.h"
#include "ros/services/service_replies.h"
#include "ros/time/tick_clock.h"

namespace vegetation_sim {

/// The part of an EventNode that applies events and that saves and loads: a state that is a
/// function of events on the tick grid of ROS time, and the queue in which inputs wait.
/// @tparam Queue EventQueue or derived from it. @tparam Options derived from NodeOptions.
template <class Queue, class Options>
class SavedNode : public NodeBase {
 protected:
  using Event = typename Queue::Event;
  using Message = typename Queue::Message;

  /// @param topic of the events.
  SavedNode(const char* name, const char* topic, const ros::NodeHandle& handle,
            const ros::NodeHandle& private_handle, Options options, TickCalls calls)
      : NodeBase(name, handle, private_handle),
        options_(std::move(options)),
        inputs_(options_.replay, &client()),
        clock_(name_, options_.state_rate, options_.replay ? options_.replay_delay : 0.0,
               std::move(calls)),
        events_publisher_(options_.replay ? ros::Publisher()
                                          : handle_.advertise<Message>(topic, Queue::MOST_WAITING)),
        snapshots_(options_.snapshots, name_, private_handle_.getNamespace(),
                   {[this] { return snapshot(); }, [this] { return sceneHash(); },
                    [this](const std::string& payload, Nanoseconds shift) {
                      return readPayload(payload, shift);
                    }}) {
    inputs_.observe([this](const Event& event) { keepArrival(event); });
  }

  virtual void tick(std::int64_t tick) = 0;
  /// Applies an event to the simulation. @throws InvalidInput, and then nothing has changed.
  virtual void apply(Event& event) = 0;
  /// Puts the live events of a tick into the order in which they are applied: by default they are
  /// in that of their arrival.
  virtual void arrange(std::vector<Event>&) const {}

  /// Hash of what the scenario and the parameters fix.
  virtual std::uint64_t sceneHash() const = 0;
  virtual std::uint64_t stateHash() const = 0;
  /// Writes what the future of the node depends on, besides the queue.
  virtual void writeState(Archive& a) const = 0;
  /// Reads it. Restoring also queues the inputs of other nodes that are newer than the state's:
  /// what they publish now stays in force. @throws InvalidInput, and then nothing has changed.
  virtual CheckedState readState(Archive& a) = 0;
  /// Returns the input to which an event refers by its hash, as bytes; empty if it refers to none.
  virtual std::string inputOf(const Event&) const { return {}; }
  /// Reads such an input, and returns what makes it known.
  virtual std::function<void()> readInput(Event&, const std::string& /*bytes*/,
                                          Nanoseconds /*shift*/) {
    return [] {};
  }
  /// Called for each input between ticks that recover() puts into the queue again.
  virtual void onRecovered(const Event&) {}
  /// Waits for inputs that a snapshot of this tick shall have.
  virtual void awaitInputsToSave() {}
  /// Called when the state has been loaded.
  virtual void onLoaded() {}

  /// Adds the services; to be called once.
  void serveSnapshots() {
    serve("save_snapshot", &SavedNode::onSave);
    serve("load_snapshot", &SavedNode::onLoad);
  }

  void refuseInReplay() const {
    if (options_.replay)
      throw InvalidInput("a replay follows its recorded events only", FaultCode::NOT_AVAILABLE);
  }
  /// @throws InvalidInput if the queue is full.
  void enqueue(Event event) {
    if (!inputs_.add(std::move(event)))
      throw InvalidInput(Queue::describeFull(), FaultCode::NO_ROOM);
  }
  /// Applies the events of a tick in order, and publishes them unless this is a replay.
  void applyInputs(Nanoseconds stamp) {
    std::vector<Event> events = inputs_.take(stamp);
    if (!options_.replay) arrange(events);
    if (recovers_) events = std::exchange(recovered_, {});
    JournalRecord done{stamp, {}};
    for (Event& event : events) {
      acceptInput("event", [&] {
        if (event.kind == Event::LOAD)
          replayLoad(event);
        else
          apply(event);
        ++applied_;
        publishEvent(event);
        if (snapshots_.hasCheckpoints() && !options_.replay) done.events.push_back(stored(event));
      });
    }
    if (!options_.replay) acceptInput("checkpoint", [&] { snapshots_.addTick(std::move(done)); });
    loss_warnings_.warn(name_.c_str(), inputs_.losses());
  }
  void publishEvent(const Event& event) {
    if (options_.replay || events_publisher_.getNumSubscribers() == 0) return;
    Message message = eventToMsg(event);
    message.header.frame_id = options_.frame_id;
    events_publisher_.publish(message);
  }
  /// Runs a tick, and writes a checkpoint if it is time.
  void runTick(std::int64_t number) {
    {
      const TickScope scope{in_tick_ = true};
      tick(number);
    }
    if (options_.replay) return;
    acceptInput("checkpoint", [this] { snapshots_.checkpointIfDue(clock_.stamp()); });
  }
  /// Writes a checkpoint now if the node has them: to be called after changes that no event shows.
  void checkpointNow() {
    if (options_.replay) return;
    acceptInput("checkpoint", [this] { snapshots_.checkpoint(); });
  }
  /// To be called when the clock has jumped back.
  void forgetCheckpoint() {
    if (!options_.replay) snapshots_.dropCheckpoint();
  }
  /// Stamp of the last tick, 0 before the first.
  Nanoseconds lastStamp() const { return clock_.hasBegun() ? clock_.stamp() : 0; }

  /// Begins with the newest checkpoint, if the node shall, and repeats its journal. Meanwhile the
  /// node is a replay. To be called before the clock runs.
  void recover() {
    if (options_.replay) return;
    acceptInput("checkpoint", [this] {
      const auto found = snapshots_.readCheckpoint();
      if (!found) return;
      const std::vector<JournalRecord> records = snapshots_.readJournal(*found);
      found->state.restore();
      clock_.resume(clock_.grid().tickAt(found->header.stamp));
      options_.replay = recovers_ = true;
      for (const JournalRecord& record : records)
        acceptInput("checkpoint", [&] { repeatRecord(record); });
      options_.replay = recovers_ = false;
      snapshots_.checkpoint();
      reportCheckpoint(clock_.stamp());
      ROS_INFO("%s: continues from its checkpoint, after the tick at %.9f s", name_.c_str(),
               secondsBetween(0, clock_.stamp()));
    });
  }
  /// Whether recover() runs ticks again, whose outputs others know.
  bool recovers() const { return recovers_; }

  Options options_;
  Queue inputs_;
  TickClock clock_;
  std::uint64_t applied_{0};  // events

 private:
  SnapshotFile snapshot() const {
    Archive a;
    writeState(a);
    std::vector<StoredEvent> waiting;
    inputs_.each([&](const Event& event) { waiting.push_back(stored(event)); });
    archive(a, waiting);
    return {{name_, sceneHash(), lastStamp(), stateHash()}, a.takeBytes()};
  }

  StoredEvent stored(const Event& event) const {
    const Message& message = eventToMsg(event);
    return {bytesOf(message), inputOf(event)};
  }

  /// An event that is read, and what makes its input known.
  struct ReadEvent {
    Event event;
    std::function<void()> keep_input;
  };
  ReadEvent readEvent(const StoredEvent& stored, Nanoseconds shift) {
    ReadEvent out{eventFromMsg(messageOf<Message>(stored.message)), [] {}};
    const Nanoseconds stamp = stampOf(out.event);
    if (stamp != 0) setStamp(out.event, stamp + shift);
    if (!stored.input.empty()) out.keep_input = readInput(out.event, stored.input, shift);
    return out;
  }

  CheckedState readPayload(const std::string& payload, Nanoseconds shift) {
    Archive a = Archive::reading(payload, shift);
    CheckedState state = readState(a);
    std::vector<StoredEvent> stored;
    archive(a, stored);
    a.finish();
    std::vector<ReadEvent> waiting;
    for (const StoredEvent& event : stored) waiting.push_back(readEvent(event, shift));
    const auto restore = [this, state, waiting] {
      std::vector<Event> events;
      for (const ReadEvent& read : waiting) {
        read.keep_input();
        events.push_back(read.event);
      }
      if (!inputs_.replay()) inputs_.restore(events);
      state.restore();
    };
    return {state.hash, restore};
  }

  struct TickScope {
    bool& in_tick;
    ~TickScope() { in_tick = false; }
  };

  // Events that a tick adds for itself are in its record.
  void keepArrival(const Event& event) {
    if (!snapshots_.hasCheckpoints() || options_.replay) return;
    if (in_tick_ && stampOf(event) <= clock_.stamp()) return;
    acceptInput("checkpoint", [&] { snapshots_.addInput(stored(event)); });
  }

  void repeatRecord(const JournalRecord& record) {
    std::vector<Event> events;
    for (const StoredEvent& event : record.events) {
      ReadEvent read = readEvent(event, 0);
      read.keep_input();
      events.push_back(std::move(read.event));
    }
    if (record.stamp == 0) {
      for (const Event& event : events) {
        inputs_.add(event);
        onRecovered(event);
      }
      return;
    }
    recovered_ = std::move(events);
    clock_.resume(clock_.grid().tickAt(record.stamp));
    tick(clock_.tick());
  }

  // A replay reads the file that the recorded node has read.
  void replayLoad(const Event& event) {
    const auto& wanted = event.snapshot;
    const auto found = snapshots_.read(wanted.name, wanted.node, fromMsg(wanted.stamp));
    if (found.header.state_hash != wanted.hash)
      throw InvalidInput("snapshot " + inQuotes(wanted.name) + " has the hash " +
                         std::to_string(found.header.state_hash) + ", the recorded one had " +
                         std::to_string(wanted.hash));
    found.state.restore();
    onLoaded();
  }

  bool onSave(SaveSnapshot::Request& request, SaveSnapshot::Response& response) {
    return answer(response, [&] {
      awaitInputsToSave();
      return snapshots_.save(request.name, response);
    });
  }

  bool onLoad(LoadSnapshot::Request& request, LoadSnapshot::Response& response) {
    return answer(response, [&] {
      refuseInReplay();
      return snapshots_.load(request, clock_.stamp(), response,
                             [&](const NodeSnapshots::Loadable& loaded) {
                               onLoaded();
                               publishLoad(request, loaded);
                             });
    });
  }

  void publishLoad(const LoadSnapshot::Request& request, const NodeSnapshots::Loadable& loaded) {
    acceptInput("checkpoint", [this] {
      snapshots_.dropCheckpoint();
      snapshots_.checkpoint();
    });
    Event event;
    event.kind = Event::LOAD;
    setStamp(event, clock_.grid().timeOf(clock_.tick() + 1));
    event.snapshot.name = request.name;
    event.snapshot.node = request.node.empty() ? snapshots_.node() : request.node;
    event.snapshot.hash = loaded.header.state_hash;
    event.snapshot.stamp = toStamp(loaded.header.stamp + loaded.shift);
    publishEvent(event);
  }

  ros::Publisher events_publisher_;
  NodeSnapshots snapshots_;
  bool recovers_{false};
  bool in_tick_{false};
  std::vector<Event> recovered_;  // of the tick that runs again
  LossWarnings loss_warnings_;
};

}  // namespace vegetation_sim
