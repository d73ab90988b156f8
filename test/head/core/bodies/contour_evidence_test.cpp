#include "head/core/bodies/contour_evidence.hpp"

#include <gtest/gtest.h>

#include "head/core/bodies/contour_pieces.hpp"
#include "test/head/core/bodies/blurred_cupboard.hpp"

namespace priamos::head {
namespace {

class ContourEvidenceTest : public test::BlurredCupboard {
 protected:
  LandmarkModel SeenAt(const Eigen::Isometry3d& pose) const {
    return VisibleSkeleton(cupboard_.body, pose.inverse() * OpticalCentre(camera_));
  }
  ContourEvidence At(const Eigen::Isometry3d& pose) const {
    return EvidenceOf(SeenAt(pose), pose, {&view_, 1}, meters_);
  }
};

TEST_F(ContourEvidenceTest, TheContourIsSeenAtTheTruthThoughNoEdgeWasLinked) {
  const ContourEvidence dut = At(truth_);
  EXPECT_GT(dut.seen, 0.85);
  EXPECT_LT(dut.rms_px, 0.6);
  EXPECT_GE(dut.n_seen, dut.n_edges - 1);
  EXPECT_NEAR(dut.seen + dut.blank + dut.other, 1, 1e-9);
}

TEST_F(ContourEvidenceTest, BesideTheTruthLessIsSeenAndWhatIsThereIsSomethingElse) {
  const ContourEvidence dut = At(Eigen::Translation3d(0, 0.03, 0.03) * truth_);
  EXPECT_LT(dut.seen, 0.3);
  EXPECT_GT(dut.other, 0.5);
}

TEST_F(ContourEvidenceTest, WhereNothingIsItIsBlank) {
  image_ = 60;
  const StepMeter blank(image_, 1, kBlur_px);
  const ContourEvidence dut = EvidenceOf(SeenAt(truth_), truth_, {&view_, 1}, {&blank, 1});
  EXPECT_EQ(dut.seen, 0);
  EXPECT_NEAR(dut.blank, 1, 1e-9);
  EXPECT_EQ(dut.n_seen, 0);
}

TEST_F(ContourEvidenceTest, MoreEdgesSeenAreWorthMore) {
  ContourEvidence few{.seen = 0.7, .n_seen = 6}, many = few;
  many.n_seen = 12;
  EXPECT_GT(many.Value(1), few.Value(1));
  EXPECT_GT(few.Value(1.1), few.Value(1));
  few.seen = 0.9;
  EXPECT_GT(few.Value(1), (ContourEvidence{.seen = 0.7, .n_seen = 6}.Value(1)));
}

TEST_F(ContourEvidenceTest, APoseFarFromTheBeliefNeedsMore) {
  const ContourEvidence evidence{.seen = 0.8, .rms_px = 0.3, .n_seen = 8, .n_edges = 9};
  const BodyAgreement linked{.covered = 0.8, .ends = 0.8};
  EXPECT_NEAR(evidence.LogOdds(linked, 0) - evidence.LogOdds(linked, 3), 4.5, 1e-9);
  EXPECT_GT(evidence.LogOdds(linked, 2), evidence.LogOdds({.covered = 0.6, .ends = 0.8}, 2));
}

TEST_F(ContourEvidenceTest, PiecesMakeALineWithItsBrightSideOnTheRight) {
  const ContourPieces pieces(SeenAt(truth_), truth_, view_);
  int n_lines = 0;
  for (std::size_t i = 0; i < pieces.edges().size(); ++i) {
    if (!pieces.edges()[i]) continue;
    EdgeImage dut;
    if (!AppendLine(pieces.Measure(meters_[0], i, 2), pieces.edges()[i]->length_px(), kBlur_px, dut))
      continue;
    ++n_lines;
    const EdgeSegment& line = dut.segments.at(0);
    EXPECT_EQ(line.n_points, static_cast<int>(dut.points.size()));
    EXPECT_GT(line.grey_right, line.grey_left);
    const Eigen::Vector2d at = line.centre + 6 * line.normal(), behind = line.centre - 6 * line.normal();
    EXPECT_GT(image_.at<unsigned char>(int(at.y()), int(at.x())),
              image_.at<unsigned char>(int(behind.y()), int(behind.x())));
  }
  EXPECT_GE(n_lines, 5);
}

}  // namespace
}  // namespace priamos::head
