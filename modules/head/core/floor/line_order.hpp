#pragma once

#include <optional>
#include <span>
#include <vector>

#include "common/image_size.hpp"
#include "head/core/camera/camera_model.hpp"
#include "head/core/camera/laser_plane.hpp"
#include "head/core/floor/laser_stripe.hpp"
#include "head/core/floor/line_geometry.hpp"

namespace priamos::head {

/// Where the line of one laser is expected in a picture.
struct ExpectedLine {
  std::size_t laser = 0;                  ///< its number in the calibration
  RowRange rows;                          ///< where it can be, for all heights that are looked for
  std::vector<std::optional<float>> row;  ///< on a level floor, by column; none: outside of the picture
  int columns = 0;                        ///< how many of these there are
};

/// The lines that a level floor would show, from the top of the picture, which is the farthest, to its
/// bottom. Rows within a few of its borders do not count: nothing is measured there.
std::vector<ExpectedLine> ExpectLines(const CameraModel& camera, std::span<const LaserPlane> lasers,
                                      const ImageSize& picture, const ObstacleOptions& options);

/// Which ridge belongs to which line; `ridges` by column, from the top. Of the lines of lasers that shine
/// from one place one lies below the other wherever both are seen, whatever stands there. So as many ridges
/// as lines are told apart by their order, fewer by where the floor would show them, in the same order.
std::vector<std::vector<StripePoint>> TellApart(std::span<const StripePoint> ridges,
                                                std::span<const ExpectedLine> lines);

}  // namespace priamos::head
