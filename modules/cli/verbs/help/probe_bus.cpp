#include "cli/verbs/help/probe_bus.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <iterator>
#include <stdexcept>

#include "bus/claim_messages.hpp"
#include "bus/clocks/host_clock.hpp"
#include "bus/node.hpp"
#include "bus/own_types.hpp"
#include "bus/probe_answerer.hpp"
#include "bus/wire/bus_error.hpp"
#include "bus/wire/datagram.hpp"
#include "bus/wire/multicast.hpp"
#include "bus/wire/udp_receiver.hpp"
#include "bus/wire/udp_sender.hpp"

namespace priamos::cli {
namespace {

using Bytes = std::span<const std::byte>;

constexpr const char* kWho = "doctor";
constexpr Duration kAskEvery{400'000}, kListenOn{500'000};
constexpr int kBurst = 1000;

/// "10.77.0.2" of a sender, without its port.
std::string AddressOf(std::uint64_t sender) {
  const std::string text = bus::SenderAddress(sender);
  return text.substr(0, text.rfind(':'));
}

/// One asking host.
class Asker {
 public:
  Asker(const std::string& url, const bus::Schema& schema)
      : schema_(schema),
        url_(url),
        sender_(url),
        receiver_(url),
        answering_(url),
        answerer_(answering_, schema, clock_, kWho),
        host_(bus::ThisHost()),
        instance_(bus::MakeClaimant("", kWho).instance),
        probe_(Self()) {}

  HostProbe Ask(Duration duration) {
    const Time begin = clock_.Now();
    Time next = begin;
    for (Time now = begin; now < begin + duration + kListenOn; now = clock_.Now()) {
      if (now >= next && now < begin + duration) {
        next += kAskEvery;
        Question(now);
      }
      pollfd fds[] = {{receiver_.fd(), POLLIN, 0}, {sender_.fd(), POLLIN, 0}, {answering_.fd(), POLLIN, 0}};
      poll(fds, std::size(fds), 20);
      receiver_.Receive(kBurst, [this](std::uint64_t sender, std::string_view channel, Bytes bytes) {
        OnBus(AddressOf(sender), channel, bytes);
      });
      ReceiveAlone();
      answering_.Drain();
    }
    return probe_;
  }

 private:
  HostProbe::Self Self() const {
    const probe_t own = bus::MakeProbe(host_, kWho, url_, clock_.Now());
    HostProbe::Self self{own.host_id, instance_, {}, own.network, own.ttl, url_};
    for (const auto& interface : bus::NetworkInterfaces())
      self.addresses.insert(interface.addresses.begin(), interface.addresses.end());
    return self;
  }

  void Question(Time now) {
    probe_t question = bus::MakeProbe(host_, kWho, url_, now);
    question.kind = probe_t::ASKS;
    question.instance = instance_;
    question.number = ++number_;
    probe_.Asked(now);
    sender_.Send(channels::kProbe.name, bus::Encode(question));
  }

  void OnBus(const std::string& address, std::string_view channel, Bytes bytes) {
    if (channel == channels::kProbe.name && TakeProbe(address, bytes, false)) return;
    if (channel == channels::kHealth.name)
      if (const auto health = bus::DecodeChecked<health_t>(schema_, bytes))
        probe_.HearClock(address, *health);
    if (channel == channels::kClock.name)
      if (const auto clock = bus::DecodeChecked<clock_report_t>(schema_, bytes))
        probe_.HearNumber(address, clock->clock_id);
    if (channel == channels::kLinkStatus.name)
      if (const auto status = bus::DecodeChecked<link_status_t>(schema_, bytes)) probe_.HearLink(*status);
    probe_.HearOther(address, channel == channels::kClaim.name ? HostOfClaim(bytes) : "");
  }

  /// What came to the asking socket: anybody may send there.
  void ReceiveAlone() {
    std::array<std::byte, 2048> buffer;
    sockaddr_in from{};
    socklen_t size = sizeof from;
    for (int i = 0; i < kBurst; ++i) {
      const ssize_t n = recvfrom(sender_.fd(), buffer.data(), buffer.size(), MSG_DONTWAIT,
                                 reinterpret_cast<sockaddr*>(&from), &size);
      if (n <= 0) return;
      std::uint32_t number = 0;
      std::string_view channel;
      Bytes bytes;
      if (bus::ParseDatagram({buffer.data(), static_cast<std::size_t>(n)}, number, channel, bytes) &&
          channel == channels::kProbe.name)
        TakeProbe(AddressOf(std::uint64_t{from.sin_addr.s_addr} << 16 | from.sin_port), bytes, true);
    }
  }

  /// Returns false for what is no probe.
  bool TakeProbe(const std::string& address, Bytes bytes, bool alone) {
    const auto message = bus::DecodeChecked<probe_t>(schema_, bytes);
    if (message) probe_.HearProbe(*message, address, alone, clock_.Now());
    return message.has_value();
  }

  /// The computer's name in a claim; empty when it is none.
  std::string HostOfClaim(Bytes bytes) const {
    const auto claim = bus::DecodeChecked<claim_t>(schema_, bytes);
    return claim ? claim->host : "";
  }

  const bus::Schema& schema_;
  std::string url_;
  const bus::HostClock clock_;
  bus::UdpSender sender_;
  bus::UdpReceiver receiver_;
  bus::LcmBus answering_;
  bus::ProbeAnswerer answerer_;
  bus::HostIdentity host_;
  std::int32_t instance_ = 0, number_ = 0;
  HostProbe probe_;
};

}  // namespace

void RequireHosts(const std::string& url) {
  if (!url.starts_with("udpm://"))
    throw bus::BusError(fmt::format("--probe: expected a bus between hosts (udpm://), got {}", url));
}

HostProbe ProbeBus(const std::string& url, double seconds) {
  const bus::Schema schema = bus::OwnTypes();
  return Asker(url, schema).Ask(FromSeconds(seconds));
}

}  // namespace priamos::cli
