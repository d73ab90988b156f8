#include "head/core/calibration/rig/progress_bar.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace priamos::head {

std::string ProgressBar(int done, int total, double seconds) {
  constexpr int kWidth = 20;
  const double share = total > 0 ? std::clamp(static_cast<double>(done) / total, 0.0, 1.0) : 1;
  const int full = static_cast<int>(std::floor(share * kWidth + 1e-9));
  std::string bar =
      fmt::format("[{:#<{}}{:.<{}}] {:3.0f} %", "", full, "", kWidth - full, std::floor(100 * share + 1e-9));
  if (done <= 0 || done >= total || !(seconds >= 0)) return bar;
  const auto left = static_cast<long>(std::lround(seconds * (total - done) / done));
  return bar + fmt::format(", {}:{:02} left", left / 60, left % 60);
}

}  // namespace priamos::head
