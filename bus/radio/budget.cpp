#include "bus/radio/budget.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "bus/radio/budget_analysis.hpp"
#include "bus/radio/channels/bundle.hpp"
#include "bus/radio/frame/forgery.hpp"
#include "bus/radio/shared_budget.hpp"
#include "common/config.hpp"

namespace priamos::bus::radio {
namespace {

/// For three decimals: a bound that is shown must itself hold.
double RoundedUp(double seconds) {
  return std::ceil(1e3 * seconds - 1e-6) / 1e3;
}

FreshnessProof ProofOf(const LinkChannel& channel, double next_s, const DirectionAnalysis& other,
                       const LinkOptions& options, std::size_t code_bytes) {
  const Duration step = channel.ttl / kOffsetSteps + Duration(1);
  return {.next = FromSeconds(next_s),
          .delay = options.line_delay,
          .ahead = FromSeconds(other.AheadSeconds()),
          .step = step,
          .silence = std::max(Duration::zero(), FromSeconds(other.SilenceSeconds()) - (channel.ttl - step)),
          .reach = EchoReach(options, EchoBytes(options.bytes_per_s), code_bytes),
          .echo_age = FromSeconds(other.SilenceSeconds()) + options.line_delay};
}

void CheckDuty(const DirectionAnalysis& analysis, const LinkOptions& options,
               std::vector<std::string>& problems) {
  if (!options.duty.limited()) return;
  const double longest_s = Seconds(analysis.LongestFrameTime());
  if (longest_s > Seconds(options.duty.longest()))
    problems.push_back(
        fmt::format("{}: expected packets of at most {:.3f} s, of which the "
                    "duty_window_s holds many, "
                    "got {:.3f} s: lower max_bundle_bytes or packet_overhead_s",
                    options.place.Of("duty_cycle"), Seconds(options.duty.longest()), longest_s));
  if (analysis.CreditSeconds() > Seconds(options.duty.credit()))
    problems.push_back(fmt::format(
        "{}: expected urgent messages that take at most {:.3f} s of air at "
        "once, with all "
        "their repetitions, got {:.3f} s: lower their burst, or line_delay_s",
        options.place.Of("duty_cycle"), Seconds(options.duty.credit()), analysis.CreditSeconds()));
}

/// An end that works must not seem to be gone.
void CheckSilence(const DirectionAnalysis& analysis, const LinkOptions& options, const char* direction,
                  std::vector<std::string>& problems) {
  const double longest_s = analysis.LongestSilenceSeconds();
  if (longest_s <= Seconds(options.silence)) return;
  problems.push_back(fmt::format(
      "{}: radio link {}: expected at least {:.3f} s, which can pass between two frames of an end "
      "that works, got {:.3f} s: {}",
      options.place.Of("silence_s"), direction, RoundedUp(longest_s), Seconds(options.silence),
      options.robots > 0 ? "raise it, or lower max_bundle_bytes"
                         : "raise it, or lower keep_alive_s, max_bundle_bytes or a turn"));
}

/// Where the bound can be kept, it bounds the latency as well.
FreshBound FreshBoundOf(const DirectionAnalysis& analysis, const LinkChannel& channel, ChannelBudget& row) {
  FreshBound bound{.least = FromSeconds(analysis.LeastFreshSeconds())};
  const auto beside_s = analysis.FreshBesideUrgent(Seconds(channel.fresh));
  if (bound.least > channel.fresh || !beside_s) return bound;
  bound.beside_urgent = FromSeconds(*beside_s);
  row.worst_latency = std::min(*bound.beside_urgent, row.worst_latency.value_or(Duration::max()));
  return bound;
}

DirectionBudget Analyse(const ChannelTable& table, const LinkOptions& options, PollBounds& polls,
                        Direction direction, std::vector<std::string>& problems) {
  DirectionAnalysis analysis(table, options, direction);
  DirectionAnalysis other(table, options, Opposite(direction));
  if (options.robots > 0) {
    analysis.SetPolled(polls, options.robots);
    other.SetPolled(polls, options.robots);
  }
  analysis.Solve(other, Seconds(options.line_delay));
  CheckDuty(analysis, options, problems);
  CheckSilence(analysis, options, NameOf(direction), problems);
  if (options.robots > 0 && direction == Direction::kDown) {
    polls.busy_cycle = analysis.BesideUrgent(polls.cycle);
    polls.busy_asked = analysis.BesideUrgent(polls.asked);
  }
  DirectionBudget budget;
  budget.direction = direction;
  budget.longest_frame_bytes = analysis.LongestFrameBytes();
  budget.control_bytes_per_s = analysis.ControlBytesPerSecond();
  budget.bytes_per_s = budget.control_bytes_per_s;
  budget.capacity_bytes_per_s = options.bytes_per_s * analysis.share();
  for (const ChannelLoad& load : analysis.loads()) {
    ChannelBudget row;
    row.channel = load.channel;
    row.bits = static_cast<std::size_t>(load.bits);
    row.rate_hz = load.keys / load.period_s;
    row.bytes_per_s = analysis.BytesPerSecond(load);
    row.share = row.bytes_per_s / budget.capacity_bytes_per_s;
    if (std::isfinite(load.latency_s)) row.worst_latency = FromSeconds(load.latency_s);
    const LinkChannel& c = table.at(load.channel);
    if (c.fresh > Duration::zero()) row.fresh = FreshBoundOf(analysis, c, row);
    if (c.channel_class == ChannelClass::kCommand)
      row.proof = ProofOf(c, analysis.NextSeconds(load), other, options, table.code_bytes());
    budget.bytes_per_s += row.bytes_per_s;
    budget.channels.push_back(row);
  }
  budget.utilisation = budget.bytes_per_s / budget.capacity_bytes_per_s;
  return budget;
}

void CheckProof(const LinkChannel& c, const FreshnessProof& proof, const SectionPlace& link,
                std::vector<std::string>& problems) {
  if (proof.echo_age > proof.reach)
    problems.push_back(
        fmt::format("{}: radio channel {}: expected a line_delay_s and a silence of the other end of at most "
                    "{:.3f} s together, "
                    "within which an echo names one frame, got {:.3f} s: lower keep_alive_s, "
                    "max_bundle_bytes or line_delay_s",
                    link.Of("line_delay_s"), c.name, Seconds(proof.reach), Seconds(proof.echo_age)));
  if (proof.age() <= c.ttl) return;
  problems.push_back(fmt::format(
      "{}: expected a ttl_s of at least {:.3f} s, in which a command can be proven fresh, got "
      "{:.6g} s, of which it takes {:.3f} s: {:.3f} s until it is sent, {:.3f} s of line_delay_s, {:.3f} s "
      "written ahead, {:.3f} s of "
      "rounding, {:.3f} s of silence of the other end beyond what can be counted: lower max_bundle_bytes or "
      "keep_alive_s, or measure line_delay_s",
      c.At("ttl_s"), RoundedUp(Seconds(proof.least())), Seconds(c.ttl), RoundedUp(Seconds(proof.age())),
      Seconds(proof.next), Seconds(proof.delay), Seconds(proof.ahead), Seconds(proof.step),
      Seconds(proof.silence)));
}

void CheckLoad(const ChannelTable& table, const DirectionBudget& budget, const SectionPlace& link,
               std::vector<std::string>& problems) {
  if (budget.utilisation <= 1) return;
  ChannelBudget largest;
  for (const ChannelBudget& row : budget.channels)
    if (row.share > largest.share) largest = row;
  const bool channel = largest.share > 0;
  problems.push_back(
      fmt::format("{}: radio link {}: expected at most {:.0f} byte/s, got {:.0f} byte/s: lower a rate_hz, {} "
                  "alone takes {:.0f} byte/s",
                  channel ? table.at(largest.channel).place.Of("rate_hz") : link.Of("baud"),
                  NameOf(budget.direction), budget.capacity_bytes_per_s, budget.bytes_per_s,
                  channel ? table.at(largest.channel).name : "acknowledging",
                  channel ? largest.bytes_per_s : budget.control_bytes_per_s));
}

void CheckDeadline(const LinkChannel& c, const ChannelBudget& row, std::vector<std::string>& problems) {
  if (c.deadline <= Duration::zero() || (row.worst_latency && *row.worst_latency <= c.deadline)) return;
  problems.push_back(fmt::format(
      "{}: expected delivery within its deadline_s of {:.6g} s, got {} in the worst case: give it a "
      "smaller priority number, lower the rate_hz of others, or lower max_bundle_bytes",
      c.At("deadline_s"), Seconds(c.deadline),
      row.worst_latency ? fmt::format("{:.3f} s", RoundedUp(Seconds(*row.worst_latency)))
                        : "no bound at all"));
}

/// A state that is dropped before its turn comes may never arrive. Of a command the proof decides.
void CheckLifetime(const LinkChannel& c, const ChannelBudget& row, std::vector<std::string>& problems) {
  if (c.channel_class != ChannelClass::kState || c.ttl <= Duration::zero()) return;
  if (row.worst_latency && *row.worst_latency <= c.ttl) return;
  const std::string expected =
      row.worst_latency
          ? fmt::format("a ttl_s of at least {:.3f} s, in which a state arrives in the worst case",
                        RoundedUp(Seconds(*row.worst_latency)))
          : "no ttl_s where nothing bounds how long a state waits";
  problems.push_back(
      fmt::format("{}: expected {}, got {:.6g} s: raise it, leave it out for no limit, or give the channel a "
                  "smaller priority number",
                  c.At("ttl_s"), expected, Seconds(c.ttl)));
}

void CheckFresh(const LinkChannel& c, const FreshBound& bound, std::vector<std::string>& problems) {
  if (bound.beside_urgent) return;
  problems.push_back(fmt::format(
      "{}: expected a fresh_s of at least {:.3f} s, in which two full frames, or the longest message between "
      "two of this one, can go, got {:.6g} s: raise it, or lower max_bundle_bytes",
      c.At("fresh_s"), RoundedUp(Seconds(bound.least)), Seconds(c.fresh)));
}

void CheckDirection(const ChannelTable& table, const DirectionBudget& budget, const SectionPlace& link,
                    std::vector<std::string>& problems) {
  CheckLoad(table, budget, link, problems);
  for (const ChannelBudget& row : budget.channels) {
    const LinkChannel& c = table.at(row.channel);
    if (row.proof) CheckProof(c, *row.proof, link, problems);
    if (row.fresh) CheckFresh(c, *row.fresh, problems);
    CheckLifetime(c, row, problems);
    CheckDeadline(c, row, problems);
  }
}

void CheckPackets(const DirectionBudget& budget, const LinkOptions& options,
                  std::vector<std::string>& problems) {
  if (options.packet_bytes == 0 || budget.longest_frame_bytes <= options.packet_bytes) return;
  problems.push_back(
      fmt::format("{}: radio link {}: expected frames of at most {} byte, the mtu_bytes, got {} byte: lower "
                  "max_bundle_bytes, or send the longest messages of class state or command as events, which "
                  "go in segments",
                  options.place.Of("mtu_bytes"), NameOf(budget.direction), options.packet_bytes,
                  budget.longest_frame_bytes));
}

/// In the largest unit of which there is at least one.
std::string FormatLongTime(double seconds) {
  constexpr double kDay_s = 86400, kYear_s = 365.25 * kDay_s;
  if (seconds < kDay_s) return fmt::format("{:.1f} hours", seconds / 3600);
  if (seconds < kYear_s) return fmt::format("{:.0f} days", seconds / kDay_s);
  if (seconds > 1e6 * kYear_s) return "millions of years";
  return fmt::format("{:.0f} years", seconds / kYear_s);
}

std::string FormatRow(const ChannelTable& table, const ChannelBudget& row) {
  constexpr const char* kClasses[] = {"state", "event", "command"};
  const LinkChannel& c = table.at(row.channel);
  const auto seconds = [](Duration d) { return fmt::format("{:.3f}", Seconds(d)); };
  const std::string worst = row.worst_latency ? seconds(*row.worst_latency) : "none";
  const bool has_deadline = c.deadline > Duration::zero();
  const std::string slack =
      has_deadline && row.worst_latency ? seconds(c.deadline - *row.worst_latency) : "-";
  return fmt::format("  {:<24} {:<8} {:>2}{} {:>6} {:>7.2f} {:>8.1f} {:>6.1f} % {:>8} {:>8} {:>8}\n", c.name,
                     kClasses[static_cast<int>(c.channel_class)], c.priority, c.urgent ? "!" : " ", row.bits,
                     row.rate_hz, row.bytes_per_s, 100 * row.share, worst,
                     has_deadline ? seconds(c.deadline) : "-", slack);
}

}  // namespace

/// With the time-to-live T and the other end's silence S: base + T / n + max(0, S - (T - T / n)) <= T, n
/// steps.
Duration FreshnessProof::least() const {
  constexpr double kSteps = static_cast<double>(kOffsetSteps);
  const double base_s = Seconds(next + delay + ahead), silence_s = Seconds(echo_age - delay);
  return FromSeconds(std::max(base_s, (base_s + silence_s) / 2) * kSteps / (kSteps - 1)) + Duration(4);
}

Budget ComputeBudget(const ChannelTable& table, const LinkOptions& options) {
  Budget budget;
  budget.robots = options.robots;
  if (options.robots > 0) {
    budget.polls = PollBoundsOf(table, options);
    budget.problems = SharedProblems(table, options);
  }
  budget.up = Analyse(table, options, budget.polls, Direction::kUp, budget.problems);
  budget.down = Analyse(table, options, budget.polls, Direction::kDown, budget.problems);
  budget.code_bytes = table.code_bytes();
  budget.forgery_s = ForgerySeconds(options.bytes_per_s, table.code_bytes());
  CheckDirection(table, budget.up, options.place, budget.problems);
  CheckDirection(table, budget.down, options.place, budget.problems);
  for (const DirectionBudget* d : {&budget.up, &budget.down}) CheckPackets(*d, options, budget.problems);
  return budget;
}

void RequireBudget(const ChannelTable& table, const LinkOptions& options) {
  const Budget budget = ComputeBudget(table, options);
  if (!budget.problems.empty()) throw ConfigError(budget.problems.front());
}

std::string FormatBudget(const ChannelTable& table, const Budget& budget) {
  std::string text;
  for (const DirectionBudget* d : {&budget.up, &budget.down}) {
    text += fmt::format("{} ({}): {:.0f} of {:.0f} byte/s, {:.0f} % of the line\n", NameOf(d->direction),
                        d->direction == Direction::kUp ? "robot to workstation" : "workstation to robot",
                        d->bytes_per_s, d->capacity_bytes_per_s, 100 * d->utilisation);
    text += fmt::format("  {:<24} {:<8} {:>3} {:>6} {:>7} {:>8} {:>8} {:>8} {:>8} {:>8}\n", "channel",
                        "class", "pri", "bits", "1/s", "byte/s", "share", "worst s", "deadline", "slack");
    for (const ChannelBudget& row : d->channels) text += FormatRow(table, row);
    text += fmt::format("  {:<24} {:>36.1f} {:>6.1f} %\n", "acknowledgements", d->control_bytes_per_s,
                        100 * d->control_bytes_per_s / d->capacity_bytes_per_s);
    for (const ChannelBudget& row : d->channels)
      if (row.fresh && row.fresh->beside_urgent)
        text += fmt::format(
            "  {}: from any moment on, one that is offered after it has left within {:.3f} s and the time "
            "until "
            "it is offered; {:.3f} s beside emergency stops\n",
            table.at(row.channel).name, Seconds(table.at(row.channel).fresh),
            RoundedUp(Seconds(*row.fresh->beside_urgent)));
    for (const ChannelBudget& row : d->channels)
      if (row.proof)
        text += fmt::format("  {}: proven to be at most {:.3f} s old, of a time-to-live of {:.3f} s\n",
                            table.at(row.channel).name, Seconds(row.proof->age()),
                            Seconds(table.at(row.channel).ttl));
  }
  if (budget.robots > 0) text += FormatPollBounds(budget.polls, budget.robots);
  text +=
      fmt::format("codes of {} bytes: of a line full of forged frames, one is accepted within {} with 50 %\n",
                  budget.code_bytes, FormatLongTime(budget.forgery_s));
  return text;
}

}  // namespace priamos::bus::radio
