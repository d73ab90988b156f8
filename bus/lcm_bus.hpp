#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

struct _lcm_t;

namespace priamos::bus {

/// A bus that cannot be opened or used; what() says which and the next step.
class BusError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One LCM bus (`udpm://`, `memq://`, `file://`): the only place that calls liblcm. Messages are bytes here.
///
/// On UDP multicast a socket filter lets only unfragmented messages pass (see socket_filter.hpp).
/// Not thread safe; handlers run inside Handle()/Drain(), on the caller's thread.
class LcmBus {
 public:
  using Handler = std::function<void(std::string_view channel, std::span<const std::byte> bytes)>;

  /// Largest message this bus sends: what fits into one unfragmented datagram.
  static constexpr std::size_t kMaxMessageBytes = 1400;

  /// Throws BusError.
  explicit LcmBus(const std::string& url);
  ~LcmBus();
  LcmBus(const LcmBus&) = delete;
  LcmBus& operator=(const LcmBus&) = delete;

  const std::string& url() const { return url_; }

  /// False when the message is too long or the network refused it.
  bool Publish(std::string_view channel, std::span<const std::byte> bytes);
  /// `channel` is taken literally. The handler must not throw.
  void Subscribe(std::string_view channel, Handler handler);
  /// Every channel, for recorders.
  void SubscribeEverything(Handler handler);

  /// Becomes readable when a message waits.
  int fd() const;
  /// Handles everything that waits now; returns the number of messages. Bounded, so that a flood cannot
  /// keep the caller from its next tick.
  int Drain(int at_most = 1000);

 private:
  struct Subscription;
  void SubscribeRegex(const std::string& regex, Handler handler);

  std::string url_;
  struct Closer {
    void operator()(_lcm_t* lcm) const;
  };
  std::unique_ptr<_lcm_t, Closer> lcm_;
  std::vector<std::unique_ptr<Subscription>> subscriptions_;
  bool filtered_ = false;
};

}  // namespace priamos::bus
