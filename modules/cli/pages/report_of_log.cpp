#include "cli/pages/report_of_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bus/log/log_reader.hpp"
#include "cli/pages/log_map.hpp"
#include "cli/report/report_looks.hpp"
#include "cli/report/report_parts.hpp"
#include "common/drawing/svg.hpp"
#include "common/time.hpp"

namespace priamos::cli {
namespace {

using drawing::Box, drawing::Drawing;
using Eigen::Vector2d;

/// Whether a log has the robot's bus in it, by a channel that never crosses the radio.
bool HasRobotsBus(const std::string& log) {
  bus::LogReader reader(log);
  while (const auto event = reader.Next())
    if (event->channel == channels::kWheelState.name) return true;
  return false;
}

/// `alone`: it is the only log, so that each side has what the log holds of it.
void AddLog(const std::string& log, bool alone, RunRecord& record) {
  const bool onboard = HasRobotsBus(log);
  bus::LogReader reader(log);
  while (const auto event = reader.Next()) {
    // What both sides take is of one bus.
    const bool of_both =
        event->channel == channels::kLinkStatus.name || event->channel == channels::kAlarm.name;
    const bool of_pose = event->channel == channels::kPose.name;
    if (onboard || (alone && !of_both))
      record.Add(Side::kOnboard, event->utime, event->channel, event->bytes);
    if (!onboard || (alone && !of_both && !of_pose))
      record.Add(Side::kOffboard, event->utime, event->channel, event->bytes);
  }
}

/// From the first to the last moment of which the record has something.
MissionSpan WholeSpan(const RunRecord& record) {
  MissionSpan span;
  const auto reach = [&](const auto& stream) {
    if (stream.empty()) return;
    const auto begin = stream.front().utime, end = stream.back().utime;
    span.begin_utime = span.begin_utime == 0 ? begin : std::min(span.begin_utime, begin);
    span.end_utime = std::max(span.end_utime, end);
  };
  reach(record.poses);
  reach(record.drive);
  reach(record.mission);
  return span;
}

/// How one order ended.
struct Ending {
  std::string title, text;
  bool done = false;
};

std::vector<Ending> EndingsOf(const RunRecord& record) {
  std::vector<Ending> endings;
  std::int32_t last = 0;
  for (const mission_status_t& status : record.mission) {
    const bool over = status.phase == mission_status_t::DONE || status.phase == mission_status_t::FAILED;
    if (!over || status.running || status.order_id == last) continue;
    last = status.order_id;
    endings.push_back({status.title, status.text, status.phase == mission_status_t::DONE});
  }
  return endings;
}

std::string VerdictOf(const std::vector<Ending>& endings) {
  if (endings.empty()) return "no mission ended";
  const auto done = std::count_if(endings.begin(), endings.end(), [](const Ending& e) { return e.done; });
  return fmt::format("{} of {} missions done", done, endings.size());
}

std::string Failures(const std::vector<Ending>& endings) {
  std::string text;
  for (const Ending& ending : endings)
    if (!ending.done)
      text += fmt::format("<p class=\"reason\">{}: {}</p>\n", drawing::EscapeMarkup(ending.title),
                          drawing::EscapeMarkup(ending.text));
  return text;
}

std::string MissionTable(const RunRecord& record, std::int64_t begin_utime) {
  std::string table =
      "<div class=\"scroll\"><table class=\"text\">" + Row({"time", "order", "what happened"}, "th");
  std::string last;
  for (const mission_status_t& status : record.mission) {
    if (status.text == last) continue;
    last = status.text;
    table += Row({fmt::format("{:.1f} s", Seconds(Duration(status.utime - begin_utime))),
                  drawing::EscapeMarkup(status.title), drawing::EscapeMarkup(status.text)});
  }
  return table + "</table></div>\n";
}

/// Distance along the believed poses; a jump by a correction is not driven.
double DrivenMetres(const RunRecord& record) {
  constexpr double kJump_m = 0.1;
  double driven_m = 0;
  for (std::size_t i = 1; i < record.poses.size(); ++i) {
    const double step_m = (PositionOf(record.poses[i]) - PositionOf(record.poses[i - 1])).norm();
    if (step_m < kJump_m) driven_m += step_m;
  }
  return driven_m;
}

std::string Cards(const RunRecord& record, const MissionSpan& span) {
  const auto applied = std::count_if(record.corrections.begin(), record.corrections.end(),
                                     [](const auto& c) { return c.verdict == pose_correction_t::APPLIED; });
  return "<div class=\"cards\">" +
         Card(fmt::format("{:.0f} s", Seconds(Duration(span.end_utime - span.begin_utime))),
              "time of the log") +
         Card(fmt::format("{:.1f} m", DrivenMetres(record)), "driven") +
         Card(fmt::format("{}", applied), "corrections of the pose by looks") +
         Card(fmt::format("{}", record.alarms.size()), "alarms") + "</div>\n";
}

}  // namespace

RunRecord RecordOfLogs(const std::vector<std::string>& logs) {
  RunRecord record;
  for (const std::string& log : logs) AddLog(log, logs.size() == 1, record);
  if (record.poses.empty() && record.mission.empty() && record.drive.empty())
    throw std::runtime_error(fmt::format(
        "{}: expected messages of a robot (POSE, MISSION_STATUS), got none; next: priamos log info {}",
        logs.front(), logs.front()));
  return record;
}

std::string LogPage(const std::string& title, const RunRecord& record,
                    const std::optional<GroundPlan>& plan) {
  const MissionSpan span = WholeSpan(record);
  const auto endings = EndingsOf(record);
  const bool good = std::all_of(endings.begin(), endings.end(), [](const Ending& e) { return e.done; });
  std::string page = PageHead(title, good, VerdictOf(endings)) + Failures(endings) + Cards(record, span);
  page += Picture("Believed path with its uncertainty, walls that were heard, and the plan; legend",
                  drawing::ToSvg(DrawLogMap(record, plan, ExtentOfLog(record, plan))));
  if (!record.mission.empty()) page += "<h2>Missions</h2>\n" + MissionTable(record, span.begin_utime);
  const std::string alarms = AlarmTable(record, span.begin_utime), looks = LookDrawings(record);
  page += "<h2>Alarms</h2>\n" + (alarms.empty() ? "<p>None.</p>\n" : alarms);
  if (!looks.empty()) page += "<h2>Looks</h2>\n" + looks;
  page += "<h2>Over time</h2>\n<div class=\"two\">" + Plots(record, span) + "</div>\n";
  page += RadioSection(RadioOf(record.onboard_link), RadioOf(record.offboard_link));
  if (record.refused > 0)
    page += fmt::format("<footer>{} messages were damaged or of another type.</footer>\n", record.refused);
  return page + "</main></body></html>\n";
}

}  // namespace priamos::cli
