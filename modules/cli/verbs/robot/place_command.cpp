#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>

#include "cli/options/verb_setup.hpp"
#include "cli/terminal/bus_session.hpp"
#include "cli/terminal/json_line.hpp"
#include "cli/verbs/robot/commands.hpp"
#include "common/geometry.hpp"
#include "common/pilot/repeated_order.hpp"
#include "lcmtypes/channels.hpp"
#include "planner/planner_messages.hpp"

namespace priamos::cli {
namespace {

constexpr int kNotSet = 1;
constexpr std::int64_t kRequestIds = 65535;

struct PlaceOptions {
  BusOptions bus;
  double x_m = 0, y_m = 0, yaw_deg = 0;
  double sigma_m = 0.1, sigma_deg = 3;
  bool json = false;
};

pose_reset_t OrderOf(const PlaceOptions& options, Time now) {
  pose_reset_t order{};
  order.utime = ToUtime(now);
  order.request_id = static_cast<std::int32_t>(1 + order.utime / 1000 % kRequestIds);
  order.x_m = options.x_m;
  order.y_m = options.y_m;
  order.yaw_rad = WrapAngle(Radians(options.yaw_deg));
  order.sigma_m = options.sigma_m;
  order.sigma_yaw_rad = Radians(options.sigma_deg);
  return order;
}

/// The robot's answer; nullopt when none came in time.
std::optional<pose_correction_t> Ask(const PlaceOptions& options) {
  BusSession session("priamos place", options.bus, channels::kPoseCorrection.name);
  auto answers = session.node().SubscribeAll(channels::kPoseCorrection);
  auto orders = session.node().Advertise(channels::kPoseReset);
  RepeatedOrder<pose_reset_t> order;
  std::optional<pose_correction_t> answer;
  order.Give(OrderOf(options, session.now()), session.now());
  session.Watch(
      Time::max(), [&] { return !order.open(); },
      [&] {
        for (const pose_correction_t& message : answers.Drain()) {
          if (!order.Answered(message.request_id)) continue;
          session.Heard();
          answer = message;
        }
        if (const auto again = order.Step(session.now())) orders.Publish(*again);
      });
  return answer;
}

/// How far the pose was moved; the answer holds no more than 5 m along either axis.
std::string MovedBy(const pose_correction_t& answer) {
  constexpr double kMost_m = 5;
  const bool cut = std::max(std::abs(answer.dx_m), std::abs(answer.dy_m)) >= kMost_m;
  return cut ? fmt::format("more than {:.0f} m", kMost_m)
             : fmt::format("{:.2f} m", std::hypot(answer.dx_m, answer.dy_m));
}

int Run(const PlaceOptions& options) {
  const auto answer = Ask(options);
  const bool set = answer && answer->verdict == pose_correction_t::RESET;
  const std::string outcome = !answer ? "no answer from the robot; next: priamos link top"
                              : set ? fmt::format("the pose is set, {} and {:.1f} degrees from where it was",
                                                  MovedBy(*answer), Degrees(answer->dyaw_rad))
                                    : std::string(planner::CorrectionVerdictText(answer->verdict));
  if (options.json) std::cout << JsonLine({{"set", set}, {"text", outcome}}) << "\n";
  if (set && !options.json) std::cout << outcome << "\n";
  if (!set) std::cerr << "priamos place: the pose is not set: " << outcome << "\n";
  return set ? 0 : kNotSet;
}

}  // namespace

void AddPlaceCommand(CLI::App& cli, int& exit_code) {
  constexpr double kFarthest_m = 100, kTurn_deg = 360;
  auto options = std::make_shared<PlaceOptions>();
  auto* verb = AddVerb(
      cli, "place", "Tell the robot where it stands; it must be at rest (exit code 1: the pose is not set).");
  verb->footer("Example: priamos place 2.0 2.4 0");
  verb->add_option("x", options->x_m, "[m] map frame")
      ->required()
      ->check(CLI::Range(-kFarthest_m, kFarthest_m));
  verb->add_option("y", options->y_m, "[m] map frame")
      ->required()
      ->check(CLI::Range(-kFarthest_m, kFarthest_m));
  verb->add_option("yaw", options->yaw_deg, "[deg] heading")
      ->required()
      ->check(CLI::Range(-kTurn_deg, kTurn_deg));
  verb->add_option("--sigma-m", options->sigma_m, "[m] how well x and y are known, one sigma")
      ->check(CLI::Range(0.01, 2.0))
      ->capture_default_str();
  verb->add_option("--sigma-deg", options->sigma_deg, "[deg] how well the heading is known, one sigma")
      ->check(CLI::Range(0.3, 90.0))
      ->capture_default_str();
  AddBusOption(*verb, options->bus);
  CompleteVerb(*verb, options, Run, exit_code, "the outcome machine-readable");
}

}  // namespace priamos::cli
