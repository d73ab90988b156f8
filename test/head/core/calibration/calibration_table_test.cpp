#include "head/core/calibration/calibration_table.hpp"

#include <gmock/gmock.h>

#include "test/support/calibration_scene.hpp"

namespace priamos::head {
namespace {

using testing::HasSubstr;

std::vector<CalibratedSetup> SomeSetups() {
  std::vector<CalibratedSetup> setups;
  Rng rng(1);
  for (int i = 0; i < 3; ++i) {
    CalibratedSetup setup;
    setup.setting = {0.1 * i, -0.05, {-0.02, 0.02}, {650 + i, 651}, {1600, 1601}};
    for (CameraModel& camera : setup.cameras) camera = support::MakeCamera(support::RandomView(rng));
    setups.push_back(setup);
  }
  return setups;
}

std::string Replaced(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

TEST(CalibrationTable, ReadsBackWhatItWrote) {
  const auto setups = SomeSetups();
  const auto dut = FromYaml(ToYaml(setups));
  ASSERT_TRUE(dut) << dut.reason();
  ASSERT_EQ(dut->size(), setups.size());
  for (std::size_t i = 0; i < setups.size(); ++i) {
    EXPECT_TRUE(IsSameSetting((*dut)[i].setting, setups[i].setting, 1e-12));
    for (int c = 0; c < 2; ++c) {
      const CameraModel &read = (*dut)[i].cameras[c], &written = setups[i].cameras[c];
      EXPECT_LT((read.image_from_base - written.image_from_base).norm(), 1e-9);
      EXPECT_LT((read.centre_px - written.centre_px).norm(), 1e-9);
      EXPECT_NEAR(read.k1, written.k1, 1e-15);
      EXPECT_NEAR(read.scale_px, written.scale_px, 1e-9);
    }
  }
}

TEST(CalibrationTable, EveryTruncationIsRefused) {
  const std::string yaml = ToYaml(SomeSetups());
  for (std::size_t n = 0; n + 2 < yaml.size(); n += 37) {
    EXPECT_FALSE(FromYaml(yaml.substr(0, n))) << "cut after " << n << " bytes";
  }
}

TEST(CalibrationTable, DamageIsNamed) {
  const std::string yaml = ToYaml(SomeSetups());
  EXPECT_THAT(FromYaml(Replaced(yaml, "pan_rad", "pan")).reason(), HasSubstr("'pan_rad' is missing"));
  EXPECT_THAT(FromYaml(Replaced(yaml, "priamos-calibration-1", "other-2")).reason(), HasSubstr("other-2"));
  EXPECT_THAT(FromYaml(Replaced(yaml, "tilt_rad:", "tilt_rad: .nan #")).reason(), HasSubstr("tilt_rad"));
  EXPECT_THAT(FromYaml("").reason(), testing::Not(testing::IsEmpty()));
  EXPECT_THAT(FromYaml("not yaml at all {{{").reason(), testing::Not(testing::IsEmpty()));
}

TEST(CalibrationTable, RandomDamageNeverThrows) {
  const std::string yaml = ToYaml(SomeSetups());
  Rng rng(5);
  for (int i = 0; i < 300; ++i) {
    std::string damaged = yaml;
    for (int k = 0; k < 3; ++k) damaged[rng.Below(damaged.size())] = static_cast<char>(rng.Below(256));
    EXPECT_NO_THROW(FromYaml(damaged));
  }
}

TEST(CalibrationTable, AMatrixThatIsNoCameraIsRefused) {
  auto setups = SomeSetups();
  setups[1].cameras[0].image_from_base.row(2) *= 5;
  EXPECT_THAT(FromYaml(ToYaml(setups)).reason(), HasSubstr("setup 1"));
}

}  // namespace
}  // namespace priamos::head
