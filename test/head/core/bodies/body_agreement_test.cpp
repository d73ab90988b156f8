#include "head/core/bodies/body_agreement.hpp"

#include <gtest/gtest.h>

namespace priamos::head {
namespace {

/// A match that covers `covered` of 100 px and ends `gap_px` before both ends of the model's edge.
EdgeMatch Match(double covered, double gap_px) {
  EdgeMatch match;
  match.covered = covered;
  match.predicted_px = 100;
  match.gap_px = {gap_px, gap_px};
  match.is_end_in_view = {true, true};
  return match;
}

/// Four edges are predicted.
Association Of(std::vector<EdgeMatch> matches) {
  Association association;
  association.matches = std::move(matches);
  association.side_predicted_px = {160, 0, 0, 0};
  return association;
}

TEST(BodyAgreementTest, ABodyThatIsFoundAsAWholeAgreesInAll) {
  const auto dut = AgreementOf(Of({Match(1, 0), Match(1, 2), Match(1, -3), Match(1, 0)}), 0);
  EXPECT_DOUBLE_EQ(dut.covered, 1);
  EXPECT_DOUBLE_EQ(dut.ends, 1);
}

TEST(BodyAgreementTest, WhatIsNotFoundCounts) {
  const auto dut = AgreementOf(Of({Match(1, 0), Match(0.5, 30)}), 0);
  EXPECT_DOUBLE_EQ(dut.covered, 1.5 / 4);
  EXPECT_DOUBLE_EQ(dut.ends, 0.5);
}

TEST(BodyAgreementTest, EndsOutOfViewAreNotAsked) {
  EdgeMatch cut = Match(1, 50);
  cut.is_end_in_view = {false, true};
  EXPECT_DOUBLE_EQ(AgreementOf(Of({cut, Match(1, 0)}), 0).ends, 2.0 / 3);
}

TEST(BodyAgreementTest, EndsOfABlurredImageAreFoundLessWell) {
  EXPECT_DOUBLE_EQ(AgreementOf(Of({Match(1, 8)}), 0).ends, 0);
  EXPECT_DOUBLE_EQ(AgreementOf(Of({Match(1, 8)}), 3).ends, 1);
}

TEST(BodyAgreementTest, ItIsWorthMoreTheBetterTheEdgesFit) {
  const BodyAgreement dut{.covered = 0.7, .ends = 0.8};
  EXPECT_GT(dut.Value(0.1), dut.Value(1));
  EXPECT_GT(dut.Value(1), dut.Value(4));
  EXPECT_DOUBLE_EQ(dut.Value(0), dut.Value(1e-3)) << "no more than exact";
}

TEST(BodyAgreementTest, NothingAgreesWithNothing) {
  const auto dut = AgreementOf({}, 0);
  EXPECT_DOUBLE_EQ(dut.covered, 0);
  EXPECT_DOUBLE_EQ(dut.ends, 0);
}

}  // namespace
}  // namespace priamos::head
