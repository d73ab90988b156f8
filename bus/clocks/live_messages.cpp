#include "bus/clocks/live_messages.hpp"

#include <fmt/format.h>

#include "bus/clocks/log_time.hpp"
#include "bus/wire/typed_message.hpp"
#include "bus/wire/udp_receiver.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::bus {

bool LiveMessages::IsLive(std::uint64_t sender, std::string_view channel, std::span<const std::byte> bytes,
                          Time now) {
  const auto stamp = StampOf(schema_, bytes);
  if (!stamp || *stamp <= now - kNow || *stamp >= now + kNow) return false;
  if (reported_.size() < kMostSenders && reported_.insert(sender).second) ReportOn(sender, channel, bytes);
  return true;
}

void LiveMessages::ReportOn(std::uint64_t sender, std::string_view channel,
                            std::span<const std::byte> bytes) const {
  if (!report_) return;
  const auto health =
      channel == channels::kHealth.name ? DecodeChecked<health_t>(schema_, bytes) : std::nullopt;
  report_(
      fmt::format("{} of {}{} is stamped with the present time: who sends it is live, not of a log that is "
                  "played; not followed",
                  channel, health ? health->process + " at " : "", SenderAddress(sender)));
}

}  // namespace priamos::bus
