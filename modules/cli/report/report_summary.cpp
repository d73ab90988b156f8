#include "cli/report/report_summary.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "cli/report/report_door.hpp"
#include "cli/report/report_timeline.hpp"
#include "common/time.hpp"

namespace priamos::cli {
namespace {

/// A pose this far before or after a correction surely does not, or does, contain it: estimates come at 50 Hz
/// and may carry the time of the wheel sample they were made from.
constexpr std::int64_t kAside_us = 40'000;
/// Slower than this is standing.
constexpr double kMotion_m_s = 0.02;

double SpeedOf(const world_truth_t& truth) {
  return std::hypot(truth.vx_m_s, truth.vy_m_s);
}

void SetErrors(const RunRecord& record, std::int64_t utime, FixSummary& fix) {
  const pose_t *before = nullptr, *after = nullptr;
  for (const pose_t& pose : record.poses) {
    if (pose.utime <= utime - kAside_us) before = &pose;
    if (!after && pose.utime >= utime + kAside_us) after = &pose;
  }
  if (const auto error = before ? ErrorOf(record, *before) : std::nullopt) {
    fix.error_before_m = error->position_m;
    fix.error_before_deg = std::abs(Degrees(error->heading_rad));
  }
  if (const auto error = after ? ErrorOf(record, *after) : std::nullopt) {
    fix.error_after_m = error->position_m;
    fix.error_after_deg = std::abs(Degrees(error->heading_rad));
  }
}

std::vector<FixSummary> FixesOf(const RunRecord& record, std::int64_t begin_utime) {
  std::vector<FixSummary> fixes;
  for (const LookSpan& look : LooksOf(record)) {
    FixSummary fix;
    fix.t_s = Seconds(Duration(look.end_utime - begin_utime));
    fix.sigma_m = look.correction.sigma_m;
    fix.sigma_deg = Degrees(look.correction.sigma_yaw_rad);
    SetErrors(record, look.end_utime, fix);
    fixes.push_back(fix);
  }
  return fixes;
}

std::optional<double> SlowestDuringFixes(const RunRecord& record) {
  std::optional<double> slowest;
  for (const LookSpan& look : LooksOf(record))
    for (const world_truth_t& truth : record.truth)
      if (truth.utime >= look.begin_utime && truth.utime <= look.end_utime)
        slowest = std::min(slowest.value_or(SpeedOf(truth)), SpeedOf(truth));
  return slowest;
}

double MeanSpeed(const RunRecord& record) {
  const auto moves = [](const world_truth_t& truth) { return SpeedOf(truth) > kMotion_m_s; };
  const auto first = std::find_if(record.truth.begin(), record.truth.end(), moves);
  const auto last = std::find_if(record.truth.rbegin(), record.truth.rend(), moves).base();
  double driven_m = 0;
  if (first == record.truth.end() || last - first < 2) return 0;
  for (auto at = first + 1; at != last; ++at)
    driven_m += std::hypot(at->x_m - (at - 1)->x_m, at->y_m - (at - 1)->y_m);
  return driven_m / Seconds(Duration((last - 1)->utime - first->utime));
}

double Median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

bool EndsBehind(const RunRecord& record, const DoorPlan& door) {
  if (record.truth.empty()) return false;
  const world_truth_t& last = record.truth.back();
  return (door.map_from_door().Inverse() * Eigen::Vector2d(last.x_m, last.y_m)).x() > door.BackX();
}

template <class T>
nlohmann::ordered_json Json(const std::optional<T>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json ToJson(const RadioSummary& radio) {
  return {{"bytes", radio.bytes},
          {"utilisation", radio.utilisation},
          {"frames", radio.frames},
          {"dropped", radio.dropped}};
}

nlohmann::ordered_json ToJson(const FixSummary& fix) {
  return {{"t_s", fix.t_s},
          {"error_before_m", fix.error_before_m},
          {"error_before_deg", fix.error_before_deg},
          {"error_after_m", fix.error_after_m},
          {"error_after_deg", fix.error_after_deg},
          {"sigma_m", fix.sigma_m},
          {"sigma_deg", fix.sigma_deg}};
}

nlohmann::ordered_json ToJson(const BeliefAtDoor& belief) {
  return {{"lateral_m", belief.lateral_m},
          {"along_m", belief.along_m},
          {"heading_deg", Degrees(belief.heading_rad)},
          {"lateral_sigma_m", belief.lateral_sigma_m},
          {"nees", belief.nees}};
}

nlohmann::ordered_json ToJson(const CorridorSummary& corridor) {
  return {{"driven_m", corridor.driven_m},
          {"across_rms_m", corridor.across_rms_m},
          {"end", corridor.end ? ToJson(*corridor.end) : nlohmann::ordered_json(nullptr)}};
}

nlohmann::ordered_json ToJson(const FoundDoors& doors) {
  auto on_the_way = nlohmann::ordered_json::array();
  for (const FoundDoor& door : doors.on_the_way)
    on_the_way.push_back({{"name", door.name},
                          {"state", door.state},
                          {"open_deg", door.open_deg},
                          {"told", Json(door.told)},
                          {"along_m", door.along_m},
                          {"across_m", door.across_m},
                          {"sigma_along_m", door.sigma_along_m},
                          {"sigma_across_m", door.sigma_across_m}});
  return {{"on_the_way", on_the_way}, {"false", doors.false_ones}};
}

nlohmann::ordered_json ToJson(const FoundObjects& things) {
  return {{"told", things.told()},
          {"edges", things.edges},
          {"faces", things.faces},
          {"boxes", things.boxes},
          {"standing", things.standing},
          {"phantoms", things.phantoms},
          {"front_p95_m", std::isfinite(things.front_p95_m) ? nlohmann::ordered_json(things.front_p95_m)
                                                            : nlohmann::ordered_json(nullptr)}};
}

nlohmann::ordered_json ToJson(const ExploreSummary& explore) {
  return {{"reachable_m2", explore.reachable_m2},
          {"seen", explore.seen},
          {"driven_m", explore.driven_m},
          {"tour_m", explore.tour_m},
          {"tour_places", explore.tour_places},
          {"wall_m", explore.wall_m},
          {"wall_error_p95_m", explore.wall_error_p95_m},
          {"pose_error_m", explore.pose_error_m},
          {"pose_error_deg", explore.pose_error_deg},
          {"end", explore.end}};
}

nlohmann::ordered_json ToJson(const HandSummary& hand) {
  return {{"wished_s", hand.wished_s},
          {"honoured", Json(hand.honoured())},
          {"longest_stop_s", Json(hand.longest_stop_s)}};
}

}  // namespace

RadioSummary RadioOf(const std::vector<link_status_t>& reports) {
  RadioSummary radio;
  if (reports.empty()) return radio;
  for (const link_status_t& report : reports)
    radio.utilisation += report.utilisation / double(reports.size());
  const link_status_t& last = reports.back();
  radio.bytes = last.bytes_sent;
  radio.frames = last.frames_sent;
  radio.dropped = last.dropped;
  // A link with many channels reports some of them at a time.
  std::map<std::string, RadioSummary::ChannelSummary> channels;
  for (const link_status_t& report : reports)
    for (const link_channel_t& channel : report.channels)
      if (channel.outgoing)
        channels[channel.channel] = {channel.channel, channel.messages, channel.bytes, channel.dropped};
  for (const auto& [name, channel] : channels) radio.channels.push_back(channel);
  std::sort(radio.channels.begin(), radio.channels.end(),
            [](const auto& a, const auto& b) { return a.bytes > b.bytes; });
  return radio;
}

Summary Summarise(const RunRecord& record, const RunInfo& info) {
  const auto built = BuiltDoor(info);
  const MissionSpan span = SpanOf(record);
  const auto crossing = built ? CrossingOf(record, built->map_from_door()) : std::nullopt;
  Summary summary;
  summary.scenario = info.scenario;
  summary.seed = info.seed;
  summary.reason = info.reason;
  summary.story = info.story;
  summary.realtime_factor = info.realtime_factor;
  summary.passed = span.done && crossing && EndsBehind(record, *built);
  if (!record.truth.empty()) {
    summary.contacts = record.truth.back().contacts;
    summary.min_gap_m = record.truth.back().min_gap_m;
  }
  if (crossing) {
    summary.lateral_at_door_m = crossing->lateral_m;
    summary.heading_at_door_deg = Degrees(crossing->heading_rad);
  }
  const RunRecord on_plan = OnPlan(record, info);
  if (crossing) summary.belief_at_door = BeliefAt(on_plan, *info.door, crossing->utime);
  summary.corrections = CorrectionsOf(record);
  summary.corridor = CorridorSummaryOf(record);
  summary.doors = FoundDoorsOf(record, info);
  summary.things = FoundObjectsOf(record, info);
  summary.explore = ExploreSummaryOf(record, info);
  summary.duration_s = Seconds(Duration(span.end_utime - span.begin_utime));
  summary.mean_speed_m_s = MeanSpeed(record);
  summary.min_speed_during_fix_m_s = SlowestDuringFixes(record);
  summary.fixes = FixesOf(on_plan, span.begin_utime);
  summary.touches = TouchesOf(record, span.begin_utime);
  summary.hand = HandSummaryOf(record, info.world, built);
  summary.up = RadioOf(record.onboard_link);
  summary.down = RadioOf(record.offboard_link);
  summary.pose_age_s = Median(record.pose_ages_s);
  return summary;
}

bool SeeksTheDoor(const Summary& summary) {
  return !summary.hand || !summary.fixes.empty();
}

nlohmann::ordered_json ToJson(const Summary& summary) {
  auto fixes = nlohmann::ordered_json::array();
  for (const FixSummary& fix : summary.fixes) fixes.push_back(ToJson(fix));
  auto touches = nlohmann::ordered_json::array();
  for (const TouchSummary& touch : summary.touches) touches.push_back(ToJson(touch));
  return {{"scenario", summary.scenario},
          {"seed", summary.seed},
          {"passed", summary.passed},
          {"reason", Json(summary.passed ? std::nullopt : std::optional(summary.reason))},
          {"contacts", summary.contacts},
          {"touches", touches},
          {"min_gap_m", summary.min_gap_m},
          {"lateral_at_door_m", Json(summary.lateral_at_door_m)},
          {"heading_at_door_deg", Json(summary.heading_at_door_deg)},
          {"belief_at_door",
           summary.belief_at_door ? ToJson(*summary.belief_at_door) : nlohmann::ordered_json(nullptr)},
          {"corrections", ToJson(summary.corrections)},
          {"corridor", summary.corridor ? ToJson(*summary.corridor) : nlohmann::ordered_json(nullptr)},
          {"doors", summary.doors ? ToJson(*summary.doors) : nlohmann::ordered_json(nullptr)},
          {"things", summary.things ? ToJson(*summary.things) : nlohmann::ordered_json(nullptr)},
          {"explore", summary.explore ? ToJson(*summary.explore) : nlohmann::ordered_json(nullptr)},
          {"duration_s", summary.duration_s},
          {"mean_speed_m_s", summary.mean_speed_m_s},
          {"min_speed_during_fix_m_s", Json(summary.min_speed_during_fix_m_s)},
          {"fixes", fixes},
          {"hand", summary.hand ? ToJson(*summary.hand) : nlohmann::ordered_json(nullptr)},
          {"radio", {{"up", ToJson(summary.up)}, {"down", ToJson(summary.down)}}},
          {"realtime_factor", summary.realtime_factor}};
}

}  // namespace priamos::cli
