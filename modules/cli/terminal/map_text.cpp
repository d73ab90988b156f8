#include "cli/terminal/map_text.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "cli/terminal/braille.hpp"
#include "common/learned/wall_gaps.hpp"

namespace priamos::cli {
namespace {

constexpr int kLeastRows = 4;

std::string Ago(double seconds) {
  if (seconds < 0) return "-";
  if (seconds < 120) return fmt::format("{:.0f} s", seconds);
  if (seconds < 7200) return fmt::format("{:.0f} min", seconds / 60);
  if (seconds < 172800) return fmt::format("{:.0f} h", seconds / 3600);
  return fmt::format("{:.0f} d", seconds / 86400);
}

/// A window of dots on the map.
class Dots {
 public:
  Dots(const Eigen::AlignedBox2d& box, ScreenSize size)
      : box_(box), dots_per_m_(2 * size.columns / std::max(1.0, box.sizes().x())) {
    const double most = 4.0 * std::max(kLeastRows, size.rows);
    dots_per_m_ = std::min(dots_per_m_, most / std::max(1.0, box.sizes().y()));
    picture_ = Braille(Cells(box.sizes().x(), 2), Cells(box.sizes().y(), 4));
  }
  void Line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, Braille::Ink ink) {
    picture_.Line(X(from), Y(from), X(to), Y(to), ink);
  }
  /// A cross of five dots.
  void Cross(const Eigen::Vector2d& at, Braille::Ink ink) {
    picture_.Line(X(at) - 1, Y(at), X(at) + 1, Y(at), ink);
    picture_.Line(X(at), Y(at) - 1, X(at), Y(at) + 1, ink);
  }
  std::string Text(bool colour) const { return picture_.Text(colour); }

 private:
  int Cells(double metres, int dots) const {
    return std::max(1, static_cast<int>(std::ceil((metres * dots_per_m_ + 1) / dots)));
  }
  double X(const Eigen::Vector2d& at) const { return (at.x() - box_.min().x()) * dots_per_m_; }
  double Y(const Eigen::Vector2d& at) const { return (box_.max().y() - at.y()) * dots_per_m_; }

  Eigen::AlignedBox2d box_;
  double dots_per_m_;
  Braille picture_{1, 1};
};

}  // namespace

std::string MapDots(const GroundPlan& plan, const LearnedWalls& learned, ScreenSize size, bool colour) {
  Eigen::AlignedBox2d box;
  for (const WallPlan& wall : plan.walls) box.extend(wall.from()).extend(wall.to());
  for (const LearnedWall& wall : learned.walls) box.extend(wall.from()).extend(wall.to());
  for (const LearnedPoint& point : learned.points) box.extend(point.at());
  for (const LearnedDoor& door : learned.doors) box.extend(Eigen::Vector2d(door.x_m, door.y_m));
  for (const LearnedObject& object : learned.objects)
    for (const Eigen::Vector2d& corner : object.Footprint().Corners()) box.extend(corner);
  if (box.isEmpty()) return "";
  Dots dots(box, size);
  for (const WallPlan& wall : plan.walls) dots.Line(wall.from(), wall.to(), Braille::kDim);
  for (const LearnedWall& wall : learned.walls) dots.Line(wall.from(), wall.to(), Braille::kGreen);
  for (const LearnedPoint& point : learned.points) dots.Cross(point.at(), Braille::kGreen);
  for (const LearnedDoor& door : learned.doors) {
    const Pose2 at = door.map_from_door();
    dots.Line(at * Eigen::Vector2d(0, -door.width_m / 2), at * Eigen::Vector2d(0, door.width_m / 2),
              door.state == "open" ? Braille::kGreen : Braille::kRed);
  }
  for (const LearnedObject& object : learned.objects) {
    const auto corners = object.Footprint().Corners();
    for (std::size_t i = 0; i < corners.size(); ++i)
      dots.Line(corners[i], corners[(i + 1) % corners.size()], Braille::kRed);
  }
  return dots.Text(colour);
}

