#include "cli/supervise/link_emulate.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <poll.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "bus/clocks/host_clock.hpp"
#include "bus/host/service_notifier.hpp"
#include "bus/real_time_loop.hpp"
#include "common/config.hpp"
#include "common/input/quoted.hpp"
#include "common/input/regular_file.hpp"

namespace priamos::cli {
namespace {

namespace fs = std::filesystem;
using bus::radio::Line;
using bus::radio::LineConfig;
using bus::radio::LineCut;
using bus::radio::LineDelay;
using bus::radio::PacketAirConfig;

/// What a tty's own buffer holds: who writes more has to wait.
constexpr Duration kTtyBuffer{4'000'000};
constexpr std::size_t kReadAtOnce = 256;
constexpr std::size_t kMostBytes = 16 << 20;  ///< of a schedule
constexpr Duration kLongestIdle = std::chrono::milliseconds(100);

LineConfig WithSchedules(const LinkEmulateOptions& options) {
  LineConfig line = options.line;
  if (!options.blackouts.empty())
    for (const LineCut& cut : ReadBlackouts(options.blackouts)) line.cuts.push_back(cut);
  if (!options.delays.empty())
    for (LineDelay& delay : ReadDelays(options.delays)) line.delays.push_back(std::move(delay));
  return line;
}

PacketAirConfig WithBlackouts(const LinkEmulateOptions& options) {
  PacketAirConfig air = *options.packets;
  air.bytes_per_s = options.line.air_rate_bytes_s;
  air.latency_s = options.line.latency_s;
  air.half_duplex = options.line.half_duplex;
  if (!options.blackouts.empty()) air.cuts = ReadBlackouts(options.blackouts);
  return air;
}

/// Calls `take` with every line of a CSV file and its number, but for comments and a heading.
template <class Take>
void ForEachRow(const std::string& path, const std::string& what, const std::string& heading, Take take) {
  const RegularFile file(path);
  if (!file.open())
    throw ConfigError(fmt::format("{}: expected a {} schedule, got {}", Escaped(path), what, file.problem()));
  const auto content = file.Read(kMostBytes);
  if (!content)
    throw ConfigError(
        fmt::format("{}: expected a {} schedule of at most {} bytes that can be read, got "
                    "another",
                    Escaped(path), what, kMostBytes));
  std::istringstream in(*content);
  bool empty = true;
  std::string text;
  for (int line = 1; std::getline(in, text); ++line) {
    if (text.empty() || text[0] == '#' || (line == 1 && text.starts_with(heading))) continue;
    take(line, text);
    empty = false;
  }
  if (empty) throw ConfigError(fmt::format("{}: expected a {} schedule, got one without rows", path, what));
}

void RemoveDeadLink(const std::string& link) {
  std::error_code ignored;
  if (fs::is_symlink(link, ignored)) fs::remove(link, ignored);
}

/// Moves what a program wrote to `write`, as long as `free_at` says that a tty's buffer would take it.
template <class FreeAt, class Write>
void MoveIn(PseudoTerminal& from, Time now, FreeAt free_at, Write write) {
  while (free_at() < now + kTtyBuffer) {
    const auto bytes = from.Read(kReadAtOnce);
    if (bytes.empty()) return;
    write(bytes);
  }
}

void MoveIn(PseudoTerminal& from, Line& line, Time now) {
  MoveIn(
      from, now, [&] { return line.free_at(); }, [&](const auto& bytes) { line.Write(bytes, now); });
}

std::unique_ptr<EmulatedMedium> MakeMedium(const LinkEmulateOptions& options, Time start) {
  if (options.robots > 0) return std::make_unique<EmulatedChannel>(options, start);
  if (options.packets) return std::make_unique<EmulatedPacketRadios>(options, start);
  return std::make_unique<EmulatedLine>(options, start);
}

void Announce(const LinkEmulateOptions& options, const std::vector<std::string>& ttys) {
  if (options.json && options.robots > 0)
    std::cout << nlohmann::ordered_json{{"ttys", ttys}, {"baud", options.line.baud}} << std::endl;
  else if (options.json)
    std::cout << nlohmann::ordered_json{{"a", options.a}, {"b", options.b}, {"baud", options.line.baud}}
              << std::endl;
  else
    std::cout << fmt::format("{}: {} baud; Ctrl-C ends it\n", fmt::join(ttys, " <-> "), options.line.baud)
              << std::flush;
}

}  // namespace

std::vector<LineCut> ReadBlackouts(const std::string& path) {
  std::vector<LineCut> cuts;
  ForEachRow(path, "blackout", "from_s", [&](int line, const std::string& text) {
    LineCut cut;
    char rest = 0;
    if (std::sscanf(text.c_str(), "%lf,%lf %c", &cut.from_s, &cut.to_s, &rest) != 2 || cut.from_s < 0 ||
        !(cut.to_s >= cut.from_s) || !(cut.to_s <= 1e6))
      throw ConfigError(fmt::format("{}:{}: expected from_s,to_s with 0 <= from_s <= to_s, got {}",
                                    Escaped(path), line, Quoted(text)));
    cuts.push_back(cut);
  });
  return cuts;
}

std::vector<LineDelay> ReadDelays(const std::string& path) {
  std::vector<LineDelay> delays;
  ForEachRow(path, "delay", "way", [&](int line, const std::string& text) {
    LineDelay d;
    std::array<char, 8> way{};
    char rest = 0;
    const int n = std::sscanf(text.c_str(), "%7[a-z_],%lf,%lf,%lf,%lf %c", way.data(), &d.from_s, &d.to_s,
                              &d.first_s, &d.last_s, &rest);
    d.way = way.data();
    const bool known = d.way == "a_to_b" || d.way == "b_to_a" || d.way == "both";
    if (n != 5 || !known || !(d.from_s >= 0 && d.from_s < d.to_s && d.to_s <= 1e6) ||
        !(std::min(d.first_s, d.last_s) >= 0 && std::max(d.first_s, d.last_s) <= 1000))
      throw ConfigError(
          fmt::format("{}:{}: expected way,from_s,to_s,first_s,last_s with a way of a_to_b, b_to_a or both, "
                      "0 <= from_s < to_s and delays of 0 to 1000 s, got {}",
                      Escaped(path), line, Quoted(text)));
    delays.push_back(d);
  });
  return delays;
}

EmulatedLine::EmulatedLine(const LinkEmulateOptions& options, Time start)
    : a_(options.a),
      b_(options.b),
      lines_(WithSchedules(options), Rng::Stream(options.seed, "a to b"), Rng::Stream(options.seed, "b to a"),
             start) {}

void EmulatedLine::Step(Time now) {
  MoveIn(a_, lines_.a_to_b, now);
  MoveIn(b_, lines_.b_to_a, now);
  b_.Write(lines_.a_to_b.Read(now));
  a_.Write(lines_.b_to_a.Read(now));
}

Time EmulatedLine::NextArrival() const {
  return std::min(lines_.a_to_b.next_arrival(), lines_.b_to_a.next_arrival());
}

EmulatedChannel::EmulatedChannel(const LinkEmulateOptions& options, Time start)
    : air_(WithSchedules(options), static_cast<std::size_t>(options.robots) + 1, options.seed, start) {
  for (const std::string& link : TtysOf(options)) ttys_.push_back(std::make_unique<PseudoTerminal>(link));
}

void EmulatedChannel::Step(Time now) {
  for (std::size_t i = 0; i < ttys_.size(); ++i)
    MoveIn(
        *ttys_[i], now, [&] { return air_.free_at(i); },
        [&](const auto& bytes) { air_.Write(i, bytes, now); });
  for (std::size_t i = 0; i < ttys_.size(); ++i) ttys_[i]->Write(air_.Read(i, now));
}

std::vector<int> EmulatedChannel::fds() const {
  std::vector<int> fds;
  for (const auto& tty : ttys_) fds.push_back(tty->fd());
  return fds;
}

EmulatedPacketRadios::EmulatedPacketRadios(const LinkEmulateOptions& options, Time start)
    : ttys_{PseudoTerminal(options.a), PseudoTerminal(options.b)},
      decoders_{bus::radio::KissDecoder(options.packets->mtu_bytes),
                bus::radio::KissDecoder(options.packets->mtu_bytes)},
      air_(WithBlackouts(options), Rng::Stream(options.seed, "packets"), start) {}

void EmulatedPacketRadios::Step(Time now) {
  for (std::size_t side = 0; side < 2; ++side)
    MoveIn(
        ttys_[side], now, [&] { return air_.free_at(side); },
        [&](const auto& bytes) {
          for (const std::byte byte : bytes)
            if (auto packet = decoders_[side].Push(byte)) air_.Send(side, std::move(*packet), now);
        });
  for (std::size_t side = 0; side < 2; ++side)
    for (const auto& packet : air_.Receive(side, now)) ttys_[side].Write(bus::radio::EncodeKiss(packet));
}

std::vector<std::string> TtysOf(const LinkEmulateOptions& options) {
  std::vector<std::string> ttys{options.a};
  if (options.robots == 0) ttys.push_back(options.b);
  for (int i = 1; i <= options.robots; ++i) ttys.push_back(fmt::format("{}-{}", options.b, i));
  return ttys;
}

int RunLinkEmulate(const LinkEmulateOptions& options) {
  const bus::SignalWatch signals;
  const bus::HostClock clock;
  const std::vector<std::string> ttys = TtysOf(options);
  // All at once: the new tty of one end may have the number that a link left behind at another one names.
  for (const std::string& tty : ttys) RemoveDeadLink(tty);
  const std::unique_ptr<EmulatedMedium> medium = MakeMedium(options, clock.Now());
  Announce(options, ttys);
  bus::ServiceNotifier notifier;
  std::vector<pollfd> fds{{signals.fd(), POLLIN, 0}};
  for (const int fd : medium->fds()) fds.push_back({fd, POLLIN, 0});
  for (;;) {
    notifier.Beat(clock.Now());
    const Duration idle = std::min<Duration>(medium->NextArrival() - clock.Now(), kLongestIdle);
    const auto us = std::max<Duration::rep>(0, idle.count());
    const timespec wait{static_cast<time_t>(us / 1'000'000), static_cast<long>(us % 1'000'000 * 1000)};
    ppoll(fds.data(), fds.size(), &wait, nullptr);
    if (fds[0].revents != 0) return 0;
    medium->Step(clock.Now());
  }
}

}  // namespace priamos::cli
