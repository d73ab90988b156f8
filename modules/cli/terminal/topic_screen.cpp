#include "cli/terminal/topic_screen.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "bus/wire/udp_receiver.hpp"

namespace priamos::cli {
namespace {

constexpr int kEndless = std::numeric_limits<int>::max();

TextTable Channels(const std::vector<TopicRow>& rows) {
  const bool damaged =
      std::any_of(rows.begin(), rows.end(), [](const TopicRow& r) { return r.undecodable > 0; });
  // A message that cannot be decoded is trouble; a column of zeros is not worth much.
  TextTable table({{"channel", 100, true},
                   {"type", 20, true},
                   {"rate Hz", 90},
                   {"jitter ms", 40},
                   {"bytes/s", 80},
                   {"age s", 70},
                   {"messages", 50},
                   {"undecodable", damaged ? 95 : 10}});
  for (const TopicRow& r : rows)
    table.Add({r.channel, r.type, fmt::format("{:.2f}", r.rate_hz), fmt::format("{:.2f}", r.jitter_s * 1e3),
               fmt::format("{:.0f}", r.bandwidth_bytes_s), fmt::format("{:.2f}", r.age_s),
               fmt::format("{}", r.messages), fmt::format("{}", r.undecodable)});
  return table;
}

TextTable Senders(const BusLosses& losses) {
  TextTable table({{"sender", 100, true}, {"datagrams", 50}, {"lost", 90}});
  for (const auto& s : losses.senders)
    table.Add({bus::SenderAddress(s.sender), fmt::format("{}", s.datagrams), fmt::format("{}", s.lost)});
  return table;
}

}  // namespace

std::string TopicScreen(const std::vector<TopicRow>& rows, const BusLosses& losses,
                        std::optional<ScreenSize> size) {
  const int columns = size ? size->columns : kEndless;
  const std::string sums =
      Wrapped(fmt::format("lost: {} datagrams; malformed: {}; turned away by the kernel: {}", losses.lost,
                          losses.malformed, losses.turned_away),
              columns);
  if (!size) return Channels(rows).Render() + Senders(losses).Render() + sums;
  const int room = size->rows - Lines(sums), n = static_cast<int>(rows.size()) + 1;
  const int left = room - n;
  // Senders get what the channels leave, and a header alone is of no use.
  const std::string senders = left >= 2 ? Senders(losses).Render({columns, left}) : "";
  return Channels(rows).Render({columns, room - Lines(senders)}) + senders + sums;
}

}  // namespace priamos::cli
