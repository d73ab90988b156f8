#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace priamos::bus::radio {

/// A packet for the serial port of a packet radio (TNC): begin and end are marked, and these marks are
/// written in two bytes where they are data. Chepponis and Karn, "The KISS TNC", 1987.
std::vector<std::byte> EncodeKiss(std::span<const std::byte> packet);

/// Finds the packets in what comes from such a port. What is no data of its first radio is passed over, and
/// so is a packet that is too long or escapes a byte that needs none.
class KissDecoder {
 public:
  /// Decoder of packets of at most `longest` bytes.
  explicit KissDecoder(std::size_t longest) : longest_(longest) {}

  /// Takes a byte; the packet that it ends.
  std::optional<std::vector<std::byte>> Push(std::byte byte);
  /// Whether no packet has begun.
  bool between_packets() const { return bytes_.empty(); }

 private:
  void Add(std::byte byte);
  std::size_t longest_;
  std::vector<std::byte> bytes_;  ///< its command first
  bool escaped_ = false;
  bool bad_ = false;
};

}  // namespace priamos::bus::radio
