#include "common/reference_object.hpp"

#include <gmock/gmock.h>

#include <Eigen/Dense>

#include "common/config.hpp"
#include "common/geometry.hpp"

namespace priamos {
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

ReferenceObject Shipped() {
  return LoadConfig<ReferenceObject>(PRIAMOS_SOURCE_DIR "/config/sim/reference_object.toml");
}

TEST(ReferenceObject, TheShippedOneHasSixteenDiscsInSpace) {
  const ReferenceObject dut = Shipped();
  ASSERT_EQ(dut.discs.size(), 16U);
  Eigen::MatrixXd centres(16, 3);
  for (int i = 0; i < 16; ++i) centres.row(i) = dut.discs[i].centre_m.transpose();
  centres.rowwise() -= centres.colwise().mean().eval();
  const Eigen::VectorXd spread = Eigen::JacobiSVD<Eigen::MatrixXd>(centres).singularValues();
  EXPECT_GT(spread(2), 0.1) << "coplanar points calibrate nothing";
}

TEST(ReferenceObject, EveryDiscLiesOnABlock) {
  const ReferenceObject dut = Shipped();
  for (const ReferenceDisc& disc : dut.discs) {
    bool carried = false;
    for (const ReferenceBlock& block : dut.blocks) {
      const Eigen::Vector3d d = (disc.centre_m - block.centre_m).cwiseAbs();
      const bool on_front = std::abs(disc.centre_m.x() - block.centre_m.x() - block.size_m.x() / 2) < 1e-9;
      carried |= on_front && d.y() + disc.radius_m <= block.size_m.y() / 2 + 1e-9 &&
                 d.z() + disc.radius_m <= block.size_m.z() / 2 + 1e-9;
    }
    EXPECT_TRUE(carried) << disc.centre_m.transpose();
  }
}

TEST(ReferenceObject, TheShippedDiscsAreWithinTheirBody) {
  const ReferenceObject dut = Shipped();
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
}  // namespace priamos
