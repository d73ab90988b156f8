#include "cli/report/report_table.hpp"

#include <fmt/format.h>

#include <ostream>

namespace priamos::cli {
namespace {

constexpr int kColumns = 76;

void Rule(std::ostream& out, std::string_view title) {
  out << fmt::format("\n{} {:-<{}}\n", title, "", kColumns - 1 - static_cast<int>(title.size()));
}

std::string Figure(const std::optional<double>& value, double factor, std::string_view form) {
  return value ? fmt::format(fmt::runtime(form), *value * factor) : "-";
}

void PrintFixes(std::ostream& out, const Summary& summary) {
  Rule(out, "pose error");
  if (summary.fixes.empty()) out << "  no fix corrected the pose\n";
  if (!summary.fixes.empty())
    out << fmt::format("  {:<6}{:>8}   {:>20}   {:>20}   {:>13}\n", "fix", "at", "before", "after",
                       "1 sigma");
  for (std::size_t i = 0; i < summary.fixes.size(); ++i) {
    const FixSummary& f = summary.fixes[i];
    out << fmt::format(
        "  {:<6}{:>6.1f} s   {:>8.1f} cm {:>4.2f} deg   {:>8.1f} cm {:>4.2f} deg   {:.1f} cm {:.2f} deg\n",
        i + 1, f.t_s, f.error_before_m * 100, f.error_before_deg, f.error_after_m * 100, f.error_after_deg,
        f.sigma_m * 100, f.sigma_deg);
  }
}

void PrintDoor(std::ostream& out, const Summary& summary) {
  Rule(out, "door");
  out << fmt::format("  in the door plane   {} lateral, {} heading\n",
                     Figure(summary.lateral_at_door_m, 100, "{:+.1f} cm"),
                     Figure(summary.heading_at_door_deg, 1, "{:+.2f} deg"));
  out << fmt::format("  while fixing        {} at least\n",
                     Figure(summary.min_speed_during_fix_m_s, 1, "{:.2f} m/s"));
  out << fmt::format("  corrections         {}, {} beyond 3 sigmas; largest distance {:.1f}\n",
                     summary.corrections.count, summary.corrections.beyond_3_sigma,
                     summary.corrections.most_distance);
}

void PrintRadio(std::ostream& out, std::string_view title, const RadioSummary& radio) {
  constexpr const char* kRow = "  {:<36}{:>12}{:>12}{:>12}\n";
  out << fmt::format(kRow, title, "messages", "bytes", "dropped");
  for (const auto& channel : radio.channels)
    out << fmt::format(kRow, "  " + channel.channel, channel.messages, channel.bytes, channel.dropped);
  out << fmt::format(kRow, fmt::format("  frames, {:.0f} % of the line", radio.utilisation * 100),
                     radio.frames, radio.bytes, radio.dropped);
}

void PrintExplore(std::ostream& out, const ExploreSummary& explore) {
  Rule(out, "floor");
  out << fmt::format("  seen                {:.1f} % of {:.0f} m2 that can be reached; {:.1f} m driven\n",
                     100 * explore.seen, explore.reachable_m2, explore.driven_m);
  out << fmt::format(
      "  tour                {:.1f} m to {} places that see 98 % of it, by who knows the floor\n",
      explore.tour_m, explore.tour_places);
  out << fmt::format("  walls               {:.0f} m told, 95 % within {:.1f} cm of a true face\n",
                     explore.wall_m, 100 * explore.wall_error_p95_m);
  out << fmt::format("  pose at the end     off by {:.1f} cm, {:.2f} deg\n", 100 * explore.pose_error_m,
                     explore.pose_error_deg);
  out << "  end                 " << explore.end << "\n";
}

void PrintFoundDoors(std::ostream& out, const FoundDoors& doors) {
  Rule(out, "doors on the way");
  for (const FoundDoor& door : doors.on_the_way) {
    const std::string is = fmt::format("{}, {:.0f} deg open", door.state, door.open_deg);
    out << fmt::format("  {:<12}{:<20}{}\n", door.name, is,
                       door.told ? fmt::format("told {}, {:+.1f} cm along the wall, {:+.1f} cm across it",
                                               *door.told, 100 * door.along_m, 100 * door.across_m)
                                 : "not found");
  }
  if (doors.false_ones > 0) out << fmt::format("  {} told where none is\n", doors.false_ones);
}

void PrintFoundObjects(std::ostream& out, const FoundObjects& things) {
  Rule(out, "things that the head saw");
  out << fmt::format("  told                {}: {} boxes, {} faces, {} edges\n", things.told(), things.boxes,
                     things.faces, things.edges);
  out << fmt::format("  truly there         {}, and {} where no surface is within 10 cm\n", things.standing,
                     things.phantoms);
  out << fmt::format(
      "  fronts              95 % within {:.1f} cm of a true surface, less the error of the pose\n",
      100 * things.front_p95_m);
}

void PrintHand(std::ostream& out, const HandSummary& hand) {
  Rule(out, "operator");
  out << fmt::format("  pushed for {:.0f} s; of the motion that was truly free {} was honoured\n",
                     hand.wished_s, Figure(hand.honoured(), 100, "{:.1f} %"));
  out << fmt::format("  longest stop in the passage while pushed: {}\n",
                     Figure(hand.longest_stop_s, 1, "{:.1f} s"));
}

}  // namespace

std::string Verdict(const Summary& summary) {
  return fmt::format("{}, {}", summary.passed ? "passed" : "not passed",
                     summary.contacts == 0
                         ? (summary.touches.empty() ? "nothing touched" : "touched by what came")
                     : summary.contacts == 1 ? "one contact"
                                             : fmt::format("{} contacts", summary.contacts));
}

void PrintSummary(std::ostream& out, const Summary& summary) {
  Rule(out, "run");
  out << fmt::format("  {}, seed {}: {} after {:.1f} s\n", summary.scenario, summary.seed, Verdict(summary),
                     summary.duration_s);
  if (summary.explore) PrintExplore(out, *summary.explore);
  if (SeeksTheDoor(summary) && !summary.explore) {
    PrintFixes(out, summary);
    PrintDoor(out, summary);
  }
  if (summary.doors) PrintFoundDoors(out, *summary.doors);
  if (summary.things) PrintFoundObjects(out, *summary.things);
  if (summary.hand) PrintHand(out, *summary.hand);
  Rule(out, "drive");
  out << fmt::format("  smallest gap        {:.1f} cm, {} contact{}\n", summary.min_gap_m * 100,
                     summary.contacts, summary.contacts == 1 ? "" : "s");
  out << fmt::format("  speed               {:.2f} m/s mean\n", summary.mean_speed_m_s);
  Rule(out, "radio");
  PrintRadio(out, "up: robot to workstation", summary.up);
  PrintRadio(out, "down: workstation to robot", summary.down);
  out << fmt::format("  a pose is {:.2f} s old at the workstation (median)\n", summary.pose_age_s);
  out << std::string(kColumns, '-') << "\n";
}

}  // namespace priamos::cli
