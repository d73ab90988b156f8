#include <poll.h>

#include <algorithm>
#include <cmath>

#include "test/bench/driving/driving_rig.hpp"

namespace priamos::bench {
namespace {

constexpr std::size_t kRemembered = 1000;
constexpr Duration kTtyBuffer{4'000'000};

void MoveIn(cli::PseudoTerminal& from, bus::radio::Line& line, Time now) {
  while (line.free_at() < now + kTtyBuffer) {
    const auto bytes = from.Read(256);
    if (bytes.empty()) return;
    line.Write(bytes, now);
  }
}

}  // namespace

StudyLine::StudyLine(const std::string& onboard_tty, const std::string& offboard_tty,
                     const bus::radio::LineConfig& config)
    : config_(config),
      onboard_(onboard_tty),
      offboard_(offboard_tty),
      lines_(config, Rng::Stream(1, "up"), Rng::Stream(1, "down"), clock_.Now()),
      thread_([this] { Run(); }) {}

StudyLine::~StudyLine() {
  end_ = true;
  thread_.join();
}

void StudyLine::Run() {
  while (!end_) {
    const Time now = clock_.Now();
    const Time next = std::min(lines_.a_to_b.next_arrival(), lines_.b_to_a.next_arrival());
    const auto us =
        std::clamp<Duration::rep>((next == Time::max() ? Duration(20'000) : next - now).count(), 0, 20'000);
    const timespec wait{0, static_cast<long>(us * 1000)};
    pollfd fds[] = {{onboard_.fd(), POLLIN, 0}, {offboard_.fd(), POLLIN, 0}};
    ppoll(fds, std::size(fds), &wait, nullptr);
    Step(clock_.Now());
  }
}

void StudyLine::Step(Time now) {
  MoveIn(onboard_, lines_.a_to_b, now);
  MoveIn(offboard_, lines_.b_to_a, now);
  const auto up = lines_.a_to_b.Read(now), down = lines_.b_to_a.Read(now);
  if (cut_) return;
  offboard_.Write(up);
  onboard_.Write(down);
  NoteDown(down, now);
}

/// A frame ends with a delimiter; one that leads, after silence, belongs to what follows it.
void StudyLine::NoteDown(std::span<const std::byte> bytes, Time now) {
  const std::lock_guard lock(mutex_);
  for (const std::byte b : bytes) {
    ++bytes_;
    if (b != std::byte{0} || bytes_ == 1) continue;
    down_.push_back({now, bytes_});
    if (down_.size() > kRemembered) down_.pop_front();
    bytes_ = 0;
  }
}

StudyLine::Frame StudyLine::DownFrameBefore(Time at) const {
  const std::lock_guard lock(mutex_);
  for (auto f = down_.rbegin(); f != down_.rend(); ++f)
    if (f->end <= at) return *f;
  return {};
}

Duration StudyLine::WireTime(const Frame& frame) const {
  return FromSeconds(10.0 * static_cast<double>(frame.bytes) / config_.baud + config_.latency_s);
}

double Sample::Percentile(double percent) const {
  if (ms_.empty()) return NAN;
  std::vector<double> sorted = ms_;
  std::sort(sorted.begin(), sorted.end());
  const double rank = std::ceil(percent / 100 * static_cast<double>(sorted.size()));
  return sorted[static_cast<std::size_t>(std::clamp(rank, 1.0, static_cast<double>(sorted.size()))) - 1];
}

int Sample::Within(double ms) const {
  return static_cast<int>(std::count_if(ms_.begin(), ms_.end(), [ms](double v) { return v <= ms; }));
}

}  // namespace priamos::bench
