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
  if (const Report* answer = AnswerTo(order)) return *answer;
  if (answered_.size() >= kMostOrders) return std::nullopt;
  Report answer{};
  answer.utime = ToUtime(now);
  answer.request_id = order.request_id;
  answer.name = order.name;
  Obey(order, now, answer);
  answered_.push_back({now, answer});
  return answer;
}

/// Several supervisors may hear an order: one for each host of a robot.
bool SupervisorDesk::IsMine(const Order& order) const {
  return order.action == Order::NEW_WORLD ? hands_.new_world != nullptr : hands_.has(order.name);
}

const Report* SupervisorDesk::AnswerTo(const Order& order) const {
  const auto at = std::find_if(answered_.begin(), answered_.end(), [&](const Answered& a) {
    return a.answer.request_id == order.request_id && a.answer.name == order.name;
  });
  return at == answered_.end() ? nullptr : &at->answer;
}

void SupervisorDesk::Obey(const Order& order, Time now, Report& answer) {
  const Duration age = now - FromUtime(order.utime);
  if (age > kOldest || age < -kAheadAllowed) {
    answer.outcome = Report::TOO_OLD;
  } else if (order.action == Order::LOG) {
    Tell(order, answer);
  } else if (order.action == Order::RESTART) {
    answer.outcome = TooOften(order.name, now) ? Report::TOO_OFTEN : Report::DONE;
    if (answer.outcome == Report::DONE) answer.text = CutUtf8(hands_.restart(order.name), kMostText);
  } else if (order.action == Order::NEW_WORLD) {
    answer.outcome = TooOften("", now)              ? Report::TOO_OFTEN
                     : hands_.new_world(order.name) ? Report::DONE
                                                    : Report::UNKNOWN_SCENARIO;
  } else {
    answer.outcome = Report::UNKNOWN_ACTION;
  }
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
