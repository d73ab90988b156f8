#include "cli/report/report_html.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/report/report_looks.hpp"
#include "cli/report/report_plot.hpp"
#include "cli/report/report_style.hpp"
#include "cli/report/report_table.hpp"
#include "cli/report/report_timeline.hpp"
#include "common/drawing/svg.hpp"
#include "common/time.hpp"

namespace priamos::cli {
namespace {

std::string Card(const std::string& figure, const char* meaning) {
  return fmt::format("<div class=\"card\"><b>{}</b><span>{}</span></div>", figure, meaning);
}

std::string Row(std::initializer_list<std::string> cells, const char* tag = "td", const char* style = "") {
  std::string row = fmt::format("<tr{}>", style);
  for (const auto& cell : cells) row += fmt::format("<{0}>{1}</{0}>", tag, cell);
  return row + "</tr>\n";
}

std::string Optional(const std::optional<double>& value, double factor, const char* form) {
  return value ? fmt::format(fmt::runtime(form), *value * factor) : "&ndash;";
}

/// What a drive by hand is judged by.
std::string HandCards(const HandSummary& hand) {
  return Card(Optional(hand.honoured(), 100, "{:.1f} %"), "of the free motion wished was made") +
         Card(Optional(hand.longest_stop_s, 1, "{:.1f} s"), "longest stop in the passage while pushed") +
         Card(fmt::format("{:.0f} s", hand.wished_s), "pushed");
}

/// What a mission through the door is judged by.
std::string DoorCards(const Summary& s) {
  return Card(Optional(s.lateral_at_door_m, 100, "{:+.1f} cm"), "lateral error in the door plane") +
         Card(Optional(s.heading_at_door_deg, 1, "{:+.2f}&deg;"), "heading error in the door plane") +
         Card(Optional(s.min_speed_during_fix_m_s, 1, "{:.2f} m/s"), "lowest speed while fixing");
}

std::string Cards(const Summary& s) {
  std::string cards = "<div class=\"cards\">";
  if (s.hand) cards += HandCards(*s.hand);
  if (SeeksTheDoor(s)) cards += DoorCards(s);
  cards += Card(fmt::format("{:.1f} cm", s.min_gap_m * 100), "smallest gap to anything");
  cards += Card(fmt::format("{:.1f} s", s.duration_s), "from order to end");
  cards += Card(fmt::format("{:.2f} m/s", s.mean_speed_m_s), "mean speed");
  return cards + "</div>\n";
}

std::string FixTable(const Summary& summary) {
  std::string table = "<div class=\"scroll\"><table>";
  table += Row({"fix", "time", "error before", "", "error after", "", "its own sigma", ""}, "th");
  for (std::size_t i = 0; i < summary.fixes.size(); ++i) {
    const FixSummary& f = summary.fixes[i];
    table +=
        Row({fmt::format("{}", i + 1), fmt::format("{:.1f} s", f.t_s),
             fmt::format("{:.1f} cm", f.error_before_m * 100), fmt::format("{:.2f}&deg;", f.error_before_deg),
             fmt::format("{:.1f} cm", f.error_after_m * 100), fmt::format("{:.2f}&deg;", f.error_after_deg),
             fmt::format("{:.1f} cm", f.sigma_m * 100), fmt::format("{:.2f}&deg;", f.sigma_deg)});
  }
  if (summary.fixes.empty()) table += "<tr><td colspan=\"8\">no fix corrected the pose</td></tr>";
  return table + "</table></div>\n";
}

/// Texts of the planner's status since the order; without a planner the lines shown in the terminal.
std::vector<StoryLine> Phases(const RunRecord& record, const Summary& summary) {
  const MissionSpan span = SpanOf(record);
  std::vector<StoryLine> phases;
  for (const mission_status_t& status : record.mission) {
    if (status.utime < span.begin_utime || (!phases.empty() && status.text == phases.back().text)) continue;
    phases.push_back({Seconds(Duration(status.utime - span.begin_utime)), status.text});
  }
  return phases.empty() ? summary.story : phases;
}

std::string PhaseTable(const RunRecord& record, const Summary& summary) {
  std::string table = "<div class=\"scroll\"><table class=\"text\">" + Row({"time", "what happened"}, "th");
  for (const StoryLine& phase : Phases(record, summary))
    table += Row({fmt::format("{:.1f} s", phase.t_s), drawing::EscapeMarkup(phase.text)});
  if (!summary.passed)
    table += Row({"end", "not passed: " + drawing::EscapeMarkup(summary.reason)}, "td", " class=\"sum\"");
  return table + "</table></div>\n";
}

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

/// Every figure over time, from the order to the end.
std::string Plots(const RunRecord& record) {
  const MissionSpan span = SpanOf(record);
  const auto inside = [&](std::int64_t utime) {
    return utime >= span.begin_utime && utime <= span.end_utime;
  };
  PlotSeries position{"error", "#e8741c", {}, false}, position_sigma{"2 sigma", "#e8741c", {}, true};
  PlotSeries heading{"error", "#e8741c", {}, false}, heading_sigma{"2 sigma", "#e8741c", {}, true};
  PlotSeries speed{"true speed", "#1f62c4", {}, false}, gap{"gap", "#1f62c4", {}, false};
  for (const pose_t& pose : record.poses) {
    const auto error = inside(pose.utime) ? ErrorOf(record, pose) : std::nullopt;
    if (!error) continue;
    const double t_s = SecondsSince(span.begin_utime, pose.utime);
    position.points.emplace_back(t_s, error->position_m * 100);
    position_sigma.points.emplace_back(t_s, 200 * std::hypot(pose.sigma_x_m, pose.sigma_y_m));
    heading.points.emplace_back(t_s, std::abs(Degrees(error->heading_rad)));
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
         ToSvg({"gap to the nearest thing", "m", {gap}, spans, end_s});
}

}  // namespace

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

std::string ReportPage(const RunRecord& record, const Summary& summary, const std::string& svg) {
  const bool good = summary.passed && summary.contacts == 0;
  const std::string title = fmt::format("{}, seed {}", drawing::EscapeMarkup(summary.scenario), summary.seed);
  std::string page = "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">";
  page += "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">";
  page += fmt::format("<title>PRIAMOS: {}</title>\n<style>{}</style></head>\n<body><main>\n", title,
                      kReportStyle);
  page += fmt::format("<header><h1>{}</h1><span class=\"verdict {}\">{}</span></header>\n", title,
                      good ? "good" : "bad", drawing::EscapeMarkup(Verdict(summary)));
  if (!summary.passed)
    page += fmt::format("<p class=\"reason\">{}</p>\n", drawing::EscapeMarkup(summary.reason));
  page += Cards(summary);
  page += fmt::format(
      "<img alt=\"Ground plan with what stood in it, true path, believed path and fixes; legend and "
      "figures\" "
      "src=\"data:image/svg+xml;base64,{}\">\n",
      Base64(svg));
  page += "<h2>Mission</h2>\n" + PhaseTable(record, summary);
  const std::string looks = LookDrawings(record);
  if (SeeksTheDoor(summary)) page += "<h2>Fixes</h2>\n" + FixTable(summary);
  if (!looks.empty()) page += "<h2>Looks</h2>\n" + looks;
  page += "<h2>Over time</h2>\n";
  if (!looks.empty()) page += "<p>Shaded: from a look at the door to the fix.</p>\n";
  page += "<div class=\"two\">" + Plots(record) + "</div>\n";
  page += "<h2>Radio</h2>\n<div class=\"two\">" + RadioTable("up: robot to workstation", summary.up) +
          RadioTable("down: workstation to robot", summary.down) + "</div>\n";
  page += fmt::format(
      "<footer>A pose is {:.2f} s old at the workstation (median). Simulated at {:.1f} times "
      "real time.</footer>\n</main></body></html>\n",
      summary.pose_age_s, summary.realtime_factor);
  return page;
}

}  // namespace priamos::cli
