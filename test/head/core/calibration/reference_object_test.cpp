#include "head/core/calibration/reference_object.hpp"

#include <gmock/gmock.h>

#include "common/geometry.hpp"

namespace priamos::head {
namespace {

using testing::HasSubstr;

std::string Disc(double x) {
  return "[[disc]]\ncentre_m = [" + std::to_string(x) + ", 0, 0.1]\nnormal = [2, 0, 0]\nradius_m = 0.01\n";
}

std::string Message(const std::string& text) {
  try {
    ParseConfig<ReferenceObject>("object.toml", text);
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "";
}

TEST(ReferenceObject, TheShippedOneHas16DiscsWithinItsBody) {
  const auto dut = LoadConfig<ReferenceObject>(PRIAMOS_SOURCE_DIR "/config/sim/reference_object.toml");
  EXPECT_EQ(dut.discs.size(), 16u);
  for (const ReferenceDisc& disc : dut.discs) {
    EXPECT_LE(std::abs(disc.centre_m.y()) + disc.radius_m, 0.25);
    EXPECT_LE(std::abs(disc.centre_m.z()) + disc.radius_m, 0.30);
    EXPECT_GE(disc.centre_m.x(), 0.0);
    EXPECT_LE(disc.centre_m.x(), 0.25);
  }
}

TEST(ReferenceObject, NormalsMayHaveAnyLength) {
  std::string text;
  for (int i = 0; i < 6; ++i) text += Disc(0.1 * i);
  const auto dut = ParseConfig<ReferenceObject>("object.toml", text);
  EXPECT_NEAR(dut.discs[3].normal.norm(), 1, 1e-12);
}

TEST(ReferenceObject, RefusesWhatCannotBeCalibratedWith) {
  std::string five, twins;
  for (int i = 0; i < 5; ++i) five += Disc(0.1 * i);
  EXPECT_THAT(Message(five), HasSubstr("at least 6 discs"));
  twins = five + Disc(0.4);
  EXPECT_THAT(Message(twins), HasSubstr("different places"));
  EXPECT_THAT(Message(five + "[[disc]]\nnormal = [0, 0, 0]\n"), HasSubstr("not zero"));
}

TEST(ReferenceObject, MovesCentresAndNormals) {
  ReferenceObject object;
  object.discs.push_back({{1, 0, 0}, {1, 0, 0}, 0.02});
  const Eigen::Isometry3d turned =
      Eigen::Translation3d(0, 0, 1) * Eigen::AngleAxisd(kPi / 2, Eigen::Vector3d::UnitZ());
  const ReferenceObject dut = object.Moved(turned);
  EXPECT_LT((dut.discs[0].centre_m - Eigen::Vector3d(0, 1, 1)).norm(), 1e-12);
  EXPECT_LT((dut.discs[0].normal - Eigen::Vector3d(0, 1, 0)).norm(), 1e-12);
}

}  // namespace
}  // namespace priamos::head
