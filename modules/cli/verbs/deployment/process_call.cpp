#include "cli/verbs/deployment/process_call.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "common/pilot/repeated_order.hpp"
#include "common/text/nearest_word.hpp"

namespace priamos::cli {
namespace {

constexpr Duration kReadyWithin = std::chrono::seconds(25), kHeardWithin = std::chrono::seconds(12);
constexpr std::int64_t kRequestIds = 65535;

std::vector<std::string> LinesOf(const std::string& text, std::size_t most) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  if (lines.size() > most) lines.erase(lines.begin(), lines.end() - static_cast<std::ptrdiff_t>(most));
  return lines;
}

std::size_t CountLines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

ProcessCall::ProcessCall(const std::string& who, const BusOptions& options)
    : session_(who, options, channels::kProcessState.name),
      reports_(session_.node().SubscribeAll(channels::kProcessReport)),
      states_(session_.node().SubscribeAll(channels::kProcessState)),
      orders_(session_.node().Advertise(channels::kProcessOrder)) {}

void ProcessCall::Listen() {
  for (const process_state_t& state : states_.Drain()) {
    session_.Heard();
    heard_[state.process] = state;
  }
}

bool ProcessCall::Hear(const std::string& name) {
  const auto heard = [&] { return heard_.contains(name); };
  session_.Watch(session_.now() + kHeardWithin, heard, [&] { Listen(); });
  return heard();
}

std::optional<process_report_t> ProcessCall::Ask(std::int8_t action, const std::string& name,
                                                 std::int32_t end_bytes) {
  process_order_t message{};
  message.utime = ToUtime(session_.now());
  message.request_id = static_cast<std::int32_t>(1 + message.utime / 1000 % kRequestIds);
  message.action = action;
  message.name = name;
  message.end_bytes = end_bytes;
  RepeatedOrder<process_order_t> order;
  order.Give(message, session_.now());
  std::optional<process_report_t> answer;
  session_.Watch(
      Time::max(), [&] { return !order.open(); },
      [&] {
        Listen();
        for (const process_report_t& report : reports_.Drain())
          if (report.name == name && order.Answered(report.request_id)) answer = report;
        if (const auto again = order.Step(session_.now())) orders_.Publish(*again);
      });
  return answer;
}

std::optional<std::vector<std::string>> ProcessCall::Lines(const std::string& name, std::size_t most) {
  std::string text;
  std::int32_t end_bytes = 0;
  do {
    const auto piece = Ask(process_order_t::LOG, name, end_bytes);
    if (!piece || piece->outcome != process_report_t::DONE) return std::nullopt;
    text = piece->text + text;
    if (piece->begin_bytes == 0 || piece->text.empty()) break;
    end_bytes = piece->begin_bytes;
  } while (CountLines(text) <= most);  // of the first line there may be but the end
  return LinesOf(text, most);
}

/// What comes from now on was told after the restart: one that takes long is told as such.
bool ProcessCall::WaitUntilReady(const std::string& name) {
  heard_.erase(name);
  const auto ready = [&] {
    const auto state = heard_.find(name);
    return state != heard_.end() && state->second.state == process_state_t::READY;
  };
  session_.Watch(session_.now() + kReadyWithin, ready, [&] { Listen(); });
  return ready();
}

std::string ProcessCall::NobodyAnswers(const std::string& name) const {
  std::vector<std::string> known;
  for (const auto& [process, state] : heard_) known.push_back(process);
  if (known.empty()) return fmt::format("nobody on this bus supervises processes (`priamos up` does)");
  if (heard_.contains(name)) return fmt::format("no answer about {}; next: priamos link top", name);
  return fmt::format("unknown process \"{}\"{} (priamos topic echo PROCESS_STATE process lists all)", name,
                     NearestText(name, known));
}

std::string_view OutcomeOfProcess(int outcome) {
  switch (outcome) {
    case process_report_t::DONE:
      return "done";
    case process_report_t::TOO_OLD:
      return "the order came too late";
    case process_report_t::TOO_OFTEN:
      return "it was started again a moment ago; wait 3 s";
    case process_report_t::NO_CONSOLE:
      return "its console cannot be read";
    default:
      return "its supervisor is of another version";
  }
}

}  // namespace priamos::cli
