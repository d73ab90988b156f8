#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bus/radio/link.hpp"

namespace priamos::radio {

/// A link that is IP but thin. HOST is a name or an address (IPv6 in brackets); such a port is written
/// - `udp:HOST:PORT`: datagrams to and from HOST:PORT, and wherever the other end moves; bound to PORT here,
///   too
/// - `udp:HOST:PORT@LOCAL`: the same, bound to port LOCAL here
/// - `tcp:HOST:PORT`: connects, and again when the connection is lost
/// - `tcp::PORT`: waits for one to connect; a new connection replaces the old one when a fresh
///   frame comes on it
struct NetAddress {
  bool datagrams = false;
  std::string host;  ///< empty: wait for a connection
  std::string port;
  std::string local_port;
  bool loopback_only = false;  ///< for this machine alone, whatever a name stands for
};

/// Time of this process, asked after bytes were read.
using TimeSource = std::function<Time()>;

/// A frame that came over IP, without its delimiter, and whence.
struct NetFrame {
  std::vector<std::byte> bytes;
  Time first_byte{};      ///< when its first byte was read
  Time arrived{};         ///< when its last byte was read
  bool stranger = false;  ///< not from the place where the other end proved itself last
  std::uint64_t place = 0;
};

/// Frames over IP, from the other end and from anybody else who finds the port. The other end is known by
/// what it sends alone: a place becomes its place when a fresh frame comes from there, and keeps it until one
/// comes from elsewhere.
class NetPort {
 public:
  virtual ~NetPort() = default;
  /// The frames that have arrived, those of the other end first; of strangers no more than can be looked at.
  virtual std::vector<NetFrame> Read(const TimeSource& time) = 0;
  /// What a frame of Read() proved. To be called for each one that proved anything.
  virtual void Judge(const NetFrame& frame, bus::radio::Proof proof) = 0;
  /// Writes as many of `bytes` to the other end as are taken now, and returns their number. While it is
  /// silent they go to those as well who repeated or made one of its frames: one of them may be the other
  /// end.
  virtual std::size_t Write(std::span<const std::byte> bytes, Time now) = 0;
  /// Datagrams and connections turned away unread.
  virtual std::uint64_t turned_away() const = 0;
};

/// Longest time without a fresh frame after which nobody is taken for the other end any more.
inline constexpr Duration kPlaceSilence{1'500'000};
/// Bytes of the shortest and the longest frame on the line, delimiter included.
inline constexpr std::size_t kSmallestFrame = 7, kLargestFrame = 252;

}  // namespace priamos::radio
