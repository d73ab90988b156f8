#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include "bus/schema/schema.hpp"
#include "common/time.hpp"

namespace priamos::cli {

/// What one channel did, over a sliding window.
struct TopicRow {
  std::string channel;
  std::string type;               ///< full name, "?" when no known type has the fingerprint
  std::uint64_t messages = 0;     ///< since the start
  std::uint64_t undecodable = 0;  ///< messages refused by the schema walk
  double rate_hz = 0;             ///< over the window
  double jitter_s = 0;            ///< standard deviation of the intervals in the window
  double bandwidth_bytes_s = 0;   ///< message bytes, without LCM's header
  double age_s = 0;               ///< since the last message
  std::size_t largest_bytes = 0;
};

/// Counts every message on a bus, of types it was never compiled with.
class TopicStatistics {
 public:
  static constexpr std::size_t kMaxChannels = 1000;  ///< what comes on further ones is counted in kOthers
  static constexpr std::string_view kOthers = "(other channels)";

  /// Statistics over the last `window`; `schema` must outlive them.
  TopicStatistics(const bus::Schema& schema, Duration window) : schema_(schema), window_(window) {}

  void Add(Time now, std::string_view channel, std::span<const std::byte> bytes);
  /// One row per channel, by name.
  std::vector<TopicRow> Rows(Time now) const;
  /// Whether nothing has come yet.
  bool empty() const { return topics_.empty(); }

 private:
  struct Arrival {
    Time at;
    std::size_t bytes;
  };
  struct Topic {
    std::uint64_t fingerprint = 0;
    const bus::Struct* type = nullptr;
    std::uint64_t messages = 0, undecodable = 0;
    std::size_t largest_bytes = 0;
    Time last{};
    std::deque<Arrival> recent;
  };
  static constexpr std::size_t kMaxRecent = 20000;  ///< bounds the memory a flood can take

  TopicRow RowOf(const std::string& channel, const Topic& topic, Time now) const;

  const bus::Schema& schema_;
  Duration window_;
  std::map<std::string, Topic, std::less<>> topics_;
};

}  // namespace priamos::cli
