#include "common/principal_axes.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace priamos {
namespace {

double Real(double low, double high) {
  return low + (high - low) * *rc::gen::inRange(0, 1000001) / 1e6;
}

template <int N>
void RestoresTheMatrix() {
  Eigen::Matrix<double, N, N> m;
  for (double& v : m.reshaped()) v = Real(-1, 1);
  m = (m + m.transpose()).eval();
  const PrincipalAxes<N> dut = PrincipalAxesOf(m);
  RC_ASSERT((dut.axes * dut.values.asDiagonal() * dut.axes.transpose() - m).norm() < 1e-12);
  RC_ASSERT((dut.axes.transpose() * dut.axes - m.Identity()).norm() < 1e-12);
  for (int i = 1; i < N; ++i) RC_ASSERT(dut.values[i - 1] <= dut.values[i]);
}

RC_GTEST_PROP(PrincipalAxes, TurnADiagonalIntoTheMatrix, ()) {
  RestoresTheMatrix<2>();
  RestoresTheMatrix<3>();
  RestoresTheMatrix<6>();
}

TEST(PrincipalAxes, OfAnEllipse) {
  const PrincipalAxes<2> dut = PrincipalAxesOf<2>(Eigen::Matrix2d{{2, 1}, {1, 2}});
  EXPECT_NEAR(dut.values[0], 1, 1e-15);
  EXPECT_NEAR(dut.values[1], 3, 1e-15);
  EXPECT_NEAR(dut.axes(0, 1), dut.axes(1, 1), 1e-15);
}

}  // namespace
}  // namespace priamos
