#include "bus/wire/lcm_bus.hpp"

#include <fmt/format.h>
#include <lcm/lcm.h>

#include "bus/wire/udp_receiver.hpp"
#include "bus/wire/udp_sender.hpp"

namespace priamos::bus {

struct LcmBus::Subscription {
  Handler handler;
  std::string channel;
  lcm_subscription_t* handle = nullptr;

  static void OnMessage(const lcm_recv_buf_t* buffer, const char* channel, void* self) {
    static_cast<Subscription*>(self)->handler(
        channel, {static_cast<const std::byte*>(buffer->data), static_cast<std::size_t>(buffer->data_size)});
  }
};

void LcmBus::Closer::operator()(_lcm_t* lcm) const {
  lcm_destroy(lcm);
}

namespace {

constexpr const char* kEverything = ".*";

bool IsMulticast(const std::string& url) {
  return url.starts_with("udpm://");
}

lcm_t* Open(const std::string& url) {
  lcm_t* lcm = lcm_create(url.c_str());
  if (!lcm)
    throw BusError(
        fmt::format("bus {}: expected a URL LCM can open (udpm://, memq://, file://), got a refusal", url));
  return lcm;
}

}  // namespace

LcmBus::LcmBus(const std::string& url, Messages messages)
    : url_(url),
      messages_(messages),
      lcm_(IsMulticast(url) ? nullptr : Open(url)),
      sender_(IsMulticast(url) ? std::make_unique<UdpSender>(url) : nullptr) {}

LcmBus::~LcmBus() = default;

bool LcmBus::Publish(std::string_view channel, std::span<const std::byte> bytes) {
  if (!Fits(bytes.size())) return false;
  if (sender_ && prefix_.empty()) return sender_->Send(channel, bytes);
  const std::string name = prefix_ + std::string(channel);
  if (sender_) return sender_->Send(name, bytes);
  return lcm_publish(lcm_.get(), name.c_str(), bytes.data(), static_cast<unsigned>(bytes.size())) == 0;
}

bool LcmBus::Answer(std::string_view channel, std::span<const std::byte> bytes) {
  return sender_ && answered_ != 0 && Fits(bytes.size()) && sender_->SendTo(answered_, channel, bytes);
}

void LcmBus::Subscribe(std::string_view channel, Handler handler) {
  if (sender_) {
    if (!receiver_) receiver_ = std::make_unique<UdpReceiver>(url_, messages_ == Messages::kAnySize);
    auto& handlers = channel == kEverything ? of_everything_ : by_channel_[std::string(channel)];
    handlers.push_back(std::move(handler));
  } else {
    ListenThroughLiblcm(std::string(channel), std::move(handler));
  }
}

void LcmBus::SubscribeEverything(Handler handler) {
  Subscribe(kEverything, std::move(handler));
}

void LcmBus::ListenThroughLiblcm(const std::string& channel, Handler handler) {
  auto subscription = std::make_unique<Subscription>(Subscription{std::move(handler), channel});
  auto* handle = lcm_subscribe(lcm_.get(), channel.c_str(), &Subscription::OnMessage, subscription.get());
  if (!handle) {
    throw BusError(
        fmt::format("bus {}: expected to receive, got no multicast; `priamos doctor` names the missing "
                    "route or flag and the command that mends it",
                    url_));
  }
  // liblcm keeps the oldest messages of a full queue; ours are drained before every tick, so the queue only
  // has to hold what one tick period can bring.
  lcm_subscription_set_queue_capacity(handle, 1000);
  subscription->handle = handle;
  subscriptions_.push_back(std::move(subscription));
}

void LcmBus::Dispatch(std::string_view channel, std::span<const std::byte> bytes) const {
  for (const Handler& handler : of_everything_) handler(channel, bytes);
  const auto found = by_channel_.find(channel);
  if (found == by_channel_.end()) return;
  for (const Handler& handler : found->second) handler(channel, bytes);
}

void LcmBus::Deliver(std::string_view channel, std::span<const std::byte> bytes) const {
  Dispatch(channel, bytes);
  for (const auto& subscription : subscriptions_)
    if (subscription->channel == kEverything || subscription->channel == channel)
      subscription->handler(channel, bytes);
}

void LcmBus::UnsubscribeAll() {
  by_channel_.clear();
  of_everything_.clear();
  for (const auto& subscription : subscriptions_) lcm_unsubscribe(lcm_.get(), subscription->handle);
  subscriptions_.clear();
}

void LcmBus::Receive(std::uint64_t sender, std::string_view channel, std::span<const std::byte> bytes) {
  const auto translated = translator_ ? translator_(sender, channel, bytes) : bytes;
  if (!translated) return;
  answered_ = sender;
  Dispatch(channel, *translated);
  answered_ = 0;
}

int LcmBus::fd() const {
  if (receiver_) return receiver_->fd();
  return subscriptions_.empty() ? -1 : lcm_get_fileno(lcm_.get());
}

int LcmBus::Drain(int at_most) {
  if (receiver_)
    return receiver_->Receive(
        at_most, [this](std::uint64_t sender, std::string_view channel, std::span<const std::byte> bytes) {
          Receive(sender, channel, bytes);
        });
  int handled = 0;
  if (subscriptions_.empty()) return handled;
  while (handled < at_most && lcm_handle_timeout(lcm_.get(), 0) > 0) ++handled;
  return handled;
}

std::uint64_t LcmBus::lost() const {
  return receiver_ ? receiver_->lost() : 0;
}

std::uint64_t LcmBus::malformed() const {
  return receiver_ ? receiver_->malformed() : 0;
}

std::uint64_t LcmBus::turned_away() const {
  return receiver_ ? receiver_->turned_away() : 0;
}

std::vector<SenderCounters> LcmBus::senders() const {
  return receiver_ ? receiver_->numbers().PerSender() : std::vector<SenderCounters>();
}

}  // namespace priamos::bus
