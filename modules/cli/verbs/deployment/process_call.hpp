#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/terminal/bus_session.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::cli {

/// What a verb says on a bus to whoever supervises processes there, or behind the radio.
class ProcessCall {
 public:
  /// `who`: the verb, e.g. "priamos restart".
  ProcessCall(const std::string& who, const BusOptions& options);

  /// Waits until the state of `name` is heard, 12 s at most: on the radio it has its turn every 10 s. False
  /// when it was not.
  bool Hear(const std::string& name);
  /// The answer to an order about `name`, a constant of process_order_t; nullopt when none came in 8 s.
  std::optional<process_report_t> Ask(std::int8_t action, const std::string& name,
                                      std::int32_t end_bytes = 0);
  /// Lines of a console, at most `most`, the last ones; as many pieces as that takes. nullopt without an
  /// answer.
  std::optional<std::vector<std::string>> Lines(const std::string& name, std::size_t most);
  /// Waits until it is heard that `name`, whose restart was answered late, is ready; false when it is not in
  /// 25 s.
  bool WaitUntilReady(const std::string& name);
  Time now() const { return session_.now(); }
  /// The sentence for a name that nobody answers for.
  std::string NobodyAnswers(const std::string& name) const;

 private:
  void Listen();

  BusSession session_;
  bus::Inbox<process_report_t> reports_;
  bus::Inbox<process_state_t> states_;
  bus::Publisher<process_order_t> orders_;
  std::map<std::string, process_state_t> heard_;
};

/// Why an order was not obeyed; a constant of process_report_t.
std::string_view OutcomeOfProcess(int outcome);

}  // namespace priamos::cli
