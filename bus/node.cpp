#include "bus/node.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "bus/schema/schema.hpp"
#include "bus/schema/walk.hpp"

namespace priamos::bus {

ChannelCounters& Node::CountersOf(std::string_view channel) {
  const auto found = counters_.find(channel);
  return found != counters_.end() ? found->second : counters_[std::string(channel)];
}

bool Node::Admits(const Schema& types, std::optional<std::uint64_t> fingerprint,
                  std::span<const std::byte> bytes, ChannelCounters& counters) const {
  if (!bus_.Fits(bytes.size())) {
    ++counters.oversize;
    return false;
  }
  const std::uint64_t type = FingerprintOf(bytes.data(), bytes.size());
  const Struct* expected = !fingerprint || type == *fingerprint ? types.Find(type) : nullptr;
  if (expected == nullptr && bytes.size() >= sizeof type) ++counters.wrong_type;
  return expected != nullptr && Walk(*expected, bytes);
}

void Node::Listen(const Endpoint& endpoint, const Schema& types, std::optional<std::uint64_t> fingerprint,
                  Store store) {
  inputs_.push_back(endpoint);
  ChannelCounters& counters = CountersOf(endpoint.channel);
  bus_.Subscribe(endpoint.channel, [this, &types, fingerprint, &counters, store = std::move(store)](
                                       std::string_view, std::span<const std::byte> bytes) {
    if (!Admits(types, fingerprint, bytes, counters)) {
      ++counters.refused;
      return;
    }
    try {
      store(bytes, counters);
      ++counters.received;
    } catch (const std::exception& error) {
      ++counters.exceptions;
      counters.last_exception = error.what();
    } catch (...) {  // whatever a handler throws, the bus goes on
      ++counters.exceptions;
      counters.last_exception = "not a std::exception";
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

namespace {

std::string Describe(const ChannelCounters& c) {
  const std::uint64_t damaged = c.refused - c.wrong_type - c.oversize;
  std::vector<std::string> parts;
  if (c.exceptions > 0) parts.push_back(fmt::format("{} exceptions ({})", c.exceptions, c.last_exception));
  if (c.wrong_type > 0) parts.push_back(fmt::format("{} of wrong type", c.wrong_type));
  if (damaged > 0) parts.push_back(fmt::format("{} damaged", damaged));
  if (c.oversize > 0) parts.push_back(fmt::format("{} too long", c.oversize));
  if (c.dropped > 0) parts.push_back(fmt::format("{} dropped", c.dropped));
  if (c.publish_failed > 0) parts.push_back(fmt::format("{} not sent", c.publish_failed));
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace

ChannelCounters Node::Totals() const {
  ChannelCounters sum;
  for (const auto& [channel, c] : counters_) {
    sum.received += c.received;
    sum.refused += c.refused;
    sum.wrong_type += c.wrong_type;
    sum.oversize += c.oversize;
    sum.overwritten += c.overwritten;
    sum.dropped += c.dropped;
    sum.exceptions += c.exceptions;
    sum.published += c.published;
    sum.publish_failed += c.publish_failed;
  }
  return sum;
}

std::string Node::Problems() const {
  const auto count = [](const ChannelCounters& c) {
    return c.refused + c.exceptions + c.dropped + c.publish_failed;
  };
  std::vector<std::pair<std::uint64_t, std::string>> lines;
  for (const auto& [channel, c] : counters_)
    if (count(c) > 0) lines.emplace_back(count(c), fmt::format("{}: {}", channel, Describe(c)));
  std::stable_sort(lines.begin(), lines.end(),
                   [](const auto& x, const auto& y) { return x.first > y.first; });
  std::string text;
  for (const auto& [n, line] : lines) text += (text.empty() ? "" : "; ") + line;
  return text;
}

}  // namespace priamos::bus
