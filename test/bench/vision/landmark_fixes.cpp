#include "test/bench/vision/landmark_fixes.hpp"

#include <algorithm>
#include <cmath>

#include "head/vision_options.hpp"
#include "test/bench/figures.hpp"

namespace priamos::bench {

Eigen::Vector3d ErrorOf(const Pose2& found, const Pose2& truth) {
  return {found.x - truth.x, found.y - truth.y, WrapAngle(found.yaw - truth.yaw)};
}

bool IsGood(const Eigen::Vector3d& error) {
  return error.head<2>().norm() < 0.03 && std::abs(error.z()) < Radians(1);
}

double Quantile(std::vector<double> values, double share) {
  if (values.empty()) return 1e9;
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1, static_cast<std::size_t>(share * values.size()))];
}

head::LandmarkFixOptions Told(const LandmarkLook& look) {
  head::HeadModel head;
  head.base_covariance = look.base_covariance;
  return head::FinderOptions(head::VisionConfig(), head);
}

head::LandmarkFix Fixer::Find(const LandmarkLook& look, const head::LandmarkFixOptions& options,
                              const head::LandmarkModel& model,
                              const std::array<head::CameraModel, 2>& cameras) {
  const double start = CpuSeconds();
  for (int c = 0; c < 2; ++c) edge_operator.Extract(look.images[c], edges[c]);
  const bool third = with_third && !look.third.empty();
  if (third) edge_operator.Extract(look.third, edges[head::kThird]);
  edge_seconds = CpuSeconds() - start;
  std::vector<head::CameraView> views{MakeView(cameras[0], edges[0]), MakeView(cameras[1], edges[1])};
  if (third) views.push_back(MakeView(look.third_calibrated, edges[head::kThird]));
  const head::LandmarkFix fix =
      head::LandmarkFinder(options).Find(model, {look.believed, look.belief}, views);
  seconds = CpuSeconds() - start;
  return fix;
}

}  // namespace priamos::bench
