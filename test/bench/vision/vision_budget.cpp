#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>

#include "head/core/camera/projection.hpp"
#include "head/core/landmark/edge_observations.hpp"
#include "test/bench/vision/door_looks.hpp"
#include "test/bench/vision/landmark_fixes.hpp"
#include "test/bench/vision/vision_bench.hpp"

namespace priamos::bench {
namespace {

using Cameras = std::array<head::CameraModel, 2>;

/// Which errors there are besides those of edges in the images.
struct Source {
  const char* name;
  bool calibration, placement, model;
};
constexpr Source kSources[] = {{"edges alone", false, false, false},
                               {"edges and calibration", true, false, false},
                               {"edges and reference object's place", false, true, false},
                               {"edges and model's tolerance", false, false, true},
                               {"all", true, true, true}};

/// A look, and the cameras as the same calibration would have them if the object had stood exactly.
struct Sample {
  LandmarkLook look;
  Cameras placed_exactly, misplaced;
};

Sample Take(DoorPhotographer& photographer, std::uint64_t seed) {
  const CalibratedHead head = CalibrateSpecimen(seed), exact = CalibrateSpecimen(seed, true);
  Sample sample{photographer.Take(seed, Trouble::kNone, head), {}, {}};
  for (int c = 0; c < 2; ++c) {
    sample.placed_exactly[c] = *exact.model.CameraAt(sample.look.setting, c);
    sample.misplaced[c] = sample.look.exact[c];
    sample.misplaced[c].image_from_base = sample.look.exact[c].image_from_base * head.misplacement.matrix();
  }
  return sample;
}

const Cameras& CamerasOf(const Sample& sample, const Source& source) {
  if (source.calibration) return source.placement ? sample.look.calibrated : sample.placed_exactly;
  return source.placement ? sample.misplaced : sample.look.exact;
}

/// The finder is told which errors there are.
head::LandmarkFixOptions OptionsOf(const Sample& sample, const Source& source) {
  head::LandmarkFixOptions options = Told(sample.look);
  if (!source.model) options.solver.model_sigma_m = options.solver.tilt_sigma_m = 1e-7;
  if (!source.calibration) options.solver.camera_sigma_px = 1e-5;
  if (!source.placement) options.solver.base_covariance.setZero();
  return options;
}

std::vector<int> VisibleEdges(const LandmarkLook& look) {
  std::vector<int> visible;
  const Eigen::Vector2d viewer = look.truth.Inverse().translation();
  for (std::size_t i = 0; i < look.exact_model.edges.size(); ++i)
    if (look.exact_model.edges[i].IsSeenFrom(viewer)) visible.push_back(static_cast<int>(i));
  return visible;
}

/// How far the edges of an image really lie beside a model without errors in exact cameras: one whole edge at
/// both of its places, all that were found, right ones or not.
void AddEdgeNoise(const LandmarkLook& look, const std::array<head::EdgeImage, 3>& edges,
                  std::vector<double>& distances) {
  const std::array<head::CameraView, 2> views{head::MakeView(look.exact[0], edges[0]),
                                              head::MakeView(look.exact[1], edges[1])};
  const Eigen::Isometry3d truth = head::Lift(look.truth);
  const auto found = head::Associate(look.exact_model, VisibleEdges(look), views, truth, {});
  for (const head::ObservedLine& line :
       head::ObservedLines(head::Observations(look.exact_model, found, views, truth, false))) {
    for (int end = 0; end < line.n; ++end) {
      const auto residual =
          head::ResidualOf(look.exact[line.camera], truth, look.exact_model.edges[line.edge], line.at[end]);
      if (residual) distances.push_back(std::abs(residual->distance_px));
    }
  }
}

/// Every edge of the model that is in view, from end to end, exactly where it is.
std::vector<head::EdgeObservation> Everything(const LandmarkLook& look) {
  constexpr int kPoints = 9;
  std::vector<head::EdgeObservation> observations;
  const Eigen::Isometry3d truth = head::Lift(look.truth);
  for (int c = 0; c < 2; ++c) {
    for (const int index : VisibleEdges(look)) {
      const head::LandmarkEdge& edge = look.exact_model.edges[index];
      const auto seen = head::ProjectEdge(look.exact[c], {look.images[c].cols, look.images[c].rows},
                                          truth * edge.from, truth * edge.to);
      if (!seen) continue;
      for (int i = 0; i < kPoints; ++i)
        observations.push_back({index, c, seen->p + i / (kPoints - 1.0) * (seen->q - seen->p), 1e-6});
    }
  }
  return observations;
}

/// Cramer-Rao bound of (depth, lateral, heading): the covariance of the efficient estimator that uses every
/// edge in view with the noise that edges were measured to have, and knows the distribution of the other
/// errors but not their values.
Eigen::Vector3d Bound(const LandmarkLook& look, head::PoseSolverOptions solver, double edge_sigma_px) {
  solver.edge_sigma_px = edge_sigma_px;
  const std::array<const head::CameraModel*, 2> cameras{&look.exact[0], &look.exact[1]};
  const auto solution =
      head::SolvePose(look.exact_model, cameras, Everything(look), head::Lift(look.truth), solver);
  const Eigen::Matrix<double, 6, 1> variances = solution.covariance.diagonal();
  return {variances[0], variances[1], variances[5]};
}

/// Sums of one row of the table.
struct Row {
  int found = 0;
  Eigen::Vector3d error = Eigen::Vector3d::Zero(), told = error, bound = error;  ///< squares

