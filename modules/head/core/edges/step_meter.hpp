#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>

namespace priamos::head {

/// What a blurred step of brightness across a short piece of a line looks like.
struct Step {
  double shift_px = 0;  ///< from the line to the step, along the normal [px]
  double contrast = 0,
         contrast_sigma = 0;  ///< rise along the normal, and its standard deviation [grey values]
  double grey = 0;            ///< mean grey value there
  double explained = 0;       ///< share of the variance of the grey values that blurred steps explain, 0..1
  double steepest = 0;        ///< contrast of a lone step as steep as the steepest slope there [grey values]
};

/// Measures steps of brightness on an image whose blur is known, also those that lie so near beside each
/// other that their images merge: all of them are fitted at once, as one profile that is moved as a whole.
/// Works on the image reduced by as much as its blur allows.
class StepMeter {
 public:
  static constexpr int kMostSteps = 3;  ///< that are fitted at once

  /// Sets the image to measure (CV_8UC1), the noise of its pixels [grey values], and its blur beyond that of
  /// the pixels [px].
  StepMeter(const cv::Mat& image, double noise_sigma, double blur_px);

  /// The step nearest to where it explains the image best, up to 1.5 times the blur beside `at`, on a piece
  /// of `length_px` square to the unit vector `normal`. `beside_px`: where along the normal other steps are
  /// expected, against this one. nullopt at the border of the image.
  std::optional<Step> Measure(const Eigen::Vector2d& at, const Eigen::Vector2d& normal, double length_px,
                              std::span<const double> beside_px) const;

 private:
  struct Profile;
  struct Fit;

  bool Sample(const Eigen::Vector2d& at, const Eigen::Vector2d& normal, double length_px,
              Profile& profile) const;
  Fit FitOne(const Profile& profile, double shift) const;
  Fit FitAt(const Profile& profile, double shift) const;
  Fit FitBest(const Profile& profile) const;
  double Steepest(const Profile& profile) const;

  cv::Mat reduced_;
  double factor_ = 1;             ///< pixels of the image per pixel of the reduced one
  double noise_ = 0, sigma_ = 0;  ///< of the reduced image: noise, and width of a step [its px]
};

}  // namespace priamos::head
