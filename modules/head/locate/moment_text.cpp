#include "head/locate/moment_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "head/see/see_landmark.hpp"

namespace priamos::head {
namespace {

/// The largest of three standard deviations, from `first` on.
double SigmaOf(const FreeModelFix& fix, int first) {
  return std::sqrt(std::max(0.0, fix.covariance.diagonal().segment<3>(first).maxCoeff()));
}

}  // namespace

std::string MomentText(const MomentReport& report) {
  const std::string& name = report.images.front();
  const FreeModelFix& fix = report.fix;
  if (!report.why_unread.empty()) return fmt::format("{}: not found: {}\n", name, report.why_unread);
  if (fix.verdict != Verdict::kFound)
    return fmt::format("{}: not found: {}{}\n", name, Describe(fix.verdict),
                       report.n_lost > 1 ? fmt::format(", for {} images", report.n_lost) : "");
  const auto at = SixFromPose(fix.base_from_model);
  return fmt::format(
      "{}: at {:.4f} {:.4f} {:.4f} m, {:.3f} {:.3f} {:.3f} deg; sigma {:.1f} mm, {:.2f} deg; {} edges, "
      "{:.0f} % "
      "of what is seen of it, {:.0f} ms\n",
      name, at[0], at[1], at[2], at[3], at[4], at[5], 1e3 * SigmaOf(fix, 0), Degrees(SigmaOf(fix, 3)),
      fix.n_matched, 100 * fix.agreement.covered, report.time_ms);
}

nlohmann::ordered_json MomentToJson(const MomentReport& report, std::span<const CameraView> views) {
  nlohmann::ordered_json json{{"images", report.images}};
  if (report.why_unread.empty()) {
    auto fix = LandmarkToJson(views, report.fix);
    fix.erase("matches");
    json.update(fix);
    json["edges"] = report.fix.n_matched;
    json["share"] = report.fix.agreement.covered;
    json["ends"] = report.fix.agreement.ends;
    json["misfit"] = report.fix.misfit;
    json["agreement"] = report.fix.agreement.Value(report.fix.misfit);
    json["log_odds"] = report.fix.log_odds;
    json["rival_log_odds"] = report.fix.rival_log_odds;
  } else {
    json["found"] = false;
    json["verdict"] = report.why_unread;
  }
  json["lost"] = report.n_lost;
  json["time_ms"] = report.time_ms;
  return json;
}

}  // namespace priamos::head
