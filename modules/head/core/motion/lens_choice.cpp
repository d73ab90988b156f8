#include "head/core/motion/lens_choice.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace priamos::head {
namespace {

constexpr int kZoomGrid_steps = 100, kFocusGrid_steps = 10;
constexpr double kDrives_m_s = 0.05;  // a base that is slower stands

/// Calibrated steps of a motor that both cameras have and that can be approached from below.
struct StepRange {
  int first = 0, last = -1;

  bool Contains(int step) const { return step >= first && step <= last; }
};

StepRange RangeOf(const HeadModel& head, const std::vector<int>& (LensTable::*steps)() const,
                  int approach_steps) {
  StepRange range{approach_steps, 1'000'000};
  for (const Camera camera : {kLeft, kRight}) {
    const std::vector<int>& all = (head.lenses[camera].*steps)();
    if (all.empty()) return {};
    range = {std::max(range.first, all.front()), std::min(range.last, all.back())};
  }
  return range;
}

/// Inverse distances of the landmark's fixed edges from the head [1/m].
struct DioptreRange {
  double nearest = 0, farthest = 0;
};

DioptreRange DioptresOf(const HeadGeometry& head, const LandmarkModel& model,
                        const Pose2& base_from_landmark) {
  constexpr double kTooNear_m = 0.1;
  const Eigen::Isometry3d transform = Lift(base_from_landmark);
  DioptreRange range{0, 1 / kTooNear_m};
  for (const LandmarkEdge& edge : model.edges) {
    if (edge.IsMovable()) continue;
    const Eigen::Vector2d d = (transform * edge.from).head<2>() - Eigen::Vector2d(head.x_m, head.y_m);
    const double dioptre = 1 / std::max(d.norm(), kTooNear_m);
    range = {std::max(range.nearest, dioptre), std::min(range.farthest, dioptre)};
  }
  return range;
}

/// A setting and what it is worth.
struct Choice {
  HeadSetting setting;
  int lost = 0;  ///< edges that the fixed setting would keep
  bool whole = true;
  double score = 0;  ///< logarithm of what the look tells in a second
};

bool IsBetter(const Choice& a, const Choice& b) {
  return a.lost != b.lost ? a.lost < b.lost : a.score > b.score;
}

/// One question, with what does not depend on the setting.
class Chooser {
 public:
  Chooser(const HeadModel& head, const HeadSetting& fixed, const HeadSetting& here, const LookWish& wish,
          const AimConfig& aim, const LensChoiceConfig& config, int approach_steps)
      : head_(head),
        fixed_(fixed),
        here_(here),
        wish_(wish),
        aim_(aim),
        config_(config),
        approach_steps_(approach_steps),
        zooms_(RangeOf(head, &LensTable::zoom_steps, approach_steps)),
        focuses_(RangeOf(head, &LensTable::focus_steps, approach_steps)),
        drives_(std::hypot(wish.robot.twist.vx, wish.robot.twist.vy) > kDrives_m_s),
        reference_(Kept(Aimed(fixed, 0), 0)) {}

  HeadSetting Best() const {
    Choice best = Judge(fixed_);
    std::vector<std::pair<double, HeadSetting>> settings;  // with the most that each can be worth
    for (const HeadSetting& setting : Settings()) settings.emplace_back(MostScore(setting), setting);
    std::ranges::sort(settings, std::greater(), [](const auto& s) { return s.first; });
    for (const auto& [most, setting] : settings) {
      if (best.lost == 0 && most <= best.score) break;
      const Choice choice = Judge(setting);
      // Through a longer lens a landmark that may be elsewhere would be missed, and of a part little is seen.
      const bool longer = setting.zoom_step[0] > fixed_.zoom_step[0];
      if ((choice.whole || !longer) && IsBetter(choice, best)) best = choice;
    }
    return best.setting;
  }

 private:
  HeadSetting At(int zoom, int focus) const {
    HeadSetting setting = fixed_;
    setting.zoom_step = {zoom, zoom};
    setting.focus_step = {focus, focus};
    return setting;
  }

  /// All that is looked at: where the motors are, and a grid over the zoom, in focus and as it is.
  std::vector<HeadSetting> Settings() const {
    std::vector<int> zooms{here_.zoom_step[0]}, focuses{here_.focus_step[0], fixed_.focus_step[0]};
    for (int zoom = zooms_.first; zoom <= zooms_.last; zoom += kZoomGrid_steps) zooms.push_back(zoom);
    std::vector<HeadSetting> settings;
    for (const int zoom : zooms) {
      if (!zooms_.Contains(zoom)) continue;
      for (const int focus : focuses)
        if (focuses_.Contains(focus)) settings.push_back(At(zoom, focus));
      if (const auto sharp = InFocus(zoom)) settings.push_back(*sharp);
    }
    return settings;
  }

  /// In focus for where the landmark is once the motors have arrived, as far as the ring turns.
  std::optional<HeadSetting> InFocus(int zoom) const {
    if (focuses_.first > focuses_.last) return std::nullopt;
    HeadSetting setting = At(zoom, std::clamp(here_.focus_step[0], focuses_.first, focuses_.last));
    for (int pass = 0; pass < 2; ++pass) {
      const DioptreRange range =
          DioptresOf(head_.geometry, wish_.model, Expected(Extra(setting)).base_from_landmark);
      const double step = config_.optics.StepFor((range.nearest + range.farthest) / 2);
      const int round = kFocusGrid_steps * static_cast<int>(std::lround(step / kFocusGrid_steps));
      setting = At(zoom, std::clamp(round, focuses_.first, focuses_.last));
    }
    return setting;
  }

