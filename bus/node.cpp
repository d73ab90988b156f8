#include "bus/node.hpp"

#include "bus/schema/schema.hpp"
#include "bus/schema/walk.hpp"

namespace priamos::bus {

ChannelCounters& Node::CountersOf(std::string_view channel) {
  const auto found = counters_.find(channel);
  return found != counters_.end() ? found->second : counters_[std::string(channel)];
}

void Node::Listen(const Endpoint& endpoint, const Schema& types, std::optional<std::uint64_t> fingerprint,
                  Store store) {
  inputs_.push_back(endpoint);
  ChannelCounters& counters = CountersOf(endpoint.channel);
  bus_.Subscribe(endpoint.channel, [&types, fingerprint, &counters, store = std::move(store)](
                                       std::string_view, std::span<const std::byte> bytes) {
    const std::uint64_t type = FingerprintOf(bytes.data(), bytes.size());
    const Struct* expected = !fingerprint || type == *fingerprint ? types.Find(type) : nullptr;
    if (!expected || !Walk(*expected, bytes)) {
      ++counters.refused;
      return;
    }
    try {
      store(bytes, counters);
      ++counters.received;
    } catch (const std::exception&) {
      ++counters.exceptions;
    }
  });
}

void Node::SubscribeRaw(std::string_view channel,
                        std::function<void(std::span<const std::byte>, Time)> handler) {
  SubscribeRaw(channel, schema_, std::move(handler));
}

void Node::SubscribeRaw(std::string_view channel, const Schema& types,
                        std::function<void(std::span<const std::byte>, Time)> handler) {
  Listen({std::string(channel), "*", 0}, types, std::nullopt,
         [this, handler = std::move(handler)](std::span<const std::byte> bytes, ChannelCounters&) {
           handler(bytes, clock_.Now());
         });
}

void Node::AdvertiseRaw(std::string_view channel) {
  outputs_.push_back({std::string(channel), "*", 0});
}

void Node::PublishRaw(std::string_view channel, std::span<const std::byte> bytes) {
  ChannelCounters& counters = CountersOf(channel);
  ++(bus_.Publish(channel, bytes) ? counters.published : counters.publish_failed);
}

ChannelCounters Node::Totals() const {
  ChannelCounters sum;
  for (const auto& [channel, c] : counters_) {
    sum.received += c.received;
    sum.refused += c.refused;
    sum.overwritten += c.overwritten;
    sum.dropped += c.dropped;
    sum.exceptions += c.exceptions;
    sum.published += c.published;
    sum.publish_failed += c.publish_failed;
  }
  return sum;
}

}  // namespace priamos::bus
