// A Magellan on a serial port, without a daemon: what lockstep plays, too.
#include <array>
#include <span>
#include <string_view>

#include "common/serial_port.hpp"
#include "teleop/core/magellan.hpp"
#include "teleop/device.hpp"

namespace priamos::teleop {
namespace {

constexpr int kBaud = 9600;
constexpr Duration kAskAgain = std::chrono::seconds(2);

class SerialMouse : public StickDevice {
 public:
  SerialMouse(const SpaceMouseConfig& config, bus::Context& context)
      : config_(config), port_(context.OpenSerial(config.port, kBaud)) {}

  Stick Poll(Time now) override {
    if (!stick_.connected && now >= next_try_) {
      next_try_ = now + kAskAgain;
      Write("\rvQ\rm3\r");
    }
    std::array<std::byte, 256> bytes;
    while (const std::size_t n = port_->Read(bytes))
      for (const std::byte b : std::span(bytes).first(n))
        if (const auto packet = parser_.Add(static_cast<char>(b))) Take(*packet, now);
    return stick_;
  }
  std::string Describe() const override {
    return stick_.connected ? "Magellan on " + config_.port : "Magellan: no word from " + config_.port;
  }

 private:
  void Write(std::string_view text) { port_->Write(std::as_bytes(std::span(text))); }
  void Take(const MagellanPacket& packet, Time now) {
    stick_.connected = true;
    stick_.heard = now;
    if (packet.motion) stick_.axis = StickAxes(*packet.motion, config_.full_scale);
    if (packet.keys) stick_.buttons = *packet.keys;
  }

  SpaceMouseConfig config_;
  std::unique_ptr<ByteStream> port_;
  MagellanParser parser_;
  Time next_try_{};
  Stick stick_;
};

}  // namespace

std::unique_ptr<StickDevice> MakeSerialMouse(const SpaceMouseConfig& config, bus::Context& context) {
  return std::make_unique<SerialMouse>(config, context);
}

}  // namespace priamos::teleop
