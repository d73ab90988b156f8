#include "radio/estop_rule.hpp"

#include <algorithm>

#include "bus/wire/typed_message.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::radio {
namespace {

/// `@range` of estop_t.driver.
constexpr std::int8_t kLastDriver = 3;

}  // namespace

std::optional<std::vector<std::byte>> StopToSend(std::span<const std::byte> encoded) {
  estop_t stop;
  if (stop.decode(encoded.data(), 0, static_cast<int>(encoded.size())) < 0) return std::nullopt;
  if (stop.action != estop_t::STOP) return std::nullopt;
  stop.driver = std::clamp<std::int8_t>(stop.driver, 0, kLastDriver);
  return bus::Encode(stop);
}

}  // namespace priamos::radio
