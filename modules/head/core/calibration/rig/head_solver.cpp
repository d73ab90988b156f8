#include "head/core/calibration/rig/head_solver.hpp"

#include <ceres/problem.h>
#include <ceres/solver.h>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "head/core/calibration/resection/camera_parameters.hpp"
#include "head/core/calibration/rig/head_costs.hpp"
#include "head/core/calibration/rig/head_residuals.hpp"
#include "head/core/calibration/targets/camera_calibration.hpp"

namespace priamos::head {

namespace {

using Eigen::Vector2d;

constexpr int kPasses = 3;
constexpr double kWorst_px = 1;
constexpr double kSigmaFloor_px = 0.02;  // of what the model leaves out

template <int N>
void AddNear(ceres::Problem& problem, double* block, const std::array<double, N>& mean,
             const std::array<double, N>& sigma) {
  problem.AddResidualBlock(NewCost(Near<N>{mean, sigma}), nullptr, block);
}

std::array<double, kHead> HeadBlock(const HeadGeometry& g) {
  return {g.x_m, g.y_m, g.z_m, g.roll_rad, g.pitch_rad, g.yaw_rad, g.tilt_axis_x_m, g.tilt_axis_roll_rad};
}
std::array<double, kMount> MountBlock(const CameraMount& m) {
  return {m.x_m,    m.y_m,      m.z_m,       m.axis_roll_rad, m.axis_pitch_rad,
          m.side_m, m.roll_rad, m.pitch_rad, m.yaw_rad};
}
CameraMount MountFrom(const std::array<double, kMount>& b) {
  return {b[0], b[1], b[2], b[3], b[4], b[5], b[6], b[7], b[8]};
}
LensState LensFrom(const std::array<double, kLens>& b) {
  return {std::exp(b[0]), {b[1], b[2]}, b[3], b[4], b[5]};
}

/// Which lens state a view belongs to.
using LensKey = std::array<int, 3>;  // camera, zoom, focus

LensKey KeyOf(const HeadView& view) {
  if (view.camera == kThird) return {kThird, 0, 0};
  return {view.camera, view.setting.zoom_step[view.camera], view.setting.focus_step[view.camera]};
}

/// The unknowns of the whole problem.
struct Unknowns {
  std::array<double, kHead> head;
  std::array<std::array<double, kMount>, kCameras> mounts;
  std::map<LensKey, std::array<double, kLens>> lenses;
  std::map<int, std::array<double, kJitter>> jitter;
};

HeadGeometry GeometryFrom(const Unknowns& x) {
  HeadGeometry g;
  const auto& h = x.head;
  g.x_m = h[0];
  g.y_m = h[1];
  g.z_m = h[2];
  g.roll_rad = h[3];
  g.pitch_rad = h[4];
  g.yaw_rad = h[5];
  g.tilt_axis_x_m = h[6];
  g.tilt_axis_roll_rad = h[7];
  for (int c = 0; c < kCameras; ++c) g.cameras[c] = MountFrom(x.mounts[c]);
  return g;
}

/// The camera at one exposure as the solution has it, errors of the motors included.
CameraModel CameraOf(const Unknowns& x, const HeadView& view) {
  HeadSetting setting = view.setting;
  const auto& jitter = x.jitter.at(view.exposure);
  setting.pan_rad += jitter[0];
  setting.tilt_rad += jitter[1];
  for (int i = 0; i < 2; ++i) setting.vergence_rad[i] += jitter[2 + i];
  const LensState lens = LensFrom(x.lenses.at(KeyOf(view)));
  return MakeCameraModel(lens, GeometryFrom(x).BaseFromCamera(setting, view.camera, lens.pupil_m));
}

std::optional<Refusal> CheckViews(const std::vector<HeadView>& views) {
  if (views.empty()) return Refusal{"there are no views"};
  for (const HeadView& view : views) {
    if (view.camera < 0 || view.camera >= kCameras)
      return Refusal{fmt::format("there is no camera {}", view.camera)};
    for (const DiscObservation& o : view.discs) {
      if (!o.centroid_px.allFinite() || !o.disc.centre_m.allFinite())
        return Refusal{"a disc is not a finite number"};
    }
  }
  return std::nullopt;
}

/// Focal lengths from every view alone; everything else as the drawing has it.
Outcome<Unknowns> Start(const std::vector<HeadView>& views, const HeadKnowledge& known) {
  Unknowns x{HeadBlock(known.drawing), {}, {}, {}};
  for (int c = 0; c < kCameras; ++c) x.mounts[c] = MountBlock(known.drawing.cameras[c]);
  for (const HeadView& view : views) {
    x.jitter[view.exposure] = {};
    auto [lens, is_new] = x.lenses.try_emplace(KeyOf(view));
    if (!is_new) continue;
    const Outcome<CameraCalibration> alone = CalibrateFromDiscs(view.discs, known.lens);
    if (!alone) return Refusal{fmt::format("camera {}: {}", view.camera, alone.reason())};
    const auto parameters = ExtractParameters(alone->model.image_from_base);
    if (!parameters) return Refusal{parameters.reason()};
    lens->second = {std::log(parameters->focal_u_px),
                    known.lens.centre_px.x(),
                    known.lens.centre_px.y(),
                    0,
                    0,
                    known.pupil_m};
  }
  return x;
}

/// Adds residuals of smoothness, each for three nodes in a row, in one direction (1 zoom, 2 focus) of the
/// grid.
void AddSmoothness(Unknowns& x, int direction, ceres::Problem& problem) {
  std::map<LensKey, std::vector<double*>> rows;  // by what stays the same; a map is in order of the steps
  for (auto& [key, block] : x.lenses) {
    LensKey row = key;
    row[direction] = 0;
    rows[row].push_back(block.data());
  }
  for (const auto& [row, nodes] : rows) {
    for (std::size_t i = 1; i + 1 < nodes.size(); ++i) {
      problem.AddResidualBlock(NewCost(Smooth{}), nullptr, nodes[i - 1], nodes[i], nodes[i + 1]);
    }
  }
}

void AddPriors(const HeadKnowledge& known, Unknowns& x, ceres::Problem& problem) {
  const double l = known.length_sigma_m, a = known.angle_sigma_rad;
  AddNear<kHead>(problem, x.head.data(), HeadBlock(known.drawing), {l, l, l, a, a, a, l, a});
  for (int c = 0; c < kCameras; ++c) {
    AddNear<kMount>(problem, x.mounts[c].data(), MountBlock(known.drawing.cameras[c]),
                    {l, l, l, a, a, l, a, a, a});
  }
  const LensKnowledge& lens = known.lens;
  for (auto& [key, block] : x.lenses) {
    AddNear<kLens>(
        problem, block.data(), {block[0], lens.centre_px.x(), lens.centre_px.y(), 0, 0, known.pupil_m},
        {1e3, lens.centre_sigma_px, lens.centre_sigma_px, lens.k1_sigma, lens.k2_sigma, known.pupil_sigma_m});
  }
  for (const int direction : {1, 2}) AddSmoothness(x, direction, problem);
  const double r = known.repeatability_rad;
  for (auto& [exposure, block] : x.jitter) AddNear<kJitter>(problem, block.data(), {}, {r, r, r, r});
}

std::string Minimise(const std::vector<HeadView>& views, const HeadKnowledge& known, bool use_bias,
                     Unknowns& x) {
  ceres::Problem problem;
  for (const HeadView& view : views) {
    const CameraModel camera = CameraOf(x, view);
    for (const DiscObservation& o : view.discs) {
      const Vector2d bias = use_bias ? CentroidBias(camera, o.disc) : Vector2d::Zero();
      problem.AddResidualBlock(
          NewCost(HeadReprojection{view.setting, view.camera, o.disc.centre_m, o.centroid_px - bias,
                                   std::max(kSigmaFloor_px, o.sigma_px)}),
          nullptr, x.head.data(), x.mounts[view.camera].data(), x.lenses.at(KeyOf(view)).data(),
          x.jitter.at(view.exposure).data());
    }
  }
  AddPriors(known, x, problem);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = 100;
  options.function_tolerance = 1e-9;
  options.parameter_tolerance = 1e-10;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return summary.IsSolutionUsable() ? "" : "the solution did not converge: " + summary.message;
}

Outcome<LensTable> TableOf(int camera, const Unknowns& x) {
  std::set<int> zoom, focus;
  for (const auto& [key, block] : x.lenses) {
    if (key[0] != camera) continue;
    zoom.insert(key[1]);
    focus.insert(key[2]);
  }
  std::vector<LensState> nodes;
  for (const int z : zoom) {
    for (const int f : focus) {
      const auto node = x.lenses.find({camera, z, f});
      if (node == x.lenses.end()) {
        return Refusal{fmt::format("camera {} has no view with zoom {} and focus {}", camera, z, f)};
      }
      nodes.push_back(LensFrom(node->second));
    }
  }
  return LensTable({zoom.begin(), zoom.end()}, {focus.begin(), focus.end()}, std::move(nodes));
}

void FillErrors(const std::vector<HeadView>& views, const Unknowns& x, HeadCalibration& result) {
  std::size_t n = 0;
  for (const HeadView& view : views) {
    const CameraModel camera = CameraOf(x, view);
    double sum = 0;
    for (const DiscObservation& o : view.discs) {
      const Vector2d shown = camera.Distort(camera.Project(o.disc.centre_m)) + CentroidBias(camera, o.disc);
      result.residuals_px.push_back(o.centroid_px - shown);
      sum += result.residuals_px.back().norm();
    }
    result.view_error_px.push_back(view.discs.empty() ? 0 : sum / view.discs.size());
    result.mean_error_px += sum;
    n += view.discs.size();
  }
  if (n > 0) result.mean_error_px /= n;
}

}  // namespace

Outcome<HeadCalibration> SolveHead(const std::vector<HeadView>& views, const HeadKnowledge& known) {
  if (const auto refusal = CheckViews(views)) return *refusal;
  Outcome<Unknowns> x = Start(views, known);
  if (!x) return Refusal{x.reason()};
  for (int pass = 0; pass < kPasses; ++pass) {
    if (std::string reason = Minimise(views, known, pass > 0, *x); !reason.empty()) return Refusal{reason};
  }
  HeadCalibration result;
  result.model.geometry = GeometryFrom(*x);
  for (int c = 0; c < kCameras; ++c) {
    const bool seen =
        std::any_of(views.begin(), views.end(), [&](const HeadView& v) { return v.camera == c; });
    if (!seen) continue;
    const Outcome<LensTable> table = TableOf(c, *x);
    if (!table) return Refusal{table.reason()};
    result.model.lenses[c] = *table;
  }
  FillErrors(views, *x, result);
  if (!(result.mean_error_px < kWorst_px)) {
    return Refusal{
        fmt::format("the discs are {:.2f} px from where the best head sees them", result.mean_error_px)};
  }
  return result;
}

}  // namespace priamos::head
