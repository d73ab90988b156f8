#include "planner/agenda_messages.hpp"

#include <algorithm>
#include <utility>

namespace priamos::planner {
namespace {

constexpr std::size_t kMaxText = 200, kMaxTitle = 60, kMaxResult = 120;
constexpr double kMost_s = 360000;

std::int8_t PhaseOf(Phase phase) {
  switch (phase) {
    case Phase::kWaiting:
      return mission_status_t::WAITING;
    case Phase::kApproaching:
      return mission_status_t::APPROACHING;
    case Phase::kLookingLeft:
      return mission_status_t::LOOKING_LEFT;
    case Phase::kLookingRight:
      return mission_status_t::LOOKING_RIGHT;
    case Phase::kPassing:
      return mission_status_t::PASSING;
    case Phase::kRetreating:
      return mission_status_t::RETREATING;
    case Phase::kDriving:
      return mission_status_t::DRIVING;
    case Phase::kDone:
      return mission_status_t::DONE;
    case Phase::kFailed:
      break;
  }
  return mission_status_t::FAILED;
}

AgendaStep FromMessage(const mission_step_t& message) {
  AgendaStep step{{message.mission,
                   message.landmark_id,
                   {{message.x_m, message.y_m, WrapAngle(message.yaw_rad)}, message.turn != 0},
                   message.distance_m}};
  if (message.mission == mission_command_t::WAIT) step.wait_s = message.wait_s;
  return step;
}

std::int8_t OutcomeOf(AgendaEnd end) {
  switch (end) {
    case AgendaEnd::kDone:
      return mission_result_t::DONE;
    case AgendaEnd::kFailed:
      return mission_result_t::FAILED;
    case AgendaEnd::kCancelled:
      return mission_result_t::CANCELLED;
    case AgendaEnd::kRefused:
      break;
  }
  return mission_result_t::REFUSED;
}

mission_result_t ToMessage(const AgendaResult& result) {
  mission_result_t message{};
  message.order_id = result.order_id;
  message.step = static_cast<std::int16_t>(result.step);
  message.round = static_cast<std::int16_t>(result.round);
  message.outcome = OutcomeOf(result.end);
  message.took_s = std::min(result.took_s, kMost_s);
  message.text = result.text.substr(0, kMaxResult);
  return message;
}

}  // namespace

AgendaOrder OrderIn(const mission_command_t& message) {
  AgendaOrder order{message.order_id, message.title, {}, 1};
  if (message.mission != mission_command_t::RUN) {
    mission_step_t step{};
    step.mission = message.mission;
    step.landmark_id = message.landmark_id;
    step.x_m = message.x_m;
    step.y_m = message.y_m;
    step.yaw_rad = message.yaw_rad;
    step.turn = message.turn;
    step.distance_m = message.distance_m;
    order.steps.push_back(FromMessage(step));
    return order;
  }
  order.rounds = message.rounds;
  for (const mission_step_t& step : message.steps) order.steps.push_back(FromMessage(step));
  return order;
}

mission_status_t StatusOf(const Agenda& agenda, Time now, std::size_t n_later) {
  const AgendaOrder& order = agenda.order();
  mission_status_t message{};
  message.utime = ToUtime(now);
  message.mission = static_cast<std::int8_t>(agenda.kind());
  message.phase = PhaseOf(agenda.state().phase);
  message.text = agenda.state().text.substr(0, kMaxText);
  message.order_id = order.id;
  message.title = order.title.substr(0, kMaxTitle);
  message.running = agenda.running();
  message.paused = agenda.paused();
  message.step = static_cast<std::int16_t>(agenda.step());
  message.n_steps = static_cast<std::int16_t>(order.steps.size());
  message.round = static_cast<std::int16_t>(agenda.round());
  message.rounds = static_cast<std::int16_t>(order.rounds);
  message.left_s = std::min(agenda.Left_s(now).value_or(-1), kMost_s);
  for (const AgendaOrder& waits : agenda.waiting()) {
    mission_waiting_t waiting{};
    waiting.order_id = waits.id;
    waiting.title = waits.title.substr(0, kMaxTitle);
    message.waiting.push_back(std::move(waiting));
  }
  message.n_waiting = static_cast<std::int8_t>(message.waiting.size());
  const auto& results = agenda.results();
  const std::size_t end = results.size() - std::min(results.size(), n_later);
  for (std::size_t i = end - std::min(end, kShownResults); i < end; ++i)
    message.results.push_back(ToMessage(results[i]));
  message.n_results = static_cast<std::int8_t>(message.results.size());
  return message;
}

}  // namespace priamos::planner
