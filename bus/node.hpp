#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bus/clocks/clock.hpp"
#include "bus/inbox.hpp"
#include "bus/wire/lcm_bus.hpp"
#include "bus/wire/typed_message.hpp"
#include "common/time.hpp"
#include "lcmtypes/channel.hpp"

namespace priamos::bus {

class Schema;

/// Counters of the messages of one channel in one process.
struct ChannelCounters {
  std::uint64_t received = 0;     ///< passed the schema walk and the decoder
  std::uint64_t refused = 0;      ///< wrong type, damaged, too long, or not decodable
  std::uint64_t wrong_type = 0;   ///< part of `refused`: another fingerprint than the channel's
  std::uint64_t oversize = 0;     ///< part of `refused`: longer than a message of this bus may be
  std::uint64_t overwritten = 0;  ///< replaced by a newer one, of a full safety inbox one of the same act
  std::uint64_t dropped = 0;      ///< every-message channel: the oldest of a full inbox
  std::uint64_t exceptions = 0;   ///< decoder or handler threw
  std::uint64_t published = 0;
  std::uint64_t publish_failed = 0;  ///< too long, or the network refused
  std::string last_exception;        ///< what() of the newest one
};

/// One line of a process's interface: what it reads or writes.
struct Endpoint {
  std::string channel;
  std::string type;
  double rate_hz = 0;
};

namespace detail {

template <class T>
struct LatestState {
  T message{};
  Time received{};
  bool valid = false;
  bool taken = true;
};

}  // namespace detail

/// The newest message of a state channel. Handlers only store it; Tick(now) decides, so that silence is
/// noticed. Before the first message get() is null and Age() is Duration::max().
template <class T>
class Latest {
 public:
  explicit Latest(std::shared_ptr<detail::LatestState<T>> state) : state_(std::move(state)) {}

  const T* get() const { return state_->valid ? &state_->message : nullptr; }
  /// The newest message if it has not been taken before.
  std::optional<T> Take() {
    if (!state_->valid || state_->taken) return std::nullopt;
    state_->taken = true;
    return state_->message;
  }
  /// Time since the arrival of the newest message, by the receiver's own clock.
  Duration Age(Time now) const { return state_->valid ? now - state_->received : Duration::max(); }

 private:
  std::shared_ptr<detail::LatestState<T>> state_;
};

class Node;

/// Right to publish on one channel.
template <class T>
class Publisher {
 public:
  Publisher(Node& node, std::string_view channel) : node_(&node), channel_(channel) {}
  void Publish(const T& message);

 private:
  Node* node_;
  std::string channel_;
};

/// A process's place on a bus. Every byte that arrives is walked against the schema before a generated
/// decoder sees it; what does not pass is counted, never fatal. Newest wins (Subscribe) or all are kept, as
/// far as an InboxQueue reaches (SubscribeAll). Handlers run while the bus is drained, between ticks.
class Node {
 public:
  /// Node of a process on `bus`; `bus`, `schema` and `clock` must outlive it.
  Node(LcmBus& bus, const Schema& schema, const Clock& clock) : bus_(bus), schema_(schema), clock_(clock) {}
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  template <class T>
  Latest<T> Subscribe(const Channel<T>& channel);
  template <class T>
  Inbox<T> SubscribeAll(const Channel<T>& channel);
  template <class T>
  Publisher<T> Advertise(const Channel<T>& channel);

  /// Subscribes to encoded messages, for programs that were not compiled with their types. `handler` gets the
  /// messages that passed the walk; those of a type that the schema does not know are refused.
  void SubscribeRaw(std::string_view channel, std::function<void(std::span<const std::byte>, Time)> handler);
  /// Subscribes to encoded messages of `types`, which must outlive the node.
  void SubscribeRaw(std::string_view channel, const Schema& types,
                    std::function<void(std::span<const std::byte>, Time)> handler);
  void AdvertiseRaw(std::string_view channel);
  void PublishRaw(std::string_view channel, std::span<const std::byte> bytes);

  const std::map<std::string, ChannelCounters, std::less<>>& counters() const { return counters_; }
  ChannelCounters Totals() const;
  /// Errors per channel, most frequent first, as one line: "POSE: 3 wrong type; PATH: 1 exception (what)".
  /// Empty if there were none.
  std::string Problems() const;
  const std::vector<Endpoint>& inputs() const { return inputs_; }
  const std::vector<Endpoint>& outputs() const { return outputs_; }
  const Schema& schema() const { return schema_; }
  /// The time at this moment. That of a tick was taken before it began: too early for what is read in it.
  Time Now() const { return clock_.Now(); }

 private:
  /// Stores one message; throws when it cannot be decoded.
  using Store = std::function<void(std::span<const std::byte>, ChannelCounters&)>;
  void Listen(const Endpoint& endpoint, const Schema& types, std::optional<std::uint64_t> fingerprint,
              Store store);
  bool Admits(const Schema& types, std::optional<std::uint64_t> fingerprint, std::span<const std::byte> bytes,
              ChannelCounters& counters) const;
  ChannelCounters& CountersOf(std::string_view channel);

  LcmBus& bus_;
  const Schema& schema_;
  const Clock& clock_;
  std::map<std::string, ChannelCounters, std::less<>> counters_;
  std::vector<Endpoint> inputs_, outputs_;
};

template <class T>
Latest<T> Node::Subscribe(const Channel<T>& channel) {
  auto state = std::make_shared<detail::LatestState<T>>();
  Listen({std::string(channel.name), T::getTypeName(), channel.rate_hz}, schema_,
         static_cast<std::uint64_t>(T::getHash()),
         [this, state](std::span<const std::byte> bytes, ChannelCounters& counters) {
           state->message = Decode<T>(bytes);
           state->received = clock_.Now();
           if (!state->taken) ++counters.overwritten;
           state->valid = true;
           state->taken = false;
         });
  return Latest<T>(state);
}

template <class T>
Inbox<T> Node::SubscribeAll(const Channel<T>& channel) {
  auto queue = std::make_shared<InboxQueue<T>>(channel.safety_act);
  Listen({std::string(channel.name), T::getTypeName(), channel.rate_hz}, schema_,
         static_cast<std::uint64_t>(T::getHash()),
         [this, queue](std::span<const std::byte> bytes, ChannelCounters& counters) {
           const Displaced displaced = queue->Add(clock_.Now(), Decode<T>(bytes));
           if (displaced == Displaced::kRepeated) ++counters.overwritten;
           if (displaced == Displaced::kLost) ++counters.dropped;
         });
  return Inbox<T>(queue);
}

template <class T>
Publisher<T> Node::Advertise(const Channel<T>& channel) {
  outputs_.push_back({std::string(channel.name), T::getTypeName(), channel.rate_hz});
  return Publisher<T>(*this, channel.name);
}

template <class T>
void Publisher<T>::Publish(const T& message) {
  node_->PublishRaw(channel_, Encode(message));
}

}  // namespace priamos::bus
