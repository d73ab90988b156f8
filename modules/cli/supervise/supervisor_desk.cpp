#include "cli/supervise/supervisor_desk.hpp"

#include <algorithm>

#include "common/input/utf8.hpp"

namespace priamos::cli {
namespace {

using Order = process_order_t;
using Report = process_report_t;

/// The radio restores times to a few milliseconds.
constexpr Duration kAheadAllowed = std::chrono::seconds(1);

}  // namespace

std::optional<Report> SupervisorDesk::Take(const Order& order, Time now) {
  if (!IsMine(order)) return std::nullopt;
  while (!answered_.empty() && now - answered_.front().time > kOldest) answered_.pop_front();
  if (const Answered* known = AnswerTo(order)) return AnswerOf(*known);
  if (answered_.size() >= kMostOrders) return std::nullopt;
  Answered taken{now, {}};
  taken.answer.utime = ToUtime(now);
  taken.answer.request_id = order.request_id;
  taken.answer.name = order.name;
  Obey(order, now, taken);
  answered_.push_back(taken);
  return AnswerOf(taken);
}

std::optional<Report> SupervisorDesk::AnswerOf(const Answered& taken) {
  return taken.starts_before ? std::nullopt : std::optional(taken.answer);
}

std::vector<Report> SupervisorDesk::Step(Time now) {
  std::vector<Report> answers;
  for (Answered& taken : answered_) {
    if (!taken.starts_before) continue;
    const auto process = hands_.look(taken.answer.name);
    const bool ready =
        process && process->state == ProcessState::kReady && process->starts > *taken.starts_before;
    if (!ready && now - taken.time < kReadyWithin) continue;
    taken.starts_before.reset();
    taken.answer.utime = ToUtime(now);
    taken.answer.outcome = Report::DONE;
    answers.push_back(taken.answer);
  }
  return answers;
}

/// Several supervisors may hear an order: one for each host of a robot.
bool SupervisorDesk::IsMine(const Order& order) const {
  return order.action == Order::NEW_WORLD ? hands_.new_world != nullptr : hands_.look(order.name).has_value();
}

const SupervisorDesk::Answered* SupervisorDesk::AnswerTo(const Order& order) const {
  const auto at = std::find_if(answered_.begin(), answered_.end(), [&](const Answered& a) {
    return a.answer.request_id == order.request_id && a.answer.name == order.name;
  });
  return at == answered_.end() ? nullptr : &*at;
}

void SupervisorDesk::Obey(const Order& order, Time now, Answered& taken) {
  Report& answer = taken.answer;
  const Duration age = now - FromUtime(order.utime);
  if (age > kOldest || age < -kAheadAllowed) {
    answer.outcome = Report::TOO_OLD;
  } else if (order.action == Order::LOG) {
    Tell(order, answer);
  } else if (order.action == Order::RESTART) {
    answer.outcome = Report::TOO_OFTEN;
    if (!TooOften(order.name, now)) Restart(taken);
  } else if (order.action == Order::NEW_WORLD) {
    answer.outcome = TooOften("", now)              ? Report::TOO_OFTEN
                     : hands_.new_world(order.name) ? Report::DONE
                                                    : Report::UNKNOWN_SCENARIO;
  } else {
    answer.outcome = Report::UNKNOWN_ACTION;
  }
}

void SupervisorDesk::Restart(Answered& taken) {
  const auto before = hands_.look(taken.answer.name);
  taken.answer.text = CutUtf8(before->reason, kMostText);
  taken.starts_before = before->starts;
  hands_.restart(taken.answer.name);
}

void SupervisorDesk::Tell(const Order& order, Report& answer) const {
  auto piece = hands_.console(order.name, order.end_bytes);
  answer.outcome = piece ? Report::DONE : Report::NO_CONSOLE;
  if (!piece) return;
  answer.begin_bytes = static_cast<std::int32_t>(std::min<std::int64_t>(piece->begin, 2'000'000'000));
  answer.text = std::move(piece->text);
}

bool SupervisorDesk::TooOften(const std::string& name, Time now) {
  const auto [at, first] = begun_.try_emplace(name, now);
  if (!first && now - at->second < kPause) return true;
  at->second = now;
  return false;
}

}  // namespace priamos::cli
