#include "console/news_feed.hpp"

#include <utility>

#include "bus/schema/json.hpp"
#include "bus/schema/schema.hpp"
#include "console/console_messages.hpp"

namespace priamos::console {
namespace {

/// Stamps that are further away than the longest age of a message on the radio say nothing.
constexpr Duration kLongestAge = std::chrono::seconds(120);

}  // namespace

void NewsFeed::Hear(const std::string& channel, std::span<const std::byte> bytes, Time arrival) {
  const bus::Struct* type = schema_.Find(bus::FingerprintOf(bytes.data(), bytes.size()));
  if (type == nullptr) return;
  News::Json message = bus::ToJson(*type, bytes);
  const std::string key = KeyOf(channel, message, heard_[channel]++);
  const Time valid = ValidTime(message, arrival, kLongestAge);
  news_.Put(key, channel, valid, std::move(message));
}

void NewsFeed::Forget() {
  news_ = {};
  heard_.clear();
}

}  // namespace priamos::console
