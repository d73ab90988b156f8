#include "planner/core/graph/anchored_objects.hpp"

#include <gmock/gmock.h>

#include "test/planner/core/learned.hpp"

namespace priamos::planner {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

/// A robot that drove 5 m ahead. What it believed the whole time to be a straight line was one.
struct Drive {
  Drive() {
    for (int i = 0; i <= 10; ++i) graph.NoteAt({0.5 * i, 0, 0}, i);
  }
  FloorGraph graph{FloorGraphConfig{}};
};

TEST(AnchoredObjects, AThingLiesWhereItWasTold) {
  Drive drive;
  AnchoredObjects dut;
  EXPECT_TRUE(dut.Take({BoxAt(6, 1, 90)}, drive.graph));
  ASSERT_THAT(dut.At(drive.graph), SizeIs(1));
  EXPECT_NEAR(dut.At(drive.graph)[0].x_m, 6, 1e-6);
  EXPECT_NEAR(dut.At(drive.graph)[0].yaw_deg, 90, 1e-6);
  EXPECT_FALSE(dut.Take({BoxAt(6, 1, 90)}, drive.graph)) << "told again";
}

TEST(AnchoredObjects, WhatIsToldElsewhereMovesAndWhatIsForgottenGoes) {
  Drive drive;
  AnchoredObjects dut;
  dut.Take({BoxAt(6, 1, 90)}, drive.graph);
  EXPECT_TRUE(dut.Take({BoxAt(6.2, 1, 90)}, drive.graph));
  EXPECT_NEAR(dut.At(drive.graph)[0].x_m, 6.2, 1e-6);
  EXPECT_TRUE(dut.Take({}, drive.graph));
  EXPECT_THAT(dut.At(drive.graph), IsEmpty());
}

}  // namespace
}  // namespace priamos::planner
