#include "console/process_orders.hpp"

#include <algorithm>

namespace priamos::console {
namespace {

constexpr std::int64_t kRequestIds = 65535;

process_order_t ToMessage(const ProcessWish& wish, Time now) {
  using enum ProcessWish::Kind;
  process_order_t order{};
  order.utime = ToUtime(now);
  order.request_id = static_cast<std::int32_t>(1 + order.utime / 1000 % kRequestIds);
  order.action = wish.kind == kRestart ? process_order_t::RESTART
                 : wish.kind == kLog   ? process_order_t::LOG
                                       : process_order_t::NEW_WORLD;
  order.name = wish.name;
  order.end_bytes = static_cast<std::int32_t>(wish.end_bytes);
  return order;
}

}  // namespace

void ProcessOrders::Know(const process_state_t& state) {
  if (processes_.size() < kMostKnown) processes_.insert(state.process);
}

void ProcessOrders::Know(const simulation_t& simulation) {
  scenarios_.clear();
  for (const scenario_offer_t& offer : simulation.scenarios) scenarios_.insert(offer.name);
}

bool ProcessOrders::Wish(const ProcessWish& wish) {
  const auto& known = wish.kind == ProcessWish::Kind::kNewWorld ? scenarios_ : processes_;
  if (!known.contains(wish.name)) return false;
  const auto same = std::find_if(waiting_.begin(), waiting_.end(), [&](const ProcessWish& other) {
    return other.kind == wish.kind && other.name == wish.name;
  });
  if (same != waiting_.end()) {
    *same = wish;
    return true;
  }
  if (waiting_.size() >= kMostWaiting) return false;
  waiting_.push_back(wish);
  return true;
}

std::optional<process_order_t> ProcessOrders::Step(Time now) {
  if (const auto again = open_.Step(now)) return again;
  if (open_.open() || waiting_.empty()) return std::nullopt;
  open_.Give(ToMessage(waiting_.front(), now), now);
  waiting_.pop_front();
  return open_.Step(now);
}

ProcessChannels::ProcessChannels(bus::Node& node)
    : states_(node.SubscribeAll(channels::kProcessState)),
      reports_(node.SubscribeAll(channels::kProcessReport)),
      simulation_(node.Subscribe(channels::kSimulation)),
      order_(node.Advertise(channels::kProcessOrder)) {}

void ProcessChannels::Tick(Time now) {
  for (const process_state_t& state : states_.Drain()) orders_.Know(state);
  if (const auto simulation = simulation_.Take()) orders_.Know(*simulation);
  for (const process_report_t& report : reports_.Drain()) orders_.Answered(report);
  if (const auto order = orders_.Step(now)) order_.Publish(*order);
}

}  // namespace priamos::console
