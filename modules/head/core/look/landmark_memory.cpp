#include "head/core/look/landmark_memory.hpp"

#include <utility>

namespace priamos::head {
namespace {

/// So many looks in a row that do not show what is known: it is given up.
constexpr int kContradicted = 3;

}  // namespace

LandmarkFix LandmarkMemory::Find(const LandmarkFinder& finder, const LandmarkModel& model,
                                 const LandmarkPrediction& expected, std::span<const CameraView> views) {
  for (const bool with_greys : {true, false}) {
    if (errors_.empty() || (with_greys && greys_.empty())) continue;
    LandmarkFix fix = finder.Find(with_greys ? WithGreys(model, greys_) : model, expected, views, &errors_);
    if (fix.verdict != Verdict::kFound) continue;
    Keep(model, fix, with_greys ? std::move(greys_) : EdgeGreys{});
    return fix;
  }
  const ModelErrors breadth = OnlyBreadth(errors_, model, finder.options().solver.VarianceOfModel());
  LandmarkFix fix = finder.Find(model, expected, views, &breadth);
  if (fix.verdict == Verdict::kFound && (errors_.empty() || ++contradicted_ == kContradicted))
    Keep(model, fix, {});
  return fix;
}

void LandmarkMemory::Keep(const LandmarkModel& model, const LandmarkFix& fix, EdgeGreys before) {
  errors_ = fix.errors;
  greys_ = keeps_greys_ ? Learned(std::move(before), model, fix.matches, grey_options_) : EdgeGreys{};
  contradicted_ = 0;
}

}  // namespace priamos::head
