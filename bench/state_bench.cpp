// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Measures the messages of state by their rate: bytes a second, and the distance of what a replica
// shows at any time from the truth, a run of 240 ticks a second. Of trees in a breeze that are
// pulled and pushed, it is that of the tips of physical branches; of people, that of the ends of
// their limbs.
// usage: state_bench [--quick | --full] [--part NAME,..] [--csv FILE]
//   parts: trees, people

#include <ros/serialization.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <list>
#include <string>
#include <utility>
#include <vector>

#include "crowd/agents/crowd_scene.h"
#include "options.h"
#include "ros/replicas/subscribed_crowd.h"
#include "ros/replicas/subscribed_forest.h"
#include "scenes/crowd/crowd_scenes.h"
#include "scenes/forest/physics_scene.h"
#include "table.h"
#include "vegetation_sim/ros/conversions/forest_conversions.h"

namespace vegetation_sim {
namespace {

constexpr int TRUTH_RATE = 240, DEFAULT_RATE = 30;          // [Hz]
const std::vector<int> RATES{60, 30, 20, 15, 10, 5};        // of messages [Hz]
constexpr int SETTLING = 5;                                 // [s]
constexpr double PULL = 0.3, PUSH = 20.0;                   // [m], [N]
constexpr double PULLED = 2.2, PUSHED = 1.0, PERIOD = 1.5;  // [s]
constexpr int LOADED_DEPTH = 2;                             // of the limbs that loads act on
constexpr int PEOPLE = 300;

template <class Message>
std::size_t bytesOf(Message& message) {
  message.header.frame_id = "map";
  return ros::serialization::serializationLength(message);
}

/// The bytes of one topic at one rate, and the distances of what a replica shows from the truth.
class Series {
 public:
  void addBytes(std::size_t bytes) { bytes_ += bytes; }
  void add(const Vec3& shown, const Vec3& truth) {
    distances_.push_back(static_cast<float>(length(shown - truth)));
  }
  void report(const std::string& part, const std::string& topic, const std::string& reader,
              int rate, double seconds, bench::Table& table) {
    double sum = 0.0;
    for (const float each : distances_)
      sum += static_cast<double>(each) * static_cast<double>(each);
    const double rms = std::sqrt(sum / static_cast<double>(distances_.size()));
    const double largest = *std::max_element(distances_.begin(), distances_.end());
    const auto at = distances_.begin() + static_cast<std::ptrdiff_t>(distances_.size() * 99 / 100);
    std::nth_element(distances_.begin(), at, distances_.end());
    const double high = *at, bytes = static_cast<double>(bytes_) / seconds;
    std::printf("%-6s %-12s %-8s %3d Hz %10.0f B/s %8.2f mm %8.2f mm %8.2f mm\n", part.c_str(),
                topic.c_str(), reader.c_str(), rate, bytes, 1e3 * rms, 1e3 * high, 1e3 * largest);
    table.row(part, topic, reader, rate, bytes, rms, high, largest, int(rate == DEFAULT_RATE));
  }

 private:
  std::size_t bytes_{0};
  std::vector<float> distances_;
};

/// Trees of all species in a breeze. After SETTLING a limb of every other one is moved to and fro
/// and released, one of the others is pushed.
class LoadedTrees {
 public:
  LoadedTrees(int side, int rate)
      : forest_(forest::gridLayout(side, 12.0), forest::flatTerrain(), {}),
        grid_(rate),
        tick_(grid_.tickAt(forest::PHYSICS_START)) {
    wind::Primitive breeze = forest::makeBreeze(1, Vec3(4.0, 2.0, 0.0));
    breeze.turbulence = 0.2;
    forest_.setWind(wind::Field({breeze}));
    Viewpoint eye;
    eye.position = Vec3(0.0, -10.0, 2.0);
    forest_.setViewers({eye});
    forest_.advance(grid_.timeOf(tick_));
    for (std::uint32_t id = 0; id < forest_.layout().treeCount(); ++id)
      trees_.push_back(forest::growTree(forest_.layout(), id, forest_.terrain()));
  }
  const std::vector<forest::Tree>& trees() const { return trees_; }
  const forest::Forest& forest() const { return forest_; }
  Nanoseconds now() const { return forest_.snapshot().stamp; }

