#include "cli/report/report_html.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/report/report_looks.hpp"
#include "cli/report/report_parts.hpp"
#include "cli/report/report_table.hpp"
#include "cli/report/report_timeline.hpp"
#include "common/drawing/svg.hpp"
#include "common/time.hpp"

namespace priamos::cli {
namespace {

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

}  // namespace

std::string ReportPage(const RunRecord& record, const Summary& summary, const std::string& svg) {
  const bool good = summary.passed && summary.contacts == 0;
  const std::string title = fmt::format("{}, seed {}", summary.scenario, summary.seed);
  std::string page = PageHead(title, good, Verdict(summary));
  if (!summary.passed)
    page += fmt::format("<p class=\"reason\">{}</p>\n", drawing::EscapeMarkup(summary.reason));
  page += Cards(summary);
  page += Picture("Ground plan with what stood in it, true path, believed path and fixes; legend and figures",
                  svg);
  page += "<h2>Mission</h2>\n" + PhaseTable(record, summary);
  const std::string looks = LookDrawings(record);
  if (SeeksTheDoor(summary)) page += "<h2>Fixes</h2>\n" + FixTable(summary);
  if (!looks.empty()) page += "<h2>Looks</h2>\n" + looks;
  page += "<h2>Over time</h2>\n";
  if (!looks.empty()) page += "<p>Shaded: from a look at the door to the fix.</p>\n";
  page += "<div class=\"two\">" + Plots(record, SpanOf(record)) + "</div>\n";
  const std::string alarms = AlarmTable(record, SpanOf(record).begin_utime);
  if (!alarms.empty()) page += "<h2>Alarms</h2>\n" + alarms;
  page += RadioSection(summary.up, summary.down);
  page += fmt::format(
      "<footer>A pose is {:.2f} s old at the workstation (median). Simulated at {:.1f} times "
      "real time.</footer>\n</main></body></html>\n",
      summary.pose_age_s, summary.realtime_factor);
  return page;
}

}  // namespace priamos::cli