  Eigen::Vector3d Mean(const Eigen::Vector3d& sum) const { return (sum / std::max(1, found)).cwiseSqrt(); }
  void Print(const char* name, Figures& figures) const {
    const Eigen::Vector3d e = Mean(error), t = Mean(told), b = Mean(bound);
    const auto line = [](const char* what, const Eigen::Vector3d& v) {
      fmt::print("    {:24} {:8.3f} mm {:8.3f} mm {:9.4f} deg\n", what, 1000 * v.x(), 1000 * v.y(),
                 Degrees(v.z()));
    };
    fmt::print("  {}: depth, lateral, heading of {} fixes\n", name, found);
    line("root mean square error", e);
    line("standard deviation told", t);
    line("Cramer-Rao bound", b);
    constexpr const char* kAxes[] = {"depth", "lateral", "heading"};
    for (int k = 0; k < 3; ++k)
      figures.AtMost(fmt::format("    error over Cramer-Rao bound, {}", kAxes[k]), e[k] / b[k], 1.5, "");
  }
};

}  // namespace

void BenchBudget(const VisionOptions& options, Figures& figures) {
  const int n = options.quick ? 12 : 120;
  fmt::print("where the error of a door fix comes from: {} looks, each source of errors alone\n", n);
  DoorPhotographer photographer;
  Fixer fixer;
  std::vector<Sample> samples;
  std::vector<double> noise;
  std::array<Row, std::size(kSources)> rows;
  std::vector<std::array<head::LandmarkFix, std::size(kSources)>> fixes(n);
  for (int i = 0; i < n; ++i) {
    samples.push_back(Take(photographer, options.seed + i));
    const LandmarkLook& look = samples.back().look;
    for (std::size_t s = 0; s < rows.size(); ++s)
      fixes[i][s] = fixer.Find(look, OptionsOf(samples.back(), kSources[s]),
                               kSources[s].model ? look.model : look.exact_model,
                               CamerasOf(samples.back(), kSources[s]));
    AddEdgeNoise(look, fixer.edges, noise);
  }
  const double sigma_px = 1.4826 * Quantile(noise, 0.5);
  figures.Note("  noise of a whole edge at either end, cameras and model exact", sigma_px, "px");
  for (std::size_t s = 0; s < rows.size(); ++s) {
    for (int i = 0; i < n; ++i) {
      const LandmarkLook& look = samples[i].look;
      const head::LandmarkFix& fix = fixes[i][s];
      const Eigen::Vector3d error = ErrorOf(fix.base_from_landmark, look.truth);
      if (fix.verdict != head::Verdict::kFound || !IsGood(error)) continue;
      ++rows[s].found;
      rows[s].error += error.cwiseAbs2();
      rows[s].told += fix.covariance.diagonal();
      rows[s].bound += Bound(look, OptionsOf(samples[i], kSources[s]).solver, sigma_px);
    }
    rows[s].Print(kSources[s].name, figures);
  }
}

}  // namespace priamos::bench