  void advance() {
    ++tick_;
    const double before = loadedSince(now()), after = loadedSince(grid_.timeOf(tick_));
    if (before == 0.0) addLoads();
    for (const auto& [id, target] : held_) {
      if (before < PULLED)
        forest_.moveGrab(id, target + wayAt(after));
      else
        forest_.release(id);
    }
    if (before >= PULLED) held_.clear();
    forest_.advance(grid_.timeOf(tick_));
  }
  /// Returns the message of a tick. @param view whether it is that for displays.
  ForestState message(bool view) {
    const bool key_frame = tick_ % grid_.rate() == 0;
    return toMsg(view ? forest_.updateView(key_frame) : forest_.update(key_frame));
  }

 private:
  static double loadedSince(Nanoseconds stamp) {
    return secondsBetween(forest::PHYSICS_START, stamp) - SETTLING;
  }
  static Vec3 wayAt(double time) {
    return 0.5 * PULL * (1.0 - sinCosTurns(time / PERIOD).cos) * Vec3(0.6, 0.0, -0.8);
  }
  void addLoads() {
    for (std::uint32_t id = 0; id < trees_.size(); ++id) {
      const forest::Tree& tree = trees_[id];
      const int branch = tree.skeleton.depth_end[LOADED_DEPTH] - 1;
      const forest::Branch& limb = tree.skeleton.branches[static_cast<std::size_t>(branch)];
      if (id % 2 == 0) {
        forest::Grab grab;
        grab.point = {id, branch, limb.length};
        grab.target = tree.foot +
                      tipOf(limb, forest_.pose(tree, id, now())[static_cast<std::size_t>(branch)]);
        held_.emplace_back(forest_.addGrab(grab), grab.target);
      } else {
        forest::Push push;
        push.point = {id, branch, limb.length};
        push.force = PUSH * Vec3(0.6, 0.0, -0.8);
        push.until = now() + fromSeconds(PUSHED);
        forest_.push(push);
      }
    }
  }

  forest::Forest forest_;
  TickGrid grid_;
  std::int64_t tick_;
  std::vector<forest::Tree> trees_;
  std::vector<std::pair<std::uint32_t, Vec3>> held_;  // grabs and their first targets
};

/// A display or a sensor of trees, and the messages that it reads.
class TreeReader {
 public:
  TreeReader(bool is_view, const forest::Forest& forest)
      : is_view_(is_view),
        replica_({}, is_view ? SubscribedForest::FineModes::ONE_BY_ONE
                             : SubscribedForest::FineModes::AT_ONCE) {
    replica_.setLayout(toMsg(forest.layout()));
    replica_.setWind(forest.snapshot().wind);
  }
  void read(LoadedTrees& sent, bool is_measured) {
    ForestState message = sent.message(is_view_);
    const std::size_t bytes = bytesOf(message);
    if (is_measured) series.addBytes(bytes);
    replica_.apply(message);
  }
  /// Adds the tips of the branches that are physical.
  void compare(const LoadedTrees& truth) {
    const Nanoseconds now = truth.now();
    for (const std::uint32_t id : truth.forest().physicalTrees()) {
      const forest::Tree& tree = truth.trees()[id];
      const auto exact = is_view_ ? truth.forest().poseInView(tree, id, now)
                                  : truth.forest().poseForSensors(tree, id, now);
      const auto shown = replica_.replica().pose(tree, id, now);
      for (const forest::PromotedBranch& each : truth.forest().promoted(id).branches) {
        const auto k = static_cast<std::size_t>(each.branch);
        const forest::Branch& branch = tree.skeleton.branches[k];
        series.add(tipOf(branch, shown[k]), tipOf(branch, exact[k]));
      }
    }
  }
  Series series;

