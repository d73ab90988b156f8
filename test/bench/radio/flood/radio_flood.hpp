#pragma once

#include <atomic>
#include <cstdint>
#include <random>
#include <string>
#include <thread>
#include <vector>

namespace priamos {

/// What a stranger sends to the port of a radio link on this machine. Needs a network of its own.
struct FloodOptions {
  /// - `short`, `long`: datagrams of 9 and 45 bytes, random within the form of a frame
  /// - `hello`: datagrams that look like a hello
  /// - `next`: the newest datagram of the true other end, with the next counter and a wrong code
  /// - `replay`: what was `recorded`, in any order
  /// - `silent`, `garbage`: connections that say nothing, or nonsense as fast as it is taken
  std::string kind = "short";
  std::uint16_t port = 0;  ///< of the end that is flooded
  std::uint16_t source =
      0;                ///< of the true other end: where datagrams claim to come from; 0: each from another
  double per_s = 1000;  ///< datagrams or connections
  std::vector<std::vector<std::uint8_t>> recorded{};
};

/// A flood, as long as it lives.
class Flood {
 public:
  explicit Flood(const FloodOptions& options);
  ~Flood();
  Flood(const Flood&) = delete;
  Flood& operator=(const Flood&) = delete;
  std::uint64_t sent() const { return sent_; }

 private:
  void SendDatagrams();
  std::vector<std::uint8_t> Payload(const std::vector<std::uint8_t>& newest, std::mt19937& random) const;
  void Connect();

  FloodOptions options_;
  std::atomic<bool> stop_{false};
  std::atomic<std::uint64_t> sent_{0};
  std::thread thread_;
};

}  // namespace priamos
