#include "cli/report/report_corrections.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace priamos::cli {
namespace {

/// A fix that makes no sense as a number is implausible, too, but was never compared: it has no distance.
bool WasCompared(const pose_correction_t& correction) {
  if (!std::isfinite(correction.distance)) return false;
  return correction.verdict == pose_correction_t::APPLIED ||
         (correction.verdict == pose_correction_t::IMPLAUSIBLE && correction.distance > 0);
}

}  // namespace

CorrectionSummary CorrectionsOf(const RunRecord& record) {
  CorrectionSummary summary;
  for (const pose_correction_t& correction : record.corrections) {
    if (!WasCompared(correction)) continue;
    ++summary.count;
    summary.beyond_3_sigma += correction.distance > kThreeSigmas;
    summary.most_distance = std::max(summary.most_distance, correction.distance);
  }
  return summary;
}

nlohmann::ordered_json ToJson(const CorrectionSummary& corrections) {
  return {{"count", corrections.count},
          {"beyond_3_sigma", corrections.beyond_3_sigma},
          {"most_distance", corrections.most_distance}};
}

}  // namespace priamos::cli
