#include "world/core/camera/image_formation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace priamos::world {
namespace {

using Eigen::Vector2d;

cv::Mat EvenLight(float light) {
  return {FineGrid::kHeight, FineGrid::kWidth, CV_32F, cv::Scalar(light)};
}

ImagingConfig Noiseless() {
  ImagingConfig config;
  config.read_noise = config.photon_noise = config.vignetting = 0;
  return config;
}

int At(const GreyImage& image, int u, int v) {
  return image.pixels.at(v * image.width + u);
}

struct Statistics {
  double mean = 0, sigma = 0;
};

Statistics Middle(const GreyImage& image) {
  double sum = 0, squares = 0, n = 0;
  for (int v = 188; v < 388; ++v) {
    for (int u = 284; u < 484; ++u, ++n) {
      sum += At(image, u, v);
      squares += At(image, u, v) * At(image, u, v);
    }
  }
  return {sum / n, std::sqrt(squares / n - sum * sum / n / n)};
}

GreyImage Formed(const ImagingConfig& config, const TrueCamera& camera, double defocus_px,
                 const cv::Mat& light, const Exposure& exposure, Rng& rng) {
  return FormImage(config, LensMap(camera, config.vignetting), defocus_px, light, exposure, rng);
}

TEST(SubSample, HasEveryColumnAndRowOnce) {
  for (int n = 1; n <= 16; ++n) {
    std::set<double> columns, rows;
    for (int k = 0; k < n; ++k) {
      columns.insert(SubSample(k, n).x());
      rows.insert(SubSample(k, n).y());
    }
    EXPECT_EQ(columns.size(), static_cast<std::size_t>(n));
    EXPECT_EQ(rows.size(), static_cast<std::size_t>(n));
    EXPECT_NEAR((*columns.begin() + *columns.rbegin()) / 2, 0.5, 1e-12) << "no shift on average";
  }
}

TEST(FormImage, LevelsFollowLightExposureAndGain) {
  Rng rng(1);
  const ImagingConfig config = Noiseless();
  EXPECT_EQ(At(Formed(config, {}, 0, EvenLight(0), {}, rng), 100, 100), 8) << "black level";
  EXPECT_EQ(At(Formed(config, {}, 0, EvenLight(1), {}, rng), 384, 288), 230) << "white level";
  EXPECT_EQ(At(Formed(config, {}, 0, EvenLight(0.4F), {0.005, 1, 0}, rng), 384, 288), 52)
      << "8 + 222 * 0.4 / 2";
  EXPECT_EQ(At(Formed(config, {}, 0, EvenLight(0.4F), {0.005, 2, 0}, rng), 384, 288), 97);
  EXPECT_EQ(At(Formed(config, {}, 0, EvenLight(3), {}, rng), 384, 288), 255) << "saturated";
}

TEST(FormImage, NoiseHasTheStatedSigma) {
  ImagingConfig config = Noiseless();
  config.read_noise = 2;
  config.photon_noise = 0.03;
  Rng rng(5);
  const Statistics dark = Middle(Formed(config, {}, 0, EvenLight(0.1F), {}, rng));
  EXPECT_NEAR(dark.mean, 8 + 22.2, 0.1);
  EXPECT_NEAR(dark.sigma, std::sqrt(4 + 0.03 * 22.2 + 1 / 12.0), 0.03);
  const Statistics bright = Middle(Formed(config, {}, 0, EvenLight(0.4F), {0.010, 2, 0}, rng));
  EXPECT_NEAR(bright.sigma, std::sqrt(4 * 4 + 2 * 0.03 * 177.6 + 1 / 12.0), 0.05);
}

TEST(FormImage, CornersAreDarkerByTheVignetting) {
  ImagingConfig config = Noiseless();
  config.vignetting = 0.25;
  Rng rng(1);
  TrueCamera camera;
  camera.focal_px = 800;
  const GreyImage image = Formed(config, camera, 0, EvenLight(1), {}, rng);
  EXPECT_NEAR((At(image, 0, 0) - 8) / 222.0, 0.75, 0.01);
  EXPECT_NEAR(At(image, 384, 288), 230, 1);
}

/// A bright spot on the fine grid where an undistorted image point falls.
cv::Mat Spot(const Vector2d& undistorted_px) {
  cv::Mat light = EvenLight(0);
  const Vector2d place = FineGrid::FromImage(undistorted_px) - Vector2d::Constant(0.5);
  const int x = static_cast<int>(std::floor(place.x())), y = static_cast<int>(std::floor(place.y()));
  const double a = place.x() - x, b = place.y() - y;
  light.at<float>(y, x) = float((1 - a) * (1 - b)), light.at<float>(y, x + 1) = float(a * (1 - b));
  light.at<float>(y + 1, x) = float((1 - a) * b), light.at<float>(y + 1, x + 1) = float(a * b);
  return light * 8;
}

Vector2d Centroid(const GreyImage& image) {
  double weight = 0;
  Vector2d moment = Vector2d::Zero();
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      const double w = At(image, u, v) - 8;
      weight += w;
      moment += w * Vector2d(u, v);
    }
  }
  return moment / weight;
}

TEST(FormImage, TheLensDistortsAsTheCameraSays) {
  Rng rng(1);
  for (int i = 0; i < 12; ++i) {
    TrueCamera camera;
    camera.focal_px = rng.Uniform(800, 1300);
    camera.centre_px = {rng.Uniform(370, 400), rng.Uniform(270, 300)};
    camera.k1 = rng.Uniform(-0.08, 0.04);
    camera.k2 = rng.Uniform(-0.01, 0.02);
    const Vector2d seen(rng.Uniform(10, 757), rng.Uniform(10, 565));
    const GreyImage image = Formed(Noiseless(), camera, 0, Spot(camera.Undistort(seen)), {}, rng);
    EXPECT_LT((Centroid(image) - seen).norm(), 0.03);
  }
}

TEST(FormImage, DefocusWidensASpot) {
  Rng rng(1);
  const auto peak = [&](double defocus) {
    return At(Formed(Noiseless(), {}, defocus, Spot({300, 200}), {}, rng), 300, 200);
  };
  EXPECT_GT(peak(0), 2 * peak(1.5));
}

}  // namespace
}  // namespace priamos::world
