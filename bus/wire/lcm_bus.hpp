#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bus/wire/bus_error.hpp"
#include "bus/wire/sequence_tracker.hpp"

struct _lcm_t;  // NOLINT(bugprone-reserved-identifier): the name that LCM gave it

namespace priamos::bus {

class UdpReceiver;
class UdpSender;

/// One LCM bus (`udpm://`, `memq://`, `file://`): the only place that calls liblcm. Messages are bytes here.
///
/// liblcm does `memq://` and `file://`. UDP multicast is sent by UdpSender, which can name a network
/// interface, and received by UdpReceiver, which liblcm's weaknesses cannot reach and which counts losses. A
/// foreign bus whose messages come in fragments needs `Messages::kAnySize`.
///
/// Not thread safe but for Publish(); handlers run inside Drain(), on the caller's thread.
class LcmBus {
 public:
  using Handler = std::function<void(std::string_view channel, std::span<const std::byte> bytes)>;
  /// Looks at a message of UDP multicast before its handlers do; `sender` as SenderAddress has it. Returns
  /// what they get, valid until the next message, or nullopt to keep it from them.
  using Translator = std::function<std::optional<std::span<const std::byte>>(
      std::uint64_t sender, std::string_view channel, std::span<const std::byte> bytes)>;
  /// Which messages are received.
  enum class Messages {
    kParametric,  ///< at most kMaxMessageBytes, never in fragments
    kAnySize,     ///< up to 64 MB, in fragments: no socket filter
  };

  /// Largest message this bus sends: what fits into one unfragmented datagram.
  static constexpr std::size_t kMaxMessageBytes = 1400;

  /// Opens the bus at an LCM URL. Throws BusError when it cannot be opened.
  explicit LcmBus(const std::string& url, Messages messages = Messages::kParametric);
  ~LcmBus();
  LcmBus(const LcmBus&) = delete;
  LcmBus& operator=(const LcmBus&) = delete;

  const std::string& url() const { return url_; }

  /// Sends a message; returns false when it is too long or the network refused it.
  bool Publish(std::string_view channel, std::span<const std::byte> bytes);
  /// Sends a message to the sender of the one that is being handled, and to nobody else; for handlers.
  /// Returns false where senders are not known: on other buses than UDP multicast.
  bool Answer(std::string_view channel, std::span<const std::byte> bytes);
  /// Subscribes to one channel, whose name is taken literally. The handler must not throw.
  void Subscribe(std::string_view channel, Handler handler);
  /// Subscribes to every channel, for recorders.
  void SubscribeEverything(Handler handler);
  /// Hands a message to those who subscribed, as if it had just arrived; not within a handler.
  void Deliver(std::string_view channel, std::span<const std::byte> bytes) const;
  /// Takes back every subscription; not within a handler. What arrives until somebody subscribes anew waits.
  void UnsubscribeAll();
  /// From now on every message passes through `translator`; an empty one takes it away.
  void TranslateBy(Translator translator) { translator_ = std::move(translator); }
  /// From now on Publish puts `prefix` before the name of every channel.
  void PublishUnder(std::string_view prefix) { prefix_ = prefix; }
  /// True when a message of this size may be on this bus.
  bool Fits(std::size_t bytes) const { return messages_ == Messages::kAnySize || bytes <= kMaxMessageBytes; }

  /// File descriptor that becomes readable when a message waits; -1 (which poll ignores) while nothing is
  /// subscribed.
  int fd() const;
  /// Handles everything that waits now; returns the number of messages. Bounded, so that a flood cannot
  /// keep the caller from its next tick.
  int Drain(int at_most = 1000);

  /// Messages that senders numbered and this bus never got, on all channels together. Known only of UDP
  /// multicast; 0 elsewhere.
  std::uint64_t lost() const;
  /// Datagrams that are none of LCM's.
  std::uint64_t malformed() const;
  /// Datagrams the kernel did not hand over: fragments and nonsense, which the socket filter stops, and what
  /// found the receive buffer full (also in lost()).
  std::uint64_t turned_away() const;
  /// Senders heard; SenderAddress() names them. Known as lost() is.
  std::vector<SenderCounters> senders() const;

 private:
  struct Subscription;
  void ListenThroughLiblcm(const std::string& channel, Handler handler);
  void Receive(std::uint64_t sender, std::string_view channel, std::span<const std::byte> bytes);
  void Dispatch(std::string_view channel, std::span<const std::byte> bytes) const;

  std::string url_;
  Messages messages_;
  struct Closer {
    void operator()(_lcm_t* lcm) const;
  };
  std::unique_ptr<_lcm_t, Closer> lcm_;    ///< null for UDP multicast
  std::unique_ptr<UdpSender> sender_;      ///< for UDP multicast
  std::unique_ptr<UdpReceiver> receiver_;  ///< receives UDP multicast, from the first subscription on
  std::map<std::string, std::vector<Handler>, std::less<>> by_channel_;
  std::vector<Handler> of_everything_;
  Translator translator_;
  std::string prefix_;  ///< of the channels it publishes
  std::vector<std::unique_ptr<Subscription>> subscriptions_;
  std::uint64_t answered_ = 0;  ///< sender of the message that is being handled; 0: none is
};

}  // namespace priamos::bus
