#include "head/core/look/look_evaluator.hpp"

#include <algorithm>
#include <opencv2/core.hpp>

#include "head/core/doors/model_door.hpp"
#include "head/core/look/look_drift.hpp"

namespace priamos::head {
namespace {

constexpr int kSmallest_px = 64;
constexpr double kLeastBreadthSigma_m = 0.001;

bool IsUsable(const std::optional<GreyImage>& image) {
  return image && image->width >= kSmallest_px && image->height >= kSmallest_px;
}

/// OpenCV's view of the pixels, which the edge operator only reads.
cv::Mat Wrap(const GreyImage& image) {
  return {image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.pixels.data())};
}

LookResult Without(Verdict verdict) {
  LookResult result;
  result.fix.verdict = verdict;
  return result;
}

}  // namespace

LookEvaluator::LookEvaluator(const HeadModel& head, const LookOptions& options)
    : head_(head),
      leaf_options_(options.leaf),
      drift_options_(options.drift),
      edge_operator_(options.edges),
      finder_(options.finder) {}

/// Edges that this look did not show stay where an earlier one saw them.
void LookEvaluator::Remember(const LandmarkModel& model, const LandmarkFix& fix) {
  LandmarkMemory& seen = seen_[model.id];
  if (seen.shifts.size() != model.edges.size()) seen.shifts = fix.edge_shifts;
  for (const EdgeMatch& match : fix.matches) seen.shifts[match.edge] = fix.edge_shifts[match.edge];
  // The calibration's error is the same in every look. A breadth that is exact by the options stays so.
  if (fix.breadth.sigma_m > 0)
    seen.breadth = Breadth{fix.breadth.broader_m, std::max(fix.breadth.sigma_m, kLeastBreadthSigma_m)};
}

/// With the third camera's picture, where it is calibrated and its picture is of use.
LandmarkFix LookEvaluator::Find(const LookInput& input, const LandmarkPrediction& expected,
                                const StereoViews& views) {
  const LandmarkMemory& seen = seen_[input.model->id];
  const auto third = head_.CameraAt(input.setting, kThird);
  if (!third || !IsUsable(input.third)) return finder_.Find(*input.model, expected, views, seen);
  edge_operator_.Extract(Wrap(*input.third), edges_[kThird]);
  const std::array all{views[0], views[1], MakeView(*third, edges_[kThird])};
  return finder_.Find(*input.model, expected, all, seen);
}

LookResult LookEvaluator::Evaluate(const LookInput& input) {
  if (!input.model) return Without(Verdict::kNoModel);
  if (!input.robot) return Without(Verdict::kNoPose);
  if (!std::all_of(input.images.begin(), input.images.end(), IsUsable)) return Without(Verdict::kNoImage);
  // Where the motors stand, not where they were sent: counters have steps.
  const auto left = head_.CameraAt(input.setting, kLeft), right = head_.CameraAt(input.setting, kRight);
  if (!left || !right) return Without(Verdict::kNoImage);
  for (int i = 0; i < 2; ++i) edge_operator_.Extract(Wrap(*input.images[i]), edges_[i]);
  const StereoViews views{MakeView(*left, edges_[0]), MakeView(*right, edges_[1])};
  const LandmarkPrediction expected = Predict(*input.robot, input.model->map_from_landmark);
  LookResult result;
  result.fix = Find(input, expected, views);
  result.n_third = static_cast<int>(std::ranges::count_if(
      result.fix.matches, [](const EdgeMatch& match) { return match.camera == kThird; }));
  if (result.fix.verdict == Verdict::kFound) {
    Remember(*input.model, result.fix);
    if (const auto door = DoorOf(*input.model))
      result.leaf = SeeLeaf(*door, result.fix.base_from_landmark, views, leaf_options_);
  }
  const int camera = CameraToShow(result.fix);
  result.view = ViewLandmark(*input.model, expected, result.fix, views[camera], camera);
  result.drift = MeasureLookDrift(*input.model, result.fix, views, drift_options_);
  return result;
}

}  // namespace priamos::head
