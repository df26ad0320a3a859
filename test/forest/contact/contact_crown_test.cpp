// A capsule of 5 cm is driven through fully physical crowns.
#include <gtest/gtest.h>

#include <utility>

#include "sanitized.h"
#include "scenes/forest/crown_scene.h"

namespace vegetation_sim::forest {
namespace {

/// A drive along x, level, that meets thin wood.
struct Way {
  const char* species;
  std::uint64_t seed;
  double x, y, z;  // start [m]
  double length;   // [m]
};

constexpr Way BIRCH{"birch", 7, -1.5, 0.3, 6.5, 1.2};
// Paths with the most contacts through an oak, a pine and a willow.
constexpr Way BUSY_OAK{"oak", 7, -1.795, 0.555, 8.3, 1.1};
constexpr Way BUSY_PINE{"pine", 7, -0.624, -0.074, 9.7, 1.1};
constexpr Way BUSY_WILLOW{"willow", 7, -0.237, -2.187, 7.4, 1.1};
constexpr Way OAK{"oak", 7, -2.0, 0.0, 7.45, 1.5};
constexpr Way PINE{"pine", 9, -2.58, -0.4, 7.091, 2.0};
constexpr Way FLAT{"pine", 8, -1.192, 0.4, 8.819, 2.0};   // a stiff twig lies on the capsule
constexpr Way FOOT{"pine", 7, -1.524, -0.3, 7.673, 2.0};  // a twig grows on wood that is overrun
constexpr Way OFF{"oak", 8, -0.29028100474258256, -0.54028100474258178, 3.8, 2.0};
constexpr Way THROWN{"oak", 8, -0.090281004742582549, -1.0402810047425817, 3.4, 2.0};
constexpr Way STEM{"oak", 9, -0.13, 0.12, 4.8, 2.0};    // thick wood lies on the capsule
constexpr Way WHIP{"oak", 8, -0.986, 1.3, 6.186, 2.0};  // a branch of 1 cm passes at 9 m/s

CrownResult driveAt(double speed, const Way& way) {
  CrownScene scene(way.species, way.seed);
  return scene.drive(Vec3(way.x, way.y, way.z), 0.025, 0.6, speed, way.length);
}

std::vector<double> speeds(std::vector<double> all) {
  if (SANITIZED) all.erase(all.begin(), all.end() - 1);
  return all;
}

// Wrenches are continuous in time: none changes by more than this between substeps.
void expectGentle(const CrownResult& found, double speed) {
  for (const double change : {found.largest_rise, found.largest_fall}) {
    EXPECT_LE(change, SubstepBisection::MAX_FORCE_CHANGE * 2000.0 + 1e-6) << speed << " m/s";
    EXPECT_GT(change, 0.0) << speed << " m/s";
  }
}

// S1-W6. At every speed of a robot, thin wood moves aside: the overlap never exceeds 5 mm.
TEST(ContactInACrown, ThinWoodGoesAsideAtAnySpeed) {
  for (const double speed : speeds({0.1, 0.5, 1.0, 2.0, 3.0})) {
    const CrownResult found = driveAt(speed, BIRCH);
    EXPECT_LT(found.deepest_thin, 0.005) << speed << " m/s";
    EXPECT_GE(found.touched, 5) << speed << " m/s";
    EXPECT_EQ(found.disagreed, 0) << speed << " m/s";
    // Shallow contacts: no force rises faster than the law says.
    EXPECT_LE(found.steepest_rise, 1e5 + 1e-3) << speed << " m/s";
    expectGentle(found, speed);
  }
}

// S1-W6. The same holds for the other species where their crowns are densest; some twigs grow on
// wood that is overrun.
TEST(ContactInACrown, ThinWoodOfEverySpeciesGoesAside) {
  for (const Way& way : {BUSY_OAK, BUSY_PINE, BUSY_WILLOW}) {
    double deepest = 0.0, fall = 0.0;
    for (const double speed :
         SANITIZED ? std::vector<double>{1.0} : speeds({0.1, 0.5, 1.0, 2.0, 3.0})) {
      const bool slow = speed < 0.2;  // takes long, so the path is shorter
      Way driven = way;
      driven.length *= slow ? 0.6 : 1.0;
      const CrownResult found = driveAt(speed, driven);
      EXPECT_LT(found.deepest_thin, 0.005) << way.species << ", " << speed << " m/s";
      EXPECT_GE(found.touched, slow ? 2 : 4) << way.species << ", " << speed << " m/s";
      EXPECT_EQ(found.disagreed, 0) << way.species << ", " << speed << " m/s";
      expectGentle(found, speed);
      deepest = std::max(deepest, found.deepest_thin);
      fall = std::max(fall, found.largest_fall);
    }
    std::printf("%s: thin wood %.2f mm deep, falls %.0f N\n", way.species, 1e3 * deepest, fall);
  }
}

// S1-W6. Stiff twigs on overrun wood: their part outside the parent stays outside the body, because
// deep contacts are stopped at once.
TEST(ContactInACrown, TwigsOnOverrunWoodStayOut) {
  for (const Way& way : {PINE, FLAT}) {
    for (const double speed : speeds({1.0, 3.0})) {
      const CrownResult found = driveAt(speed, way);
      EXPECT_LT(found.deepest_thin, 0.005) << way.seed << ", " << speed << " m/s";
      EXPECT_GT(found.deepest_thick, 0.02) << way.seed << ", " << speed << " m/s";
      EXPECT_GT(found.limited, 0) << way.seed << ", " << speed << " m/s";
      expectGentle(found, speed);
    }
  }
}

// The base of a twig is inside overrun wood, which it holds off before it is entered itself. Wood
// that slides along the body faster than the body moves is followed in substeps.
TEST(ContactInACrown, FeetOfTwigsAndWhippingWoodStayOut) {
  std::vector<std::pair<double, Way>> drives{{0.5, FOOT}, {1.0, FOOT}, {3.0, WHIP}};
  if (SANITIZED) drives.erase(drives.begin());
  for (const auto& [speed, way] : drives) {
    const CrownResult found = driveAt(speed, way);
    EXPECT_LT(found.deepest_thin, 0.005) << way.species << ", " << speed << " m/s";
    EXPECT_LT(found.deepest_own, 0.005) << way.species << ", " << speed << " m/s";
    EXPECT_GT(found.deepest_thick, 0.02) << way.species << ", " << speed << " m/s";
    EXPECT_EQ(found.disagreed, 0) << way.species << ", " << speed << " m/s";
    expectGentle(found, speed);
  }
}

// Thick wood at its force limit that slides off the end of the capsule is released smoothly.
TEST(ContactInACrown, WoodThatSlidesOffLetsGoGently) {
  for (const auto& [speed, way] : {std::pair<double, Way>{0.5, OFF}, {3.0, OFF}, {3.0, THROWN}}) {
    const CrownResult found = driveAt(speed, way);
    EXPECT_LT(found.deepest_thin, 0.005) << speed << " m/s";
    EXPECT_GT(found.limited, 0) << speed << " m/s";
    expectGentle(found, speed);
  }
}

// Wood that cannot move aside reacts with the force limit, while the thin wood around it still
// moves aside.
TEST(ContactInACrown, ThickWoodAnswersWithTheLimit) {
  for (const double speed : speeds({0.5, 3.0})) {
    const CrownResult found = driveAt(speed, OAK);
    EXPECT_LT(found.deepest_thin, 0.005) << speed << " m/s";
    EXPECT_EQ(found.hardest, physics::ContactLaw().force_limit) << speed << " m/s";
    EXPECT_GT(found.deepest_thick, 0.005) << speed << " m/s";
    EXPECT_GT(found.limited, 0) << speed << " m/s";
    expectGentle(found, speed);
  }
}

// A flat branch has two contacts, whose sum no substep lets rise too far.
TEST(ContactInACrown, StoutWoodThatLiesFlatIsMetAsGently) {
  for (const double speed : speeds({1.0, 3.0})) {
    const CrownResult found = driveAt(speed, STEM);
    EXPECT_LT(found.deepest_thin, 0.005) << speed << " m/s";
    EXPECT_GT(found.deepest_thick, 0.05) << speed << " m/s";
    expectGentle(found, speed);
  }
}

TEST(ContactInACrown, EverythingReturns) {
  CrownScene scene(BIRCH.species, BIRCH.seed);
  const Vec3 start(BIRCH.x, BIRCH.y, BIRCH.z);
  EXPECT_GT(scene.drive(start, 0.025, 0.6, 3.0, BIRCH.length).touched, 5);
  const double left_over = scene.leftOver(SANITIZED ? 0.1 : 30.0);
  EXPECT_LT(left_over, SANITIZED ? 1.0 : 2e-3);  // remaining oscillation after half a minute
}

}  // namespace
}  // namespace vegetation_sim::forest
