#pragma once

#include <optional>
#include <string>
#include <vector>

namespace priamos::cli {

/// What was received on one bus for a while.
struct BusSound {
  /// A channel that was heard.
  struct Channel {
    std::string name;
    double rate_hz = 0;  ///< 0: one message
  };
  std::string name;  ///< the bus as a person types it behind --bus: "offboard", or a URL
  std::string url;
  std::vector<Channel> channels;
};

/// Why nothing came on `channel` of the bus `here`, in one sentence: what it carries that has nearly this
/// name, whether the robot's other bus has it, or that the channel is sent only now and then. An empty
/// `channel` stands for any. `known` are the channels that there can be, `events` those of them without a
/// rate.
std::string SilenceText(const std::string& channel, const BusSound& here,
                        const std::optional<BusSound>& other, const std::vector<std::string>& known,
                        const std::vector<std::string>& events);

}  // namespace priamos::cli
