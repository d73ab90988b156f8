#include "head/core/bodies/body_tracker.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::head {

std::vector<BodyTracker::Belief> BodyTracker::Beliefs() const {
  const Belief start{start_, options_.fix.prior_share, options_.fix.prior_rad, false};
  if (!last_) return {start};
  const double growth = std::min(std::sqrt(1.0 + n_lost_), options_.max_growth);
  const Belief last{*last_, growth * options_.motion_share, growth * options_.motion_rad, n_lost_ == 0};
  if (n_lost_ > 0) return {last, start};
  return {last};
}

FreeModelFix BodyTracker::Look(std::span<const CameraView> views) {
  std::optional<FreeModelFix> first;
  const std::vector<Belief> beliefs = Beliefs();
  believed_ = beliefs.front().base_from_model;
  for (const Belief& belief : beliefs) {
    FreeModelOptions options = options_.fix;
    options.prior_share = belief.share;
    options.prior_rad = belief.rad;
    if (belief.is_followed) {
      options.min_agreement = options.min_agreement_when_coarse = options_.min_agreement_when_followed;
      options.min_evidence = options_.min_evidence_when_followed;
      options.trust_linked = true;
    }
    FreeModelFix fix = LocateFreeModel(body_, belief.base_from_model, views, options);
    if (fix.verdict == Verdict::kFound) {
      last_ = fix.base_from_model;
      n_lost_ = 0;
      return fix;
    }
    if (!first) first = std::move(fix);
  }
  ++n_lost_;
  return std::move(*first);
}

}  // namespace priamos::head
