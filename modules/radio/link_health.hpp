#pragma once

#include <cstddef>
#include <string>

#include "bus/context.hpp"
#include "priamos/link_status_t.hpp"

namespace priamos::radio {

/// Health of a radio's process, and why it is not well: a sentence for people, empty when it is.
struct LinkHealth {
  bus::Health health = bus::Health::kOk;
  std::string why;
};

/// Health as the status of the link shows it; the worst that holds. `code_bytes` and `peer_code_bytes`:
/// length of a data frame's code at this end and at the other one.
LinkHealth HealthOf(const link_status_t& status, std::size_t code_bytes, std::size_t peer_code_bytes);

}  // namespace priamos::radio
