#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/time.hpp"

namespace priamos::bus {

/// Notices another sender on channels that one process has for itself: `world` stands in for drivers and must
/// not send beside them. Senders are distinguished by their socket. One that claims the same role is excused
/// for a while: Claim decides between the two.
class SoleSpeaker {
 public:
  /// Time that a new sender has to send a claim before it is judged; longer than Claim::kAnnounce.
  static constexpr Duration kGrace{500'000};
  static constexpr Duration kExcused{2'000'000};

  /// A sender on this role's channels that claims no role; `sender` stands for its socket.
  struct Intruder {
    std::uint64_t sender = 0;
    std::string channel;  ///< first channel on which it was heard
  };

  explicit SoleSpeaker(std::vector<std::string> channels) : channels_(std::move(channels)) {}

  void Excuse(std::uint64_t sender, Time now);
  void Hear(std::uint64_t sender, std::string_view channel, Time now);
  /// A sender that is not excused and began at least `grace` ago.
  std::optional<Intruder> Find(Time now, Duration grace = kGrace) const;
  /// Forgets all senders: their messages were received late.
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
