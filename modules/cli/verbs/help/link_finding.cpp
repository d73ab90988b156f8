#include "cli/verbs/help/link_finding.hpp"

#include <fmt/format.h>

namespace priamos::cli {
namespace {

using Verdict = Finding::Verdict;

constexpr double kMuchLoss = 0.1;

}  // namespace

Finding LinkFinding(const link_status_t& status) {
  const char* here = status.onboard ? "the robot's end" : "the workstation's end";
  const char* there = status.onboard ? "the workstation's end" : "the robot's end";
  const std::string what = fmt::format("radio of {}", here);
  if (status.table_mismatch)
    return {what, Verdict::kBad, fmt::format("{} has another table of channels: nothing is exchanged", there),
            "priamos topic echo HEALTH   # which one; then the same link.toml and version at both ends"};
  if (!status.up)
    return {what, Verdict::kBad,
            fmt::format("cut: nothing of {} is heard; {} bytes have come since this end was started", there,
                        status.bytes_received),
            "priamos status   # there: is its radio on? then port, rate and key of radio.toml at both ends"};
  const std::string found =
      fmt::format("both ends hear each other; {:.0f} % of what {} sends is lost", 100 * status.loss, there);
  if (status.loss > kMuchLoss)
    return {what, Verdict::kNotNeededYet, found, "priamos link top   # what the line does"};
  return {what, Verdict::kGood, found, ""};
}

}  // namespace priamos::cli
