#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <utility>
#include <vector>

#include "common/random.hpp"
#include "common/time.hpp"

namespace priamos::bus::radio {

/// What somebody on the line does to the frames of one direction.
struct Hostility {
  double lost = 0, doubled = 0, held = 0;  ///< share of the frames
  double longest_hold_s = 0.5;             ///< a held frame comes in between later ones
  double replays_hz = 0, garbage_hz = 0;   ///< frames of his own, which cut off what is being received
};

/// A line on which somebody sits: bytes of one direction as they leave it, to those that arrive.
class HostileLine {
 public:
  HostileLine(const Hostility& does, Rng rng) : does_(does), rng_(std::move(rng)) {}

  std::vector<std::byte> Pass(std::span<const std::byte> bytes, Time now) {
    std::vector<std::byte> out;
    for (const std::byte b : bytes) Take(b, now, out);
    for (auto at = held_.begin(); at != held_.end();) {
      if (at->first > now) {
        ++at;
        continue;
      }
      Send(at->second, out);
      at = held_.erase(at);
    }
    const double since_s = Seconds(now - std::exchange(now_, now));
    if (!recorded_.empty() && rng_.Uniform(0, 1) < does_.replays_hz * since_s)
      Send(recorded_[rng_.Below(recorded_.size())], out);
    if (rng_.Uniform(0, 1) < does_.garbage_hz * since_s) Send(Garbage(), out);
    return out;
  }
  /// From now on he listens only.
  void Rest() { does_ = {}; }

 private:
  enum class Fate { kPass, kLost, kHeld };

  void Take(std::byte b, Time now, std::vector<std::byte>& out) {
    if (frame_.empty() && b != std::byte{0}) fate_ = Choose();
    if (fate_ == Fate::kPass) out.push_back(b);
    if (b != std::byte{0}) return frame_.push_back(b);
    if (frame_.empty()) return;
    if (fate_ == Fate::kHeld)
      held_.emplace_back(now + FromSeconds(rng_.Uniform(0, does_.longest_hold_s)), frame_);
    if (fate_ == Fate::kPass && rng_.Uniform(0, 1) < does_.doubled) Send(frame_, out);
    recorded_.push_back(std::exchange(frame_, {}));
    if (recorded_.size() > 500) recorded_.pop_front();
    fate_ = Fate::kPass;
  }
  Fate Choose() {
    const double u = rng_.Uniform(0, 1);
    return u < does_.lost ? Fate::kLost : u < does_.lost + does_.held ? Fate::kHeld : Fate::kPass;
  }
  static void Send(const std::vector<std::byte>& frame, std::vector<std::byte>& out) {
    out.push_back(std::byte{0});
    out.insert(out.end(), frame.begin(), frame.end());
    out.push_back(std::byte{0});
  }
  std::vector<std::byte> Garbage() {
    std::vector<std::byte> frame(1 + rng_.Below(60));
    for (std::byte& b : frame) b = std::byte(1 + rng_.Below(255));
    return frame;
  }

  Hostility does_;
  Rng rng_;
  Time now_{};
  Fate fate_ = Fate::kPass;
  std::vector<std::byte> frame_;
  std::deque<std::vector<std::byte>> recorded_;
  std::deque<std::pair<Time, std::vector<std::byte>>> held_;
};

}  // namespace priamos::bus::radio
