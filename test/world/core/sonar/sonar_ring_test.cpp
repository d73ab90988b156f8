#include "world/core/sonar/sonar_ring.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "common/config.hpp"

namespace priamos::world {
namespace {

const Eigen::Vector2d kFootprint(0.95, 0.78);

Solid Box(Pose2 pose, Eigen::Vector2d size, std::string material = "plaster") {
  return {"box", pose, size, 0, 2, std::move(material)};
}

AcousticScene SceneOf(const std::vector<Solid>& solids) {
  return {solids, 0.4, 0.05, EchoMaterial::Defaults()};
}

/// A long wall whose face is `distance` before the origin, its normal turned by `incidence_deg`.
AcousticScene WallAt(double distance, double incidence_deg, std::string material = "plaster") {
  const Pose2 map_from_wall = Pose2{0, 0, Radians(incidence_deg)} * Pose2{distance + 0.1, 0, 0};
  return SceneOf({Box(map_from_wall, {0.2, 40}, std::move(material))});
}

SonarConfig Quiet() {
  SonarConfig config;
  config.fading_db = config.noise_m = config.noise_per_m = config.sound_speed_error = config.crosstalk = 0;
  return config;
}

std::optional<double> Range(const AcousticScene& scene, const Pose2& sonar = {}) {
  const auto echo = Ping(scene, Quiet(), sonar, -Quiet().sensitivity_db);
  return echo ? std::optional(echo->range_m) : std::nullopt;
}

TEST(PingTest, AWallAheadIsAtItsDistance) {
  for (const double distance : {0.2, 1.0, 3.0, 4.9}) {
    ASSERT_TRUE(Range(WallAt(distance, 0))) << distance;
    EXPECT_NEAR(*Range(WallAt(distance, 0)), distance, 1e-6);
  }
}

TEST(PingTest, NothingWithinFiveMetresGivesNoEcho) {
  EXPECT_FALSE(Range(WallAt(5.1, 0)));
  EXPECT_FALSE(Range(SceneOf({})));
}

TEST(PingTest, AnObliqueWallIsAtItsPerpendicularDistanceWhileTheBeamHoldsIt) {
  ASSERT_TRUE(Range(WallAt(1.5, 10)));
  EXPECT_NEAR(*Range(WallAt(1.5, 10)), 1.5, 0.005);
}

TEST(PingTest, ASmoothWallIsLostBeyondTheSpecularAngle) {
  // Mirror up to 12 degrees, beam sampled to 15: beyond 27 degrees nothing can come back.
  for (const double incidence : {28.0, 35.0, 45.0, 60.0})
    EXPECT_FALSE(Range(WallAt(1.5, incidence))) << incidence;
  EXPECT_TRUE(Range(WallAt(1.5, 15)));
}

TEST(PingTest, ARoughWallAnswersFromAnyIncidence) {
  for (const double incidence : {0.0, 30.0, 45.0, 60.0}) {
    const auto range = Range(WallAt(1.0, incidence, "fabric"));
    ASSERT_TRUE(range) << incidence;
    // Somewhere between the nearest point within the beam and the axis.
    EXPECT_GE(*range, 1.0 - 1e-9);
    EXPECT_LE(*range, 1.0 / std::cos(Radians(incidence)) + 1e-9);
  }
}

TEST(PingTest, AnInnerCornerComesBackThoughBothWallsAreSeenObliquely) {
  // Walls x = 2 and y = 2, seen along the diagonal: each alone is far beyond its specular angle.
  const AcousticScene corner = SceneOf({Box({2.1, 0, 0}, {0.2, 4.4}), Box({0, 2.1, 0}, {4.0, 0.2})});
  const auto range = Range(corner, {0, 0, kPi / 4});
  ASSERT_TRUE(range);
  EXPECT_NEAR(*range, 2 * std::sqrt(2.0), 0.05);
}

TEST(PingTest, AnObliqueWallMirrorsTheBeamToWhatStandsBeside) {
  // Wall at 45 degrees, 1 m ahead on the axis, and a box face 1 m beside it: the classic ghost at 2 m.
  const AcousticScene scene =
      SceneOf({Box(Pose2{1, 0, kPi / 4} * Pose2{0, -0.1, 0}, {1.0, 0.2}), Box({1, 1.1, 0}, {1, 0.2})});
  const auto range = Range(scene);
  ASSERT_TRUE(range);
  EXPECT_NEAR(*range, 2.0, 0.05);
}

TEST(PingTest, ADoorJambIsHeardByItsEdge) {
  // The jamb's face is parallel to the axis and its end turned away: only the edge answers.
  const AcousticScene jamb = SceneOf({Box({1.5, 0.1, Radians(45)}, {0.14, 0.14}, "door_frame")});
  const auto range = Range(jamb);
  ASSERT_TRUE(range);
  EXPECT_NEAR(*range, 1.5 - 0.07 * std::sqrt(2.0), 0.1);
}

TEST(PingTest, EdgesAreWeakerThanWalls) {
  EXPECT_FALSE(Range(SceneOf({Box({4.0, 0, Radians(45)}, {0.2, 0.2})})));
  EXPECT_TRUE(Range(SceneOf({Box({4.0, 0, 0}, {0.2, 0.2})})));
}

TEST(PingTest, TheEchoOfAnEdgeIsLostBeyondTwoAndAHalfMetres) {
  // -30 dB at the edge, 30 dB per factor 10 of distance, 2.6 dB per metre, against 45 dB of sensitivity.
  const auto edge_at = [](double distance) {
    return SceneOf({Box({distance + 0.1 * std::sqrt(2.0), 0, Radians(45)}, {0.2, 0.2})});
  };
  EXPECT_TRUE(Range(edge_at(2.35)));
  EXPECT_FALSE(Range(edge_at(2.5)));
}

TEST(PingTest, TheBeamIsAboutFifteenDegreesWide) {
  // A rough post of 4 cm at 2 m, moved sideways: heard on the axis and 7 degrees off, not 20 degrees off.
  const auto post = [](double off_deg) {
    return SceneOf({Box(Pose2{0, 0, Radians(off_deg)} * Pose2{2, 0, 0}, {0.04, 0.04}, "fabric")});
  };
  EXPECT_TRUE(Range(post(0)));
  EXPECT_TRUE(Range(post(7)));
  EXPECT_FALSE(Range(post(20)));
}

/// Rough and smooth boxes anywhere within `spread_m`, from a fixed seed.
std::vector<Solid> Strewn(std::uint64_t seed, double spread_m, int count) {
  Rng rng(seed);
  std::vector<Solid> solids;
  solids.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
    solids.push_back(
        Box({rng.Uniform(-spread_m, spread_m), rng.Uniform(-spread_m, spread_m), rng.Uniform(0, kPi)},
            {rng.Uniform(0.05, 2), rng.Uniform(0.05, 2)}, i % 2 ? "fabric" : "plaster"));
  return solids;
}

TEST(PingTest, WhatLiesBeyondItsRangeChangesNothing) {
  int heard = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const AcousticScene scene = SceneOf(Strewn(seed, 12, 60));
    for (int i = 0; i < kSonars; ++i) {
      const Pose2 sonar{0.2, -0.1, 2 * kPi * i / kSonars};
      const auto whole = Range(scene, sonar);
      EXPECT_EQ(whole, Range(scene.Around(sonar.translation(), kSonarMax_m), sonar)) << seed << " " << i;
      heard += whole ? 1 : 0;
    }
  }
  EXPECT_GT(heard, 400);
}

RC_GTEST_PROP(PingProperty, NoEchoIsNearerThanTheNearestSolid, ()) {
  std::vector<Solid> solids;
  const auto metres = [](int low, int high) { return *rc::gen::inRange(low, high) / 100.0; };
  for (int i = 0; i < 6; ++i)
    solids.push_back(Box({metres(-400, 400), metres(-400, 400), metres(-314, 314)},
                         {metres(5, 200), metres(5, 200)}, i % 2 ? "fabric" : "plaster"));
  double nearest = 1e9;
  for (const auto& solid : solids)
    nearest = std::min(nearest, Distance(OutlineOf(solid), Eigen::Vector2d(0, 0)));
  RC_PRE(nearest > 0.01);
  for (int i = 0; i < kSonars; ++i) {
    const auto range = Range(SceneOf(solids), {0, 0, 2 * kPi * i / kSonars});
    if (range) RC_ASSERT(*range > nearest - 1e-6);
    if (range) RC_ASSERT(*range <= kSonarMax_m);
  }
}

class SonarRingTest : public ::testing::Test {
 protected:
  static SonarRing Ring(const SonarConfig& config, AcousticScene scene, std::uint64_t seed = 1) {
    return {config, kFootprint, std::move(scene), Rng(seed)};
  }
  static void FireAll(SonarRing& dut, const Pose2& pose = {}) {
    for (int group = 0; group < dut.groups(); ++group) dut.Fire(group, pose);
  }
};

TEST_F(SonarRingTest, ReadsNoEchoBeforeTheFirstCycleAndInTheOpen) {
  SonarRing dut = Ring(Quiet(), SceneOf({}));
  for (const double range : dut.ranges_m()) EXPECT_EQ(range, kNoEcho);
  FireAll(dut);
  for (const double range : dut.ranges_m()) EXPECT_EQ(range, kNoEcho);
}

TEST_F(SonarRingTest, WallsAroundAreMeasuredFromTheSensorsOnTheOutline) {
  SonarRing dut = Ring(Quiet(), SceneOf({Box({2.1, 0, 0}, {0.2, 8}), Box({0, 1.6, 0}, {8, 0.2})}));
  FireAll(dut);
  EXPECT_NEAR(dut.ranges_m()[0], 2.0 - 0.475, 0.0051);  // S1 ahead
  EXPECT_NEAR(dut.ranges_m()[6], 1.5 - 0.39, 0.0051);   // S7 to the left
  EXPECT_EQ(dut.ranges_m()[12], kNoEcho);               // S13 behind
}

TEST_F(SonarRingTest, NearerThanTenCentimetresReadsTen) {
  SonarRing dut = Ring(Quiet(), SceneOf({Box({0.475 + 0.04 + 0.1, 0, 0}, {0.2, 8})}));
  FireAll(dut);
  EXPECT_EQ(dut.ranges_m()[0], 0.1);
}

TEST_F(SonarRingTest, OnlyTheGroupThatFiresMeasuresAnew) {
  SonarRing dut = Ring(Quiet(), SceneOf({Box({2.1, 0, 0}, {0.2, 8})}));
  FireAll(dut);
  const auto before = dut.ranges_m();
  dut.Fire(0, {0.5, 0, 0});
  EXPECT_NEAR(dut.ranges_m()[0], before[0] - 0.5, 0.0101);
  EXPECT_EQ(dut.ranges_m()[1], before[1]);
}

TEST_F(SonarRingTest, NoiseGrowsWithTheDistance) {
  SonarConfig config = Quiet();
  config.noise_m = 0.003;
  config.noise_per_m = 0.01;
  const auto spread = [&](double distance) {
    SonarRing dut = Ring(config, SceneOf({Box({distance + 0.575, 0, 0}, {0.2, 8})}));
    double sum = 0, squares = 0;
    const int n = 400;
    for (int i = 0; i < n; ++i) {
      dut.Fire(0, {});
      sum += dut.ranges_m()[0];
      squares += dut.ranges_m()[0] * dut.ranges_m()[0];
    }
    return std::sqrt(squares / n - sum * sum / n / n);
  };
  EXPECT_NEAR(spread(1.0), 0.013, 0.004);
  EXPECT_NEAR(spread(4.0), 0.043, 0.008);
}

TEST_F(SonarRingTest, CrossTalkOnlyShortensAndOnlyNowAndThen) {
  SonarConfig config = Quiet();
  // Far wall ahead, near wall to the left: S1 may overhear S7, which fires in the same group of three.
  const auto walls = [] { return SceneOf({Box({4.1, 0, 0}, {0.2, 8}), Box({0, 0.8, 0}, {8, 0.2})}); };
  SonarRing quiet = Ring(config, walls());
  FireAll(quiet);
  config.crosstalk = 0.1;
  SonarRing dut = Ring(config, walls());
  int shortened = 0;
  for (int i = 0; i < 500; ++i) {
    dut.Fire(0, {});
    EXPECT_LE(dut.ranges_m()[0], quiet.ranges_m()[0]);
    shortened += dut.ranges_m()[0] < quiet.ranges_m()[0] - 0.1;
  }
  EXPECT_GT(shortened, 2);
  EXPECT_LT(shortened, 60);
}

TEST_F(SonarRingTest, TheSeedDecides) {
  const auto readings = [](std::uint64_t seed) {
    SonarRing dut = Ring(SonarConfig{}, SceneOf({Box({3.1, 0, 0}, {0.2, 8})}), seed);
    std::vector<double> all;
    for (int i = 0; i < 20; ++i) {
      dut.Fire(0, {});
      all.push_back(dut.ranges_m()[0]);
    }
    return all;
  };
  EXPECT_EQ(readings(3), readings(3));
  EXPECT_NE(readings(3), readings(4));
}

TEST(SonarConfigTest, GroupsMustDivideTheRing) {
  EXPECT_THROW(ParseConfig<SonarConfig>("test.toml", "groups = 5"), ConfigError);
}

TEST_F(SonarRingTest, ADeadOneIsSilentADeafOneHearsOnlyWhatIsLoudAStuckOneRepeatsItself) {
  SonarRing dut = Ring(Quiet(), SceneOf({Box({3.1, 0, 0}, {0.2, 8})}));
  FireAll(dut);
  const double sound = dut.ranges_m()[0];
  ASSERT_GT(sound, 2);
  dut.Break({1, "stuck", 0, 30});
  for (int group = 0; group < dut.groups(); ++group) dut.Fire(group, {1, 0, 0});
  EXPECT_EQ(dut.ranges_m()[0], sound);
  SonarRing dead = Ring(Quiet(), SceneOf({Box({3.1, 0, 0}, {0.2, 8})}));
  dead.Break({1, "dead", 0, 30});
  FireAll(dead);
  EXPECT_EQ(dead.ranges_m()[0], kNoEcho);
  SonarRing deaf = Ring(Quiet(), SceneOf({Box({3.1, 0, 0}, {0.2, 8})}));
  deaf.Break({1, "deaf", 0, 40});
  FireAll(deaf);
  EXPECT_EQ(deaf.ranges_m()[0], kNoEcho) << "a wall at 2.6 m is 14 dB below one at 1 m";
  deaf.Fire(0, {2, 0, 0});
  EXPECT_NEAR(deaf.ranges_m()[0], sound - 2, 0.02) << "near things are loud";
}

TEST_F(SonarRingTest, ASolidThatMovesIsHeardWhereItIs) {
  SonarRing dut = Ring(Quiet(), SceneOf({Box({3.1, 0, 0}, {0.2, 8})}));
  FireAll(dut);
  const double before = dut.ranges_m()[0];
  dut.Move({0, {2.1, 0, 0}});
  FireAll(dut);
  EXPECT_NEAR(dut.ranges_m()[0], before - 1, 0.011);
}

}  // namespace
}  // namespace priamos::world