 private:
  bool is_view_;
  SubscribedForest replica_;
};

void benchTrees(const bench::Options& options, bench::Table& table) {
  const int side = options.quick ? 2 : 3, watched = options.full ? 10 : 4;
  for (const int rate : RATES) {
    LoadedTrees truth(side, TRUTH_RATE), sent(side, rate);
    TreeReader state(false, sent.forest()), view(true, sent.forest());
    for (int i = 1; i <= (SETTLING + watched) * TRUTH_RATE; ++i) {
      const bool is_measured = i > SETTLING * TRUTH_RATE;
      const bool is_sent = i % (TRUTH_RATE / rate) == 0;
      truth.advance();
      if (is_sent) sent.advance();
      for (TreeReader* reader : {&state, &view}) {
        if (is_sent) reader->read(sent, is_measured);
        if (is_measured) reader->compare(truth);
      }
    }
    state.series.report("trees", "forest/state", "sensor", rate, watched, table);
    view.series.report("trees", "forest/view", "display", rate, watched, table);
  }
}

/// A display or a sensor of people, and the messages that it reads.
class CrowdReader {
 public:
  CrowdReader(std::string topic, std::string name, int rate)
      : topic_(std::move(topic)), name_(std::move(name)), rate_(rate) {}
  int rate() const { return rate_; }
  void read(const crowd::Crowd& crowd, Nanoseconds stamp, bool is_measured) {
    const auto apply = [&](auto&& message) {
      message.header.stamp = toStamp(stamp);
      const std::size_t bytes = bytesOf(message);
      if (is_measured) series_.addBytes(bytes);
      replica_.apply(message);
    };
    if (topic_ == "agents/view") {
      apply(toView(crowd.walkers(), crowd.terrain()));
      return;
    }
    AgentStates message;
    for (const crowd::Walker& walker : crowd.walkers())
      message.agents.push_back(toMsg(walker, crowd.terrain()));
    apply(message);
  }
  /// Adds the ends of the limbs of one person.
  void compare(std::size_t i, const crowd::Skeleton& exact, const terrain::HeightMap& terrain,
               Nanoseconds stamp) {
    const crowd::Skeleton shown = bodyAt(replica_.people().at(i).walker, terrain, stamp);
    for (std::size_t limb = 0; limb < exact.size(); ++limb)
      series_.add(shown[limb].to, exact[limb].to);
  }
  void report(double seconds, bench::Table& table) {
    series_.report("people", topic_, name_, rate_, seconds, table);
  }

 private:
  crowd::Skeleton bodyAt(const crowd::Walker& walker, const terrain::HeightMap& terrain,
                         Nanoseconds stamp) const {
    return skeletonOf(walkOn(walker, secondsBetween(replica_.stamp(), stamp)), terrain,
                      replica_.motions(), secondsBetween(0, stamp));
  }

  std::string topic_, name_;
  int rate_;
  SubscribedCrowd replica_;
  Series series_;
};

crowd::Crowd wanderers() {
  crowd::Crowd out(1, {}, {-25, 25, -25, 25}, crowd::flatGround());
  for (const crowd::Spawn& spawn : crowd::groupOf({}, PEOPLE, 25.0, 0.2, Random(1)))
    out.spawn(spawn);
  return out;
}

void benchPeople(const bench::Options& options, bench::Table& table) {
  const int watched = options.full ? 6 : options.quick ? 1 : 3;
  crowd::Crowd crowd = wanderers();
  std::list<CrowdReader> readers;
  for (const int rate : RATES)
    for (const auto& [topic, name] : std::vector<std::pair<std::string, std::string>>{
             {"agents", "sensor"}, {"agents/view", "display"}})
      readers.emplace_back(topic, name, rate);
  const TickGrid grid(TRUTH_RATE);
  const std::int64_t first = grid.tickAt(forest::PHYSICS_START);
  for (int i = 1; i <= (SETTLING + watched) * TRUTH_RATE; ++i) {
    const Nanoseconds stamp = grid.timeOf(first + i);
    const bool is_measured = i > SETTLING * TRUTH_RATE;
    crowd.advance(stamp);
    for (CrowdReader& reader : readers)
      if (i % (TRUTH_RATE / reader.rate()) == 0) reader.read(crowd, stamp, is_measured);
    if (!is_measured || i % 2 != 0) continue;
    for (std::size_t k = 0; k < crowd.walkers().size(); ++k) {
      const crowd::Skeleton exact = skeletonOf(crowd.walkers()[k], crowd.terrain(),
                                               crowd::ownStyles(), secondsBetween(0, stamp));
      for (CrowdReader& reader : readers) reader.compare(k, exact, crowd.terrain(), stamp);
    }
  }
  for (CrowdReader& reader : readers) reader.report(watched, table);
}

void run(const bench::Options& options) {
  bench::Table table(options.csv, "part,topic,reader,rate,bytes,rms,high,largest,chosen");
  std::printf("%-6s %-12s %-8s %6s %14s %11s %11s %11s\n", "part", "topic", "reader", "rate",
              "bytes", "rms", "99 %", "largest");
  if (options.wants("trees")) benchTrees(options, table);
  if (options.wants("people")) benchPeople(options, table);
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  try {
    using namespace vegetation_sim;
    run(bench::readOptions(argc, argv, {"trees", "people"}));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "state_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
