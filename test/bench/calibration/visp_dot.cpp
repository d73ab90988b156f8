// Compiled as C++17: the headers of ViSP 3.5 are no C++20.
#include "test/bench/calibration/visp_dot.hpp"

#ifdef PRIAMOS_HAVE_VISP
#include <visp3/blob/vpDot2.h>

#include <algorithm>
#endif

namespace priamos::bench {

#ifdef PRIAMOS_HAVE_VISP
std::optional<Eigen::Vector2d> VispDot(const Pixels& image, double u, double v) {
  vpImage<unsigned char> view(image.height, image.width);
  std::copy(image.first, image.first + image.width * image.height, view.bitmap);
  vpDot2 dot;
  try {
    dot.initTracking(view, vpImagePoint(v, u));
  } catch (const vpException&) {
    return std::nullopt;
  }
  return Eigen::Vector2d(dot.getCog().get_u(), dot.getCog().get_v());
}
#else
std::optional<Eigen::Vector2d> VispDot(const Pixels&, double, double) {
  return std::nullopt;
}
#endif

}  // namespace priamos::bench
