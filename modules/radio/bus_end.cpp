#include "radio/bus_end.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "radio/estop_rule.hpp"
#include "radio/key_file.hpp"

namespace priamos::radio {
namespace {

constexpr double kLongestHold_s = 600;

}  // namespace

BusEnd::BusEnd(BusEndParts parts, bus::Node& node, LogFunction log)
    : parts_(std::move(parts)),
      node_(node),
      log_(std::move(log)),
      codecs_(parts_.link, parts_.types),
      requests_(node.SubscribeAll(channels::kLinkRequest)),
      status_(node.Advertise(channels::kLinkStatus)) {
  SubscribeAll();
}

void BusEnd::SubscribeAll() {
  const bus::radio::ChannelTable table = parts_.link.Table(parts_.types);
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (table.at(i).direction != parts_.outgoing) {
      node_.AdvertiseRaw(table.at(i).name);
      continue;
    }
    const auto offer = [this, i](std::span<const std::byte> encoded, Time now) {
      if (echo_.IsEcho(parts_.link.channels[i].name, encoded, now)) return;
      if (link_)
        Offer(i, encoded, pauses_->CameAt(now));
      else
        waiting_.push_back({i, {encoded.begin(), encoded.end()}});
    };
    node_.SubscribeRaw(table.at(i).name, parts_.types, offer);
  }
}

void BusEnd::Start(Time now) {
  bus::radio::LinkOptions options = parts_.link.Options();
  options.address = parts_.address;
  link_ = std::make_unique<bus::radio::LinkEndpoint>(
      parts_.link.Table(parts_.types), parts_.outgoing, parts_.key, options, *parts_.store,
      [this](std::size_t channel, std::span<const std::byte> encoded, Time at) {
        auto packed = codecs_.Pack(channel, encoded, at);
        if (packed) return packed;
        const auto stop = StopToSend(encoded);
        if (stop) packed = codecs_.Pack(channel, *stop, at);
        if (packed) packed->saturated = true;
        if (!packed) LogRefusal(channel, encoded, at);
        return packed;
      },
      parts_.nonces, now, parts_.next_key);
  for (const Waiting& w : waiting_) Offer(w.channel, w.encoded, now);
  waiting_.clear();
  pauses_.emplace(parts_.tick, now);
  last_report_ = now;
}

/// The time-to-live of a command counts from its own stamp, however long the bus or its sender kept it.
void BusEnd::Offer(std::size_t channel, std::span<const std::byte> encoded, Time came) {
  const bool command = link_->table().at(channel).channel_class == bus::radio::ChannelClass::kCommand;
  const auto made = command ? codecs_.StampOf(channel, encoded) : std::nullopt;
  if (made && *made < came - link_->table().at(channel).ttl) LogLate(channel);
  link_->Offer(channel, encoded, came, codecs_.KeyOf(channel, encoded), made);
}

void BusEnd::Tick(Time now) {
  pauses_->Tick(now);
  ServeListeners(now);
}

void BusEnd::ServeListeners(Time now) {
  for (const link_request_t& request : requests_.Drain())
    for (std::size_t i = 0; i < link_->table().size(); ++i)
      if (link_->table().at(i).name == request.channel && link_->table().at(i).direction != parts_.outgoing)
        listening_until_[i] = now + FromSeconds(std::clamp(request.hold_s, 0.0, kLongestHold_s));
  for (const auto& [channel, until] : listening_until_) link_->Listen(channel, now < until);
  std::erase_if(listening_until_, [&](const auto& l) { return now >= l.second; });
}

void BusEnd::Publish(const bus::radio::Delivery& delivery, Time now) {
  const auto message = codecs_.Unpack(delivery);
  if (!message) {
    ++undecodable_;
    return;
  }
  const std::string& channel = link_->table().at(delivery.channel).name;
  echo_.Published(channel, *message, now);
  node_.PublishRaw(channel, *message);
}

link_status_t BusEnd::Report(std::uint64_t turned_away, Time now) {
  reported_.turned_away = turned_away;
  link_status_t message =
      ToMessage(*link_, parts_.link.BytesPerSecond(), undecodable_, now - last_report_, now, reported_);
  status_.Publish(message);
  last_report_ = now;
  LogKeyChange(link_->Status(now).key_change);
  if (was_up_ != static_cast<bool>(message.up)) {
    was_up_ = message.up;
    Log(was_up_ ? bus::Level::kInfo : bus::Level::kWarning, was_up_ ? "link is up" : "link is down");
  }
  return message;
}

void BusEnd::Close() {
  if (link_) link_->Close();
}

void BusEnd::Log(bus::Level level, const std::string& text) const {
  log_(level, parts_.name.empty() ? text : parts_.name + ": " + text);
}

/// Once per channel: its counter in LINK_STATUS says how many.
void BusEnd::LogLate(std::size_t channel) {
  const std::string sentence = fmt::format(
      "{0}: a command came later than {1} s after its own stamp: not sent, counted as expired; next: the "
      "sender, or its clock",
      parts_.link.channels[channel].name, Seconds(link_->table().at(channel).ttl));
  if (refusals_.insert(sentence).second) Log(bus::Level::kWarning, sentence);
}

/// Each reason once: a sender that is wrong is so at its rate.
void BusEnd::LogRefusal(std::size_t channel, std::span<const std::byte> encoded, Time at) {
  const std::string sentence =
      parts_.link.channels[channel].name + ": " + codecs_.RefusalOf(channel, encoded, at);
  if (refusals_.insert(sentence).second) Log(bus::Level::kWarning, sentence);
}

/// Each stage once.
void BusEnd::LogKeyChange(bus::radio::KeyChange change) {
  using bus::radio::KeyChange;
  if (change == logged_change_) return;
  logged_change_ = change;
  const std::string next = NextKeyFile(parts_.key_file);
  if (change == KeyChange::kWaiting)
    Log(bus::Level::kInfo, fmt::format("{}: the link changes to it when the other end has it", next));
  if (change == KeyChange::kOffered)
    Log(bus::Level::kInfo,
        fmt::format("the other end has a next key: copy it to {} and start this process again", next));
  if (change == KeyChange::kDiffers)
    Log(bus::Level::kWarning,
        fmt::format("{}: the other end has another next key: copy one over the other and start that end's "
                    "process again",
                    next));
  if (change == KeyChange::kDone)
    Log(bus::Level::kInfo,
        fmt::format("the link uses the next key: `priamos link rekey --finish {}`", parts_.key_file));
}

}  // namespace priamos::radio
