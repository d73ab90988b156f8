#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "common/pilot/stick.hpp"

/// The serial protocol of the Magellan / SPACE MOUSE: lines of ASCII that end with a carriage return.
///
///     vQ        asks for the version; the answer begins with v
///     m3        motion and keys, please; the mouse echoes it
///     d + 24    six values of four nibbles each, offset 0x8000: x right, y up, z towards the operator, and
///               the turns about them
///     k + 3     keys, four per nibble
///
/// Each nibble is sent as the character 0x30 + nibble. While the cap is deflected the mouse keeps sending.
namespace priamos::teleop {

/// One packet of a mouse: raw values as on the line.
struct MagellanPacket {
  std::optional<std::array<int, 6>> motion{};
  std::optional<std::uint32_t> keys{};
};

/// Cuts a stream into packets. Bytes that are no packet are skipped and counted.
class MagellanParser {
 public:
  /// Takes the next byte; returns the packet that ends with it, nullopt if none does.
  std::optional<MagellanPacket> Add(char byte);
  int skipped() const { return skipped_; }

 private:
  std::string line_;
  int skipped_ = 0;
};

/// The packets for a stick, `full_scale` counts at full deflection.
std::string MagellanMotion(const Stick& stick, int full_scale);
std::string MagellanKeys(std::uint32_t buttons);

/// Puts raw values x right, y up, z towards the operator, and turns about them, into the stick's axes.
std::array<double, kAxes> StickAxes(const std::array<int, 6>& raw, int full_scale);

}  // namespace priamos::teleop
