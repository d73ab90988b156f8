#include "cli/report/report_touches.hpp"

#include <nlohmann/json.hpp>

#include "common/time.hpp"

namespace priamos::cli {
namespace {

constexpr Duration kForgotten = std::chrono::seconds(30);

std::string KindOf(const world_touch_t& touch) {
  switch (touch.kind) {
    case world_touch_t::MOVED_IN:
      return "moved in";
    case world_touch_t::FELL:
      return "fell";
    default:
      return "driven";
  }
}

bool Knows(const drive_status_t& status) {
  return status.limit == drive_status_t::LIMIT_TOUCHED || status.limit == drive_status_t::LIMIT_WHEELS_STUCK;
}

std::optional<double> NoticedAfter(const RunRecord& record, std::int64_t utime) {
  for (const drive_status_t& status : record.drive) {
    const Duration after(status.utime - utime);
    if (after >= Duration(0) && after <= kForgotten && Knows(status)) return Seconds(after);
  }
  return std::nullopt;
}

}  // namespace

std::vector<TouchSummary> TouchesOf(const RunRecord& record, std::int64_t begin_utime) {
  std::vector<TouchSummary> touches;
  for (const world_touch_t& touch : record.touches)
    touches.push_back({Seconds(Duration(touch.utime - begin_utime)), KindOf(touch), touch.thing,
                       NoticedAfter(record, touch.utime)});
  return touches;
}

nlohmann::ordered_json ToJson(const TouchSummary& touch) {
  return {{"t_s", touch.t_s},
          {"kind", touch.kind},
          {"thing", touch.thing},
          {"noticed_after_s", touch.noticed_after_s ? nlohmann::ordered_json(*touch.noticed_after_s)
                                                    : nlohmann::ordered_json(nullptr)}};
}

}  // namespace priamos::cli
