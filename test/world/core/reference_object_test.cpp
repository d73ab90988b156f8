#include "world/core/reference_object.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

namespace priamos::world {
namespace {

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

TEST(ReferenceObject, NormalsAreMadeUnitAndZeroIsRefused) {
  const auto dut = ParseConfig<ReferenceObject>("x.toml", "[[disc]]\nnormal = [0.5, 0.0, 0.0]\n");
  EXPECT_DOUBLE_EQ(dut.discs.at(0).normal.x(), 1);
  EXPECT_THROW(ParseConfig<ReferenceObject>("x.toml", "[[disc]]\nnormal = [0.0, 0.0, 0.0]\n"), ConfigError);
  EXPECT_THROW(ParseConfig<ReferenceObject>("x.toml", "[[disc]]\nradius_m = 0.0\n"), ConfigError);
}

}  // namespace
}  // namespace priamos::world
