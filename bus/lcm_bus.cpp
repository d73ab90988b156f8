#include "bus/lcm_bus.hpp"

#include <fmt/format.h>
#include <lcm/lcm.h>

#include "bus/multicast.hpp"
#include "bus/socket_filter.hpp"

namespace priamos::bus {

struct LcmBus::Subscription {
  Handler handler;

  static void OnMessage(const lcm_recv_buf_t* buffer, const char* channel, void* self) {
    static_cast<Subscription*>(self)->handler(
        channel, {static_cast<const std::byte*>(buffer->data), static_cast<std::size_t>(buffer->data_size)});
  }
};

void LcmBus::Closer::operator()(_lcm_t* lcm) const {
  lcm_destroy(lcm);
}

namespace {

lcm_t* Open(const std::string& url) {
  if (url.starts_with("udpm://")) RequireMulticastRoute(url);
  lcm_t* lcm = lcm_create(url.c_str());
  if (!lcm)
    throw BusError(
        fmt::format("bus {}: expected a URL LCM can open (udpm://, memq://, file://), got a refusal", url));
  return lcm;
}

}  // namespace

LcmBus::LcmBus(const std::string& url) : url_(url), lcm_(Open(url)) {}

LcmBus::~LcmBus() = default;

bool LcmBus::Publish(std::string_view channel, std::span<const std::byte> bytes) {
  if (bytes.size() > kMaxMessageBytes) return false;
  return lcm_publish(lcm_.get(), std::string(channel).c_str(), bytes.data(),
                     static_cast<unsigned>(bytes.size())) == 0;
}

void LcmBus::Subscribe(std::string_view channel, Handler handler) {
  SubscribeRegex(std::string(channel), std::move(handler));
}

void LcmBus::SubscribeEverything(Handler handler) {
  SubscribeRegex(".*", std::move(handler));
}

void LcmBus::SubscribeRegex(const std::string& regex, Handler handler) {
  auto subscription = std::make_unique<Subscription>(Subscription{std::move(handler)});
  auto* handle = lcm_subscribe(lcm_.get(), regex.c_str(), &Subscription::OnMessage, subscription.get());
  if (!handle) {
    throw BusError(
        fmt::format("bus {}: expected to receive, got no multicast; `priamos doctor` names the missing "
                    "route or flag and the command that mends it",
                    url_));
  }
  // liblcm keeps the oldest messages of a full queue; ours are drained before every tick, so the queue only
  // has to hold what one tick period can bring.
  lcm_subscription_set_queue_capacity(handle, 1000);
  subscriptions_.push_back(std::move(subscription));
  if (!filtered_ && url_.starts_with("udpm://")) {
    FilterFragments(PortOf(url_));
    filtered_ = true;
  }
}

int LcmBus::fd() const {
  return lcm_get_fileno(lcm_.get());
}

int LcmBus::Drain(int at_most) {
  int handled = 0;
  while (handled < at_most && lcm_handle_timeout(lcm_.get(), 0) > 0) ++handled;
  return handled;
}

}  // namespace priamos::bus
