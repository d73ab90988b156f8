#include "cli/report/report_looks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "cli/terminal/view_screen.hpp"
#include "common/drawing/svg.hpp"
#include "common/image_size.hpp"

namespace priamos::cli {
namespace {

constexpr std::array<const char*, 3> kClasses{"expected", "matched", "rejected"};

const landmark_fix_t* FixOf(const RunRecord& record, const landmark_view_t& view) {
  const auto fix = std::find_if(record.fixes.begin(), record.fixes.end(), [&](const landmark_fix_t& f) {
    return f.request_id == view.request_id && f.utime_exposure == view.utime_exposure;
  });
  return fix == record.fixes.end() ? nullptr : &*fix;
}

std::string LookDrawing(const landmark_view_t& view) {
  constexpr ImageSize kPicture{};
  std::string svg =
      fmt::format("<svg class=\"look\" viewBox=\"0 0 {} {}\">", kPicture.width, kPicture.height);
  for (const view_edge_t& e : view.edges) {
    const auto kind = static_cast<std::uint8_t>(e.kind);  // a negative one is too large
    if (kind >= kClasses.size()) continue;
    if (!std::isfinite(e.u1_px + e.v1_px + e.u2_px + e.v2_px)) continue;
    svg += fmt::format("<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>",
                       kClasses[kind], e.u1_px, e.v1_px, e.u2_px, e.v2_px);
  }
  return svg + "</svg>";
}

}  // namespace

std::string LookDrawings(const RunRecord& record) {
  std::string html;
  std::vector<std::int64_t> looks;  // one look may show several views
  for (const landmark_view_t& view : record.views) {
    if (looks.empty() || looks.back() != view.request_id) looks.push_back(view.request_id);
    const std::string title = fmt::format("look {} ({} in the log): {}", looks.size(), view.request_id,
                                          ViewFinding(view, FixOf(record, view)));
    html += fmt::format("<figure>{}<figcaption>{}<br>{}</figcaption></figure>\n", LookDrawing(view),
                        drawing::EscapeMarkup(title), drawing::EscapeMarkup(ViewLegend(view)));
  }
  return html.empty() ? html : "<div class=\"two\">" + html + "</div>\n";
}

}  // namespace priamos::cli
