#include "robot/core/sonar/near_map.hpp"

#include <gmock/gmock.h>

namespace priamos::robot {
namespace {

using std::chrono::milliseconds;
using testing::IsEmpty;
using testing::SizeIs;

constexpr Time kStart = FromUtime(1'000'000'000);
constexpr milliseconds kTick{20};

class NearMapTest : public testing::Test {
 protected:
  NearMap dut_{NearMapConfig{}};
};

TEST_F(NearMapTest, KeepsAThingWhereItIsWhileTheBaseMoves) {
  dut_.Add({0.475, 0, 0}, 0.3);
  const auto points = dut_.Points({0.2, 0, kPi / 2});
  ASSERT_THAT(points, SizeIs(1));
  EXPECT_NEAR(points[0].x(), 0, 1e-9);
  EXPECT_NEAR(points[0].y(), -0.575, 1e-9);
}

TEST_F(NearMapTest, KeepsNothingThatIsFarAway) {
  dut_.Add({0.475, 0, 0}, 0.8);
  EXPECT_THAT(dut_.Points({}), IsEmpty());
}

TEST_F(NearMapTest, TheSamePlaceIsKeptOnce) {
  for (int i = 0; i < 10; ++i) dut_.Add({0.475, 0, 0}, 0.3 + 0.0005 * i);
  EXPECT_THAT(dut_.Points({}), SizeIs(1));
}

TEST_F(NearMapTest, ABeamThatSeesOnBehindAThingClearsIt) {
  dut_.Add({0.475, 0, 0}, 0.3);
  dut_.Clear({0.475, 0, 0}, 0.4);
  EXPECT_THAT(dut_.Points({}), SizeIs(1)) << "that may be the thing itself";
  dut_.Clear({0.475, 0.2, 0}, 2.0);
  EXPECT_THAT(dut_.Points({}), SizeIs(1)) << "that beam passes beside it";
  dut_.Clear({0.475, 0, 0}, 2.0);
  EXPECT_THAT(dut_.Points({}), IsEmpty());
}

TEST_F(NearMapTest, ForgetsWhatIsOldOrFarAway) {
  Time now = kStart;
  double x = 0;
  const auto drive = [&](double seconds) {
    for (const Time end = now + FromSeconds(seconds); now < end;)
      dut_.Forget({x += 0.002, 0, 0}, now += kTick);
  };
  dut_.Forget({}, now);
  dut_.Add({0.475, 0, 0}, 0.3);
  drive(4.9);
  EXPECT_THAT(dut_.Points({}), SizeIs(1));
  drive(0.2);
  EXPECT_THAT(dut_.Points({}), IsEmpty());
  dut_.Add({0.475, 0, 0}, 0.3);
  dut_.Forget({-2, 0, 0}, now);
  EXPECT_THAT(dut_.Points({}), IsEmpty());
}

/// It parks beside a post that no beam sees, and drives off half a minute later.
TEST_F(NearMapTest, KeepsAThingLongerWhileTheBaseStands) {
  Time now = kStart;
  dut_.Forget({}, now);
  dut_.Add({0.475, 0, 0}, 0.3);
  const auto stand = [&](double seconds) {
    for (const Time end = now + FromSeconds(seconds); now < end;) dut_.Forget({}, now += kTick);
  };
  stand(29);
  EXPECT_THAT(dut_.Points({}), SizeIs(1));
  stand(2);
  EXPECT_THAT(dut_.Points({}), IsEmpty()) << "or a person who went away would block it for ever";
}

TEST_F(NearMapTest, ABaseThatWaitsForItsWayToBecomeFreeForgetsAsBefore) {
  dut_.Forget({}, kStart);
  dut_.Add({0.475, 0, 0}, 0.3);
  dut_.Forget({}, kStart + milliseconds(5100), true);
  EXPECT_THAT(dut_.Points({}), IsEmpty());
}

}  // namespace
}  // namespace priamos::robot
