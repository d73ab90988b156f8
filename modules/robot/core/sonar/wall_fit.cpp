#include "robot/core/sonar/wall_fit.hpp"

#include <Eigen/LU>
#include <cmath>

namespace priamos::robot {
namespace {

/// Ranges over the distance along the wall, in the frame of the newest sensor.
struct Profile {
  Eigen::VectorXd along_m;  ///< from their middle
  Eigen::VectorXd range_m;  ///< as if the sensor had never come nearer to the wall
  double middle_m = 0;
};

/// How far the sensor came nearer along its axis counts by the cosine of the wall's bearing from that axis.
Profile ProfileOf(const std::vector<RangeAt>& series, double bearing_rad) {
  const auto count = static_cast<Eigen::Index>(series.size());
  const Pose2 newest_from_base = series.back().base_from_sonar.Inverse();
  Profile profile{Eigen::VectorXd(count), Eigen::VectorXd(count)};
  for (Eigen::Index k = 0; k < count; ++k) {
    const RangeAt& seen = series[static_cast<std::size_t>(k)];
    const Eigen::Vector2d at = newest_from_base * seen.base_from_sonar.translation();
    profile.along_m(k) = at.y();
    profile.range_m(k) = seen.range_m + at.x() * std::cos(bearing_rad);
  }
  profile.middle_m = profile.along_m.mean();
  profile.along_m.array() -= profile.middle_m;
  return profile;
}

/// Least squares of a polynomial of the distance along the wall.
struct Polynomial {
  Eigen::VectorXd coefficients;
  Eigen::MatrixXd cofactors;  ///< covariance of the coefficients for ranges of variance 1
  double rms_m = 0;
};

Polynomial FitOf(const Profile& profile, int degree) {
  Eigen::MatrixXd a(profile.along_m.size(), degree + 1);
  a.col(0).setOnes();
  for (int k = 1; k <= degree; ++k) a.col(k) = a.col(k - 1).cwiseProduct(profile.along_m);
  Polynomial fit;
  fit.cofactors = (a.transpose() * a).inverse();
  fit.coefficients = fit.cofactors * (a.transpose() * profile.range_m);
  fit.rms_m = std::sqrt((profile.range_m - a * fit.coefficients).squaredNorm() /
                        static_cast<double>(profile.range_m.size()));
  return fit;
}

/// The wall of a line: distance of the middle of the series, and slope.
WallSeen WallOf(const Polynomial& line, const Profile& profile, const Pose2& base_from_newest,
                const WallFitConfig& config) {
  const double off_axis = std::asin(-line.coefficients(1));
  WallSeen wall;
  wall.bearing_rad = WrapAngle(base_from_newest.yaw + off_axis);
  const Eigen::Vector2d normal(std::cos(wall.bearing_rad), std::sin(wall.bearing_rad));
  const Eigen::Vector2d middle = base_from_newest * Eigen::Vector2d(0, profile.middle_m);
  wall.distance_m = line.coefficients(0) + normal.dot(middle);

  const double lever = normal.x() * middle.y() - normal.y() * middle.x();
  Eigen::Matrix2d by_fit;
  by_fit << 0, -1 / std::cos(off_axis), 1, -lever / std::cos(off_axis);
  const Eigen::Vector2d by_drift(1, lever);
  wall.covariance =
      std::pow(config.SigmaOf(line.coefficients(0)), 2) * by_fit * line.cofactors * by_fit.transpose() +
      std::pow(Radians(config.drift_deg), 2) * by_drift * by_drift.transpose();
  return wall;
}

}  // namespace

void WallFitConfig::Describe(Archive& a) {
  a.Integer("least_ranges", least_ranges, {"-", 6, 1000, "ranges in a series"});
  a.Number("most_bearing_deg", most_bearing_deg,
           {"deg", 1, 20, "angle between a sensor's axis and the normal of a wall it hears"});
  a.Number("range_sigma_m", range_sigma_m, {"m", 0.001, 0.1, "noise and rounding of a range, sigma"});
  a.Number("range_sigma_per_m", range_sigma_per_m, {"-", 0, 0.1, "growth of the noise with the range"});
  a.Number("most_rms", most_rms, {"-", 1, 10, "largest RMS of the residuals, in sigmas of a range"});
  a.Number("most_bent", most_bent, {"-", 1, 10, "largest curvature of a wall, in its sigmas"});
  a.Number("sure_sigmas", sure_sigmas,
           {"-", 1, 10, "how sure it must be that a series is no edge's or corner's"});
  a.Number("drift_deg", drift_deg, {"deg", 0, 5, "what the wheels lose of the heading within a series"});
}

std::optional<WallSeen> FitWall(const std::vector<RangeAt>& series, const WallFitConfig& config) {
  constexpr int kIterations = 3;
  if (static_cast<int>(series.size()) < config.least_ranges) return std::nullopt;
  Profile profile;
  Polynomial line;
  double bearing = 0;
  for (int i = 0; i < kIterations; ++i) {
    profile = ProfileOf(series, bearing);
    line = FitOf(profile, 1);
    // Written so that NaN is refused.
    if (!(std::abs(line.coefficients(1)) <= std::sin(Radians(config.most_bearing_deg)))) return std::nullopt;
    bearing = std::asin(-line.coefficients(1));
  }
  const double distance = line.coefficients(0);
  if (distance <= 0 || line.rms_m > config.most_rms * config.SigmaOf(distance)) return std::nullopt;
  const Polynomial curve = FitOf(profile, 2);
  const double curve_sigma = config.SigmaOf(distance) * std::sqrt(curve.cofactors(2, 2));
  if (std::abs(curve.coefficients(2)) > config.most_bent * curve_sigma) return std::nullopt;
  if (curve.coefficients(2) + config.sure_sigmas * curve_sigma > 1 / (2 * distance)) return std::nullopt;
  return WallOf(line, profile, series.back().base_from_sonar, config);
}

}  // namespace priamos::robot
