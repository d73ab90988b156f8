#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace priamos::bus {

/// Counters of one sender.
struct SenderCounters {
  std::uint64_t sender = 0;
  std::uint64_t datagrams = 0;  ///< datagrams that arrived
  std::uint64_t lost = 0;
};

/// Counts datagrams that never arrived. Every LCM sender numbers its datagrams over all channels; a gap in
/// the numbers of one sender is a loss, whoever caused it: the network, a full receive buffer, or a socket
/// filter.
///
/// Before the first datagram of a sender nothing is known of it. A datagram that comes late takes its loss
/// back. A jump back or by more than kLargestGap is a sender that began anew, not a loss.
class SequenceTracker {
 public:
  static constexpr std::uint32_t kLargestGap = 1 << 20;
  static constexpr std::size_t kMostSenders = 256;  ///< the least recently heard one is forgotten

  /// Counts the message `number` of a sender. `sender` names one sending socket, e.g. address and port.
  void Add(std::uint64_t sender, std::uint32_t number);
  std::uint64_t lost() const { return lost_; }
  std::size_t senders() const { return senders_.size(); }
  /// Counters of the senders that are not forgotten, by name. Their losses sum up to lost() until one is
  /// forgotten.
  std::vector<SenderCounters> PerSender() const;

 private:
  struct Sender {
    std::uint32_t next = 0;
    std::uint32_t lately_lost = 0;  ///< number of lost datagrams that may still arrive late
    std::uint64_t heard = 0;        ///< count of all senders' datagrams when this one was last heard
    std::uint64_t datagrams = 0, lost = 0;
  };
  void ForgetOldest();

  std::map<std::uint64_t, Sender> senders_;
  std::uint64_t datagrams_ = 0;
  std::uint64_t lost_ = 0;
};

}  // namespace priamos::bus
