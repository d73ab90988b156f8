#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "bus/replay.hpp"

namespace priamos::bus {

class Schema;

/// Differences between the recorded messages of an App and those of its replay.
struct OutputComparison {
  /// Numbers of messages of one channel: recorded, sent by the replay, equal in both.
  struct Channel {
    std::uint64_t recorded = 0, replayed = 0, equal = 0;
  };
  std::map<std::string, Channel> channels;
  /// The first differences of each channel, a line each: "POSE 12 at 0.240 s: x_m: recorded 1, replayed 2".
  std::vector<std::string> differences;
  bool equal = true;
};

/// Compares channel by channel, the n-th recorded message with the n-th replayed one, byte for byte and with
/// its time. At most `per_channel` messages of each channel are explained, field by field.
OutputComparison CompareOutputs(const std::vector<Output>& recorded, const std::vector<Output>& replayed,
                                const Schema& schema, std::size_t per_channel = 3);

/// The fields in which two messages of one type differ: "path.x_m[3]: recorded 1.5, replayed 1.25" each.
/// Bytes that are no messages are compared as bytes.
std::vector<std::string> FieldDifferences(std::span<const std::byte> recorded,
                                          std::span<const std::byte> replayed, const Schema& schema);

}  // namespace priamos::bus
