// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Requests to the nodes, and the inputs of the meadow that no other target reads.
#include <vegetation_sim/GrassColours.h>
#include <vegetation_sim/TreadEvents.h>

#include <cmath>

#include "forest/trees_around.h"
#include "fuzz/targets/decoding.h"
#include "fuzz/targets/target_lists.h"
#include "fuzz/targets/two_bushes.h"
#include "fuzz/targets/usage.h"
#include "nodes/forest/grab_manager.h"
#include "nodes/forest/tree_requests.h"
#include "nodes/grass/grass_events.h"
#include "nodes/grass/grass_sources.h"
#include "nodes/grass/treads/near_treads.h"
#include "scenes/forest/forest_fixture.h"
#include "vegetation_sim/ros/conversions/forest_conversions.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"
#include "vegetation_sim/ros/conversions/grass_conversions.h"

namespace vegetation_sim::fuzz {
namespace {

const Pose FRAME{Vec3(0.1, 0.2, 0.3), normalized({0.9, 0.0, 0.0, 0.4})};

// Requests that need no state but the scene, and treads, odometry and colours.

enum RequestPiece { PICK, FIND, CLEAR, PATH, COLOURS, TREADS, ODOMETRY, REQUEST_PIECES };

template <class Message, class Use>
void readWith(std::string_view bytes, const Use& use) {
  if (Message message; decode(bytes, message)) use(message);
}

void pickBush(const Pick::Request& request) {
  static const forest::Forest FOREST(twoBushes(), forest::flatTerrain(), {});
  const auto hit =
      forest::pickTree(FOREST.layout(), FOREST.terrain(), rayOf(request), [](std::uint32_t id) {
        forest::PosedTree out;
        out.tree = std::make_shared<const forest::Tree>(
            forest::growTree(FOREST.layout(), id, FOREST.terrain()));
        out.poses = FOREST.pose(*out.tree, id, 0);
        return out;
      });
  if (hit) requireFinite(hit->point, "point of a hit");
}

void findTrees(const FindTrees::Request& request) {
  static const forest::Layout LAYOUT = twoBushes();
  check(request);
  for (const std::uint32_t id :
       forest::treesAround(LAYOUT, fromMsg(request.centre.point), request.radius))
    if (id >= LAYOUT.treeCount()) throw BrokenPromise("a tree that is found does not exist");
}

grass::MapLaw smallLaw() {
  grass::MapLaw out;
  out.columns = out.rows = 4;
  return out;
}

void receiveTreads(const TreadEvents& message) {
  const grass::TileOwners owners(smallLaw(), {0, 2});
  NearTreads near(smallLaw(), owners, 1.0);
  for (const TreadEvent& event : message.events) try {
      const NearTreads::Use use = near.useOf(event, false);
      const grass::TreadInput input = fromMsg(event, grass::TreadLaw(), 0.3);
      requireFinite(input.position, "position of a tread");
      if (use == NearTreads::Use::ALL) near.keep(event);
    } catch (const InvalidInput&) {
    }
}

// As a source that grass_field follows.
void followOdometry(const nav_msgs::Odometry& message) {
  const GrassSources::ObservedSource at =
      GrassSources::observe(message, FRAME, Vec3(0.1, 0.0, 0.2), START);
  grass::TreadInput input;
  input.source = "robot";
  input.body_frame = message.child_frame_id;
  input.position = at.position;
  input.velocity = at.velocity;
  Faults faults;
  check(input, "source: ", faults);
  faults.throwIfAny();
  requireFinite(fromMsg(toMsg(input), grass::TreadLaw(), 0.3).position, "position of a source");
}

void colourGrass(const GrassColours& message) {
  const grass::ColourMasks masks = fromMsg(message);
  const double colour = grass::averageColour(0.5, masks.at(START), 1.0, 2.0);
  if (!std::isfinite(colour)) throw BrokenPromise("a colour is not finite");
}

void readRequest(const Piece& piece) {
  const auto frame = [] { return FRAME; };
  switch (piece.kind % REQUEST_PIECES) {
    case PICK:
      return readWith<Pick::Request>(piece.bytes, pickBush);
    case FIND:
      return readWith<FindTrees::Request>(piece.bytes, findTrees);
    case CLEAR:
      return readWith<ClearGrass::Request>(piece.bytes, [&](const ClearGrass::Request& m) {
        requireFinite(fromMsg(clearingOf(m, frame).centre), "centre of a clearing");
      });
    case PATH:
      return readWith<Tread::Request>(piece.bytes, [&](const Tread::Request& m) {
        for (const Vec3& place : pathOf(m, smallLaw(), terrain::HeightMap(), frame))
          requireFinite(place, "point of a path");
      });
    case COLOURS:
      return readWith<GrassColours>(piece.bytes, colourGrass);
    case TREADS:
      return readWith<TreadEvents>(piece.bytes, receiveTreads);
    default:
      return readWith<nav_msgs::Odometry>(piece.bytes, followOdometry);
  }
}

void runRequests(std::string_view input) {
  for (const Piece& piece : splitPieces(input)) try {
      readRequest(piece);
    } catch (const InvalidInput&) {
    }
}

std::vector<std::string> requestSeeds() {
  Pick::Request pick;
  pick.origin = toPoint(Vec3(-3.0, 0.0, 0.5));
  pick.direction.x = 1.0;
  pick.tolerance = 0.1;
  FindTrees::Request find;
  find.radius = 5.0;
  find.limit = 10;
  ClearGrass::Request clear;
  clear.centre.point.x = clear.radius = 1.0;
  Tread::Request path;
  path.points.resize(2);
  path.points[0].x = path.points[0].y = path.points[1].x = 1.0;
  path.points[1].y = 2.0;
  GrassColours colours;
  colours.header.stamp = toStamp(START);
  colours.colours.resize(2);
  colours.colours[0].radius = colours.colours[0].weight = colours.colours[1].radius = 1.0;
  TreadEvents treads;
  treads.events.resize(2);
  treads.events[0].source = treads.events[1].source = "boot";
  treads.events[1].action = TreadEvent::STROKE;
  treads.events[1].position.x = 1.0;
  nav_msgs::Odometry odometry;
  odometry.header.frame_id = "map";
  odometry.child_frame_id = "base";
  odometry.pose.pose.orientation.w = 1.0;
  odometry.twist.twist.angular.z = 0.5;
  return {pieceOf(PICK, encode(pick)),        pieceOf(FIND, encode(find)),
          pieceOf(CLEAR, encode(clear)),      pieceOf(PATH, encode(path)),
          pieceOf(COLOURS, encode(colours)),  pieceOf(TREADS, encode(treads)),
          pieceOf(ODOMETRY, encode(odometry))};
}

// Requests to hold, push and cut branches.

enum GrabPiece { GRAB, MOVE, RELEASE, PUSH, CUT, TICK, GRAB_PIECES };
constexpr int MOST_TICKS = 6;  // of an input

class GrabRig {
 public:
  GrabRig() {
    forest_.advance(stamp_);
    geometry_msgs::TransformStamped hand;
    hand.header.frame_id = "map";
    hand.header.stamp = toStamp(stamp_);
    hand.child_frame_id = "hand";
    hand.transform.translation.z = hand.transform.rotation.w = 1.0;
    tf_.setTransform(hand, "fuzz", true);
  }
  // As ForestAnimator does.
  void tick() {
    if (ticks_++ >= MOST_TICKS) return;
    stamp_ += NANOSECONDS_PER_SECOND / 60;
    grabs_.follow(stamp_, [](const std::string&, const std::string&) {});
    for (ForestInput& event : inputs_.take(stamp_)) try {
        grabs_.followFrame(event);
        applyInteraction(event, forest_);
      } catch (const InvalidInput&) {
      }
    forest_.advance(stamp_);
    grabs_.update();
    for (const ContactForce& force : grabs_.forces().forces)
      requireFinite(fromMsg(force.force), "force on a hand");
    grabs_.statuses();
  }
  void receive(const Piece& piece) {
    switch (piece.kind % GRAB_PIECES) {
      case GRAB:
        return ask<Grab>(piece, [this](auto& m, auto& out) { grabs_.grab(m, out); });
      case MOVE:
        return ask<MoveGrab>(piece, [this](auto& m, auto& out) { grabs_.move(m, out); });
      case RELEASE:
        return ask<Release>(piece, [this](auto& m, auto&) { grabs_.release(m); });
      case PUSH:
        return ask<ApplyForce>(piece, [this](auto& m, auto& out) { grabs_.push(m, out); });
      case CUT:
        return ask<CutBranch>(piece, [this](auto& m, auto& out) { grabs_.cut(m, out); });
      default:
        tick();
    }
  }

