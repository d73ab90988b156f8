#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

namespace priamos {

/// Identification of the datagrams of a flood, in their IP header: nobody who listens takes them for the
/// other end's.
inline constexpr std::uint16_t kFloodMark = 0xBEEF;

/// What the true other end sent to a port of this machine, read from the wire. Needs a network of its own.
class Eavesdropper {
 public:
  explicit Eavesdropper(std::uint16_t port);
  ~Eavesdropper();
  Eavesdropper(const Eavesdropper&) = delete;
  Eavesdropper& operator=(const Eavesdropper&) = delete;

  /// The newest datagram; empty before the first.
  std::vector<std::uint8_t> Newest();
  /// All hellos that were heard, and the newest data frames.
  std::vector<std::vector<std::uint8_t>> Recorded();
  /// Takes what has come; the kernel keeps a part of a second.
  void Listen();

 private:
  void Take(std::span<const std::uint8_t> packet);

  std::uint16_t port_;
  int fd_;
  std::vector<std::vector<std::uint8_t>> hellos_;
  std::deque<std::vector<std::uint8_t>> data_;
  std::vector<std::uint8_t> newest_;
};

}  // namespace priamos
