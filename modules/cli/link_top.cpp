#include "cli/link_top.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "bus/clock.hpp"
#include "bus/lcm_bus.hpp"
#include "bus/node.hpp"
#include "bus/own_types.hpp"
#include "cli/bus_watch.hpp"
#include "cli/silence_watch.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::cli {
namespace {

constexpr int kBarWidth = 24;
constexpr Duration kStale{3'000'000};
constexpr double kOnceWaits_s = 10;  // two rounds of reports of the largest link

std::string Bar(double share) {
  const int full = std::clamp(static_cast<int>(share * kBarWidth + 0.5), 0, kBarWidth);
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

std::string LinkTopView::Head(Time now) const {
  const link_status_t& s = *last_;
  const bool stale = now - last_at_ > kStale;
  return fmt::format(
      "radio link, {} end: {}\n"
      "  sends {:<4} {}   {} frames, {} bytes, {} cut off, {} event pieces again\n"
      "  hears {:<4} {}   {} frames, {} bytes, {} missed\n",
      s.onboard ? "onboard" : "offboard", StateOf(s, stale), s.onboard ? "up" : "down", Bar(s.utilisation),
      s.frames_sent, s.bytes_sent, s.frames_aborted, s.resent, s.onboard ? "down" : "up",
      Bar(s.utilisation_in), s.frames_received, s.bytes_received, s.frames_missed);
}

std::string LinkTopView::Quality() const {
  const link_status_t& s = *last_;
  const std::string round_trip = s.round_trip_s < 0 ? "-" : fmt::format("{:.3f} s", s.round_trip_s);
  return fmt::format(
      "  round trip {}, delay {:.3f} s, frames lost {:.0f} % here and {:.0f} % there, bit errors {:.1e}\n"
      "  refused: {} malformed, {} wrong code, {} replayed, {} flood; {} not readable\n",
      round_trip, s.latency_s, s.loss * 100, s.peer_loss * 100, s.bit_error_rate, s.rejected_malformed,
      s.rejected_code, s.rejected_replayed, s.rejected_flood, s.undecodable);
}

std::string LinkTopView::Table() const {
  constexpr const char* kRow = "{:<5}{:<24}{:>7}{:>7}{:>9}{:>9}{:>8}{:>8}{:>9}{:>6}{:>7}{:>8}\n";
  std::string text = fmt::format(fmt::runtime(kRow), "", "channel", "msg/s", "B/s", "messages", "replaced",
                                 "expired", "refused", "unwanted", "late", "satur.", "queue s");
  for (const bool outgoing : {true, false})
    for (const auto& [number, row] : rows_) {
      const link_channel_t& c = row.channel;
      if (static_cast<bool>(c.outgoing) != outgoing) continue;
      const bool up = outgoing == static_cast<bool>(last_->onboard);
      text += fmt::format(fmt::runtime(kRow), up ? "up" : "down", c.channel, Rate(row.messages_per_s, 1),
                          Rate(row.bytes_per_s, 0), c.messages, c.replaced, c.expired, c.dropped - c.expired,
                          c.unwanted, c.late, c.saturated, fmt::format("{:.2f}", c.queue_age_s));
    }
  return text;
}

std::string LinkTopView::Render(Time now) const {
  if (!last_) return "no LINK_STATUS yet: is priamos-radio running on this bus?\n";
  return Head(now) + Quality() + Table();
}

int RunLinkTop(const LinkTopOptions& options) {
  const bus::Schema schema = bus::OwnTypes();
  const bus::MonotonicClock clock;
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
  const auto show = [&] {
    const Time now = clock.Now();
    if (options.json) return void(std::cout << view.Json(now).dump() << std::endl);
    std::cout << (options.once ? "" : "\x1b[H\x1b[2J") << view.Render(now) << std::flush;
  };
  const double seconds = options.once ? kOnceWaits_s : options.seconds;
  const Time until = seconds > 0 ? clock.Now() + FromSeconds(seconds) : Time::max();
  Time next = clock.Now();
  Watch(
      bus, clock, until, [&] { return options.once && view.complete(); },
      [&] {
        take();
        if (options.once || clock.Now() < next) return;
        next = clock.Now() + FromSeconds(0.5);
        show();
      });
  if (options.once) show();
  return options.once && view.empty() ? 1 : 0;
}

int RunLinkListen(const LinkTopOptions& options) {
  const bus::Schema schema = bus::OwnTypes();
  const bus::MonotonicClock clock;
  bus::LcmBus bus(options.bus.bus.Url());
  bus::Node node(bus, schema, clock);
  SilenceWatch silence("priamos link listen", options.bus, options.channel, clock.Now(),
                       std::chrono::milliseconds(2500));
  bus.Subscribe(options.channel, [&](std::string_view, std::span<const std::byte>) { silence.Heard(); });
  LinkListener listener(node, {options.channel});
  const Time until = options.seconds > 0 ? clock.Now() + FromSeconds(options.seconds) : Time::max();
  Watch(
      bus, clock, until, [] { return false; },
      [&] {
        listener.Step(clock.Now());
        silence.Step(clock.Now());
      });
  return 0;
}

}  // namespace priamos::cli