std::string ObjectTable(const LearnedWalls& learned, double now_s, std::optional<ScreenSize> size) {
  TextTable table({{"", 9, true},
                   {"front", 8, true},
                   {"is", 5, true},
                   {"size", 8, true},
                   {"from", 6},
                   {"to", 6},
                   {"along", 6},
                   {"across", 6},
                   {"looks", 3},
                   {"seen ago", 4}});
  for (const LearnedObject& object : learned.objects)
    table.Add({NameOf(object), fmt::format("({:.2f}, {:.2f})", object.x_m, object.y_m), object.kind,
               object.kind == "edge" ? "" : SizeOf(object), fmt::format("{:.2f} m", object.bottom_m),
               fmt::format("{:.2f} m", object.top_m), fmt::format("±{:.1f} cm", 100 * object.sigma_along_m),
               fmt::format("±{:.1f} cm", 100 * object.sigma_across_m), fmt::format("{}x", object.looks),
               Ago(now_s - object.seen_s)});
  return size ? table.Render(*size) : table.Render();
}

std::string PointTable(const LearnedWalls& learned, double now_s, std::optional<ScreenSize> size) {
  TextTable table({{"", 10, true}, {"place", 8, true}, {"known to", 6}, {"heard ago", 4}});
  for (const LearnedPoint& point : learned.points)
    table.Add({fmt::format("point {}", point.id), fmt::format("({:.2f}, {:.2f})", point.x_m, point.y_m),
               fmt::format("±{:.1f} cm", 100 * point.sigma_m), Ago(now_s - point.seen_s)});
  return size ? table.Render(*size) : table.Render();
}

std::string DoorTable(const GroundPlan& plan, const LearnedWalls& learned, double now_s,
                      std::optional<ScreenSize> size) {
  TextTable table({{"", 12, true},
                   {"middle", 8, true},
                   {"wide", 6},
                   {"along", 6},
                   {"across", 6},
                   {"is", 6, true},
                   {"changed ago", 4},
                   {"looks", 3},
                   {"seen ago", 4}});
  for (const LearnedDoor& door : learned.doors)
    table.Add({NameOf(door, plan), fmt::format("({:.2f}, {:.2f})", door.x_m, door.y_m),
               fmt::format("{:.2f} m", door.width_m), fmt::format("±{:.1f} cm", 100 * door.sigma_along_m),
               fmt::format("±{:.1f} cm", 100 * door.sigma_across_m), door.state,
               door.changed_s > 0 ? Ago(now_s - door.changed_s) : "-", fmt::format("{}x", door.looks),
               Ago(now_s - door.seen_s)});
  return size ? table.Render(*size) : table.Render();
}

std::string MapTable(const LearnedWalls& learned, double now_s, std::optional<ScreenSize> size) {
  TextTable table({{"", 9, true},
                   {"from", 8, true},
                   {"to", 8, true},
                   {"long", 7},
                   {"across", 6},
                   {"turned", 5},
                   {"told", 3},
                   {"seen ago", 4}});
  const auto place = [](const Eigen::Vector2d& at) {
    return fmt::format("({:.2f}, {:.2f})", at.x(), at.y());
  };
  for (const LearnedWall& wall : learned.walls)
    table.Add({fmt::format("wall {}", wall.id), place(wall.from()), place(wall.to()),
               fmt::format("{:.2f} m", wall.length_m), fmt::format("±{:.1f} cm", 100 * wall.sigma_across_m),
               fmt::format("±{:.1f}°", wall.sigma_yaw_deg), fmt::format("{}x", wall.sightings),
               Ago(now_s - wall.seen_s)});
  for (const WallGap& gap : GapsOf(learned)) {
    const Eigen::Vector2d middle(gap.x_m, gap.y_m),
        half =
            gap.width_m / 2 * Eigen::Vector2d(std::cos(Radians(gap.yaw_deg)), std::sin(Radians(gap.yaw_deg)));
    table.Add({fmt::format("gap {}-{}", gap.before, gap.behind), place(middle - half), place(middle + half),
               fmt::format("{:.2f} m", gap.width_m), "", "", "", ""});
  }
  return size ? table.Render(*size) : table.Render();
}

}  // namespace priamos::cli
