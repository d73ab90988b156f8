#include "bus/clocks/host_clock.hpp"

#include <fmt/format.h>

#include <ctime>

#include "bus/host/host_identity.hpp"

namespace priamos::bus {
namespace {

Duration Read(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return std::chrono::seconds(time.tv_sec) +
         std::chrono::duration_cast<Duration>(std::chrono::nanoseconds(time.tv_nsec));
}

Duration UnixMinusBoot() {
  return Read(CLOCK_REALTIME) - Read(CLOCK_BOOTTIME);
}

}  // namespace

HostClock::HostClock() : HostClock(AgreeOnAnchor(AnchorFolders(), AnchorName(), UnixMinusBoot())) {}

Time HostClock::Now() const {
  return Time(Read(CLOCK_BOOTTIME) + anchor_.unix_minus_boot);
}

std::int32_t HostClock::IdAt(std::string_view address) const {
  return IdentityOf(fmt::format("{} {} {}", AnchorName(), anchor_.unix_minus_boot.count(), address));
}

Duration HostClock::WallAhead() const {
  return UnixMinusBoot() - anchor_.unix_minus_boot;
}

}  // namespace priamos::bus
