#include "test/bench/rivals/mrpt_methods.hpp"

#include <mrpt/nav/holonomic/CHolonomicFullEval.h>
#include <mrpt/nav/holonomic/CHolonomicND.h>

#include <cmath>

#include "test/bench/rivals/free_ranges.hpp"

namespace priamos::bench {
namespace {

using mrpt::nav::CAbstractHolonomicReactiveMethod;

/// Places on the way of a direction at which its clearance is told.
constexpr int kClearances = 8;
/// A target nearer than the reach: both methods know of no distance beyond it.
constexpr double kMostTarget = 0.9;

/// Turned so that the target lies ahead, away from where the directions begin and end.
std::vector<Eigen::Vector2d> Turned(const std::vector<Eigen::Vector2d>& points, double by_rad) {
  const Pose2 turned{0, 0, -by_rad};
  std::vector<Eigen::Vector2d> out;
  out.reserve(points.size());
  for (const Eigen::Vector2d& point : points) out.push_back(turned * point);
  return out;
}

class MrptMethod : public Method {
 public:
  MrptMethod(const MrptConfig& config, std::unique_ptr<CAbstractHolonomicReactiveMethod> method,
             bool wants_clearance)
      : config_(config), method_(std::move(method)), wants_clearance_(wants_clearance) {
    method_->enableApproachTargetSlowDown(false);
  }

  Twist2 Choose(const Situation& situation) override {
    const double ahead_rad = std::atan2(situation.target.y(), situation.target.x());
    const auto points = Turned(situation.points, ahead_rad);
    CAbstractHolonomicReactiveMethod::NavInput in;
    in.obstacles = Ranges(points);
    in.targets.emplace_back(std::min(kMostTarget, situation.target.norm() / config_.reach_m), 0);
    in.maxRobotSpeed = situation.speed_m_s;
    const auto clearance = wants_clearance_ ? Clearance(points) : mrpt::nav::ClearanceDiagram();
    in.clearance = &clearance;
    CAbstractHolonomicReactiveMethod::NavOutput out;
    method_->navigate(in, out);
    const double braked_m_s = std::sqrt(0.8 * situation.target.norm());
    const double speed = std::min(out.desiredSpeed, braked_m_s), course = out.desiredDirection + ahead_rad;
    return {speed * std::cos(course), speed * std::sin(course), 0};
  }

 private:
  double Radius() const { return config_.radius_m + config_.margin_m; }
  std::size_t Directions() const { return static_cast<std::size_t>(config_.directions); }

  std::vector<double> Ranges(const std::vector<Eigen::Vector2d>& points) const {
    auto ranges = FreeRanges(points, Radius(), Directions(), config_.reach_m);
    for (double& range : ranges) range /= config_.reach_m;
    return ranges;
  }
  mrpt::nav::ClearanceDiagram Clearance(const std::vector<Eigen::Vector2d>& points) const {
    mrpt::nav::ClearanceDiagram clearance;
    clearance.resize(Directions(), Directions());
    for (std::size_t k = 0; k < Directions(); ++k) {
      const double course = DirectionOf(k, Directions());
      for (int i = 1; i <= kClearances; ++i) {
        const double part = double(i) / kClearances;
        const Eigen::Vector2d at =
            part * config_.reach_m * Eigen::Vector2d(std::cos(course), std::sin(course));
        clearance.get_path_clearance(k)[part] =
            ClearanceAt(points, Radius(), at, config_.reach_m) / config_.reach_m;
      }
    }
    return clearance;
  }

  MrptConfig config_;
  std::unique_ptr<CAbstractHolonomicReactiveMethod> method_;
  bool wants_clearance_;
};

}  // namespace

std::unique_ptr<Method> MrptNearness(const MrptConfig& config) {
  auto method = std::make_unique<mrpt::nav::CHolonomicND>();
  method->options.TOO_CLOSE_OBSTACLE = config.too_close_m / config.reach_m;
  method->options.RISK_EVALUATION_DISTANCE = config.slow_m / config.reach_m;
  method->options.WIDE_GAP_SIZE_PERCENT = config.wide_gap;
  method->options.RISK_EVALUATION_SECTORS_PERCENT = config.risk_sectors;
  if (!config.weights.empty()) method->options.factorWeights = config.weights;
  return std::make_unique<MrptMethod>(config, std::move(method), false);
}

std::unique_ptr<Method> MrptFullEval(const MrptConfig& config) {
  auto method = std::make_unique<mrpt::nav::CHolonomicFullEval>();
  method->options.TOO_CLOSE_OBSTACLE = config.too_close_m / config.reach_m;
  method->options.OBSTACLE_SLOW_DOWN_DISTANCE = config.slow_m / config.reach_m;
  if (!config.weights.empty()) method->options.factorWeights = config.weights;
  if (!config.thresholds.empty()) method->options.PHASE_THRESHOLDS = config.thresholds;
  return std::make_unique<MrptMethod>(config, std::move(method), true);
}

}  // namespace priamos::bench
