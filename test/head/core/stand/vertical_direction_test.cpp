#include "head/core/stand/vertical_direction.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "common/geometry.hpp"
#include "common/random.hpp"
#include "head/core/edges/edge_segments.hpp"
#include "head/core/stand/camera_stand.hpp"
#include "test/head/exact_view.hpp"

namespace priamos::head {
namespace {

constexpr double kNoise_px = 0.1;

CameraModel OwnFrame() {
  CameraModel camera;
  camera.image_from_base << 800, 0, 384, 0, 0, 800, 288, 0, 0, 0, 1, 0;
  return camera;
}

/// What a camera that stands somehow sees of posts around it, with noise, and of anything else.
class Drawing {
 public:
  Drawing(const CameraStand& stand, std::uint64_t seed)
      : camera_from_base_(BaseFromCamera(stand).inverse()), rng_(seed), picture_(OwnFrame(), kNoise_px) {}

  void AddPosts(int n) {
    for (int i = 0; i < n; ++i) {
      const double x = rng_.Uniform(2.5, 6), y = rng_.Uniform(-0.4, 0.4) * x;
      const double low = rng_.Uniform(0.6, 1.1);
      Draw({x, y, low}, {x, y, low + rng_.Uniform(0.4, 0.9)});
    }
  }
  void AddOutliers(int n) {
    for (int i = 0; i < n; ++i) {
      const Eigen::Vector2d from(rng_.Uniform(50, 700), rng_.Uniform(50, 500));
      const double angle = rng_.Uniform(0, kPi), length = rng_.Uniform(15, 60);
      picture_.Draw(from, from + length * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    }
  }
  VerticalDirection Find() {
    const CameraView view = picture_.View();
    return FindVertical(std::span(&view, 1), {});
  }

 private:
  void Draw(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    const auto image = [&](const Eigen::Vector3d& p) -> Eigen::Vector2d {
      return OwnFrame().Project(camera_from_base_ * p) +
             Eigen::Vector2d(rng_.Normal(kNoise_px), rng_.Normal(kNoise_px));
    };
    picture_.Draw(image(from), image(to), 80, 140, 0);
  }

  Eigen::Isometry3d camera_from_base_;
  Rng rng_;
  test::ExactView picture_;
};

/// What was found in a made-up image whose truth is known, in standard deviations and in radians.
struct Trial {
  bool is_found = false;
  double sigmas = 0, off_rad = 0;
};

Trial TryToFind(Rng& rng) {
  const CameraStand stand{1.2, rng.Uniform(-0.2, 0.2), rng.Uniform(-0.08, 0.08)};
  Drawing drawing(stand, rng.Below(100000));
  drawing.AddPosts(10 + static_cast<int>(rng.Below(20)));
  drawing.AddOutliers(static_cast<int>(rng.Below(40)));
  const VerticalDirection dut = drawing.Find();
  if (dut.verdict != UprightVerdict::kFound) return {};
  const CameraStand found = StandOf(dut.up, 0);
  const Eigen::Vector2d off(found.tilt_rad - stand.tilt_rad, found.roll_rad - stand.roll_rad);
  return {true, std::sqrt(off.dot(TiltAndRollCovariance(dut).inverse() * off)), off.norm()};
}

TEST(FindVertical, TheTruthIsWithinTheCovarianceWhateverElseIsInTheImage) {
  constexpr int kTrials = 400;
  Rng rng(48);
  int n_found = 0, n_beyond = 0, n_far = 0;
  for (int i = 0; i < kTrials; ++i) {
    const Trial trial = TryToFind(rng);
    n_found += trial.is_found;
    n_beyond += trial.sigmas > 3.5;
    n_far += trial.off_rad > 0.02;
  }
  EXPECT_GE(n_found, 0.99 * kTrials);
  EXPECT_LE(n_beyond, 0.02 * kTrials) << "an outlier may happen to agree";
  EXPECT_LE(n_far, 0.005 * kTrials);
}

TEST(FindVertical, WhereNothingIsUprightItIsNotFoundAndNothingIsNotANumber) {
  Rng rng(49);
  for (int i = 0; i < 200; ++i) {
    Drawing drawing({}, rng.Below(100000));
    drawing.AddOutliers(static_cast<int>(rng.Below(60)));
    const VerticalDirection dut = drawing.Find();
    EXPECT_NE(dut.verdict, UprightVerdict::kFound) << i;
    EXPECT_TRUE(dut.up.allFinite() && dut.covariance.allFinite()) << i;
  }
}

TEST(FindVertical, TwoDirectionsWithAsManyEdgesAreAmbiguous) {
  test::ExactView picture(OwnFrame());
  for (int i = 0; i < 8; ++i) {
    picture.Draw({50 + 80.0 * i, 100}, {50 + 80.0 * i, 220});
    picture.Draw({90 + 80.0 * i, 300}, {110 + 80.0 * i, 420});
  }
  const CameraView view = picture.View();
  EXPECT_EQ(FindVertical(std::span(&view, 1), {}).verdict, UprightVerdict::kAmbiguous);
}

TEST(FindVertical, EdgesInOnePlaceTellNoTilt) {
  test::ExactView picture(OwnFrame(), 0.3);
  for (int i = 0; i < 8; ++i) picture.Draw({300 + 6.0 * i, 250}, {300 + 6.0 * i, 280});
  const CameraView view = picture.View();
  EXPECT_NE(FindVertical(std::span(&view, 1), {}).verdict, UprightVerdict::kFound);
}

TEST(FindVertical, OfNoViewAndNoEdgesThereIsNone) {
  EXPECT_EQ(FindVertical({}, {}).verdict, UprightVerdict::kTooFew);
  test::ExactView picture(OwnFrame());
  const CameraView view = picture.View();
  EXPECT_EQ(FindVertical(std::span(&view, 1), {}).verdict, UprightVerdict::kTooFew);
}

TEST(FindVertical, NoiseAndUniformImagesHaveNone) {
  Rng rng(3);
  EdgeOperator op;
  for (const double sigma : {0.0, 8.0, 60.0}) {
    cv::Mat image(240, 320, CV_8UC1);
    for (int i = 0; i < image.rows * image.cols; ++i)
      image.data[i] = cv::saturate_cast<std::uint8_t>(128 + rng.Normal(sigma));
    EdgeImage edges;
    op.Extract(image, edges);
    const CameraModel camera = OwnFrame();
    const CameraView view = MakeView(camera, edges);
    EXPECT_NE(FindVertical(std::span(&view, 1), {}).verdict, UprightVerdict::kFound) << sigma;
  }
}

TEST(UprightVerdict, EachIsDescribed) {
  for (const auto verdict :
       {UprightVerdict::kFound, UprightVerdict::kTooFew, UprightVerdict::kAmbiguous, UprightVerdict::kVague})
    EXPECT_GT(std::string(Describe(verdict)).size(), 4u);
}

}  // namespace
}  // namespace priamos::head
