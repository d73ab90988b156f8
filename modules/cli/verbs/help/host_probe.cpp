#include "cli/verbs/help/host_probe.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "bus/clocks/clock_exchange.hpp"
#include "bus/wire/multicast.hpp"
#include "cli/verbs/help/link_finding.hpp"

namespace priamos::cli {
namespace {

using Verdict = Finding::Verdict;

constexpr const char* kThisHost = "this host";
constexpr std::size_t kMostClocks = 256;                    // processes; anybody may send HEALTH
constexpr std::int64_t kLatest_us = 7'258'118'400'000'000;  // the year 2200

/// Words of another computer end up in a terminal: only what a name or an address has.
std::string Plain(const std::string& text) {
  std::string plain;
  for (const char c : text)
    plain += (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' ||
                     c == '.' || c == '_'
                 ? c
                 : '?';
  return plain;
}

/// "vision (10.77.0.2)"
std::string Named(const std::string& name, const std::string& address) {
  return name.empty() ? address : fmt::format("{} ({})", Plain(name), address);
}

std::string Way(const std::string& network, int ttl) {
  return fmt::format("by {} with ttl {}", network.empty() ? "no interface" : Plain(network), ttl);
}

/// "; its clock is 0.1000 s ahead, to 0.2 ms: stamps are translated"
std::string ClockOf(const std::optional<bus::ClockDifference>& clock) {
  if (!clock) return "";
  const double ahead_s = Seconds(clock->ahead), uncertainty_ms = 1000 * Seconds(clock->uncertainty);
  if (std::chrono::abs(clock->ahead) <= clock->uncertainty)
    return fmt::format("; its clock agrees to {:.1f} ms", uncertainty_ms);
  return fmt::format("; its clock is {:.4f} s {}, to {:.1f} ms: processes translate its stamps",
                     std::abs(ahead_s), ahead_s > 0 ? "ahead" : "behind", uncertainty_ms);
}

}  // namespace

bool HostProbe::IsOwn(const std::string& address) const {
  return address == "localhost" || self_.addresses.contains(address);
}

void HostProbe::HearProbe(const probe_t& message, const std::string& address, bool alone, Time now) {
  // By another of its interfaces this host sends under another number.
  if (message.host_id == self_.host_id || IsOwn(address)) return;
  Host& host = hosts_[message.host_id];
  host.name = message.host;
  if (!alone || host.address.empty()) host.address = address;
  host.network = message.network;
  host.ttl = message.ttl;
  host.processes.insert(message.process);
  if (!alone) host.heard = true;
  if (message.kind != probe_t::ANSWERS || message.instance != self_.instance) return;
  if (message.number < 1 || static_cast<std::size_t>(message.number) > asked_.size()) return;
  (alone ? host.alone : host.on_bus).insert(message.number);
  const Time there = FromUtime(std::clamp<std::int64_t>(message.utime, 0, kLatest_us));
  host.clock.Add({asked_[static_cast<std::size_t>(message.number) - 1], there, there, now});
}

void HostProbe::HearOther(const std::string& address, const std::string& host) {
  if (IsOwn(address)) return;
  std::string& name = others_[address];
  if (!host.empty()) name = host;
}

void HostProbe::HearClock(const std::string& address, const health_t& message) {
  const std::pair key(address, message.process);
  if (clocks_.size() < kMostClocks || clocks_.contains(key)) clocks_[key] = message.clock_uncertainty_s;
}

void HostProbe::HearNumber(const std::string& address, std::int32_t clock_id) {
  if (speakers_.size() >= kMostClocks && !speakers_.contains(clock_id)) return;
  std::set<std::string>& addresses = speakers_[clock_id];
  if (addresses.size() < kMostClocks) addresses.insert(IsOwn(address) ? kThisHost : address);
}

bool HostProbe::IsCopied(const std::string& address) const {
  return std::any_of(speakers_.begin(), speakers_.end(), [&](const auto& number) {
    return number.second.size() > 1 && number.second.contains(address);
  });
}

/// "vision (10.77.0.2)", as far as it is known.
std::string HostProbe::NameOf(const std::string& address) const {
  if (address == kThisHost || IsOwn(address)) return kThisHost;
  for (const auto& [id, host] : hosts_)
    if (host.address == address) return Named(host.name, address);
  const auto other = others_.find(address);
  return Named(other == others_.end() ? "" : other->second, address);
}

void HostProbe::AddClocks(std::vector<Finding>& findings) const {
  const double bound_s = Seconds(bus::ClockExchange::kMostUncertain);
  for (const auto& [key, uncertainty_s] : clocks_) {
    const auto& [address, process] = key;
    if (uncertainty_s >= 0 && uncertainty_s <= bound_s) continue;
    findings.push_back(
        {fmt::format("clock of {} on {}", Plain(process), NameOf(address)), Verdict::kBad,
         fmt::format(
             "{} against the reference of the bus, {:.0f} ms expected: messages between such hosts are "
             "refused",
             uncertainty_s >= 0 ? fmt::format("known to {:.0f} ms", 1000 * uncertainty_s) : "not known",
             1000 * bound_s),
         "priamos topic echo CLOCK   # who has heard whom, and how exactly"});
  }
}

void HostProbe::AddCopies(std::vector<Finding>& findings) const {
  for (const auto& [number, addresses] : speakers_) {
    if (addresses.size() < 2) continue;
    std::vector<std::string> names;
    for (const std::string& address : addresses) names.push_back(NameOf(address));
    findings.push_back(
        {"copied machine", Verdict::kBad,
         fmt::format("{} run with one clock's number, as machines do of which one was copied while "
                     "it ran: they refuse each other's messages",
                     fmt::join(names, " and ")),
         "priamos down && priamos up   # start the processes of the copy again"});
  }
}

Finding HostProbe::Works(const Host& host) const {
  const std::string who = Named(host.name, host.address);
  const std::size_t answered = host.on_bus.size();
  const std::string found = fmt::format("both ways work: {} of {} questions answered, by {} process{}, {}{}",
                                        answered, asked_.size(), host.processes.size(),
                                        host.processes.size() == 1 ? "" : "es", Way(host.network, host.ttl),
                                        IsCopied(host.address) ? "; its clock's number is another host's"
                                                               : ClockOf(host.clock.At(asked_.back())));
  if (answered == asked_.size()) return {"host " + who, Verdict::kGood, found, ""};
  return {"host " + who, Verdict::kNotNeededYet, found + "; some were lost",
          "priamos topic list --watch   # shows who loses messages"};
}

/// It heard the question, and what it sends to the bus does not arrive.
Finding HostProbe::CutFrom(const Host& host) const {
  const std::string who = Named(host.name, host.address);
  const std::string command =
      host.ttl == 0
          ? "export PRIAMOS_TTL=1   # there, or onboard_ttl in its deployment.toml; then start it again"
          : fmt::format(
                "ip -4 route get {}   # there: it sends {}; if that is another cable: export "
                "PRIAMOS_NETWORK=...",
                bus::GroupOf(self_.bus), Plain(host.network));
  return {fmt::format("way from {} to here", who), Verdict::kBad,
          fmt::format(
              "cut: it answers {} of {} questions, but nothing that it sends to the bus ({}) arrives here",
              host.alone.size(), asked_.size(), Way(host.network, host.ttl)),
          command};
}

/// It is heard, and answers nothing.
Finding HostProbe::CutTo(const std::string& who) const {
  const std::string command =
      self_.ttl == 0
          ? "export PRIAMOS_TTL=1   # or --ttl 1, or onboard_ttl in deployment.toml"
          : fmt::format("sudo tcpdump -ni any udp port {}   # there, while this runs here: does it arrive?",
                        bus::PortOf(self_.bus));
  return {
      fmt::format("way from here to {}", who), Verdict::kBad,
      fmt::format("cut: it is heard, but answered none of {} questions: what this host sends ({}) does not "
                  "arrive there, or it is no host of PRIAMOS",
                  asked_.size(), Way(self_.network, self_.ttl)),
      command};
}

Finding HostProbe::Legs(const Host& host) const {
  if (!host.on_bus.empty() || (!host.alone.empty() && host.heard)) return Works(host);
  if (!host.alone.empty()) return CutFrom(host);
  return CutTo(Named(host.name, host.address));
}

std::vector<Finding> HostProbe::Findings(const std::vector<std::string>& expected) const {
  std::vector<Finding> findings;
  std::set<std::string> addresses, names;
  for (const auto& [id, host] : hosts_) {
    findings.push_back(Legs(host));
    addresses.insert(host.address);
    names.insert(host.name);
  }
  for (const auto& [address, name] : others_) {
    if (addresses.contains(address)) continue;
    findings.push_back(CutTo(Named(name, address)));
    names.insert(name);
  }
  const std::string ask_there = fmt::format("priamos doctor --probe --bus '{}'   # there, at the same time",
                                            bus::WithoutNetwork(self_.bus));
  for (const std::string& name : expected)
    if (!names.contains(name))
      findings.push_back({fmt::format("way from {} to here", Plain(name)), Verdict::kBad,
                          "cut, or it is off: nothing of it arrives here", ask_there});
  if (findings.empty())
    findings.push_back({"other hosts", Verdict::kNotNeededYet,
                        fmt::format("none is heard, and none answered {} questions sent {}: whether one is "
                                    "there and cut off both ways cannot be told from here; --expect NAME "
                                    "says that one has to be",
                                    asked_.size(), Way(self_.network, self_.ttl)),
                        ask_there});
  for (const auto& [onboard, status] : links_) findings.push_back(LinkFinding(status));
  AddClocks(findings);
  AddCopies(findings);
  return findings;
}

}  // namespace priamos::cli
