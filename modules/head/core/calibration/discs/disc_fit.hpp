#pragma once

#include <optional>
#include <span>

#include "common/frame_store.hpp"
#include "head/core/calibration/discs/disc_projection.hpp"

namespace priamos::head {

/// A bright ellipse on a dark ground as it was measured.
struct DetectedDisc {
  Ellipse ellipse;           ///< centre: the measured centroid [distorted px]
  double background = 0;     ///< grey levels around it
  double amplitude = 0;      ///< grey levels above the background
  double blur_sigma_px = 0;  ///< Gaussian width of the rim
  double residual = 0;       ///< RMS misfit of the disc model over the window, in grey levels
  double sigma_px = 0;       ///< standard deviation of each coordinate of the centre, from the misfit
};

/// Grey-weighted first and second moments of the window around `guess`, the local background subtracted
/// before weighting and the blurred rim included (section 3.1.2 of the paper). nullopt if the window leaves
/// the image or nothing in it stands out.
///
/// Pixels within `others`, which are bright spots close by, do not count.
std::optional<DetectedDisc> MeasureMoments(const GreyImage& image, const Ellipse& guess,
                                           std::span<const Ellipse> others = {});

/// Least squares fit of a blurred ellipse (centre, shape, rim width, brightness with slope inside,
/// background) to the grey values. Its centre is about 1.4 times as precise as the centroid's, because the
/// rim alone carries the information, and a slope of brightness does not shift it. nullopt if it does not
/// converge near the start.
std::optional<DetectedDisc> FitDisc(const GreyImage& image, const DetectedDisc& start,
                                    std::span<const Ellipse> others = {});

}  // namespace priamos::head
