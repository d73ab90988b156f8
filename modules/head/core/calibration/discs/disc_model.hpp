#pragma once

#include <Eigen/Core>

#include "head/core/calibration/discs/disc_pixels.hpp"

namespace priamos::head {

/// The parameters of the grey-value model. By symmetry the odd ones (centre, slopes) and the even ones
/// (brightness, shape, rim width) do not disturb each other, so each group has its own normal equations.
struct DiscModel {
  Eigen::Vector2d centre;
  Eigen::Matrix2d k;  ///< inverse shape
  double rim_sigma, amplitude, background;
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();  ///< relative gradient of the brightness inside [1/px]
  Eigen::Vector2d background_slope =
      Eigen::Vector2d::Zero();  ///< gradient of the background [grey values/px]

  /// One Gauss-Newton step.
  void Step(const NormalEquations& eq);
};

/// The normal equations of the model on the pixels of a window whose centre is `window_centre`, with what is
/// known of slopes beforehand.
NormalEquations Linearise(const DiscModel& model, const WindowPixels& pixels,
                          const Eigen::Vector2d& window_centre);

/// How far the model's rim reaches to either side [px].
double RimFade(const DiscModel& model);

}  // namespace priamos::head
