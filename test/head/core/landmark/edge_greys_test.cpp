#include "head/core/landmark/edge_greys.hpp"

#include <gtest/gtest.h>

namespace priamos::head {
namespace {

EdgeMatch Match(int edge, int camera, double ratio, double length_px = 100) {
  EdgeMatch match;
  match.edge = edge;
  match.camera = camera;
  match.covered = 1;
  match.predicted_px = length_px;
  match.grey_ratio = ratio;
  return match;
}

class EdgeGreysTest : public testing::Test {
 protected:
  EdgeGreysTest() { model_.edges.resize(2); }

  void Look(std::vector<EdgeMatch> matches) { dut_ = Learned(std::move(dut_), model_, matches); }

  LandmarkModel model_;
  EdgeGreys dut_;
};

TEST_F(EdgeGreysTest, OneLookTellsTheMeanOfItsCamerasAndIsNotSure) {
  Look({Match(0, 0, 0.4, 300), Match(0, 1, 0.6, 100)});
  ASSERT_TRUE(dut_[0]);
  EXPECT_NEAR(dut_[0]->ratio, 0.45, 1e-9);
  EXPECT_EQ(dut_[0]->sigma, EdgeGreyOptions().first_sigma);
  EXPECT_FALSE(dut_[1]) << "no camera saw it";
}

TEST_F(EdgeGreysTest, LooksThatAgreeMakeSureButNotSurerThanLooksCanBe) {
  Look({Match(0, 0, 0.5)});
  double before = dut_[0]->sigma;
  for (int i = 0; i < 3; ++i) {
    Look({Match(0, 0, 0.5)});
    EXPECT_LE(dut_[0]->sigma, before);
    before = dut_[0]->sigma;
  }
  for (int i = 0; i < 20; ++i) Look({Match(0, 0, 0.5)});
  EXPECT_EQ(dut_[0]->sigma, EdgeGreyOptions().least_sigma);
}

TEST_F(EdgeGreysTest, WhatChangesFromLookToLookIsFollowedAndLessSure) {
  for (const double ratio : {0.5, 0.5, 0.5, 0.5}) Look({Match(0, 0, ratio)});
  const EdgeGrey steady = *dut_[0];
  Look({Match(0, 0, 0.9)});
  EXPECT_NEAR(dut_[0]->ratio, 0.7, 1e-9);
  EXPECT_GT(dut_[0]->sigma, steady.sigma);
}

TEST_F(EdgeGreysTest, AContradictionIsBelievedInsteadOfWhatWasKnown) {
  for (int i = 0; i < 5; ++i) Look({Match(0, 0, 0.8)});
  Look({Match(0, 0, -0.8)});
  EXPECT_EQ(dut_[0]->ratio, -0.8);
  EXPECT_EQ(dut_[0]->sigma, EdgeGreyOptions().first_sigma);
}

TEST_F(EdgeGreysTest, CamerasThatSeeDifferentThingsBesideTheEdgeTellNothing) {
  Look({Match(0, 0, 0.8), Match(0, 1, -0.2)});
  EXPECT_FALSE(dut_[0]);
}

TEST_F(EdgeGreysTest, WhatIsNotSeenIsKept) {
  Look({Match(0, 0, 0.5)});
  Look({Match(1, 0, 0.2)});
  EXPECT_TRUE(dut_[0] && dut_[1]);
}

TEST_F(EdgeGreysTest, OfAPartThatMovesNothingIsKept) {
  model_.edges[1].side = 3;
  Look({Match(0, 0, 0.5), Match(1, 0, 0.5)});
  EXPECT_TRUE(dut_[0]);
  EXPECT_FALSE(dut_[1]);
}

TEST_F(EdgeGreysTest, AModelGetsWhatIsKnownAndKeepsTheRest) {
  model_.edges[0].grey_ratio = -1;
  model_.edges[1].grey_ratio = 0.3;
  Look({Match(0, 0, 0.5)});
  const LandmarkModel told = WithGreys(model_, dut_);
  EXPECT_EQ(told.edges[0].grey_ratio, 0.5);
  EXPECT_EQ(told.edges[0].grey_sigma, dut_[0]->sigma);
  EXPECT_EQ(told.edges[1].grey_ratio, 0.3);
  EXPECT_EQ(told.edges[1].grey_sigma, 0);
}

TEST_F(EdgeGreysTest, WhatIsKnownOfAnotherModelIsNotUsed) {
  Look({Match(0, 0, 0.5)});
  LandmarkModel other;
  other.edges.resize(3);
  EXPECT_FALSE(WithGreys(other, dut_).edges[0].grey_ratio);
  EXPECT_EQ(Learned(dut_, other, {}).size(), 3u);
  EXPECT_FALSE(Learned(dut_, other, {})[0]);
}

}  // namespace
}  // namespace priamos::head
