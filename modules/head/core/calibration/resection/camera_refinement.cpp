#include "head/core/calibration/resection/camera_refinement.hpp"

#include <ceres/ceres.h>
#include <ceres/rotation.h>

#include <array>
#include <optional>
#include <string>

#include "head/core/calibration/resection/camera_parameters.hpp"

namespace priamos::head {

namespace {

/// The unknowns of a view: rotation (angle-axis) and translation camera_from_base.
enum ViewUnknown { kRotation = 0, kTranslation = 3, kViewUnknowns = 6 };
/// The unknowns of the lens: log of the focal length, image centre, aspect ratio, skew, k1, k2.
enum LensUnknown { kLogFocal = 0, kCentre = 1, kAspect = 3, kSkew, kK1, kK2, kLensUnknowns };
using ViewUnknowns = std::array<double, kViewUnknowns>;
using LensUnknowns = std::array<double, kLensUnknowns>;

/// The distorted image of a point.
template <class T>
void ProjectPoint(const T* view, const T* x, const Eigen::Vector3d& point_m, T* px) {
  const T in_base[3] = {T(point_m.x()), T(point_m.y()), T(point_m.z())};
  T p[3];
  ceres::AngleAxisRotatePoint(view + kRotation, in_base, p);
  for (int i = 0; i < 3; ++i) p[i] += view[kTranslation + i];
  const T focal = exp(x[kLogFocal]);
  const T a = p[0] / p[2], b = p[1] / p[2];
  // Image offsets in units of the focal length, as CameraModel's distortion takes them.
  const T du = a + x[kSkew] * b, dv = b * x[kAspect];
  const T r2 = du * du + dv * dv;
  const T stretch = T(1) + r2 * (x[kK1] + r2 * x[kK2]);
  px[0] = x[kCentre] + focal * du * stretch;
  px[1] = x[kCentre + 1] + focal * dv * stretch;
}

struct Reprojection {
  Eigen::Vector3d point_m;
  Eigen::Vector2d image_px;
  double sigma_px;

  template <class T>
  bool operator()(const T* view, const T* lens, T* residual) const {
    T px[2];
    ProjectPoint(view, lens, point_m, px);
    residual[0] = (px[0] - T(image_px.x())) / T(sigma_px);
    residual[1] = (px[1] - T(image_px.y())) / T(sigma_px);
    return true;
  }
};

struct Knowledge {
  LensKnowledge lens;