 private:
  // As answer() does, by which services reply.
  template <class Service, class Use>
  static void ask(const Piece& piece, const Use& use) {
    typename Service::Response response;
    readWith<typename Service::Request>(piece.bytes, [&](const auto& m) {
      try {
        use(m, response);
      } catch (const InvalidInput&) {
      } catch (const std::out_of_range&) {  // an unknown tree
      }
    });
  }

  Nanoseconds stamp_{START};
  int ticks_{0};
  ForestOptions options_;
  forest::Forest forest_{twoBushes(), forest::flatTerrain(), {}};
  forest::TreeCache cache_{10000};
  ForestInputs inputs_{false};
  tf2_ros::Buffer tf_;
  GrabManager grabs_{GrabDependencies{options_, forest_, cache_, inputs_, tf_}};
};

void runGrabs(std::string_view input) {
  GrabRig rig;
  for (const Piece& piece : splitPieces(input)) rig.receive(piece);
  rig.tick();
}

std::vector<std::string> grabSeeds() {
  const std::string tick = pieceOf(TICK, "");
  Grab::Request grab;
  grab.along = 0.1;
  grab.target.point = toPoint(Vec3(0.1, 0.1, 0.2));
  Grab::Request by_hand = grab;
  by_hand.frame = "hand";
  by_hand.nearest = by_hand.keep_offset = true;
  by_hand.point.point.z = 0.5;
  MoveGrab::Request move;
  move.id = 1;
  move.target.point = toPoint(Vec3(0.2, 0.1, 0.3));
  Release::Request release;
  release.id = 1;
  ApplyForce::Request push;
  push.duration = push.force.vector.x = 1.0;
  CutBranch::Request cut;
  cut.branch = 1;
  const std::string held = pieceOf(GRAB, encode(grab)) + tick;
  return {held + pieceOf(MOVE, encode(move)) + tick + pieceOf(RELEASE, encode(release)) + tick,
          pieceOf(GRAB, encode(by_hand)) + tick + tick,
          pieceOf(PUSH, encode(push)) + tick + pieceOf(CUT, encode(cut)) + tick,
          held + pieceOf(CUT, encode(cut)) + tick};
}

}  // namespace

std::vector<Target> requestTargets() {
  return {{"requests", "Pick, FindTrees, ClearGrass, Tread, TreadEvents, Odometry and GrassColours",
           runRequests, requestSeeds},
          {"grabs", "Grab, MoveGrab, Release, ApplyForce and CutBranch; two bushes", runGrabs,
           grabSeeds}};
}

}  // namespace vegetation_sim::fuzz
