#include "radio/link_health.hpp"

#include <fmt/format.h>

namespace priamos::radio {

LinkHealth HealthOf(const link_status_t& status, std::size_t code_bytes, std::size_t peer_code_bytes) {
  if (status.table_mismatch && peer_code_bytes != code_bytes)
    return {bus::Health::kFailed,
            fmt::format("the other end has codes of {} bytes, this one of {}: set code_bytes alike "
                        "in both link.toml",
                        peer_code_bytes, code_bytes)};
  if (status.table_mismatch)
    return {bus::Health::kFailed, "the other end has another channel table: compare link.toml and lcmtypes"};
  if (status.alarm) return {bus::Health::kDegraded, "frames arrive that the other end did not send"};
  if (!status.up) return {bus::Health::kDegraded, "nothing is heard from the other end"};
  return {};
}

}  // namespace priamos::radio
