#include "planner/core/missions/lost_watch.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/principal_axes.hpp"

namespace priamos::planner {
namespace {

/// One wrong door makes nobody lost, nor does a look at each side of it.
constexpr int kRefused = 4;
/// A robot drives no path with a pose that is known no better.
constexpr double kLost_m = 0.5, kLost_deg = 12;

}  // namespace

void LostWatch::Note(const LookResult& result) {
  if (result.ok || result.placed) n_refused_ = 0;
  n_refused_ += result.implausible;
}

std::optional<std::string> LostWatch::Why(const std::optional<RobotPose>& pose) const {
  if (n_refused_ >= kRefused)
    return fmt::format("{} landmarks in a row were seen where they cannot be by its pose", n_refused_);
  if (!pose) return std::nullopt;
  const double sigma_m = PositionSigma(pose->covariance),
               sigma_deg = Degrees(std::sqrt(pose->covariance(2, 2)));
  if (sigma_m < kLost_m && sigma_deg < kLost_deg) return std::nullopt;
  return fmt::format("its pose is known to {:.1f} m and {:.0f} degrees only", sigma_m, sigma_deg);
}

}  // namespace priamos::planner
