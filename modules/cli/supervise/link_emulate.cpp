#include "cli/supervise/link_emulate.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "bus/clock.hpp"
#include "bus/real_time_loop.hpp"
#include "bus/service_notifier.hpp"
#include "common/config.hpp"

namespace priamos::cli {
namespace {

namespace fs = std::filesystem;
using bus::radio::Line;
using bus::radio::LineConfig;
using bus::radio::LineCut;

/// What a tty's own buffer holds: who writes more has to wait.
constexpr Duration kTtyBuffer{4'000'000};
constexpr std::size_t kReadAtOnce = 256;
constexpr Duration kLongestIdle = std::chrono::milliseconds(100);

LineConfig WithBlackouts(const LinkEmulateOptions& options) {
  LineConfig line = options.line;
  if (options.blackouts.empty()) return line;
  for (const LineCut& cut : ReadBlackouts(options.blackouts)) line.cuts.push_back(cut);
  return line;
}

void MakeRaw(int fd) {
  termios settings{};
  tcgetattr(fd, &settings);
  cfmakeraw(&settings);
  tcsetattr(fd, TCSANOW, &settings);
}

void RemoveDeadLink(const std::string& link) {
  std::error_code ignored;
  if (fs::is_symlink(link, ignored)) fs::remove(link, ignored);
}

void MoveIn(PseudoTerminal& from, Line& line, Time now) {
  while (line.free_at() < now + kTtyBuffer) {
    const auto bytes = from.Read(kReadAtOnce);
    if (bytes.empty()) return;
    line.Write(bytes, now);
  }
}

}  // namespace

std::vector<LineCut> ReadBlackouts(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw ConfigError(fmt::format("{}: expected a blackout schedule, got none", path));
  std::vector<LineCut> cuts;
  std::string text;
  for (int line = 1; std::getline(in, text); ++line) {
    if (text.empty() || text[0] == '#' || (line == 1 && text.rfind("from_s", 0) == 0)) continue;
    LineCut cut;
    char rest = 0;
    if (std::sscanf(text.c_str(), "%lf,%lf %c", &cut.from_s, &cut.to_s, &rest) != 2 || cut.from_s < 0 ||
        !(cut.to_s >= cut.from_s) || !(cut.to_s <= 1e6))
      throw ConfigError(
          fmt::format("{}:{}: expected from_s,to_s with 0 <= from_s <= to_s, got \"{}\"", path, line, text));
    cuts.push_back(cut);
  }
  return cuts;
}

PseudoTerminal::PseudoTerminal(std::string link) : link_(std::move(link)) {
  if (fs::exists(fs::symlink_status(link_)) && !fs::is_symlink(fs::symlink_status(link_)))
    throw std::runtime_error(
        fmt::format("{}: expected a free name for an emulated tty, got something else there", link_));
  master_ = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  std::array<char, 128> name{};
  if (master_ < 0 || grantpt(master_) != 0 || unlockpt(master_) != 0 ||
      ptsname_r(master_, name.data(), name.size()) != 0)
    throw std::runtime_error(fmt::format("no pseudo terminal can be had: {}", std::strerror(errno)));
  target_ = name.data();
  slave_ = open(target_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  MakeRaw(slave_);
  std::error_code error;
  fs::remove(link_, error);
  fs::create_symlink(target_, link_, error);
  if (error) {
    close(slave_);
    close(master_);
    throw std::runtime_error(fmt::format("{}: the link cannot be made: {}", link_, error.message()));
  }
}

PseudoTerminal::~PseudoTerminal() {
  std::error_code error;
  if (fs::read_symlink(link_, error) == target_) fs::remove(link_, error);
  close(slave_);
  close(master_);
}

std::vector<std::byte> PseudoTerminal::Read(std::size_t most) {
  // This process keeps the tty open: the exclusive use of a program that was killed would never end.
  ioctl(slave_, TIOCNXCL);
  std::vector<std::byte> bytes(most);
  const ssize_t n = read(master_, bytes.data(), bytes.size());
  bytes.resize(n > 0 ? static_cast<std::size_t>(n) : 0);
  return bytes;
}

void PseudoTerminal::Write(std::span<const std::byte> bytes) {
  if (!bytes.empty() && write(master_, bytes.data(), bytes.size()) < 0 && errno != EAGAIN)
    throw std::runtime_error(fmt::format("{}: cannot be written: {}", link_, std::strerror(errno)));
}

EmulatedLine::EmulatedLine(const LinkEmulateOptions& options, Time start)
    : a_(options.a),
      b_(options.b),
      lines_(WithBlackouts(options), Rng::Stream(options.seed, "a to b"), Rng::Stream(options.seed, "b to a"),
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

int RunLinkEmulate(const LinkEmulateOptions& options) {
  const bus::SignalWatch signals;
  const bus::MonotonicClock clock;
  // Both at once: the new tty of one end may have the number that a link left behind at the other end names.
  RemoveDeadLink(options.a);
  RemoveDeadLink(options.b);
  EmulatedLine line(options, clock.Now());
  if (options.json)
    std::cout << nlohmann::ordered_json{{"a", options.a}, {"b", options.b}, {"baud", options.line.baud}}
              << std::endl;
  else
    std::cout << fmt::format("{} <-> {}: {} baud; Ctrl-C ends it\n", options.a, options.b, options.line.baud)
              << std::flush;
  bus::ServiceNotifier notifier;
  for (;;) {
    notifier.Beat(clock.Now());
    const Duration idle = std::min<Duration>(line.NextArrival() - clock.Now(), kLongestIdle);
    const auto us = std::max<Duration::rep>(0, idle.count());
    const timespec wait{static_cast<time_t>(us / 1'000'000), static_cast<long>(us % 1'000'000 * 1000)};
    pollfd fds[] = {{line.a().fd(), POLLIN, 0}, {line.b().fd(), POLLIN, 0}, {signals.fd(), POLLIN, 0}};
    ppoll(fds, std::size(fds), &wait, nullptr);
    if (fds[2].revents != 0) return 0;
    line.Step(clock.Now());
  }
}

}  // namespace priamos::cli
