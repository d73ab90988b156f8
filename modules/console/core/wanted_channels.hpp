#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/time.hpp"
#include "console/core/seat.hpp"

namespace priamos::console {

/// Which on-request channels somebody looks at. Four pages that look at one channel cost the radio what one
/// costs.
class WantedChannels {
 public:
  static constexpr double kHold_s = 3;
  static constexpr Duration kAgain{1'000'000};

  /// What the radio is told about one channel.
  struct Request {
    std::string channel;
    double hold_s = 0;  ///< 0: nobody looks any more
    bool operator==(const Request&) const = default;
  };

  /// `offered`: channels that may be wanted.
  explicit WantedChannels(std::set<std::string> offered) : offered_(std::move(offered)) {}

  /// False for a channel that is not offered.
  bool Wish(ClientId client, const std::string& channel, bool on);
  void Leave(ClientId client);
  /// What the radio is to be told now: wanted channels every kAgain, once what nobody wants any more.
  std::vector<Request> Step(Time now);

 private:
  std::set<std::string> offered_;
  std::map<std::string, std::set<ClientId>> viewers_;
  std::map<std::string, Time> asked_;
};

}  // namespace priamos::console
