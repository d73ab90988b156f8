#include "head/core/landmark/pose_solver.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <array>

#include "common/random.hpp"
#include "head/core/camera/head_model.hpp"
#include "head/core/camera/projection.hpp"
#include "test/support/quad_scene.hpp"

namespace priamos::head {
namespace {

/// What both cameras see of the model, with noise and an error of the model's edges.
std::vector<EdgeObservation> Observe(const LandmarkModel& model, std::span<const CameraModel* const> cameras,
                                     const Eigen::Isometry3d& pose, double noise_px, Rng& rng) {
  std::vector<EdgeObservation> observations;
  for (std::size_t e = 0; e < model.edges.size(); ++e) {
    for (std::size_t c = 0; c < cameras.size(); ++c) {
      const auto edge =
          ProjectEdge(*cameras[c], {768, 576}, pose * model.edges[e].from, pose * model.edges[e].to);
      if (!edge) continue;
      for (double f = 0.05; f < 1; f += 0.1) {
        const Eigen::Vector2d at = edge->p + f * (edge->q - edge->p) + rng.Normal(noise_px) * edge->normal();
        observations.push_back({int(e), int(c), at, std::max(noise_px, 0.01)});
      }
    }
  }
  return observations;
}

class PoseSolverTest : public testing::Test {
 protected:
  const CameraModel left_ = test::HeadCamera(0.05, 1), right_ = test::HeadCamera(0.05, -1);
  const std::array<const CameraModel*, 2> cameras_{&left_, &right_};
  const LandmarkModel door_ = test::DoorModel();
};

TEST_F(PoseSolverTest, RecoversThePoseFromExactPoints) {
  Rng rng(1);
  const Eigen::Isometry3d truth = Lift({3.2, 0.1, 0.05});
  const auto observations = Observe(door_, cameras_, truth, 0, rng);
  const PoseSolution dut = SolvePose(door_, cameras_, observations, Lift({3.3, 0.05, 0.0}), {});
  ASSERT_TRUE(dut.ok);
  EXPECT_LT((dut.base_from_landmark.translation() - truth.translation()).norm(), 1e-5);
  EXPECT_LT(dut.rms_px, 1e-3);
  EXPECT_LT(dut.misfit, 0.01);
}

TEST_F(PoseSolverTest, TellsWhereTheEdgesOfABroaderDoorLie) {
  Rng rng(1);
  const Eigen::Isometry3d truth = Lift({3.2, 0.1, 0.05});
  const auto observations = Observe(test::DoorModel(0.912), cameras_, truth, 0, rng);
  PoseSolverOptions options;
  options.model_sigma_m = 0.002;
  options.breadth_sigma_m = 0.01;
  const PoseSolution dut = SolvePose(door_, cameras_, observations, truth, options);
  ASSERT_TRUE(dut.ok);
  EXPECT_NEAR(dut.base_from_landmark.translation().y(), 0.1, 5e-4);
  for (std::size_t i = 0; i < door_.edges.size(); ++i) {
    const double side = door_.edges[i].side == 1 ? 1 : door_.edges[i].side == 2 ? -1 : 0;
    EXPECT_NEAR(dut.edge_shifts[i].y(), side * 0.006, 0.0015) << i;
  }
  EXPECT_LT(dut.rms_px, 0.3) << "against the model with these shifts";
  EXPECT_LT(dut.misfit, 1);
}

TEST_F(PoseSolverTest, BothSidesTellTheBreadthOneSideAloneDoesNot) {
  PoseSolverOptions options;
  options.breadth_sigma_m = 0.01;
  double sum = 0, squared = 0;
  constexpr int kRuns = 60;
  for (int run = 0; run < kRuns; ++run) {
    Rng rng(static_cast<std::uint64_t>(run));
    const double broader = rng.Normal(0.01);
    const auto observations =
        Observe(test::DoorModel(0.9 + broader), cameras_, Lift({3.2, 0.1, 0.05}), 0.2, rng);
    const PoseSolution dut = SolvePose(door_, cameras_, observations, Lift({3.2, 0.1, 0.05}), options);
    ASSERT_TRUE(dut.ok);
    EXPECT_LT(dut.breadth.sigma_m, 0.002);
    sum += std::pow((dut.breadth.broader_m - broader) / dut.breadth.sigma_m, 2) / kRuns;
    squared += std::pow(dut.breadth.broader_m - broader, 2) / kRuns;
  }
  EXPECT_LT(std::sqrt(squared), 0.0015);
  EXPECT_LT(sum, 1.5) << "its sigma is honest";
  Rng rng(1);
  auto observations = Observe(door_, cameras_, Lift({3.2, 0.1, 0.05}), 0.2, rng);
  std::erase_if(observations, [&](const EdgeObservation& o) { return door_.edges[o.edge].side != 1; });
  EXPECT_GT(SolvePose(door_, cameras_, observations, Lift({3.2, 0.1, 0.05}), options).breadth.sigma_m, 0.008);
}

TEST_F(PoseSolverTest, StaysOnTheFloor) {
  Rng rng(2);
  const auto observations = Observe(door_, cameras_, Lift({3.2, 0.1, 0.05}), 0.3, rng);
  const PoseSolution dut = SolvePose(door_, cameras_, observations, Lift({3.2, 0.1, 0.05}), {});
  ASSERT_TRUE(dut.ok);
  EXPECT_EQ(dut.base_from_landmark.translation().z(), 0);
  EXPECT_EQ(dut.covariance.row(2).norm(), 0);
}

TEST_F(PoseSolverTest, SolvesSixDegreesOfFreedom) {
  Rng rng(3);
  Eigen::Isometry3d truth = Lift({3.0, 0.0, 0.1});
  truth.translation().z() = -0.1;
  truth.linear() =
      Eigen::AngleAxisd(0.05, Eigen::Vector3d(1, 2, 0.5).normalized()).toRotationMatrix() * truth.linear();
  const auto observations = Observe(door_, cameras_, truth, 0, rng);
  PoseSolverOptions options;
  options.on_floor = false;
  options.max_iterations = 20;
  const PoseSolution dut = SolvePose(door_, cameras_, observations, Lift({3.05, 0.03, 0.08}), options);
  ASSERT_TRUE(dut.ok);
  EXPECT_LT((dut.base_from_landmark.matrix() - truth.matrix()).norm(), 1e-4);
}

TEST_F(PoseSolverTest, CovarianceIsHonest) {
  // Noise, shifted cameras and misplaced edges as large as the options say: the normalised error is chi
  // squared.
  PoseSolverOptions options;
  options.model_sigma_m = 0.001;
  options.tilt_sigma_m = 0.0005;
  options.camera_sigma_px = 0.2;
  options.base_covariance = PlacementCovariance({2.05, 0, 1.2}, 0.0005, 0.001);
  const Eigen::Matrix<double, 6, 6> common_root = options.base_covariance.llt().matrixL();
  Rng rng(4);
  const Pose2 truth{3.0, 0.05, -0.04};
  double nees = 0;
  constexpr int kRuns = 200;
  for (int run = 0; run < kRuns; ++run) {
    LandmarkModel real = door_;
    for (LandmarkEdge& e : real.edges) {
      const Eigen::Vector3d along = (e.to - e.from).normalized(), a = along.unitOrthogonal(),
                            b = along.cross(a);
      const Eigen::Vector3d shift = rng.Normal(0.001) * a + rng.Normal(0.001) * b;
      const Eigen::Vector3d tilt = rng.Normal(0.0005) * a + rng.Normal(0.0005) * b;
      e.from += shift - tilt;
      e.to += shift + tilt;
    }
    // All cameras are wrong together: as if the landmark had moved the other way.
    Eigen::Matrix<double, 6, 1> common;
    for (int i = 0; i < 6; ++i) common[i] = rng.Normal(1);
    common = common_root * common;
    const Eigen::Vector3d turn = common.tail<3>();
    Eigen::Isometry3d moved = Lift(truth);
    moved.prerotate(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
    moved.pretranslate(Eigen::Vector3d(common.head<3>()));
    auto observations = Observe(real, cameras_, moved, 0.1, rng);
    const Eigen::Vector2d shift[2] = {{rng.Normal(0.2), rng.Normal(0.2)}, {rng.Normal(0.2), rng.Normal(0.2)}};
    for (EdgeObservation& o : observations) o.at += shift[o.camera];
    const PoseSolution dut = SolvePose(door_, cameras_, observations, Lift(truth), options);
    ASSERT_TRUE(dut.ok);
    const Eigen::Vector3d t = dut.base_from_landmark.translation();
    const double yaw =
        std::atan2(dut.base_from_landmark.linear()(1, 0), dut.base_from_landmark.linear()(0, 0));
    const Eigen::Vector3d error(t.x() - truth.x, t.y() - truth.y, yaw - truth.yaw);
    Eigen::Matrix3d c;
    const int axes[3] = {0, 1, 5};
    for (int i = 0; i < 9; ++i) c(i / 3, i % 3) = dut.covariance(axes[i / 3], axes[i % 3]);
    nees += error.dot(c.inverse() * error) / 3 / kRuns;
  }
  EXPECT_GT(nees, 0.6);
  EXPECT_LT(nees, 1.2);
}

TEST_F(PoseSolverTest, TellsHowMuchOfTheCovarianceIsThePicturesOwn) {
  Rng rng(5);
  const auto observations = Observe(door_, cameras_, Lift({3.0, 0.05, -0.04}), 0.1, rng);
  PoseSolverOptions options;
  options.model_sigma_m = options.tilt_sigma_m = options.movable_sigma_m = options.camera_sigma_px = 1e-9;
  const auto share = [&] {
    return SolvePose(door_, cameras_, observations, Lift({3, 0, 0}), options).own_share;
  };
  EXPECT_NEAR(share(), 1, 1e-3);
  options.model_sigma_m = options.tilt_sigma_m = options.movable_sigma_m = 0.03;
  EXPECT_LT(share(), 0.02);
  options.model_sigma_m = options.tilt_sigma_m = options.movable_sigma_m = 1e-9;
  options.base_covariance = PlacementCovariance({2.05, 0, 1.2}, 0.01, 0.01);
  EXPECT_LT(share(), 0.02);
}

TEST_F(PoseSolverTest, PointsOutTheEdgeThatIsNotTheModels) {
  Rng rng(5);
  const Eigen::Isometry3d truth = Lift({3.0, 0.0, 0.0});
  auto observations = Observe(door_, cameras_, truth, 0.05, rng);
  for (EdgeObservation& o : observations) {
    if (o.edge == 3) o.at.x() += 3;
  }
  const PoseSolution dut = SolvePose(door_, cameras_, observations, truth, {});
  ASSERT_TRUE(dut.ok);
  EXPECT_EQ(dut.suspect.edge, 3);
  EXPECT_GT(dut.suspect.misfit, 10);
  EXPECT_GT(dut.misfit, 2);
}

TEST_F(PoseSolverTest, RefusesTooFewEdges) {
  Rng rng(6);
  auto observations = Observe(door_, cameras_, Lift({3, 0, 0}), 0.05, rng);
  std::erase_if(observations, [](const EdgeObservation& o) { return o.edge != 0; });
  EXPECT_FALSE(SolvePose(door_, cameras_, observations, Lift({3, 0, 0}), {}).ok);
  EXPECT_FALSE(SolvePose(door_, cameras_, {}, Lift({3, 0, 0}), {}).ok);
}

}  // namespace
}  // namespace priamos::head
