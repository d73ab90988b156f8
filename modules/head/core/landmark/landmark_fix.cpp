#include "head/core/landmark/landmark_fix.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "head/core/landmark/other_breadth.hpp"
#include "head/core/landmark/prediction.hpp"

namespace priamos::head {
namespace {

constexpr std::size_t kRefineBest = 8;
constexpr double kSameAnswer = 9;  ///< squared Mahalanobis distance, 3 degrees of freedom

Eigen::Matrix3d OnFloor(const Eigen::Matrix<double, 6, 6>& covariance) {
  constexpr std::array<int, 3> kAxes{0, 1, 5};
  Eigen::Matrix3d floor;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) floor(r, c) = covariance(kAxes[r], kAxes[c]);
  }
  return floor;
}

/// Whether two poses are so near that refinement leads to the same one.
bool IsSame(const Pose2& a, const Pose2& b) {
  return (a.translation() - b.translation()).norm() < 0.004 && std::abs(WrapAngle(a.yaw - b.yaw)) < 0.002;
}

/// Refines all starts; many lead to the same pose, which is refined only once.
std::vector<RefinedPose> RefineAll(std::vector<RefinedPose> starts, const PoseRefinement& refinement) {
  std::vector<RefinedPose> approached, refined;
  for (RefinedPose& pose : starts) {
    if (!refinement.Approach(pose)) continue;
    const bool known = std::any_of(approached.begin(), approached.end(), [&](const RefinedPose& other) {
      return IsSame(other.base_from_landmark, pose.base_from_landmark);
    });
    if (known) continue;
    approached.push_back(pose);
    refinement.Refine(pose);
    if (pose.solution.ok) refined.push_back(std::move(pose));
  }
  return refined;
}

bool IsDistinct(const Pose2& a, const Pose2& b, const LandmarkFixOptions& options) {
  return (a.translation() - b.translation()).norm() > options.distinct_m ||
         std::abs(WrapAngle(a.yaw - b.yaw)) > options.distinct_rad;
}

/// Edges that should be seen of a landmark near its prediction, in all pictures together.
std::size_t CountPredicted(const LandmarkModel& model, const LandmarkPrediction& prediction,
                           const Eigen::Matrix3d& search, std::span<const CameraView> views) {
  std::size_t n = 0;
  for (const CameraView& view : views)
    n += PredictEdges(model, prediction.base_from_landmark, search, *view.camera, view.size).size();
  return n;
}

/// Poses near `expected` at which upright edges of the model meet those that both pictures show.
Proposals Propose(const LandmarkModel& model, const Pose2& expected, const Eigen::Matrix3d& search,
                  std::span<const CameraView> views, const LandmarkFixOptions& options) {
  const auto verticals = MatchVerticals(views[0], views[1], options.stereo);
  ProposalOptions proposal_options = options.proposals;
  proposal_options.gate = options.gate_elsewhere;
  const double margin_rad = 3 * std::sqrt(search(2, 2)) + 0.1;
  return ProposePoses(model, VisibleAt(model, expected, margin_rad), verticals, expected, search,
                      proposal_options);
}

/// Poses beside the prediction, so densely that one lies within the first gate: from near a picture holds too
/// little of a landmark to propose one.
void AddPredicted(const Pose2& predicted, const Eigen::Matrix3d& search, std::vector<PoseProposal>& poses) {
  constexpr double kStep_m = 0.008;
  const int steps = static_cast<int>(2 * std::sqrt(search(1, 1)) / kStep_m);
  for (int k = -steps; k <= steps; ++k)
    poses.push_back({{predicted.x, predicted.y + k * kStep_m, predicted.yaw}});
}

/// Shifts of the edges of a landmark that is broader than its model by so much.
EdgeShifts ShiftsOfBreadth(const LandmarkModel& model, double broader_m) {
  EdgeShifts shifts;
  shifts.reserve(model.edges.size());
  for (const LandmarkEdge& edge : model.edges) shifts.emplace_back(0, broader_m * edge.ByBreadth(), 0);
  return shifts;
}

}  // namespace

