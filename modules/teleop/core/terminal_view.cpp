#include "teleop/core/terminal_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace priamos::teleop {
namespace {

constexpr int kHalfBar = 20;

/// Bar of characters, `.......####|..........`: it grows from the middle, to the left for negative values.
std::string Bar(double value) {
  std::string bar(2 * kHalfBar + 1, '.');
  bar[kHalfBar] = '|';
  const long reach = std::lround(std::clamp(value, -1.0, 1.0) * kHalfBar);
  for (long i = 1; i <= std::abs(reach); ++i)
    bar[static_cast<std::size_t>(kHalfBar + (reach < 0 ? -i : i))] = '#';
  return bar;
}

/// What the operator does next.
const char* NextStep(const TerminalView& view) {
  if (view.estop && view.phase != PilotPhase::kNoDevice)
    return "nothing moves: let go of everything, then hold re-arm";
  switch (view.phase) {
    case PilotPhase::kNoDevice:
      return "no device";
    case PilotPhase::kIdle:
      return view.device == "keyboard" ? "press and hold a key to drive" : "hold the dead-man and push";
    case PilotPhase::kMustLetGo:
      return "let go of the stick and of the dead-man first";
    case PilotPhase::kAsking:
      return "asking for the lease";
    case PilotPhase::kDriving:
      return "driving";
  }
  return "";
}

std::string Buttons(const TerminalView& view) {
  std::string text;
  const auto add = [&](int button, const char* name) {
    if (button >= 0)
      text += fmt::format("{}{}{} ", IsPressed(view.stick, button) ? "[" : " ", name,
                          IsPressed(view.stick, button) ? "]" : " ");
  };
  add(view.buttons.dead_man, "dead-man");
  add(view.buttons.mode, "mode");
  add(view.buttons.take_over, "take-over");
  add(view.buttons.range, "range");
  add(view.buttons.rearm, "re-arm");
  add(view.buttons.estop, "E-STOP");
  return text;
}

std::string Wish(const TerminalView& view) {
  const HeadRates& h = view.head_wish;
  if (view.mode == PilotMode::kBase)
    return fmt::format("x {:+.2f} m/s   y {:+.2f} m/s   turn {:+.2f} rad/s", view.wish.vx, view.wish.vy,
                       view.wish.wz);
  return fmt::format("pan {:+.2f}  tilt {:+.2f}  vergence {:+.2f} rad/s  zoom {:+.0f}  focus {:+.0f} step/s",
                     h.pan_rad_s, h.tilt_rad_s, h.vergence_rad_s, h.zoom_step_s, h.focus_step_s);
}

std::string Robot(const TerminalView& view) {
  if (!view.answer_age_s) return "no answer yet";
  return fmt::format("answered {:.1f} s ago: {}, {:.2f} m/s", *view.answer_age_s, view.doing, view.speed_m_s);
}

std::string Limit(const TerminalView& view) {
  if (!view.answer_age_s) return "-";
  const std::string nearest = view.nearest_m < 0 ? "" : fmt::format(", {:.2f} m free ahead", view.nearest_m);
  return fmt::format("{} ({:.0f} % of the wish left{})", view.limit, 100 * view.allowed, nearest);
}

}  // namespace

std::array<std::string, kAxes> Uses(const PilotConfig& config, PilotMode mode) {
  std::array<std::string, kAxes> uses{};
  const auto add = [&uses](const AxisUse& use, const char* name) {
    for (std::size_t i = 0; i < kAxes; ++i)
      if (use.axis == kAxisNames[i]) uses[i] += (uses[i].empty() ? "" : ", ") + std::string(name);
  };
  if (mode == PilotMode::kBase) {
    add(config.base.vx, "x");
    add(config.base.vy, "y");
    add(config.base.turn, "turn");
  } else {
    add(config.head.pan, "pan");
    add(config.head.tilt, "tilt");
    add(config.head.vergence, "vergence");
    add(config.head.zoom, "zoom");
    add(config.head.focus, "focus");
  }
  return uses;
}

std::string Draw(const TerminalView& view) {
  std::string text =
      fmt::format("PRIAMOS teleop   {}   {} mode   {} range\n", view.device,
                  view.mode == PilotMode::kBase ? "BASE" : "HEAD", view.fast ? "fast" : "slow");
  for (std::size_t i = 0; i < kAxes; ++i)
    text += fmt::format("  {:<8} {} {:+.2f}{}\n", kAxisNames[i], Bar(view.stick.axis[i]), view.stick.axis[i],
                        view.uses[i].empty() ? "" : "  " + view.uses[i]);
  text += fmt::format("  buttons  {}\n", Buttons(view));
  text += fmt::format("  stick    {}\n", NextStep(view));
  text += fmt::format("  wish     {}\n", Wish(view));
  text += fmt::format("  lease    {}\n", view.answer_age_s ? view.lease : "-");
  text += fmt::format("  robot    {}\n", Robot(view));
  text += fmt::format("  limit    {}\n", Limit(view));
  text += fmt::format("  refused  {} commands{}\n", view.refused,
                      view.refusal.empty() ? "" : ", the last one: " + view.refusal);
  text += fmt::format("  e-stop   {}\n", !view.answer_age_s ? "-"
                                         : view.estop       ? "*** LATCHED ***"
                                                            : "not pressed");
  return text;
}

}  // namespace priamos::teleop
