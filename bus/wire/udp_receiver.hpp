#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "bus/wire/reassembler.hpp"
#include "bus/wire/sequence_tracker.hpp"

namespace priamos::bus {

/// Receives the messages of an LCM multicast bus, in place of liblcm's receive thread.
///
/// Compared with liblcm: fragments, which kill it, are turned away by a socket filter in the kernel, or,
/// where a foreign bus has messages of any size, put together by a Reassembler that believes nothing; the
/// socket is bound to the multicast group, so other groups on the same port are not heard, and neither is
/// anything sent to this host alone; the sequence numbers of every sender are looked at, so that losses
/// are known; and there is no thread and no copy between the kernel and the handler.
class UdpReceiver {
 public:
  /// Function that gets each message; `sender` names the sending socket, see SenderAddress.
  using Handler =
      std::function<void(std::uint64_t sender, std::string_view channel, std::span<const std::byte> bytes)>;

  /// Joins the multicast group of an LCM URL, on the interface that the URL names. Throws BusError with a
  /// sentence when the group cannot be joined. Without `fragments` a filter stops them.
  explicit UdpReceiver(const std::string& url, bool fragments = false);
  ~UdpReceiver();
  UdpReceiver(const UdpReceiver&) = delete;
  UdpReceiver& operator=(const UdpReceiver&) = delete;

  int fd() const { return fd_; }
  /// Hands out at most `at_most` of the messages that wait, without blocking. Returns their number.
  int Receive(int at_most, const Handler& handler);

  /// A large message of which a part is missing is lost, too.
  std::uint64_t lost() const { return numbers_.lost() + reassembler_.abandoned(); }
  /// Datagrams that are not what LCM sends.
  std::uint64_t malformed() const { return malformed_; }
  /// Datagrams the kernel did not hand over: no `LC02` (fragments, nonsense), or the receive buffer was full.
  /// The latter are in lost() as well, if what came from their sender was numbered.
  std::uint64_t turned_away() const;
  const SequenceTracker& numbers() const { return numbers_; }

 private:
  struct Batch;
  int ReceiveBatch(int at_most);
  void Take(std::uint64_t sender, std::span<const std::byte> datagram, const Handler& handler);
  void TakeFragment(std::uint64_t sender, std::span<const std::byte> datagram, const Handler& handler);

  int fd_ = -1;
  std::unique_ptr<Batch> batch_;
  SequenceTracker numbers_;
  Reassembler reassembler_;
  Reassembler::Message large_;
  std::uint64_t malformed_ = 0;
};

/// Address and port of SenderCounters::sender, as text.
std::string SenderAddress(std::uint64_t sender);

}  // namespace priamos::bus
