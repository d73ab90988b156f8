#include "head/core/landmark/landmark_fix.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "head/core/edges/edge_segments.hpp"
#include "test/support/quad_scene.hpp"

namespace priamos::head {
namespace {

const Eigen::Matrix3d kTwentyCentimetresFiveDegrees =
    Eigen::Vector3d(0.115 * 0.115, 0.115 * 0.115, 0.05 * 0.05).asDiagonal();

class LandmarkFixTest : public testing::Test {
 protected:
  LandmarkFix Find(const std::vector<test::Quad>& quads, const Pose2& base_from_landmark,
                   const Pose2& believed, double noise = 3, double light = 1) {
    std::vector<test::Quad> lit = quads;
    for (test::Quad& quad : lit) quad.grey *= light;
    EdgeOperator op;
    op.Extract(test::RenderQuads(lit, Lift(base_from_landmark), left_, noise, rng_, 60 * light), left_edges_);
    op.Extract(test::RenderQuads(lit, Lift(base_from_landmark), right_, noise, rng_, 60 * light),
               right_edges_);
    return FindAgain(believed);
  }
  /// In the images of the last Find.
  LandmarkFix FindAgain(const Pose2& believed) const {
    return dut_.Find(model_, {believed, kTwentyCentimetresFiveDegrees},
                     {MakeView(left_, left_edges_), MakeView(right_, right_edges_)});
  }

  /// What looks may have shown: how much broader the landmark is, and nothing of its edges.
  ModelErrors KnownBreadth(const LandmarkFixOptions& options, double broader_m) const {
    ModelErrors errors;
    errors.mean = Eigen::VectorXd::Zero(ModelErrors::SizeFor(model_));
    errors.mean.tail<1>()(0) = broader_m;
    errors.covariance = options.solver.VarianceOfModel().CovarianceFor(model_);
    errors.covariance.bottomRightCorner<1, 1>()(0, 0) = 1e-8;
    return errors;
  }

