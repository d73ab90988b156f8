#include "test/support/simulated_head.hpp"

#include <cmath>

#include "common/geometry.hpp"

namespace priamos::support {

namespace {

using head::HeadSetting;

/// Half the play behind the motor, on the side it came from.
double Lag(double from, double to, double play) {
  if (to == from) return 0;
  return to > from ? -play / 2 : play / 2;
}

template <class Visit>
void ForEachAngle(HeadSetting& s, const Visit& visit) {
  visit(s.pan_rad, 0);
  visit(s.tilt_rad, 1);
  visit(s.vergence_rad[0], 2);
  visit(s.vergence_rad[1], 3);
}

std::array<double, 4> Angles(HeadSetting s) {
  std::array<double, 4> angles{};
  ForEachAngle(s, [&](double& value, int i) { angles[i] = value; });
  return angles;
}

head::HeadGeometry Built(Rng& rng) {
  head::HeadGeometry g;
  const double mm = 0.001, mrad = 0.004;
  for (double* length : {&g.x_m, &g.y_m, &g.z_m, &g.tilt_axis_x_m}) *length += rng.Normal(mm);
  for (double* angle : {&g.roll_rad, &g.pitch_rad, &g.yaw_rad, &g.tilt_axis_roll_rad})
    *angle += rng.Normal(mrad);
  for (head::CameraMount& c : g.cameras) {
    for (double* length : {&c.x_m, &c.y_m, &c.z_m, &c.side_m}) *length += rng.Normal(mm);
    for (double* angle : {&c.axis_roll_rad, &c.axis_pitch_rad, &c.roll_rad, &c.pitch_rad, &c.yaw_rad}) {
      *angle += rng.Normal(mrad);
    }
  }
  return g;
}

}  // namespace

SimulatedHead::SimulatedHead(std::uint64_t seed, const Motors& motors)
    : motors_(motors), rng_(seed), geometry_(Built(rng_)) {
  for (auto& variation : lens_variation_) {
    for (double& v : variation) v = rng_.Uniform(-1, 1);
  }
  counters_.zoom_step = {650, 650};
  counters_.focus_step = {1600, 1600};
  MoveTo(counters_);
}

void SimulatedHead::MoveTo(const HeadSetting& setting) {
  const std::array<double, 4> before = Angles(counters_), goal = Angles(setting);
  ForEachAngle(axes_.angles, [&](double& axis, int i) {
    // A motor that does not move leaves its axis where it was.
    if (goal[i] != before[i]) {
      axis = goal[i] + Lag(before[i], goal[i], motors_.play_rad) + rng_.Normal(motors_.repeatability_rad);
    }
  });
  for (int c = 0; c < 2; ++c) {
    const auto turn = [&](double& axis, int from, int to) {
      if (from == to && axis != 0) return;
      axis = to + Lag(from, to, motors_.play_steps) + rng_.Normal(motors_.repeatability_steps);
    };
    turn(axes_.zoom[c], counters_.zoom_step[c], setting.zoom_step[c]);
    turn(axes_.focus[c], counters_.focus_step[c], setting.focus_step[c]);
  }
  counters_ = setting;
}

void SimulatedHead::ApproachFromBelow(const HeadSetting& setting) {
  HeadSetting below = setting;
  ForEachAngle(below, [](double& angle, int) { angle -= 0.004; });
  for (int c = 0; c < 2; ++c) {
    below.zoom_step[c] -= 25;
    below.focus_step[c] -= 25;
  }
  MoveTo(below);
  MoveTo(setting);
}

head::LensState SimulatedHead::LensAt(int camera, double zoom, double focus) const {
  const auto& v = lens_variation_[camera];
  const double z = zoom / 2000, f = focus / 2000;
  head::LensState lens;
  lens.focal_px = 800 * (1 + 0.01 * v[0]) * std::pow(2 * (1 + 0.01 * v[1]), z) *
                  (1 + 0.012 * (1 - f) * (1 - 0.3 * z)) * (1 + 0.004 * std::sin(3 * z + v[2]));
  lens.centre_px = {383.5 + 8 * v[3] + 4 * (z - 0.5) + 1.5 * std::sin(4 * z + v[4]) + 0.8 * f,
                    287.5 + 8 * v[5] - 3 * (z - 0.5) + 1.0 * std::cos(5 * z + v[6]) - 0.5 * f};
  lens.k1 = -0.07 + 0.05 * z + 0.004 * std::sin(3 * z) + 0.005 * (1 - f);
  lens.k2 = 0.01 * (1 - z);
  lens.pupil_m = 0.02 * lens.focal_px / 1130 * (1 + 0.2 * v[7]);
  return lens;
}

head::CameraModel SimulatedHead::CameraAt(const Axes& axes, int camera) const {
  const bool third = camera == head::kThird;
  const head::LensState lens =
      third ? LensAt(camera, 1000, 1600) : LensAt(camera, axes.zoom[camera], axes.focus[camera]);
  return head::MakeCameraModel(lens, geometry_.BaseFromCamera(axes.angles, camera, lens.pupil_m));
}

head::CameraModel SimulatedHead::Now(int camera) const {
  return CameraAt(axes_, camera);
}

head::CameraModel SimulatedHead::AfterApproach(const HeadSetting& setting, int camera) const {
  Axes axes{setting, {}, {}};
  ForEachAngle(axes.angles, [&](double& angle, int) { angle -= motors_.play_rad / 2; });
  for (int c = 0; c < 2; ++c) {
    axes.zoom[c] = setting.zoom_step[c] - motors_.play_steps / 2;
    axes.focus[c] = setting.focus_step[c] - motors_.play_steps / 2;
  }
  return CameraAt(axes, camera);
}

std::vector<head::HeadView> Observe(const SimulatedHead& simulated, const ReferenceObject& in_base,
                                    int exposure, double noise_px, Rng& rng) {
  std::vector<head::HeadView> views;
  for (int c = 0; c < head::kCameras; ++c) {
    const head::CameraModel camera = simulated.Now(c);
    head::HeadView view{simulated.counters(), exposure, c, {}};
    for (const ReferenceDisc& disc : in_base.discs) {
      const auto ellipse = head::ProjectDisc(camera.image_from_base, disc);
      if (!ellipse) continue;
      const Eigen::Vector2d px = *head::ProjectDiscCentroid(camera, disc);
      const double margin = ellipse->SemiMajor() + 8;
      if (px.x() < margin || px.x() > 767 - margin || px.y() < margin || px.y() > 575 - margin) continue;
      view.discs.push_back(
          {disc, px + Eigen::Vector2d(rng.Normal(noise_px), rng.Normal(noise_px)), noise_px});
    }
    if (view.discs.size() >= 10) views.push_back(view);
  }
  return views;
}

Eigen::Isometry3d ObjectBeforeHead(double distance_m) {
  return Eigen::Translation3d(0.25 + distance_m, 0, 1.2) * Eigen::AngleAxisd(kPi, Eigen::Vector3d::UnitZ());
}

}  // namespace priamos::support