const char* Describe(Verdict verdict) {
  switch (verdict) {
    case Verdict::kFound:
      return "found";
    case Verdict::kNoModel:
      return "no model of this landmark";
    case Verdict::kNoPose:
      return "the robot has no pose for the time of the picture";
    case Verdict::kNoImage:
      return "no usable image";
    case Verdict::kNotVisible:
      return "too few of its edges can be in the picture";
    case Verdict::kTooFewEdges:
      return "too few of its edges were found";
    case Verdict::kAmbiguous:
      return "two poses explain the picture equally well";
    case Verdict::kResidualTooLarge:
      return "the model does not fit";
    case Verdict::kElsewhere:
      return "it is not where it was expected";
  }
  return "unknown";
}

std::string_view WhyBlind(const EdgeImage& edges) {
  if (edges.width < 64 || edges.height < 64) return "too small";
  if (edges.mean_grey < 4) return "black";
  if (edges.saturated_share > 0.6) return "black or white all over";
  if (edges.segments.size() < 2) return "without edges";
  return {};
}

/// The proposed poses that explain the pictures best, best first; the others are not refined. A landmark that
/// is broader or narrower than its model is tried as well, as both of its sides would be beyond the gates.
std::vector<RefinedPose> LandmarkFinder::BestStarts(const LandmarkModel& model,
                                                    std::span<const PoseProposal> proposals,
                                                    std::span<const CameraView> views) const {
  std::vector<std::pair<double, RefinedPose>> starts;
  const auto suppose = [&](const EdgeShifts& shifts, double log_prior) {
    const LandmarkModel supposed = Shifted(model, shifts);
    for (const PoseProposal& p : proposals) {
      const auto visible = VisibleAt(supposed, p.base_from_landmark);
      const auto a = Associate(supposed, visible, views, Lift(p.base_from_landmark), kProposed);
      starts.push_back({a.log_odds + log_prior, {.base_from_landmark = p.base_from_landmark}});
      starts.back().second.solution.edge_shifts = shifts;
    }
  };
  suppose({}, 0);
  const ModelErrors* known = options_.solver.known;
  const double breadth_sigma_m = known ? known->breadth().sigma_m : options_.solver.breadth_sigma_m;
  for (const double sigmas : {-1.0, 1.0})
    if (breadth_sigma_m > 0) suppose(ShiftsOfBreadth(model, sigmas * breadth_sigma_m), -sigmas * sigmas / 2);
  std::stable_sort(starts.begin(), starts.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  if (starts.size() > kRefineBest) starts.resize(kRefineBest);
  std::vector<RefinedPose> best;
  best.reserve(starts.size());
  for (auto& start : starts) best.push_back(std::move(start.second));
  return best;
}

Eigen::Matrix3d LandmarkFixOptions::SearchCovariance(const LandmarkPrediction& prediction) const {
  Eigen::Matrix3d search = prediction.covariance;
  for (int k = 0; k < 3; ++k) search(k, k) += std::pow(k < 2 ? min_sigma_m : min_sigma_rad, 2);
  return search;
}

bool LandmarkFixOptions::IsSharp(const Eigen::Matrix3d& search) const {
  return search(0, 0) + search(1, 1) < sharp_m * sharp_m;
}

bool LandmarkFixOptions::IsTracked(const Eigen::Matrix3d& search) const {
  return search(0, 0) + search(1, 1) < tracked_m * tracked_m;
}

LandmarkFix LandmarkFinder::Find(const LandmarkModel& model, const LandmarkPrediction& prediction,
                                 std::span<const CameraView> views, const ModelErrors* known) const {
  if (known && known->mean.size() == ModelErrors::SizeFor(model))
    return FindKnown(model, prediction, views, *known);
  LandmarkFix fix;
  if (model.edges.empty()) {
    fix.verdict = Verdict::kNoModel;
    return fix;
  }
  if (IsBlind(*views[0].edges) || IsBlind(*views[1].edges)) return fix;
  if (views.size() > 2 && IsBlind(*views[2].edges)) views = views.first(2);
  const Eigen::Matrix3d search = options_.SearchCovariance(prediction);
  if (CountPredicted(model, prediction, search, views) < std::size_t(options_.min_predicted)) {
    fix.verdict = Verdict::kNotVisible;
    return fix;
  }
  Proposals proposals = Propose(model, prediction.base_from_landmark, search, views, options_);
  if (options_.IsSharp(search)) AddPredicted(prediction.base_from_landmark, search, proposals.poses);
  const PoseRefinement refinement(model, views, options_);
  std::vector<RefinedPose> poses = RefineAll(BestStarts(model, proposals.poses, views), refinement);
  fix.verdict = Verdict::kTooFewEdges;
  if (poses.empty()) return fix;
  std::stable_sort(poses.begin(), poses.end(),
                   [](const auto& a, const auto& b) { return a.LogOdds() > b.LogOdds(); });
  const Sought sought{model, prediction, search, views, static_cast<int>(proposals.poses.size())};
  fix = AnswerWith(sought, refinement, poses, poses.front());
  // One place has several solutions: few edges that fit well, with one side left out, go before all edges
  // that fit as shadows let them. The more complete one may be the one that convinces.
  for (std::size_t i = 1; i < poses.size() && fix.verdict != Verdict::kFound; ++i) {
    if (IsDistinct(poses[i].base_from_landmark, poses.front().base_from_landmark, options_)) continue;
    LandmarkFix other = AnswerWith(sought, refinement, poses, poses[i]);
    if (other.verdict == Verdict::kFound) fix = std::move(other);
  }
  return fix;
}

/// The answer if `chosen` of the refined poses is the right one.
LandmarkFix LandmarkFinder::AnswerWith(const Sought& sought, const PoseRefinement& refinement,
                                       const std::vector<RefinedPose>& poses, RefinedPose chosen) const {
  LandmarkFix fix;
  // Outliers bent the pose from which its edges were looked for.
  if (RefinedPose again = chosen; refinement.MatchAgain(again), again.solution.ok) chosen = std::move(again);
  fix.rival_log_odds = RivalLogOdds(sought.prediction, sought.search, poses, chosen);
  Judge(sought, chosen, fix);
  const bool may_be_another = !options_.IsSharp(sought.search) && !IsNearlyAll(chosen.association);
  if (fix.verdict == Verdict::kFound && may_be_another && IsOtherBreadth(sought.model, sought.views, chosen))
    fix.verdict = Verdict::kResidualTooLarge;
  if (fix.verdict == Verdict::kFound) fix.errors = refinement.Learn(chosen);
  return fix;
}

/// Finds a landmark that was seen before: the model is made as it was seen, and what is reported is of the
/// model again.
LandmarkFix LandmarkFinder::FindKnown(const LandmarkModel& model, const LandmarkPrediction& prediction,
                                      std::span<const CameraView> views, const ModelErrors& known) const {
  LandmarkFixOptions options = options_;
  const ModelErrors carried = CarriedOver(known, model, options.solver.VarianceOfModel());
  options.solver.known = &carried;
  const EdgeShifts shifts = ShiftsOf(model, carried.mean);
  LandmarkFix fix = LandmarkFinder(options).Find(Shifted(model, shifts), prediction, views);
  for (std::size_t i = 0; i < fix.edge_shifts.size(); ++i) fix.edge_shifts[i] += shifts[i];
  fix.breadth.broader_m += carried.breadth().broader_m;
  if (!fix.errors.empty()) fix.errors.mean += carried.mean;
  return fix;
}

bool LandmarkFinder::IsNearlyAll(const Association& association) const {
  return association.log_odds >= options_.nearly_all * association.best_log_odds;
}

/// A landmark of the same kind explains the images as well.
bool LandmarkFinder::IsOtherBreadth(const LandmarkModel& model, std::span<const CameraView> views,
                                    const RefinedPose& pose) const {
  const LandmarkModel seen = Shifted(model, pose.solution.edge_shifts);
  return LeadOfOtherBreadth(seen, VisibleAt(model, pose.base_from_landmark), views,
                            Lift(pose.base_from_landmark), kProposed) > -options_.min_lead_over_breadth;
}

double LandmarkFinder::RivalLogOdds(const LandmarkPrediction& prediction, const Eigen::Matrix3d& search,
                                    const std::vector<RefinedPose>& poses, const RefinedPose& best) const {
  // Where the prediction is sharp, it has a say in which of two poses it is.
  const double weight = options_.IsSharp(search) ? 0.5 : 0;
  const auto surprise = [&](const RefinedPose& p) {
    return weight * SquaredDistance(p.base_from_landmark, prediction.base_from_landmark, search);
  };
  const Eigen::Matrix3d uncertainty = OnFloor(best.solution.covariance);
  double rival = -1e9;
  for (const RefinedPose& p : poses) {
    if (!IsDistinct(p.base_from_landmark, best.base_from_landmark, options_)) continue;
    // One side alone leaves the heading open: what lies within that uncertainty is the same answer.
    if (SquaredDistance(p.base_from_landmark, best.base_from_landmark, uncertainty) < kSameAnswer) continue;
    rival = std::max(rival, p.LogOdds() + best.sharp_chi_squared / 2 + surprise(best) - surprise(p));
  }
  return rival;
}

void LandmarkFinder::Judge(const Sought& sought, const RefinedPose& best, LandmarkFix& fix) const {
  const Eigen::Matrix3d& search = sought.search;
  fix.base_from_landmark = best.base_from_landmark;
  fix.covariance = OnFloor(best.solution.covariance);
  fix.own_share = best.solution.own_share;
  fix.n_matched = static_cast<int>(best.association.matches.size());
  fix.residual_px = best.solution.rms_px;
  fix.misfit = best.solution.misfit;
  fix.matches = best.association.matches;
  fix.edge_shifts = best.solution.edge_shifts;
  fix.breadth = best.solution.breadth;
  fix.log_odds = best.association.log_odds;
  fix.best_log_odds = best.association.best_log_odds;
  const double left = best.association.side_predicted_px[1], right = best.association.side_predicted_px[2];
  const double found_left = best.association.side_found_px[1],
               found_right = best.association.side_found_px[2];
  const bool one_sided = (left == 0) != (right == 0);
  if (left > 0) fix.side_share = std::min(fix.side_share, found_left / left);
  if (right > 0) fix.side_share = std::min(fix.side_share, found_right / right);
  const bool side_missing = fix.side_share < options_.min_side_share;
  // Where it can be no other landmark a side in view may be lost, and one alone is enough.
  const bool may_miss = options_.IsSharp(search);
  const double wanted = options_.min_log_odds + std::log(std::max(sought.n_tested, 1)) +
                        ((one_sided && !may_miss) || side_missing ? options_.one_sided_log_odds : 0);
  const bool too_little_of_it =
      !may_miss && !IsNearlyAll(best.association) && best.association.best_log_odds < options_.few_log_odds;
  const bool tracked = options_.IsTracked(search);
  const double least_share = tracked ? options_.min_share_tracked : options_.min_share;
  const int per_pair = may_miss ? options_.min_matched_sharp : options_.min_matched;
  const int least =
      tracked ? options_.min_matched_sharp : per_pair * static_cast<int>(sought.views.size()) / 2;
  if (fix.n_matched < least || fix.log_odds < wanted || (side_missing && !may_miss) || too_little_of_it ||
      fix.log_odds < least_share * best.association.best_log_odds) {
    fix.verdict = Verdict::kTooFewEdges;
  } else if (fix.rival_log_odds > fix.log_odds - options_.min_lead) {
    fix.verdict = Verdict::kAmbiguous;
  } else if (fix.residual_px > options_.max_residual_px || fix.misfit > options_.max_misfit) {
    fix.verdict = Verdict::kResidualTooLarge;
  } else if (SquaredDistance(fix.base_from_landmark, sought.prediction.base_from_landmark,
                             search + fix.covariance) > options_.gate * options_.gate) {
    fix.verdict = Verdict::kElsewhere;
  } else {
    fix.verdict = Verdict::kFound;
  }
}

}  // namespace priamos::head
