#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "common/time.hpp"

namespace priamos::radio {

/// Recognises messages that this process itself put on the bus: a channel that crosses the link in both
/// directions would otherwise send back what it brought, for ever. Such a channel has two rows of the link's
/// table and one name.
class EchoFilter {
 public:
  void Published(std::string_view channel, std::span<const std::byte> bytes, Time now) {
    Forget(now);
    own_.push_back({now, std::string(channel), Hash(bytes)});
  }
  /// True once per message published.
  bool IsEcho(std::string_view channel, std::span<const std::byte> bytes, Time now) {
    Forget(now);
    for (auto at = own_.begin(); at != own_.end(); ++at) {
      if (at->channel != channel || at->hash != Hash(bytes)) continue;
      own_.erase(at);
      return true;
    }
    return false;
  }

 private:
  struct Own {
    Time at;
    std::string channel;
    std::size_t hash;
  };
  static constexpr Duration kMemory{2'000'000};
  static std::size_t Hash(std::span<const std::byte> bytes) {
    return std::hash<std::string_view>{}({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }
  void Forget(Time now) {
    while (!own_.empty() && now - own_.front().at > kMemory) own_.pop_front();
  }
  std::deque<Own> own_;
};

}  // namespace priamos::radio
