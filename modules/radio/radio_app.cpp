#include "radio/radio_app.hpp"

#include <fmt/format.h>
#include <sodium.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "bus/radio/budget.hpp"
#include "bus/type_files.hpp"
#include "common/config.hpp"
#include "common/random.hpp"
#include "radio/file_store.hpp"
#include "radio/key_file.hpp"
#include "radio/link_health.hpp"
#include "radio/net_port.hpp"
#include "radio/private_line.hpp"

namespace priamos::radio {
namespace {

using bus::radio::Direction;

constexpr Duration kReportPeriod{1'000'000};
constexpr double kLongestHold_s = 600;
/// Bytes that may wait for a port that takes none; more are dropped, because late bytes are worth nothing.
constexpr std::size_t kMostUnwritten = 64;

std::optional<bus::Schema> TypesIn(const std::string& folder) {
  if (folder.empty()) return std::nullopt;
  return bus::Schema(bus::ReadTypeFiles(folder));
}

}  // namespace

RadioApp::RadioApp(const RadioConfig& config, bus::Context& context)
    : config_(config),
      context_(context),
      link_config_(LoadLink()),
      own_types_(TypesIn(config.types)),
      outgoing_(config.side == "onboard" ? Direction::kUp : Direction::kDown),
      codecs_(link_config_, types()),
      key_(LoadKey()),
      next_key_(LoadNextKey()),
      requests_(context.node().SubscribeAll(channels::kLinkRequest)),
      status_(context.node().Advertise(channels::kLinkStatus)) {
  bus::radio::RequireBudget(link_config_.Table(types()), link_config_.Options());
  OpenLine();
  if (link_config_.simulation_key && !context.lockstep())
    context.Log(bus::Level::kInfo, "the link has the simulation key, which everybody knows");
  if (config.state_file.empty()) {
    store_ = std::make_unique<bus::radio::MemoryStore>();
  } else {
    store_ = std::make_unique<FileStore>(
        context.ResolvePath(config.state_file),
        config.fast_state_file.empty() ? "" : context.ResolvePath(config.fast_state_file));
  }
  SubscribeAll();
}

RadioApp::~RadioApp() {
  try {
    if (link_) link_->Close();
  } catch (const std::exception& error) {
    context_.Log(bus::Level::kError, error.what());
  }
}

bus::radio::LinkConfig RadioApp::LoadLink() const {
  bus::radio::LinkConfig link = config_.HasOwnLink()
                                    ? config_.own_link
                                    : LoadConfig<bus::radio::LinkConfig>(context_.ResolvePath(config_.link));
  // Who owns what is settled on each bus: an owner beyond the radio is none here.
  for (const auto& channel : link.channels)
    if (channel.name == channels::kClaim.name || channel.name == channels::kWheelCommand.name)
      throw ConfigError(fmt::format("{}: channel: expected one that may cross the radio, got {}",
                                    context_.ResolvePath(config_.link), channel.name));
  return link;
}

void RadioApp::OpenLine() {
  if (!IsNetPort(config_.port)) {
    port_ = context_.OpenSerial(config_.port, link_config_.baud);
    return;
  }
  NetAddress address = ParseNetAddress(config_.port);
  address.loopback_only = link_config_.simulation_key;
  if (address.datagrams != link_config_.Options().datagrams)
    throw ConfigError(fmt::format("radio link: datagrams: expected {} with port {}, got {}",
                                  address.datagrams, config_.port, link_config_.Options().datagrams));
  net_ = OpenNetPort(address);
}

bus::radio::LinkKey RadioApp::LoadKey() const {
  if (!link_config_.simulation_key) return ReadKeyFile(context_.ResolvePath(link_config_.key_file));
  if (context_.lockstep()) return SimulationKey();
  const bool is_there =
      IsNetPort(config_.port) || std::filesystem::exists(config_.port);  // else see OpenLine
  if (is_there && !IsPrivateLine(config_.port))
    throw ConfigError(
        fmt::format("{}: simulation_key: expected false on {}, which others can reach, got true: make a key "
                    "with `priamos link keygen`",
                    context_.ResolvePath(config_.link), config_.port));
  return SimulationKey();
}

std::optional<bus::radio::LinkKey> RadioApp::LoadNextKey() const {
  if (link_config_.simulation_key) return std::nullopt;
  return ReadNextKeyFile(context_.ResolvePath(link_config_.key_file), key_);
}

bus::radio::NonceSource RadioApp::Nonces() const {
  if (context_.lockstep())
    return [rng = Rng::Stream(context_.seed(), "radio " + config_.side)]() mutable { return rng.engine()(); };
  return [] {
    std::uint64_t nonce = 0;
    randombytes_buf(&nonce, sizeof nonce);
    return nonce;
  };
}

void RadioApp::SubscribeAll() {
  const bus::radio::ChannelTable table = link_config_.Table(types());
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (table.at(i).direction != outgoing_) {
      context_.node().AdvertiseRaw(table.at(i).name);
      continue;
    }
    const auto offer = [this, i](std::span<const std::byte> encoded, Time now) {
      if (echo_.IsEcho(i, encoded, now)) return;
      if (!link_) {
        waiting_.push_back({i, {encoded.begin(), encoded.end()}});
        return;
      }
      link_->Offer(i, encoded, pauses_->CameAt(now), codecs_.KeyOf(i, encoded));
    };
    context_.node().SubscribeRaw(table.at(i).name, types(), offer);
  }
}

