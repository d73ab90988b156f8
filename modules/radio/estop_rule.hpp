#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace priamos::radio {

/// A message that the radio refuses to send, made one that it sends: an emergency stop with a driver out of
/// range gets the nearest one, because a stop that is not sent is the unsafe side. nullopt for every other
/// message, a REARM above all.
std::optional<std::vector<std::byte>> StopToSend(std::span<const std::byte> encoded);

}  // namespace priamos::radio
