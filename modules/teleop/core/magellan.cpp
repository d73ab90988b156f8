#include "teleop/core/magellan.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace priamos::teleop {
namespace {

constexpr std::size_t kLongestLine = 80;
constexpr int kOffset = 0x8000;

bool IsNibble(char c) {
  return (c & 0xf0) == 0x30;
}

std::optional<std::uint32_t> Number(std::string_view nibbles) {
  std::uint32_t value = 0;
  for (const char c : nibbles) {
    if (!IsNibble(c)) return std::nullopt;
    value = value << 4 | (static_cast<std::uint32_t>(c) & 0xf);
  }
  return value;
}

std::optional<MagellanPacket> Motion(std::string_view nibbles) {
  MagellanPacket packet;
  packet.motion.emplace();
  for (std::size_t i = 0; i < kAxes; ++i) {
    const auto value = Number(nibbles.substr(4 * i, 4));
    if (!value) return std::nullopt;
    (*packet.motion)[i] = static_cast<int>(*value) - kOffset;
  }
  return packet;
}

/// The first nibble holds keys 0 to 3, its lowest bit key 0.
std::optional<MagellanPacket> Keys(std::string_view nibbles) {
  MagellanPacket packet;
  packet.keys = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto value = Number(nibbles.substr(i, 1));
    if (!value) return std::nullopt;
    *packet.keys |= *value << (4 * i);
  }
  return packet;
}

char Nibble(std::uint32_t value) {
  return static_cast<char>(0x30 | (value & 0xf));
}

}  // namespace

std::optional<MagellanPacket> MagellanParser::Add(char byte) {
  if (byte != '\r') {
    if (line_.size() < kLongestLine) line_ += byte;
    return std::nullopt;
  }
  const std::string line = std::exchange(line_, {});
  if (line.empty() || line[0] == 'v' || line[0] == 'm') return std::nullopt;
  std::optional<MagellanPacket> packet;
  if (line[0] == 'd' && line.size() == 25) packet = Motion(std::string_view(line).substr(1));
  if (line[0] == 'k' && line.size() == 4) packet = Keys(std::string_view(line).substr(1));
  if (!packet) ++skipped_;
  return packet;
}

std::string MagellanMotion(const Stick& stick, int full_scale) {
  const auto& a = stick.axis;  // forward, left, up, roll, pitch, turn
  const std::array<double, 6> raw{-a[1], a[2], -a[0], -a[4], a[5], -a[3]};
  std::string packet = "d";
  for (const double value : raw) {
    const long counts = std::lround(std::clamp(value, -1.0, 1.0) * full_scale);
    const auto code = static_cast<std::uint32_t>(std::clamp(counts + kOffset, 0L, 0xffffL));
    for (const unsigned shift : {12u, 8u, 4u, 0u}) packet += Nibble(code >> shift);
  }
  return packet + '\r';
}

std::string MagellanKeys(std::uint32_t buttons) {
  return {'k', Nibble(buttons), Nibble(buttons >> 4), Nibble(buttons >> 8), '\r'};
}

std::array<double, kAxes> StickAxes(const std::array<int, 6>& raw, int full_scale) {
  const auto part = [&](int value) { return std::clamp(double(value) / full_scale, -1.0, 1.0); };
  return {part(-raw[2]), part(-raw[0]), part(raw[1]), part(-raw[5]), part(-raw[3]), part(raw[4])};
}

}  // namespace priamos::teleop
