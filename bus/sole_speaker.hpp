#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/time.hpp"

namespace priamos::bus {

/// Notices that somebody else speaks channels that one process has for itself: `world` stands in for drivers
/// and must not speak beside them. Senders are told apart by their socket. One that claims the same role is
/// excused for a while: with it the claim deals.
class SoleSpeaker {
 public:
  /// A sender is judged when it had so much time to say a claim; longer than Claim::kAnnounce.
  static constexpr Duration kGrace{500'000};
  static constexpr Duration kExcused{2'000'000};

  /// A sender that speaks on this role's channels and claims no role; `sender` stands for its socket.
  struct Intruder {
    std::uint64_t sender = 0;
    std::string channel;  ///< the first one heard of it
  };

  explicit SoleSpeaker(std::vector<std::string> channels) : channels_(std::move(channels)) {}

  void Excuse(std::uint64_t sender, Time now);
  void Hear(std::uint64_t sender, std::string_view channel, Time now);
  /// Somebody who speaks and is not excused, and began at least `grace` ago.
  std::optional<Intruder> Find(Time now, Duration grace = kGrace) const;
  /// Forgets who spoke: it was heard late.
  void Forget() { foreign_.clear(); }

 private:
  struct ForeignSender {
    std::string channel;
    Time first;
  };
  bool IsExcused(std::uint64_t sender, Time now) const;

  std::vector<std::string> channels_;
  std::map<std::uint64_t, Time> excused_until_;
  std::map<std::uint64_t, ForeignSender> foreign_;
};

}  // namespace priamos::bus
