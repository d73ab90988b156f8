#include "cli/report/report_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/report/report_plot.hpp"
#include "cli/report/report_style.hpp"
#include "common/drawing/svg.hpp"
#include "common/time.hpp"

namespace priamos::cli {
namespace {

std::string RadioTable(const char* title, const RadioSummary& radio) {
  std::string table = "<div class=\"scroll\"><table>" + Row({title, "messages", "bytes", "dropped"}, "th");
  for (const auto& c : radio.channels)
    table += Row({drawing::EscapeMarkup(c.channel), fmt::format("{}", c.messages), fmt::format("{}", c.bytes),
                  fmt::format("{}", c.dropped)});
  table +=
      Row({fmt::format("frames, {:.0f} % of the line", radio.utilisation * 100),
           fmt::format("{}", radio.frames), fmt::format("{}", radio.bytes), fmt::format("{}", radio.dropped)},
          "td", " class=\"sum\"");
  return table + "</table></div>\n";
}

double SecondsSince(std::int64_t begin_utime, std::int64_t utime) {
  return Seconds(Duration(utime - begin_utime));
}

const char* WordOf(int severity) {
  switch (severity) {
    case alarm_t::CAUTION:
      return "caution";
    case alarm_t::WARNING:
      return "warning";
    default:
      return "critical";
  }
}

/// Who took note of an alarm; empty when nobody did.
std::string NotedBy(const RunRecord& record, const alarm_t& alarm) {
  const auto ack = std::find_if(record.acks.begin(), record.acks.end(), [&](const alarm_ack_t& a) {
    return a.source == alarm.source && a.utime_alarm == alarm.utime;
  });
  return ack == record.acks.end() ? "" : ack->by;
}

}  // namespace

std::string Card(const std::string& figure, const char* meaning) {
  return fmt::format("<div class=\"card\"><b>{}</b><span>{}</span></div>", figure, meaning);
}

std::string Row(std::initializer_list<std::string> cells, const char* tag, const char* style) {
  std::string row = fmt::format("<tr{}>", style);
  for (const auto& cell : cells) row += fmt::format("<{0}>{1}</{0}>", tag, cell);
  return row + "</tr>\n";
}

std::string Base64(std::string_view bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (k < n ? static_cast<std::uint8_t>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= n ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string Plots(const RunRecord& record, const MissionSpan& span) {
  const auto inside = [&](std::int64_t utime) {
    return utime >= span.begin_utime && utime <= span.end_utime;
  };
  PlotSeries position{"error", "#e8741c", {}, false}, position_sigma{"2 sigma", "#e8741c", {}, true};
  PlotSeries heading{"error", "#e8741c", {}, false}, heading_sigma{"2 sigma", "#e8741c", {}, true};
  PlotSeries speed{record.truth.empty() ? "believed speed" : "true speed", "#1f62c4", {}, false},
      gap{"gap", "#1f62c4", {}, false};
  for (const pose_t& pose : record.poses) {
    if (!inside(pose.utime)) continue;
    const double t_s = SecondsSince(span.begin_utime, pose.utime);
    if (record.truth.empty()) speed.points.emplace_back(t_s, std::hypot(pose.vx_m_s, pose.vy_m_s));
    if (const auto error = ErrorOf(record, pose)) {
      position.points.emplace_back(t_s, error->position_m * 100);
      heading.points.emplace_back(t_s, std::abs(Degrees(error->heading_rad)));
    }
    position_sigma.points.emplace_back(t_s, 200 * std::hypot(pose.sigma_x_m, pose.sigma_y_m));
    heading_sigma.points.emplace_back(t_s, 2 * Degrees(pose.sigma_yaw_rad));
  }
  for (const world_truth_t& truth : record.truth) {
    if (!inside(truth.utime)) continue;
    const double t_s = SecondsSince(span.begin_utime, truth.utime);
    speed.points.emplace_back(t_s, std::hypot(truth.vx_m_s, truth.vy_m_s));
    gap.points.emplace_back(t_s, truth.gap_m);
  }
  std::vector<PlotSpan> spans;
  for (const LookSpan& look : LooksOf(record))
    spans.push_back({SecondsSince(span.begin_utime, look.begin_utime),
                     SecondsSince(span.begin_utime, look.end_utime), fmt::format("{}", spans.size() + 1)});
  const double end_s = SecondsSince(span.begin_utime, span.end_utime);
  return ToSvg({"position error", "cm", {position, position_sigma}, spans, end_s}) +
         ToSvg({"heading error", "deg", {heading, heading_sigma}, spans, end_s}) +
         ToSvg({"speed", "m/s", {speed}, spans, end_s}) +
         (gap.points.empty() ? "" : ToSvg({"gap to the nearest thing", "m", {gap}, spans, end_s}));
}

std::string PageHead(const std::string& title, bool good, const std::string& verdict) {
  const std::string name = drawing::EscapeMarkup(title);
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">"
      "<title>PRIAMOS: {0}</title>\n<style>{1}</style></head>\n<body><main>\n"
      "<header><h1>{0}</h1><span class=\"verdict {2}\">{3}</span></header>\n",
      name, kReportStyle, good ? "good" : "bad", drawing::EscapeMarkup(verdict));
}

std::string Picture(const char* description, const std::string& svg) {
  return fmt::format("<img alt=\"{}\" src=\"data:image/svg+xml;base64,{}\">\n", description, Base64(svg));
}

std::string AlarmTable(const RunRecord& record, std::int64_t begin_utime) {
  if (record.alarms.empty()) return "";
  std::string table =
      "<div class=\"scroll\"><table class=\"text\">" + Row({"time", "", "from", "alarm", "noted by"}, "th");
  for (const alarm_t& alarm : record.alarms)
    table += Row({fmt::format("{:.1f} s", SecondsSince(begin_utime, alarm.utime)), WordOf(alarm.severity),
                  drawing::EscapeMarkup(alarm.source), drawing::EscapeMarkup(alarm.text),
                  drawing::EscapeMarkup(NotedBy(record, alarm))});
  return table + "</table></div>\n";
}

std::string RadioSection(const RadioSummary& up, const RadioSummary& down) {
  return "<h2>Radio</h2>\n<div class=\"two\">" + RadioTable("up: robot to workstation", up) +
         RadioTable("down: workstation to robot", down) + "</div>\n";
}

}  // namespace priamos::cli
