#include "head/core/calibration/rig/calibration_table.hpp"

#include <gmock/gmock.h>

#include "common/random.hpp"

namespace priamos::head {
namespace {

using testing::HasSubstr;

LensTable SomeLens(Rng& rng) {
  std::vector<LensState> nodes;
  for (int i = 0; i < 6; ++i) {
    nodes.push_back({rng.Uniform(800, 1600),
                     {rng.Uniform(370, 390), rng.Uniform(280, 295)},
                     rng.Normal(0.05),
                     rng.Normal(0.01),
                     rng.Uniform(0.01, 0.03)});
  }
  return LensTable({0, 650, 1300}, {1200, 1600}, nodes);
}

HeadModel SomeHead() {
  Rng rng(1);
  HeadModel model;
  model.geometry.pitch_rad = 0.0123456789012345;
  model.geometry.cameras[kRight].axis_roll_rad = -0.004;
  model.lenses[kLeft] = SomeLens(rng);
  model.lenses[kRight] = SomeLens(rng);
  model.lenses[kThird] = LensTable({0}, {0}, {LensState{}});
  model.base_covariance = PlacementCovariance({1.75, 0.1, 1.2}, 0.0005, 0.001);
  return model;
}

HeadSetting Between() {
  return {0.2, -0.1, {-0.02, 0.03}, {433, 501}, {1333, 1402}};
}

std::string Replaced(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

TEST(CalibrationTable, ReadsBackWhatItWrote) {
  const HeadModel written = SomeHead();
  const auto dut = FromYaml(ToYaml(written));
  ASSERT_TRUE(dut) << dut.reason();
  EXPECT_EQ(dut->base_covariance, written.base_covariance);
  for (int c = 0; c < kCameras; ++c) {
    const auto a = dut->CameraAt(Between(), c), b = written.CameraAt(Between(), c);
    ASSERT_TRUE(a) << a.reason();
    EXPECT_EQ(a->image_from_base, b->image_from_base);
    EXPECT_EQ(a->k1, b->k1);
    EXPECT_EQ(a->k2, b->k2);
  }
}

TEST(CalibrationTable, ACameraThatWasNotCalibratedStaysSo) {
  HeadModel written = SomeHead();
  written.lenses[kThird] = LensTable();
  const auto dut = FromYaml(ToYaml(written));
  ASSERT_TRUE(dut) << dut.reason();
  EXPECT_FALSE(dut->CameraAt(Between(), kThird));
}

TEST(CalibrationTable, KeepsTheLasersInTheirOrder) {
  HeadModel written = SomeHead();
  EXPECT_TRUE(FromYaml(ToYaml(written))->lasers.empty());
  written.lasers = {{{0.6, 0, 0.8}, -0.123456789, {1, 2, 3}, 0.0004, 0.0002},
                    {{0.8, 0, 0.6}, -2.5, {3, 2, 1}, 0.0003, 0.0001}};
  const auto dut = FromYaml(ToYaml(written));
  ASSERT_TRUE(dut) << dut.reason();
  ASSERT_EQ(dut->lasers.size(), 2U);
  for (int k = 0; k < 2; ++k) {
    EXPECT_EQ(dut->lasers[k].normal, written.lasers[k].normal);
    EXPECT_EQ(dut->lasers[k].offset_m, written.lasers[k].offset_m);
    EXPECT_EQ(dut->lasers[k].pivot_m, written.lasers[k].pivot_m);
    EXPECT_EQ(dut->lasers[k].sigma_turn_rad, written.lasers[k].sigma_turn_rad);
    EXPECT_EQ(dut->lasers[k].sigma_shift_m, written.lasers[k].sigma_shift_m);
  }
  EXPECT_THAT(FromYaml(Replaced(ToYaml(written), "pivot_m:", "pivot:")).reason(), HasSubstr("'pivot_m'"));
  written.lasers[1].normal *= 2;
  EXPECT_THAT(FromYaml(ToYaml(written)).reason(), HasSubstr("'normal' is not of length 1"));
  written.lasers.assign(5, written.lasers[0]);
  EXPECT_THAT(FromYaml(ToYaml(written)).reason(), HasSubstr("'lasers' is not a list of 1 to 4"));
}

/// Light that meets the floor behind the base, beyond the camera's reach or nowhere is that of no laser here.
TEST(CalibrationTable, LasersWhoseLightMeetsNoFloorAheadAreRefused) {
  HeadModel written = SomeHead();
  const auto reason = [&](const Eigen::Vector3d& normal, double offset_m) {
    written.lasers = {{normal, offset_m, {1, 2, 3}, 0.0004, 0.0002}};
    return FromYaml(ToYaml(written)).reason();
  };
  EXPECT_EQ(reason({0.6, 0, 0.8}, -1.2), "");
  EXPECT_THAT(reason({0.6, 0, 0.8}, 1.2), HasSubstr("meets the floor -2.00 m ahead"));
  EXPECT_THAT(reason({0.6, 0, 0.8}, -6), HasSubstr("expected 0.2 to 8 m; calibrate it anew"));
  EXPECT_THAT(reason({0, 0.6, 0.8}, -1.2), HasSubstr("laser: its light meets the floor inf m ahead"));
  EXPECT_THAT(reason({0, 0, 1}, 0), HasSubstr("laser: its light meets the floor"));
}

/// As tables were when there was only one.
TEST(CalibrationTable, ATableWithASingleLaserIsRead) {
  const std::string yaml =
      Replaced(ToYaml(SomeHead()), "base_covariance:",
               "laser:\n   normal: [ 0.6, 0., 0.8 ]\n   offset_m: -0.5\n   pivot_m: [ 1., 2., 3. ]\n"
               "   sigma_turn_rad: 0.0004\n   sigma_shift_m: 0.0002\nbase_covariance:");
  const auto dut = FromYaml(yaml);
  ASSERT_TRUE(dut) << dut.reason();
  ASSERT_EQ(dut->lasers.size(), 1U);
  EXPECT_EQ(dut->lasers[0].offset_m, -0.5);
}

TEST(CalibrationTable, EveryTruncationIsRefused) {
  HeadModel model = SomeHead();
  model.lasers = {LaserPlane{{0.6, 0, 0.8}, -1.2}, LaserPlane{{0.8, 0, 0.6}, -2.4}};
  const std::string yaml = ToYaml(model);
  for (std::size_t n = 0; n + 2 < yaml.size(); n += 37)
    EXPECT_FALSE(FromYaml(yaml.substr(0, n))) << "cut after " << n << " bytes";
}

TEST(CalibrationTable, DamageIsNamed) {
  const std::string yaml = ToYaml(SomeHead());
  EXPECT_THAT(FromYaml(Replaced(yaml, "pitch_rad", "pitch")).reason(), HasSubstr("'pitch_rad' is missing"));
  EXPECT_THAT(FromYaml(Replaced(yaml, "priamos-calibration-2", "other-2")).reason(), HasSubstr("other-2"));
  EXPECT_THAT(FromYaml(Replaced(yaml, "side_m:", "side_m: .nan #")).reason(), HasSubstr("side_m"));
  EXPECT_THAT(FromYaml(Replaced(yaml, "[ 0, 650, 1300 ]", "[ 0, 650, 650 ]")).reason(),
              HasSubstr("ascending"));
  EXPECT_THAT(FromYaml(Replaced(yaml, "[ 0, 650, 1300 ]", "[ 0, 650 ]")).reason(), HasSubstr("2 by 2"));
  EXPECT_THAT(FromYaml(Replaced(yaml, "focal_px:", "focal_px:-")).reason(), HasSubstr("left camera"));
  EXPECT_THAT(FromYaml("").reason(), testing::Not(testing::IsEmpty()));
  EXPECT_THAT(FromYaml("not yaml at all {{{").reason(), testing::Not(testing::IsEmpty()));
}

TEST(CalibrationTable, RandomDamageNeverThrows) {
  HeadModel model = SomeHead();
  model.lasers = {LaserPlane{{0.6, 0, 0.8}, -1.2}, LaserPlane{{0.8, 0, 0.6}, -2.4}};
  const std::string yaml = ToYaml(model);
  Rng rng(5);
  for (int i = 0; i < 300; ++i) {
    std::string damaged = yaml;
    for (int k = 0; k < 3; ++k) damaged[rng.Below(damaged.size())] = static_cast<char>(rng.Below(256));
    EXPECT_NO_THROW(FromYaml(damaged));
  }
}

TEST(CalibrationTable, ACovarianceThatIsNoneIsRefused) {
  HeadModel model = SomeHead();
  model.base_covariance(0, 0) = -1;
  EXPECT_THAT(FromYaml(ToYaml(model)).reason(), HasSubstr("no covariance"));
}

}  // namespace
}  // namespace priamos::head
