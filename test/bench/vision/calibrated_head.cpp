#include <fmt/format.h>

#include <stdexcept>

#include "common/geometry.hpp"
#include "head/core/calibration/discs/disc_projection.hpp"
#include "head/core/calibration/rig/calibration_plan.hpp"
#include "head/core/calibration/rig/head_solver.hpp"
#include "test/bench/vision/landmark_looks.hpp"
#include "test/bench/vision/true_axes.hpp"
#include "test/support/calibration_scene.hpp"
#include "test/support/image_from_base.hpp"

namespace priamos::bench {
namespace {

constexpr double kDetector_px = 0.02;
constexpr double kPlace_m = 0.0005, kTurn_deg = 0.05;  // as config/sim/head.toml declares them
const Eigen::Vector3d kStand(2.05, 0, 1.2);

/// The look's zoom and focus lie in the middle of this grid.
head::CalibrationPlan PlanAroundLooks() {
  head::CalibrationPlan plan;
  plan.zoom = {50, 450, 3};
  plan.focus = {1400, 1800, 2};
  return plan;
}

/// Placement of the object by a person, a little beside where it should be, as the motion of space from there
/// to here.
Eigen::Isometry3d Misplaced(Rng& rng) {
  Eigen::Isometry3d motion(Eigen::Translation3d(
      kStand + Eigen::Vector3d(rng.Normal(kPlace_m), rng.Normal(kPlace_m), rng.Normal(kPlace_m))));
  const Eigen::Vector3d turn =
      Radians(kTurn_deg) * Eigen::Vector3d(rng.Normal(1), rng.Normal(1), rng.Normal(1));
  motion.rotate(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
  motion.translate(-kStand);
  return motion;
}

std::vector<head::DiscObservation> Observe(const head::CameraModel& camera, const ReferenceObject& real,
                                           const ReferenceObject& supposed, Rng& rng) {
  std::vector<head::DiscObservation> discs;
  for (std::size_t i = 0; i < real.discs.size(); ++i) {
    const auto px = head::ProjectDiscCentroid(camera, real.discs[i]);
    if (!px || px->x() < 20 || px->x() > 747 || px->y() < 20 || px->y() > 555) continue;
    const Eigen::Vector2d noise(rng.Normal(kDetector_px), rng.Normal(kDetector_px));
    discs.push_back({supposed.discs[i], *px + noise, kDetector_px});
  }
  return discs;
}

}  // namespace

world::HeadAxes RestAfter(const head::HeadSetting& setting, Rng& rng) {
  constexpr double kAnglePlay = 0.0004, kVergencePlay = 0.0003, kStepPlay = 6;
  const auto angle = [&](double counter, double play) { return counter - play / 2 + rng.Normal(0.00003); };
  const auto step = [&](double counter) { return counter - kStepPlay / 2 + rng.Normal(0.4); };
  world::HeadAxes axes;
  axes.pan_rad = angle(setting.pan_rad, kAnglePlay);
  axes.tilt_rad = angle(setting.tilt_rad, kAnglePlay);
  for (int c = 0; c < 2; ++c) {
    axes.vergence_rad[c] = angle(setting.vergence_rad[c], kVergencePlay);
    axes.zoom_step[c] = step(setting.zoom_step[c]);
    axes.focus_step[c] = step(setting.focus_step[c]);
  }
  return axes;
}

head::CameraModel ExactCamera(const world::HeadBuild& build, int camera, const world::HeadAxes& axes) {
  const world::TrueCamera real = world::CameraAt(build, static_cast<world::Camera>(camera), axes);
  return {world::ImageFromBase(real), real.centre_px, real.focal_px, real.k1, real.k2};
}

namespace {

CalibratedHead Calibrate(std::uint64_t seed, bool exactly_placed, const head::CalibrationPlan& plan) {
  Rng rng = Rng::Stream(seed, "calibration");
  CalibratedHead head{world::HeadBuild::Specimen(seed), {}, Misplaced(rng)};
  if (exactly_placed) head.misplacement.setIdentity();
  Eigen::Isometry3d nominal(Eigen::Translation3d(kStand) * Eigen::AngleAxisd(kPi, Eigen::Vector3d::UnitZ()));
  const ReferenceObject object = support::ShippedReferenceObject(), supposed = object.Moved(nominal),
                        real = object.Moved(head.misplacement * nominal);
  std::vector<head::HeadView> views;
  int exposure = 0;
  for (const head::HeadSetting& setting : plan.Settings()) {
    const world::HeadAxes axes = RestAfter(setting, rng);
    for (int c = 0; c < head::kCameras; ++c) {
      head::HeadView view{setting, exposure, c,
                          Observe(ExactCamera(head.build, c, axes), real, supposed, rng)};
      if (view.discs.size() >= 10) views.push_back(std::move(view));
    }
    ++exposure;
  }
  auto solved = head::SolveHead(views);
  if (!solved)
    throw std::runtime_error(fmt::format("specimen {}: not calibrated: {}", seed, solved.reason()));
  head.model = std::move(solved->model);
  head.model.base_covariance = head::PlacementCovariance(kStand, kPlace_m, Radians(kTurn_deg));
  return head;
}

}  // namespace

CalibratedHead CalibrateSpecimen(std::uint64_t seed, bool exactly_placed) {
  return Calibrate(seed, exactly_placed, PlanAroundLooks());
}

CalibratedHead CalibrateSpecimenWholly(std::uint64_t seed) {
  return Calibrate(seed, false, {});
}

}  // namespace priamos::bench