  /// How much longer [s] than without moving the lenses a look takes.
  double Extra(const HeadSetting& setting) const {
    double longest = 0;
    for (int i = 0; i < 2; ++i) {
      longest =
          std::max({longest, LensTravel(here_.zoom_step[i], setting.zoom_step[i], approach_steps_, config_),
                    LensTravel(here_.focus_step[i], setting.focus_step[i], approach_steps_, config_)});
    }
    return std::max(0.0, longest - config_.turn_s);
  }

  LandmarkPrediction Expected(double extra_s) const {
    return PredictAhead(wish_.robot, wish_.model.map_from_landmark, aim_.lead_s + extra_s);
  }

  HeadSetting Aimed(HeadSetting setting, double extra_s) const {
    setting.pan_rad = AimPan(head_, setting, wish_.model, Expected(extra_s), wish_.side, aim_);
    return setting;
  }

  KeptEdges Kept(const HeadSetting& aimed, double extra_s) const {
    return KeptAt(head_, aimed, wish_.model, Expected(extra_s), aim_);
  }

  double Score(const HeadSetting& setting, int kept) const {
    const auto camera = head_.CameraAt(setting, kLeft);
    if (!camera) return -1e9;
    const double extra_s = Extra(setting);
    const DioptreRange range = DioptresOf(head_.geometry, wish_.model, Expected(extra_s).base_from_landmark);
    double blur_px = 0;
    for (const double dioptre : {range.nearest, range.farthest})
      blur_px = std::max(blur_px, config_.optics.Blur(camera->scale_px, setting.focus_step[0], dioptre));
    const double look_s = drives_ ? config_.driving_look_s : config_.standing_look_s;
    const bool stays = setting.zoom_step == here_.zoom_step && setting.focus_step == here_.focus_step;
    return std::log(std::max(kept, 1)) + 2 * std::log(camera->scale_px / blur_px) -
           std::log((look_s + extra_s) / look_s) + (stays ? config_.least_gain : 0);
  }

  double MostScore(const HeadSetting& setting) const {
    return Score(setting, static_cast<int>(wish_.model.edges.size()));
  }

  Choice Judge(const HeadSetting& setting) const {
    const double extra_s = Extra(setting);
    const HeadSetting aimed = Aimed(setting, extra_s);
    const KeptEdges kept = Kept(aimed, extra_s);
    return {aimed, kept.Lost(reference_), kept.whole, Score(setting, kept.count())};
  }

  const HeadModel& head_;
  const HeadSetting &fixed_, &here_;
  const LookWish& wish_;
  const AimConfig& aim_;
  const LensChoiceConfig& config_;
  int approach_steps_;
  StepRange zooms_, focuses_;
  bool drives_;
  KeptEdges reference_;  ///< of a head that has always stood at the fixed setting
};

double MoveTime(double steps, const LensChoiceConfig& config) {
  const double to_speed_s = config.speed_step_s / config.acceleration_step_s2;
  if (steps <= config.speed_step_s * to_speed_s) return 2 * std::sqrt(steps / config.acceleration_step_s2);
  return steps / config.speed_step_s + to_speed_s;
}

}  // namespace

void LensChoiceConfig::Describe(Archive& a) {
  a.Flag("choose", choose, "zoom and focus for each look by itself; off: zoom_step and focus_step for all");
  a.Number("speed_step_s", speed_step_s, {"step/s", 10, 100000, "of the motors of zoom and focus"});
  a.Number("acceleration_step_s2", acceleration_step_s2, {"step/s^2", 10, 1e6, "of these motors"});
  a.Number("turn_s", turn_s, {"s", 0, 5, "turning takes as long anyway; lens motors within it cost nothing"});
  a.Number("driving_look_s", driving_look_s,
           {"s", 0.1, 60, "what a look takes while the base drives; so much longer it is worth half"});
  a.Number("standing_look_s", standing_look_s, {"s", 0.1, 60, "the same while the base stands"});
  a.Number("least_gain", least_gain,
           {"-", 0, 3, "natural logarithm of what a look tells in a second: less moves no motor"});
  a.Section("optics", optics, "what the lens's maker says");
}

int KeptEdges::count() const {
  return static_cast<int>(std::ranges::count(edge, true));
}

int KeptEdges::Lost(const KeptEdges& other) const {
  int lost = 0;
  for (std::size_t i = 0; i < edge.size(); ++i) lost += other.edge[i] && !edge[i];
  return lost;
}

KeptEdges KeptAt(const HeadModel& head, const HeadSetting& setting, const LandmarkModel& model,
                 const LandmarkPrediction& prediction, const AimConfig& aim) {
  KeptEdges kept{std::vector<bool>(model.edges.size(), false), false};
  const auto left = head.CameraAt(setting, kLeft), right = head.CameraAt(setting, kRight);
  if (!left || !right) return kept;
  kept.whole = true;
  for (std::size_t i = 0; i < model.edges.size(); ++i) {
    const LandmarkEdge& edge = model.edges[i];
    kept.edge[i] = OutsideBy(head.geometry, {*left, *right}, setting.tilt_rad, edge, prediction, aim) == 0;
    if (!edge.IsMovable() && (edge.IsVertical() || edge.IsLevel()) && !kept.edge[i]) kept.whole = false;
  }
  return kept;
}

double LensTravel(int from_step, int to_step, int approach_steps, const LensChoiceConfig& config) {
  const int below = std::max(0, to_step - approach_steps);
  return MoveTime(std::abs(below - from_step), config) + MoveTime(to_step - below, config);
}

HeadSetting ChooseLens(const HeadModel& head, const HeadSetting& fixed, const HeadSetting& here,
                       const LookWish& wish, const AimConfig& aim, const LensChoiceConfig& config,
                       int approach_steps) {
  return Chooser(head, fixed, here, wish, aim, config, approach_steps).Best();
}

}  // namespace priamos::head
