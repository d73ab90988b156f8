#include "robot/core/sonar/approach_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "test/robot/support/legs.hpp"
#include "test/robot/support/simulated_sonars.hpp"

namespace priamos::robot {
namespace {

constexpr double kWithin_s = 1.5, kBase_m_s = 0.3;

/// A watch on a base that drives straight ahead at `speed_m_s`.
class Rig {
 public:
  explicit Rig(std::uint64_t seed, double speed_m_s = kBase_m_s) : sonars_(seed, {}), speed_m_s_(speed_m_s) {}

  Pose2 base() const { return {speed_m_s_ * t_s_, 0, 0}; }
  double t_s() const { return t_s_; }
  /// The next cycle, 0.1 s later, among these surfaces. Whether something will meet the base.
  bool Hears(const std::vector<Surface>& surfaces) {
    t_s_ += 0.1;
    sonars_.Clear();
    sonars_.Add(surfaces);
    dut_.Add(sonars_.Listen(FromUtime(1'000'000'000) + FromSeconds(t_s_), base()), base());
    return dut_.Meets({speed_m_s_, 0}, kWithin_s);
  }
  bool MayTouch() const { return dut_.MayTouch(); }
  double Gap() const { return sonars_.Gap(base()); }

 private:
  ApproachWatch dut_{ApproachConfig{}, Footprint{}};
  SimulatedSonars sonars_;
  double speed_m_s_, t_s_ = 0;
};

TEST(ApproachWatch, WhoComesFromTheSideIsNoticedHalfAMetreBefore) {
  for (const double speed_m_s : {0.4, 0.6, 0.9, 1.2})
    for (const double slant_deg : {-30.0, 0.0, 30.0}) {
      // Who goes along with the base comes hardly nearer by a beam that looks ahead of him.
      if (speed_m_s < 0.5 && slant_deg < 0) continue;
      for (const double side : {-1.0, 1.0}) {
        Rig rig(1);
        const Eigen::Vector2d velocity =
            speed_m_s * Eigen::Vector2d(-std::sin(Radians(slant_deg)), -side * std::cos(Radians(slant_deg)));
        // After 6 s he would be before the front corner.
        const Eigen::Vector2d meets(6 * kBase_m_s + 0.4, side * 0.4);
        double noticed_m = 0;
        while (rig.t_s() < 5.9 && noticed_m == 0)
          if (rig.Hears(RoundLegs(meets + (rig.t_s() + 0.1 - 6) * velocity))) noticed_m = rig.Gap();
        EXPECT_GT(noticed_m, 0.3) << speed_m_s << " m/s, " << slant_deg << " degrees, side " << side;
      }
    }
}

TEST(ApproachWatch, ThingsThatStandDoNotClose) {
  std::vector<Surface> things;
  const auto add = [&](const std::vector<Surface>& more) {
    things.insert(things.end(), more.begin(), more.end());
  };
  add(BoxSides(1.5, 0.6, 2.0, 1.2));
  add(BoxSides(2.6, -1.1, 2.7, -1.0));
  add(BoxSides(4.0, -1.4, 4.6, -0.7));
  add({{{3, 1.9}, {6, 0.7}}, {{5, -1.6}, {8, -0.6}}});
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Rig rig(seed);
    int noticed = 0;
    while (rig.base().x < 6) noticed += rig.Hears(things);
    EXPECT_EQ(noticed, 0) << seed;
  }
}

TEST(ApproachWatch, WhoStandsCloseIsWaitedForButNotForEver) {
  Rig rig(1, 0);
  const auto distance_m = [&] { return std::max(0.62, 2.4 - 0.6 * rig.t_s()); };
  while (rig.t_s() < 3.2) rig.Hears(RoundLegs({0, distance_m()}));
  EXPECT_TRUE(rig.Hears(RoundLegs({0, distance_m()})));
  EXPECT_TRUE(rig.MayTouch()) << "16 cm before the base his trunk may reach it";
  while (rig.t_s() < 9) rig.Hears(RoundLegs({0, 0.62}));
  EXPECT_FALSE(rig.Hears(RoundLegs({0, 0.62})));
  EXPECT_FALSE(rig.MayTouch());
}

TEST(ApproachWatch, WhoHasGoneIsForgotten) {
  Rig rig(1, 0);
  while (rig.t_s() < 2) rig.Hears(RoundLegs({0, 2.4 - 0.6 * rig.t_s()}));
  EXPECT_TRUE(rig.Hears(RoundLegs({0, 1.2})));
  for (int i = 0; i < 6; ++i) rig.Hears({});
  EXPECT_FALSE(rig.Hears({}));
}

}  // namespace
}  // namespace priamos::robot
