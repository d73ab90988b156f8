#include "bus/radio/line/shared_line.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace priamos::bus::radio {

SharedLine::SharedLine(const LineConfig& config, std::size_t sides, std::uint64_t seed, Time start)
    : air_(std::make_shared<SharedAir>(config.turnaround_s, sides)), lines_(sides) {
  for (std::size_t from = 0; from < sides; ++from) {
    lines_[from].resize(sides);
    for (std::size_t to = 0; to < sides; ++to) {
      if (to == from) continue;
      lines_[from][to] =
          std::make_unique<Line>(config, Rng::Stream(seed, fmt::format("radio {} to {}", from, to)), start,
                                 air_, static_cast<int>(from), static_cast<int>(to));
    }
  }
}

void SharedLine::Write(std::size_t side, std::span<const std::byte> bytes, Time now) {
  for (const auto& line : lines_[side])
    if (line) line->Write(bytes, now);
}

std::vector<std::byte> SharedLine::Read(std::size_t side, Time now) {
  std::vector<std::byte> heard;
  for (const auto& from : lines_) {
    if (!from[side]) continue;
    const std::vector<std::byte> bytes = from[side]->Read(now);
    heard.insert(heard.end(), bytes.begin(), bytes.end());
  }
  return heard;
}

Time SharedLine::free_at(std::size_t side) const {
  return lines_[side][side == 0 ? 1 : 0]->free_at();
}

Time SharedLine::next_arrival() const {
  Time next = Time::max();
  for (const auto& from : lines_)
    for (const auto& line : from)
      if (line) next = std::min(next, line->next_arrival());
  return next;
}

}  // namespace priamos::bus::radio