  template <class T>
  bool operator()(const T* x, T* residual) const {
    residual[0] = (x[kCentre] - T(lens.centre_px.x())) / T(lens.centre_sigma_px);
    residual[1] = (x[kCentre + 1] - T(lens.centre_px.y())) / T(lens.centre_sigma_px);
    residual[2] = (x[kAspect] - T(lens.aspect)) / T(lens.aspect_sigma);
    residual[3] = x[kSkew] / T(lens.skew_sigma_rad);
    residual[4] = x[kK1] / T(lens.k1_sigma);
    residual[5] = x[kK2] / T(lens.k2_sigma);
    return true;
  }
};

ViewUnknowns ToView(const CameraParameters& p) {
  ViewUnknowns x{};
  Eigen::Map<Eigen::Vector3d>(x.data() + kTranslation) = -p.camera_from_base * p.centre_m;
  const Eigen::Matrix3d rotation = p.camera_from_base;
  ceres::RotationMatrixToAngleAxis(rotation.data(), x.data() + kRotation);  // both column-major
  return x;
}

LensUnknowns ToLens(const CameraParameters& p, const CameraModel& start) {
  LensUnknowns x{};
  x[kLogFocal] = std::log(p.focal_u_px);
  x[kCentre] = p.principal_px.x();
  x[kCentre + 1] = p.principal_px.y();
  x[kAspect] = p.focal_v_px / p.focal_u_px;
  x[kSkew] = -1 / std::tan(p.axes_angle_rad);
  const double unit = p.focal_u_px / start.scale_px;
  x[kK1] = start.k1 * unit * unit;
  x[kK2] = start.k2 * unit * unit * unit * unit;
  return x;
}

CameraModel ToModel(const ViewUnknowns& view, const LensUnknowns& x) {
  CameraModel model;
  Eigen::Matrix3d rotation;
  ceres::AngleAxisToRotationMatrix(view.data() + kRotation, rotation.data());
  const double focal = std::exp(x[kLogFocal]);
  Eigen::Matrix3d k;
  k << focal, focal * x[kSkew], x[kCentre], 0, focal * x[kAspect], x[kCentre + 1], 0, 0, 1;
  model.image_from_base << k * rotation, k * Eigen::Map<const Eigen::Vector3d>(view.data() + kTranslation);
  model.centre_px = {x[kCentre], x[kCentre + 1]};
  model.scale_px = focal;
  model.k1 = x[kK1];
  model.k2 = x[kK2];
  return model;
}

/// The image centre from a DLT matrix of one view may be far outside of the image; the least squares then
/// starts from what the lens is known to be.
CameraParameters Plausible(CameraParameters p, const LensKnowledge& lens) {
  if ((p.principal_px - lens.centre_px).norm() > 10 * lens.centre_sigma_px) p.principal_px = lens.centre_px;
  return p;
}

void AddView(const RefinementView& view, double* pose, double* lens, ceres::Problem& problem) {
  for (std::size_t i = 0; i < view.observations.size(); ++i) {
    const DiscObservation& o = view.observations[i];
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<Reprojection, 2, kViewUnknowns, kLensUnknowns>(
                                 new Reprojection{o.disc.centre_m, o.centroid_px - view.bias[i], o.sigma_px}),
                             nullptr, pose, lens);
  }
}

std::optional<std::string> Solve(ceres::Problem& problem) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 60;
  options.function_tolerance = 1e-12;
  options.parameter_tolerance = 1e-12;
  options.gradient_tolerance = 1e-14;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) return "the refinement did not converge: " + summary.message;
  return std::nullopt;
}

}  // namespace

Outcome<std::vector<CameraModel>> RefineViews(std::span<const RefinementView> views,
                                              const LensKnowledge& lens) {
  if (views.empty()) return Refusal{"there is no view to refine"};
  std::vector<ViewUnknowns> poses(views.size());
  LensUnknowns shared{};
  ceres::Problem problem;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const CameraModel& start = views[i].start;
    const Outcome<CameraParameters> parameters = ExtractParameters(start.image_from_base);
    if (!parameters) return Refusal{parameters.reason()};
    for (const DiscObservation& o : views[i].observations)
      if (!(start.Depth(o.disc.centre_m) > 0)) return Refusal{"a disc would lie behind the camera"};
    const CameraParameters plausible = Plausible(*parameters, lens);
    poses[i] = ToView(plausible);
    if (i == 0) shared = ToLens(plausible, start);
    AddView(views[i], poses[i].data(), shared.data(), problem);
  }
  problem.AddResidualBlock(new ceres::AutoDiffCostFunction<Knowledge, 6, kLensUnknowns>(new Knowledge{lens}),
                           nullptr, shared.data());
  if (const auto problem_found = Solve(problem)) return Refusal{*problem_found};
  std::vector<CameraModel> models;
  for (const ViewUnknowns& pose : poses) {
    models.push_back(ToModel(pose, shared));
    if (!models.back().image_from_base.allFinite())
      return Refusal{"the refinement ended in numbers that are none"};
  }
  return models;
}

Outcome<CameraModel> RefineCamera(std::span<const DiscObservation> observations,
                                  std::span<const Eigen::Vector2d> bias, const CameraModel& start,
                                  const LensKnowledge& lens) {
  const RefinementView view{observations, bias, start};
  const auto models = RefineViews({&view, 1}, lens);
  if (!models) return Refusal{models.reason()};
  return models->front();
}

}  // namespace priamos::head
