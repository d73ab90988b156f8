#include "cli/terminal/silence_watch.hpp"

#include <fmt/format.h>

#include <iostream>
#include <optional>
#include <tuple>
#include <utility>

#include "bus/own_types.hpp"
#include "cli/terminal/topic_statistics.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::cli {
namespace {

/// The other of the two buses of the same robot, as --bus names it.
std::optional<std::string> OtherBus(const bus::BusChoice& choice) {
  for (const char* name : {"onboard", "offboard"}) {
    bus::BusChoice named = choice;
    named.bus = name;
    if (named.Url() == choice.Url()) return named.bus == "onboard" ? "offboard" : "onboard";
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::string> ChannelNames(bool events) {
  std::vector<std::string> names;
  const auto add = [&](const auto& channel) {
    if (!events || channel.rate_hz == 0) names.emplace_back(channel.name);
  };
  std::apply([&](const auto&... channel) { (add(channel), ...); }, channels::kAll);
  return names;
}

/// Counts what is on one bus.
struct SilenceWatch::Ear {
  Ear(std::string its_name, const std::string& url, bus::LcmBus::Messages messages, const bus::Schema& schema)
      : name(std::move(its_name)), bus(url, messages), statistics(schema, std::chrono::seconds(10)) {
    bus.SubscribeEverything([this](std::string_view channel, std::span<const std::byte> bytes) {
      statistics.Add(now, channel, bytes);
    });
  }
  void Drain(Time at) {
    now = at;
    bus.Drain();
  }
  BusSound Sound() const {
    BusSound sound{name, bus.url(), {}};
    for (const TopicRow& row : statistics.Rows(now)) sound.channels.push_back({row.channel, row.rate_hz});
    return sound;
  }

  std::string name;
  bus::LcmBus bus;
  TopicStatistics statistics;
  Time now{};
};

SilenceWatch::SilenceWatch(std::string who, const BusOptions& options, std::string channel, Time now,
                           Duration patience)
    : who_(std::move(who)),
      channel_(std::move(channel)),
      schema_(std::make_unique<bus::Schema>(bus::OwnTypes())),
      until_(now + patience) {
  here_ = std::make_unique<Ear>(options.bus.bus, options.bus.Url(), options.messages(), *schema_);
  if (const auto other = OtherBus(options.bus)) {
    bus::BusChoice choice = options.bus;
    choice.bus = *other;
    other_ = std::make_unique<Ear>(*other, choice.Url(), options.messages(), *schema_);
  }
}

SilenceWatch::~SilenceWatch() = default;

void SilenceWatch::Heard() {
  here_.reset();
  other_.reset();
}

void SilenceWatch::Step(Time now) {
  if (!here_) return;
  here_->Drain(now);
  if (other_) other_->Drain(now);
  if (now >= until_) Explain(now);
}

void SilenceWatch::Explain(Time now) {
  if (!here_) return;
  here_->Drain(now);
  const auto other = other_ ? std::optional(other_->Sound()) : std::nullopt;
  std::cerr << fmt::format(
      "{}: {}\n", who_,
      SilenceText(channel_, here_->Sound(), other, ChannelNames(false), ChannelNames(true)));
  Heard();
}

}  // namespace priamos::cli
