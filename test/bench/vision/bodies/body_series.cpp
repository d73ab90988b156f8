#include "test/bench/vision/bodies/body_series.hpp"

#include <fmt/format.h>

#include "common/geometry.hpp"
#include "head/core/bodies/free_model_fix.hpp"
#include "head/core/edges/scale_edges.hpp"

namespace priamos::bench {
namespace {

void PrintLook(const BodyScene& scene, int k, const head::FreeModelFix& fix, double blur_px) {
  const double distance_m = scene.truth.translation().norm();
  const Eigen::Isometry3d error = scene.truth.inverse() * fix.base_from_model;
  fmt::print(
      "  {} {}: {}, {:.2f} % {:.2f} deg, sigma {:.2f} %, {} edges, {:.2f} px, misfit {:.2f}, odds {:.1f} "
      "covered {:.2f} ends {:.2f} "
      "agreement {:.2f} lead {:.1f}, sigma turn {:.2f} deg, blur {:.1f} px\n",
      scene.kind, k, head::Describe(fix.verdict),
      100 * (fix.base_from_model.translation() - scene.truth.translation()).norm() / distance_m,
      Degrees(Eigen::AngleAxisd(error.linear()).angle()),
      100 * std::sqrt(fix.covariance.topLeftCorner<3, 3>().trace()) / distance_m, fix.n_matched,
      fix.residual_px, fix.misfit, fix.log_odds, fix.agreement.covered, fix.agreement.ends,
      fix.agreement.Value(fix.misfit), fix.log_odds - fix.rival_log_odds,
      Degrees(std::sqrt(fix.covariance.bottomRightCorner<3, 3>().trace())), blur_px);
}

}  // namespace

std::string BodyStart::Words() const {
  return fmt::format("begun {:.0f} % and {:.0f} degrees beside the truth", 100 * share, turn_deg);
}

void AddStarts(const BodyScene& scene, const BodyStart& start, int n, Rng& rng, bool verbose,
               BodyTally& tally) {
  head::ScaleEdgeOperator edge_operator;
  const double distance_m = scene.truth.translation().norm();
  for (int k = 0; k < n; ++k) {
    const Eigen::Isometry3d believed =
        Beside(scene.truth, start.share * distance_m, Radians(start.turn_deg), rng);
    const double begin = CpuSeconds();
    head::BlurredEdges blurred;
    edge_operator.Extract(scene.image, blurred);
    head::CameraView view = head::MakeView(scene.camera, blurred.edges);
    view.blur_px = blurred.MedianBlur();
    view.image = &scene.image;
    const auto fix = head::LocateFreeModel(scene.model, believed, {&view, 1}, {});
    tally.Add(fix, scene.truth, CpuSeconds() - begin);
    if (verbose) PrintLook(scene, k, fix, view.blur_px);
  }
}

}  // namespace priamos::bench