  Rng rng_{7};
  const CameraModel left_ = test::HeadCamera(0, 1, 1000, -0.05),
                    right_ = test::HeadCamera(0, -1, 1000, -0.05);
  const LandmarkModel model_ = test::DoorModel();
  const LandmarkFinder dut_{LandmarkFixOptions{}};
  EdgeImage left_edges_, right_edges_;
};

TEST_F(LandmarkFixTest, FindsTheDoorFromTwentyCentimetresAndFiveDegreesOff) {
  for (int i = 0; i < 8; ++i) {
    const Pose2 truth{rng_.Uniform(2.9, 4.2), rng_.Uniform(-0.15, 0.15), rng_.Uniform(-0.05, 0.05)};
    const Pose2 error{rng_.Uniform(-0.2, 0.2), rng_.Uniform(-0.2, 0.2), Radians(rng_.Uniform(-5, 5))};
    const Pose2 believed{truth.x + error.x, truth.y + error.y, truth.yaw + error.yaw};
    const LandmarkFix fix = Find(test::DoorQuads(), truth, believed);
    ASSERT_EQ(fix.verdict, Verdict::kFound) << Describe(fix.verdict) << " at " << truth.x << " " << truth.y;
    EXPECT_NEAR(fix.base_from_landmark.x, truth.x, 0.005);
    EXPECT_NEAR(fix.base_from_landmark.y, truth.y, 0.003);
    EXPECT_NEAR(fix.base_from_landmark.yaw, truth.yaw, Radians(0.15));
  }
}

TEST_F(LandmarkFixTest, TheResultDoesNotDependOnThePrediction) {
  const Pose2 truth{3.2, 0.05, 0.02};
  const LandmarkFix near = Find(test::DoorQuads(), truth, truth);
  const LandmarkFix far = FindAgain({3.35, -0.05, -0.02});
  ASSERT_EQ(near.verdict, Verdict::kFound);
  ASSERT_EQ(far.verdict, Verdict::kFound);
  EXPECT_NEAR(near.base_from_landmark.x, far.base_from_landmark.x, 1e-4);
  EXPECT_NEAR(near.base_from_landmark.yaw, far.base_from_landmark.yaw, 1e-4);
}

TEST_F(LandmarkFixTest, CovarianceIsCredible) {
  const Pose2 truth{3.2, 0.05, 0.02};
  const LandmarkFix fix = Find(test::DoorQuads(), truth, truth);
  ASSERT_EQ(fix.verdict, Verdict::kFound);
  const Eigen::Vector3d error(fix.base_from_landmark.x - truth.x, fix.base_from_landmark.y - truth.y,
                              fix.base_from_landmark.yaw - truth.yaw);
  EXPECT_LT(error.dot(fix.covariance.inverse() * error), 16);
  EXPECT_LT(std::sqrt(fix.covariance(0, 0)), 0.01);
  EXPECT_GT(std::sqrt(fix.covariance(0, 0)), 0.0003);
}

/// Finds doors that are not as drawn with the errors that a tape measure leaves.
TEST_F(LandmarkFixTest, ADoorThatIsNotAsDrawnIsFoundWhereItsMiddleIs) {
  LandmarkFixOptions options;
  options.solver.model_sigma_m = 0.005;
  options.solver.breadth_sigma_m = 0.012;
  const LandmarkFinder finder(options);
  const Pose2 truth{2.8, 0.05, 0.02};
  for (const auto& [width_m, frame_m] : {std::pair{0.90, 0.063},
                                         {0.90, 0.065},
                                         {0.895, 0.06},
                                         {0.89, 0.06},
                                         {0.88, 0.06},
                                         {0.875, 0.06},
                                         {0.91, 0.055},
                                         {0.885, 0.066}}) {
    Find(test::DoorQuads(width_m, frame_m), truth, truth);
    const LandmarkFix fix = finder.Find(model_, {{2.9, 0, 0.05}, kTwentyCentimetresFiveDegrees},
                                        {MakeView(left_, left_edges_), MakeView(right_, right_edges_)});
    ASSERT_EQ(fix.verdict, Verdict::kFound) << Describe(fix.verdict) << ' ' << width_m << ' ' << frame_m;
    EXPECT_NEAR(fix.base_from_landmark.y, truth.y, 0.004) << width_m << ' ' << frame_m;
    const Eigen::Vector3d error(fix.base_from_landmark.x - truth.x, fix.base_from_landmark.y - truth.y,
                                fix.base_from_landmark.yaw - truth.yaw);
    EXPECT_LT(error.dot(fix.covariance.inverse() * error), 16);
  }
}

/// What is off by millimetres is off by more pixels from near, where fewer edges are in the pictures.
TEST_F(LandmarkFixTest, WhereAnEarlierFixSawTheEdgesTheyAreFoundFromNearer) {
  LandmarkFixOptions options;
  options.solver.model_sigma_m = 0.005;
  options.solver.breadth_sigma_m = 0.012;
  const LandmarkFinder finder(options);
  const auto look = [&](const Pose2& truth, const ModelErrors& known) {
    Find(test::DoorQuads(0.872, 0.07), truth, truth);
    return finder.Find(model_, {truth, kTwentyCentimetresFiveDegrees},
                       {MakeView(left_, left_edges_), MakeView(right_, right_edges_)}, &known);
  };
  const LandmarkFix far = look({3.2, 0.05, 0.02}, {});
  ASSERT_EQ(far.verdict, Verdict::kFound) << Describe(far.verdict);
  ASSERT_EQ(far.edge_shifts.size(), model_.edges.size());
  const Pose2 truth{2.3, 0.1, 0.04};
  const LandmarkFix near = look(truth, far.errors);
  ASSERT_EQ(near.verdict, Verdict::kFound) << Describe(near.verdict);
  EXPECT_NEAR(near.base_from_landmark.y, truth.y, 0.005);
  EXPECT_LT(near.errors.breadth().sigma_m, far.errors.breadth().sigma_m);
  const ModelErrors other{Eigen::VectorXd::Zero(10), Eigen::MatrixXd::Identity(10, 10)};
  EXPECT_EQ(look(truth, other).verdict, look(truth, {}).verdict) << "of another model";
}

TEST_F(LandmarkFixTest, ADoorOfAnotherWidthIsAnotherDoor) {
  LandmarkFixOptions options;
  options.solver.model_sigma_m = 0.005;
  options.solver.breadth_sigma_m = 0.012;
  const Pose2 truth{2.8, 0.05, 0.02};
  for (const double width_m : {0.80, 1.00}) {
    Find(test::DoorQuads(width_m), truth, truth);
    const LandmarkFix fix =
        LandmarkFinder(options).Find(model_, {truth, kTwentyCentimetresFiveDegrees},
                                     {MakeView(left_, left_edges_), MakeView(right_, right_edges_)});
    EXPECT_NE(fix.verdict, Verdict::kFound) << width_m;
  }
}

TEST_F(LandmarkFixTest, ABareWallIsNoDoor) {
  const LandmarkFix fix = Find(test::WallQuads(), {3.2, 0, 0}, {3.2, 0, 0});
  EXPECT_NE(fix.verdict, Verdict::kFound);
}

TEST_F(LandmarkFixTest, ADoorOfAnotherWidthIsNotThisDoor) {
  for (const double width : {0.8, 1.0}) {
    const LandmarkFix fix = Find(test::DoorQuads(width), {3.2, 0, 0}, {3.2, 0, 0});
    EXPECT_NE(fix.verdict, Verdict::kFound) << width;
  }
}

/// Something as grey as the wall stands before the right jamb.
TEST_F(LandmarkFixTest, OneHiddenSideIsBelievedOnlyWhereThePlaceIsKnown) {
  std::vector<test::Quad> quads = test::DoorQuads();
  quads.push_back({{-0.4, -1.3, 0}, {0, 0.94, 0}, {0, 0, 2.4}, quads.front().grey});
  const Pose2 truth{2.6, 0.02, 0.01};
  const LandmarkFix vague = Find(quads, truth, truth);
  const Eigen::Matrix3d sharp = Eigen::Vector3d(1e-4, 1e-4, 1e-5).asDiagonal();
  const LandmarkFix known = dut_.Find(model_, {{2.605, 0.015, 0.012}, sharp},
                                      {MakeView(left_, left_edges_), MakeView(right_, right_edges_)});
  EXPECT_NE(vague.verdict, Verdict::kFound);
  ASSERT_EQ(known.verdict, Verdict::kFound) << Describe(known.verdict);
  EXPECT_LT(known.side_share, 0.2);
  EXPECT_NEAR(known.base_from_landmark.y, truth.y, 0.005);
}

TEST_F(LandmarkFixTest, TheBreadthOfEarlierLooksPlacesALandmarkOfWhichOneSideIsSeen) {
  std::vector<test::Quad> quads = test::DoorQuads();
  quads.push_back({{-0.4, -1.3, 0}, {0, 0.94, 0}, {0, 0, 2.4}, quads.front().grey});
  const Pose2 truth{2.6, 0.02, 0.01};
  Find(quads, truth, truth);
  const Eigen::Matrix3d sharp = Eigen::Vector3d(1e-4, 1e-4, 1e-5).asDiagonal();
  LandmarkFixOptions options;
  options.solver.breadth_sigma_m = 0.012;
  const LandmarkFinder dut(options);
  const auto find = [&](const ModelErrors& errors) {
    return dut.Find(model_, {{2.605, 0.015, 0.012}, sharp},
                    {MakeView(left_, left_edges_), MakeView(right_, right_edges_)}, &errors);
  };
  const LandmarkFix unknown = find({}), known = find(KnownBreadth(options, 0)),
                    broader = find(KnownBreadth(options, 0.003));
  ASSERT_EQ(unknown.verdict, Verdict::kFound) << Describe(unknown.verdict);
  ASSERT_EQ(known.verdict, Verdict::kFound) << Describe(known.verdict);
  ASSERT_EQ(broader.verdict, Verdict::kFound) << Describe(broader.verdict);
  EXPECT_LT(std::sqrt(known.covariance(1, 1)), 0.6 * std::sqrt(unknown.covariance(1, 1)));
  EXPECT_NEAR(known.base_from_landmark.y, truth.y, 0.003);
  // The left side is where it is: the middle of a broader door lies farther to the right.
  EXPECT_NEAR(broader.base_from_landmark.y, known.base_from_landmark.y - 0.0015, 0.0008);
  EXPECT_NEAR(broader.breadth.broader_m, 0.003, 0.001);
}

TEST_F(LandmarkFixTest, FromNearOneJambIsEnoughWhereThePlaceIsKnown) {
  const Pose2 truth{1.35, 0.02, 0.01};
  const CameraModel left = test::HeadCamera(0.3, 1, 890, -0.05),
                    right = test::HeadCamera(0.3, -1, 890, -0.05);
  EdgeOperator op;
  op.Extract(test::RenderQuads(test::DoorQuads(), Lift(truth), left, 2, rng_, 60), left_edges_);
  op.Extract(test::RenderQuads(test::DoorQuads(), Lift(truth), right, 2, rng_, 60), right_edges_);
  const StereoViews views{MakeView(left, left_edges_), MakeView(right, right_edges_)};
  const Eigen::Matrix3d sharp = Eigen::Vector3d(1e-4, 1e-4, 5e-5).asDiagonal();
  const ModelErrors known = KnownBreadth(dut_.options(), 0);
  const LandmarkFix fix = dut_.Find(model_, {{1.345, 0.03, 0.015}, sharp}, views, &known);
  ASSERT_EQ(fix.verdict, Verdict::kFound) << Describe(fix.verdict);
  // The heading is open, and with it x; what a heading tells makes y sharp.
  const double by_yaw = fix.covariance(1, 2) / fix.covariance(2, 2);
  const double y = fix.base_from_landmark.y - by_yaw * (fix.base_from_landmark.yaw - truth.yaw);
  EXPECT_NEAR(y, truth.y, 0.004);
}

TEST_F(LandmarkFixTest, ADoorElsewhereIsRefused) {
  const LandmarkFix fix = Find(test::DoorQuads(), {3.6, 0.1, 0}, {3.6, -0.55, 0});
  EXPECT_EQ(fix.verdict, Verdict::kElsewhere);
}

TEST_F(LandmarkFixTest, SwappedImagesGiveNoFix) {
  Find(test::DoorQuads(), {3.2, 0, 0}, {3.2, 0, 0});
  const LandmarkFix fix = dut_.Find(model_, {{3.2, 0, 0}, kTwentyCentimetresFiveDegrees},
                                    {MakeView(left_, right_edges_), MakeView(right_, left_edges_)});
  EXPECT_NE(fix.verdict, Verdict::kFound);
}

TEST_F(LandmarkFixTest, DarknessIsNoImage) {
  EXPECT_EQ(Find(test::DoorQuads(), {3.2, 0, 0}, {3.2, 0, 0}, 0, 0).verdict, Verdict::kNoImage);
}

TEST_F(LandmarkFixTest, ALandmarkBehindTheRobotIsNotVisible) {
  EXPECT_EQ(Find(test::DoorQuads(), {3.2, 0, 0}, {-3.2, 0, 0}).verdict, Verdict::kNotVisible);
}

TEST_F(LandmarkFixTest, AMovablePartThatStandsElsewhereSaysNothing) {
  const Pose2 truth{3.2, 0.05, 0.02};
  const LandmarkFix without = Find(test::DoorQuads(), truth, truth);
  ASSERT_EQ(without.verdict, Verdict::kFound);
  LandmarkModel with_leaf = model_;
  const int leaf = static_cast<int>(with_leaf.edges.size());
  for (const double y : {-0.2, 0.0, 0.2}) with_leaf.edges.push_back({{0.5, y, 0}, {0.5, y, 2}, -kPi, kPi, 3});
  const LandmarkFix with = dut_.Find(with_leaf, {truth, kTwentyCentimetresFiveDegrees},
                                     {MakeView(left_, left_edges_), MakeView(right_, right_edges_)});
  ASSERT_EQ(with.verdict, Verdict::kFound);
  EXPECT_DOUBLE_EQ(with.log_odds, without.log_odds);
  EXPECT_DOUBLE_EQ(with.base_from_landmark.x, without.base_from_landmark.x);
  for (const EdgeMatch& m : with.matches) EXPECT_LT(m.edge, leaf);
}

TEST_F(LandmarkFixTest, AMovablePartThatIsFoundSpeaksForThePose) {
  const Pose2 truth{3.2, 0.05, 0.02};
  LandmarkModel less = model_, more = model_;
  const int part = 0;  // the outer arris on the left
  less.edges.erase(less.edges.begin() + part);
  more.edges[part].side = 3;
  Find(test::DoorQuads(), truth, truth);
  const LandmarkPrediction prediction{truth, kTwentyCentimetresFiveDegrees};
  const LandmarkFix a =
      dut_.Find(less, prediction, {MakeView(left_, left_edges_), MakeView(right_, right_edges_)});
  const LandmarkFix b =
      dut_.Find(more, prediction, {MakeView(left_, left_edges_), MakeView(right_, right_edges_)});
  ASSERT_EQ(b.verdict, Verdict::kFound);
  EXPECT_GT(b.log_odds, a.log_odds + 1);
  EXPECT_TRUE(
      std::any_of(b.matches.begin(), b.matches.end(), [&](const EdgeMatch& m) { return m.edge == part; }));
}

TEST_F(LandmarkFixTest, AnEmptyModelIsNoModel) {
  Find(test::DoorQuads(), {3.2, 0, 0}, {3.2, 0, 0});
  EXPECT_EQ(dut_.Find({}, {{3.2, 0, 0}, kTwentyCentimetresFiveDegrees},
                      {MakeView(left_, left_edges_), MakeView(right_, right_edges_)})
                .verdict,
            Verdict::kNoModel);
}

TEST(VerdictTest, EveryVerdictHasWords) {
  for (int v = 0; v <= 8; ++v) EXPECT_STRNE(Describe(static_cast<Verdict>(v)), "unknown");
}

}  // namespace
}  // namespace priamos::head
