#include "cli/terminal/link_top.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <nlohmann/json.hpp>

#include "bus/clocks/host_clock.hpp"
#include "bus/node.hpp"
#include "bus/own_types.hpp"
#include "bus/wire/lcm_bus.hpp"
#include "cli/terminal/bus_watch.hpp"
#include "cli/terminal/link_channels.hpp"
#include "cli/terminal/silence_watch.hpp"
#include "cli/terminal/terminal_screen.hpp"
#include "common/config.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::cli {
namespace {

constexpr int kBarWidth = 24;
constexpr Duration kStale{3'000'000}, kPeriod{500'000};
constexpr Duration kReportsOfAll{4'500'000};  // of the largest link: four, one a second
constexpr double kOnceWaits_s = 10;           // two rounds of reports of the largest link

std::string Bar(double share) {
  const int full = std::clamp(static_cast<int>(std::lround(share * kBarWidth)), 0, kBarWidth);
  return fmt::format("[{:#<{}}{:.<{}}] {:>3.0f} %", "", full, "", kBarWidth - full, share * 100);
}

std::string StateOf(const link_status_t& s, bool stale) {
  if (stale) return "SILENT: is priamos-radio running on this bus?";
  if (s.table_mismatch) return "TABLE MISMATCH: the other end has another link.toml or other types";
  if (s.alarm) return "ALARM: frames arrive that the other end did not send";
  return s.up ? "up" : "DOWN: nothing is heard from the other end";
}

std::string Rate(const std::optional<double>& per_s, int digits) {
  return per_s ? fmt::format("{:.{}f}", *per_s, digits) : "-";
}

}  // namespace

void LinkTopView::Add(const link_status_t& report, Time now) {
  for (int i = 0; i < report.n_channels; ++i) {
    const link_channel_t& channel = report.channels[static_cast<std::size_t>(i)];
    const auto [at, is_new] = rows_.try_emplace(report.first_channel + i);
    Row& row = at->second;
    const double elapsed_s = Seconds(now - row.at);
    // After a restart counters begin anew.
    if (!is_new && elapsed_s > 0 && channel.messages >= row.channel.messages) {
      row.messages_per_s = (channel.messages - row.channel.messages) / elapsed_s;
      row.bytes_per_s = (channel.bytes - row.channel.bytes) / elapsed_s;
    }
    row.channel = channel;
    row.at = now;
  }
  rows_.erase(rows_.lower_bound(report.all_channels), rows_.end());
  last_ = report;
  last_at_ = now;
}

bool LinkTopView::complete() const {
  return last_ && rows_.size() == static_cast<std::size_t>(last_->all_channels) &&
         std::all_of(rows_.begin(), rows_.end(),
                     [](const auto& row) { return row.second.messages_per_s.has_value(); });
}

std::string LinkTopView::Head(Time now, int columns) const {
  const link_status_t& s = *last_;
  const bool stale = now - last_at_ > kStale;
  return Wrapped(fmt::format("radio link, {} end: {}", s.onboard ? "onboard" : "offboard", StateOf(s, stale)),
                 columns) +
         Wrapped(fmt::format("  sends {:<4} {}  {} frames, {} bytes, {} cut off, {} event pieces again",
                             s.onboard ? "up" : "down", Bar(s.utilisation), s.frames_sent, s.bytes_sent,
                             s.frames_aborted, s.resent),
                 columns, 4) +
         Wrapped(fmt::format("  hears {:<4} {}  {} frames, {} bytes, {} missed", s.onboard ? "down" : "up",
                             Bar(s.utilisation_in), s.frames_received, s.bytes_received, s.frames_missed),
                 columns, 4);
}

std::string LinkTopView::Quality(int columns) const {
  const link_status_t& s = *last_;
  const std::string round_trip = s.round_trip_s < 0 ? "-" : fmt::format("{:.3f} s", s.round_trip_s);
  return Wrapped(fmt::format("  round trip {}, delay {:.3f} s, frames lost {:.0f} % here and {:.0f} % there, "
                             "bit errors {:.1e}",
                             round_trip, s.latency_s, s.loss * 100, s.peer_loss * 100, s.bit_error_rate),
                 columns, 4) +
         Wrapped(fmt::format("  refused: {} malformed, {} wrong code, {} replayed, {} flood; {} not readable",
                             s.rejected_malformed, s.rejected_code, s.rejected_replayed, s.rejected_flood,
                             s.undecodable),
                 columns, 4);
}

TextTable LinkTopView::Table() const {
  TextTable table({{"", 100, true},
                   {"channel", 110, true},
                   {"msg/s", 95},
                   {"B/s", 98},
                   {"messages", 40},
                   {"replaced", 50},
                   {"expired", 70},
                   {"refused", 75},
                   {"unwanted", 20},
                   {"late", 80},
                   {"satur.", 60},
                   {"queue s", 90}});
  for (const bool outgoing : {true, false})
    for (const auto& [number, row] : rows_) {
      const link_channel_t& c = row.channel;
      if (static_cast<bool>(c.outgoing) != outgoing) continue;
      const bool up = outgoing == static_cast<bool>(last_->onboard);
      const auto count = [](auto n) { return fmt::format("{}", n); };
      table.Add({up ? "up" : "down", c.channel, Rate(row.messages_per_s, 1), Rate(row.bytes_per_s, 0),
                 count(c.messages), count(c.replaced), count(c.expired), count(c.dropped - c.expired),
                 count(c.unwanted), count(c.late), count(c.saturated), fmt::format("{:.2f}", c.queue_age_s)});
    }
  return table;
}

std::string LinkTopView::Render(Time now, std::optional<ScreenSize> size) const {
  constexpr int kEndless = std::numeric_limits<int>::max();
  const int columns = size ? size->columns : kEndless;
  if (!last_) return Wrapped("no LINK_STATUS yet: is priamos-radio running on this bus?", columns);
  const std::string head = Head(now, columns), quality = Quality(columns);
  if (!size) return head + quality + Table().Render();
  // The table's header, three channels and the count of the others are worth more than the quality.
  const int least = 1 + std::min(4, static_cast<int>(rows_.size()));
  int room = size->rows - Lines(head);
  const bool has_room = room - Lines(quality) >= least;
  if (has_room) room -= Lines(quality);
  return head + (has_room ? quality : "") + Table().Render({columns, room});
}

namespace {

void PrintJson(const LinkTopView& view, Time now) {
  std::cout << view.Json(now).dump() << std::endl;
}

}  // namespace

int RunLinkTop(const LinkTopOptions& options) {
  const bus::Schema schema = bus::OwnTypes();
  const bus::HostClock clock;
  bus::LcmBus bus(options.bus.bus.Url());
  bus::Node node(bus, schema, clock);
  // A radio reports once a second.
  SilenceWatch silence("priamos link top", options.bus, std::string(channels::kLinkStatus.name), clock.Now(),
                       std::chrono::milliseconds(2500));
  auto reports = node.SubscribeAll(channels::kLinkStatus);
  LinkTopView view;
  const auto take = [&] {
    for (const link_status_t& report : reports.Drain()) view.Add(report, clock.Now());
    if (!view.empty()) silence.Heard();
    silence.Step(clock.Now());
  };
  const double seconds = options.once ? kOnceWaits_s : options.seconds;
  const Time until = seconds > 0 ? clock.Now() + FromSeconds(seconds) : Time::max();
  TerminalScreen screen;
  Watch(
      bus, clock, until, [&] { return options.once && view.complete(); },
      [&] {
        take();
        if (options.once || view.empty() || !screen.Due(clock.Now(), kPeriod)) return;
        if (options.json) return PrintJson(view, clock.Now());
        screen.Show(view.Render(clock.Now(), screen.size()));
      });
  if (options.once && options.json) PrintJson(view, clock.Now());
  if (options.once && !options.json) std::cout << view.Render(clock.Now(), TableSize());
  return options.once && view.empty() ? 1 : 0;
}

int RunLinkListen(const LinkTopOptions& options) {
  const bus::Schema schema = bus::OwnTypes();
  const bus::HostClock clock;
  bus::LcmBus bus(options.bus.bus.Url());
  bus::Node node(bus, schema, clock);
  SilenceWatch silence("priamos link listen", options.bus, options.channel, clock.Now(),
                       std::chrono::milliseconds(2500));
  bus.Subscribe(options.channel, [&](std::string_view, std::span<const std::byte>) { silence.Heard(); });
  auto reports = node.SubscribeAll(channels::kLinkStatus);
  LinkListener listener(node, {options.channel});
  LinkChannels known;
  const auto step = [&] {
    for (const link_status_t& report : reports.Drain()) known.Add(report);
    if (const auto why = known.WhyNot(options.channel)) throw ConfigError(*why);
    listener.Step(clock.Now());
    silence.Step(clock.Now());
  };
  const Time until = options.seconds > 0 ? clock.Now() + FromSeconds(options.seconds) : Time::max();
  Watch(
      bus, clock, until, [] { return false; }, step);
  // A short time may end between two reports, before all channels are known.
  if (!known.empty())
    Watch(
        bus, clock, clock.Now() + kReportsOfAll, [&] { return known.complete(); }, step);
  return 0;
}

}  // namespace priamos::cli
