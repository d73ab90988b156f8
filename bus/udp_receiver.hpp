#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "bus/sequence_tracker.hpp"

namespace priamos::bus {

/// Receives the unfragmented messages (`LC02`) of an LCM multicast bus, in place of liblcm's receive thread.
///
/// Compared with liblcm: fragments, which kill it, are turned away by a socket filter in the kernel; the
/// socket is bound to the multicast group, so other groups on the same port are not heard, and neither is
/// anything sent to this host alone; the sequence numbers of every sender are looked at, so that losses
/// are known; and there is no thread and no copy between the kernel and the handler.
class UdpReceiver {
 public:
  using Handler = std::function<void(std::string_view channel, std::span<const std::byte> bytes)>;

  /// Throws BusError with a sentence when the group cannot be joined.
  explicit UdpReceiver(const std::string& url);
  ~UdpReceiver();
  UdpReceiver(const UdpReceiver&) = delete;
  UdpReceiver& operator=(const UdpReceiver&) = delete;

  int fd() const { return fd_; }
  /// Hands out at most `at_most` of the messages that wait, without blocking. Returns their number.
  int Receive(int at_most, const Handler& handler);

  std::uint64_t lost() const { return numbers_.lost(); }
  /// Datagrams that say they are LCM and are not.
  std::uint64_t malformed() const { return malformed_; }
  std::size_t senders() const { return numbers_.senders(); }

 private:
  struct Batch;
  int ReceiveBatch(int at_most);

  int fd_ = -1;
  std::unique_ptr<Batch> batch_;
  SequenceTracker numbers_;
  std::uint64_t malformed_ = 0;
};

/// One unfragmented LCM datagram: magic `LC02`, number, channel (printable ASCII) with a zero behind it,
/// message. False when it
/// is none; `channel` and `bytes` point into it.
bool ParseDatagram(std::span<const std::byte> datagram, std::uint32_t& number, std::string_view& channel,
                   std::span<const std::byte>& bytes);

}  // namespace priamos::bus
