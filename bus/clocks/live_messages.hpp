#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "common/time.hpp"

namespace priamos::bus {

class Schema;

/// Distinguishes what live processes say on a bus from the log that is being played there: a recorder's
/// HEALTH is stamped with the time it is sent, and would make that the time of the log. Pure.
class LiveMessages {
 public:
  /// A stamp that is so near to the present is a live process's. Logs are older; a younger one would have
  /// to be played while it is recorded.
  static constexpr Duration kNow{2'000'000};
  /// Given a sentence for people about each sender of live messages, once.
  using Report = std::function<void(const std::string& sentence)>;

  /// `schema` must outlive it.
  LiveMessages(const Schema& schema, Report report) : schema_(schema), report_(std::move(report)) {}

  /// Whether a message that arrived at `now`, by the host's clock, is a live process's; `sender` as
  /// SenderAddress has it.
  bool IsLive(std::uint64_t sender, std::string_view channel, std::span<const std::byte> bytes, Time now);

 private:
  static constexpr std::size_t kMostSenders = 32;  ///< of more, nothing is said

  void ReportOn(std::uint64_t sender, std::string_view channel, std::span<const std::byte> bytes) const;

  const Schema& schema_;
  Report report_;
  std::set<std::uint64_t> reported_;
};

}  // namespace priamos::bus
