#include "cli/terminal/view_screen.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/geometry.hpp"
#include "common/image_size.hpp"
#include "planner/planner_messages.hpp"

namespace priamos::cli {
namespace {

constexpr ImageSize kPicture{};      // of every camera: lcmtypes/README.md
constexpr int kStrip = 61;           // characters, where there is room for them
constexpr int kLeastPicture = 4;     // rows
constexpr double kStripReach_m = 1;  // to either side
constexpr std::array<std::string_view, 3> kSides{"", ", left side", ", right side"};

int Count(const landmark_view_t& view, int kind) {
  return static_cast<int>(std::count_if(view.edges.begin(), view.edges.end(),
                                        [kind](const view_edge_t& e) { return e.kind == kind; }));
}

Braille::Ink InkOf(int kind) {
  if (kind == view_edge_t::MATCHED) return Braille::kGreen;
  return kind == view_edge_t::REJECTED ? Braille::kRed : Braille::kDim;
}

std::string Piece(const obstacle_segment_t& s) {
  const double ahead = (s.x1_m + s.x2_m) / 2;
  const std::string where = fmt::format("{:.1f} m ahead, from {:+.2f} to {:+.2f} m", ahead, s.y2_m, s.y1_m);
  if (s.kind == obstacle_segment_t::MISSING) return "no line " + where;
  return fmt::format("{} {:.1f} cm {}", s.kind == obstacle_segment_t::UP ? "UP" : "DOWN",
                     100 * std::abs(s.height_m), where);
}

/// From the left to the right: floor, up, down, not seen.
std::string Strip(const obstacle_line_t& line, int characters) {
  std::string strip(static_cast<std::size_t>(characters), line.verdict == obstacle_line_t::BLIND ? '?' : '-');
  const auto column = [characters](double y_m) {
    const double place = (kStripReach_m - y_m) / (2 * kStripReach_m) * (characters - 1);
    return static_cast<int>(std::lround(std::clamp(place, 0.0, characters - 1.0)));
  };
  for (const obstacle_segment_t& s : line.segments) {
    if (!std::isfinite(s.y1_m + s.y2_m) || s.kind < 0 || s.kind > 2) continue;
    const int first = column(std::max(s.y1_m, s.y2_m)), last = column(std::min(s.y1_m, s.y2_m));
    for (int i = first; i <= last; ++i) strip[static_cast<std::size_t>(i)] = "^v "[s.kind];
  }
  return strip;
}

}  // namespace

std::string FloorText(const obstacle_line_t& line, double age_s, int columns) {
  std::string text = line.verdict == obstacle_line_t::CLEAR   ? "floor: clear"
                     : line.verdict == obstacle_line_t::BLIND ? "floor: not to be seen"
                                                              : "floor: OBSTACLE";
  for (const obstacle_segment_t& s : line.segments) {
    if (s.kind == obstacle_segment_t::MISSING && line.verdict == obstacle_line_t::OBSTACLE) continue;
    text += "; " + Piece(s);
    break;
  }
  const int strip = std::clamp(columns - 13, 1, kStrip);
  return Wrapped(fmt::format("{}; {:.0f} % of the line seen {:.1f} s ago", text, 100 * line.seen_share,
                             std::max(age_s, 0.0)),
                 columns) +
         fmt::format("left |{}| right\n", Strip(line, strip));
}

std::string ViewTitle(const landmark_view_t& view, const landmark_fix_t* fix) {
  return fmt::format("look {}: {}", view.request_id, ViewFinding(view, fix));
}

std::string ViewFinding(const landmark_view_t& view, const landmark_fix_t* fix) {
  std::string text = fmt::format("landmark {}{}: {}", view.landmark_id,
                                 kSides[static_cast<std::size_t>(std::clamp<int>(view.side, 0, 2))],
                                 view.verdict == landmark_fix_t::FOUND
                                     ? "FOUND"
                                     : "not found, " + std::string(planner::FixVerdictText(view.verdict)));
  if (fix == nullptr || fix->request_id != view.request_id || fix->verdict != view.verdict) return text;
  if (fix->n_matched > 0) text += fmt::format("; {} edges, {:.2f} px", fix->n_matched, fix->residual_px);
  if (fix->verdict == landmark_fix_t::FOUND)
    text += fmt::format(", {:.1f} mm, {:.2f} deg", 1000 * std::hypot(fix->sigma_x_m, fix->sigma_y_m),
                        Degrees(fix->sigma_yaw_rad));
  return text;
}

std::string ViewLegend(const landmark_view_t& view) {
  std::string text =
      fmt::format("{} camera: {} edges expected (dotted), {} matched (green), {} rejected (red)",
                  view.camera == 1 ? "right" : "left", Count(view, view_edge_t::PREDICTED),
                  Count(view, view_edge_t::MATCHED), Count(view, view_edge_t::REJECTED));
  if (view.n_left_out > 0) text += fmt::format(", {} more not shown", view.n_left_out);
  return text;
}

Braille DrawView(const landmark_view_t& view, ScreenSize size) {
  const double scale = std::min(2.0 * size.columns / kPicture.width, 4.0 * size.rows / kPicture.height);
  Braille picture(static_cast<int>(kPicture.width * scale / 2),
                  static_cast<int>(kPicture.height * scale / 4));
  const double right = picture.width() - 1, bottom = picture.height() - 1;
  picture.Line(0, 0, right, 0, Braille::kDim);
  picture.Line(0, bottom, right, bottom, Braille::kDim);
  picture.Line(0, 0, 0, bottom, Braille::kDim);
  picture.Line(right, 0, right, bottom, Braille::kDim);
  for (const view_edge_t& e : view.edges)
    picture.Line(e.u1_px * scale, e.v1_px * scale, e.u2_px * scale, e.v2_px * scale, InkOf(e.kind),
                 e.kind == view_edge_t::PREDICTED ? 3 : 1);
  return picture;
}

std::string ViewScreen::Render(Time now, ScreenSize size, bool colour) const {
  std::string text;
  if (line_) text += FloorText(*line_, Seconds(now - FromUtime(line_->utime_exposure)), size.columns);
  if (!view_)
    return text +
           Wrapped("waiting for LANDMARK_VIEW: it comes when the head looks at a landmark", size.columns);
  const landmark_view_t& view = *view_;
  const double age_s = Seconds(now - FromUtime(view.utime_exposure));
  text += Wrapped(ViewTitle(view, fix_ ? &*fix_ : nullptr), size.columns) +
          Wrapped(ViewLegend(view), size.columns) + fmt::format("seen {:.1f} s ago\n", std::max(age_s, 0.0));
  const int rows = size.rows - Lines(text) - 1;
  return text + DrawView(view, {size.columns, std::max(rows, kLeastPicture)}).Text(colour);
}

}  // namespace priamos::cli