void RadioApp::StartLink(Time now) {
  link_ = std::make_unique<bus::radio::LinkEndpoint>(
      link_config_.Table(types()), outgoing_, key_, link_config_.Options(), *store_,
      [this](std::size_t channel, std::span<const std::byte> encoded, Time at) {
        auto packed = codecs_.Pack(channel, encoded, at);
        if (!packed) LogRefusal(channel, encoded, at);
        return packed;
      },
      Nonces(), now, next_key_);
  for (const Waiting& w : waiting_)
    link_->Offer(w.channel, w.encoded, now, codecs_.KeyOf(w.channel, w.encoded));
  waiting_.clear();
  pauses_.emplace(TickPeriod(), now);
  last_report_ = now;
  next_report_ = now + kReportPeriod;
}

/// Each reason once: a sender that is wrong is so at its rate.
void RadioApp::LogRefusal(std::size_t channel, std::span<const std::byte> encoded, Time at) {
  const std::string sentence =
      link_config_.channels[channel].name + ": " + codecs_.RefusalOf(channel, encoded, at);
  if (refusals_.insert(sentence).second) context_.Log(bus::Level::kWarning, sentence);
}

void RadioApp::Tick(Time now) {
  if (!link_) StartLink(now);
  pauses_->Tick(now);
  ReadLine();
  ServeListeners(now);
  FeedLine(now);
  if (now >= *next_report_) Report(now);
}

void RadioApp::ServeListeners(Time now) {
  for (const link_request_t& request : requests_.Drain())
    for (std::size_t i = 0; i < link_->table().size(); ++i)
      if (link_->table().at(i).name == request.channel && link_->table().at(i).direction != outgoing_)
        listening_until_[i] = now + FromSeconds(std::clamp(request.hold_s, 0.0, kLongestHold_s));
  for (const auto& [channel, until] : listening_until_) link_->Listen(channel, now < until);
  std::erase_if(listening_until_, [&](const auto& l) { return now >= l.second; });
}

void RadioApp::ReadLine() {
  if (net_) return ReadFrames();
  std::array<std::byte, 256> buffer;
  for (;;) {
    const std::size_t n = port_->Read(buffer);
    if (n == 0) return;
    // Taken after the reading: bytes must never seem to have arrived before they did.
    const Time now = context_.node().Now();
    for (const bus::radio::Delivery& d : link_->Receive(std::span(buffer).first(n), now)) Publish(d, now);
  }
}

void RadioApp::ReadFrames() {
  for (const NetFrame& frame : net_->Read([this] { return context_.node().Now(); })) {
    const auto received = link_->ReceiveFrame(frame.bytes, frame.first_byte, frame.arrived, frame.stranger);
    if (received.proof != bus::radio::Proof::kNone) net_->Judge(frame, received.proof);
    for (const bus::radio::Delivery& d : received.deliveries) Publish(d, frame.arrived);
  }
}

void RadioApp::FeedLine(Time now) {
  const auto bytes = link_->Step(now);
  unwritten_.insert(unwritten_.end(), bytes.begin(), bytes.end());
  if (unwritten_.empty()) return;
  const std::size_t n = net_ ? net_->Write(unwritten_, now) : port_->Write(unwritten_);
  unwritten_.erase(unwritten_.begin(), unwritten_.begin() + static_cast<std::ptrdiff_t>(n));
  if (unwritten_.size() > kMostUnwritten) unwritten_.clear();
}

void RadioApp::Publish(const bus::radio::Delivery& delivery, Time now) {
  const auto message = codecs_.Unpack(delivery);
  if (!message) {
    ++undecodable_;
    return;
  }
  echo_.Published(delivery.channel, *message, now);
  context_.node().PublishRaw(link_->table().at(delivery.channel).name, *message);
}

/// Each stage once.
void RadioApp::LogKeyChange(bus::radio::KeyChange change) {
  using bus::radio::KeyChange;
  if (change == logged_change_) return;
  logged_change_ = change;
  const std::string file = link_config_.simulation_key ? "" : context_.ResolvePath(link_config_.key_file);
  const std::string next = NextKeyFile(file);
  if (change == KeyChange::kWaiting)
    context_.Log(bus::Level::kInfo,
                 fmt::format("{}: the link changes to it when the other end has it", next));
  if (change == KeyChange::kOffered)
    context_.Log(
        bus::Level::kInfo,
        fmt::format("the other end has a next key: copy it to {} and start this process again", next));
  if (change == KeyChange::kDiffers)
    context_.Log(bus::Level::kWarning,
                 fmt::format("{}: the other end has another next key: copy one over the other and start that "
                             "end's process again",
                             next));
  if (change == KeyChange::kDone)
    context_.Log(bus::Level::kInfo,
                 fmt::format("the link uses the next key: `priamos link rekey --finish {}`", file));
}

void RadioApp::Report(Time now) {
  if (net_) reported_.turned_away = net_->turned_away();
  const link_status_t message =
      ToMessage(*link_, link_config_.BytesPerSecond(), undecodable_, now - last_report_, now, reported_);
  status_.Publish(message);
  last_report_ = now;
  next_report_ = now + kReportPeriod;
  const auto [health, why] =
      HealthOf(message, link_->table().code_bytes(), link_->Status(now).peer_code_bytes);
  context_.SetHealth(health, why);
  LogKeyChange(link_->Status(now).key_change);
  if (was_up_ != static_cast<bool>(message.up)) {
    was_up_ = message.up;
    context_.Log(was_up_ ? bus::Level::kInfo : bus::Level::kWarning, was_up_ ? "link is up" : "link is down");
  }
}

}  // namespace priamos::radio
