#include "console/parameter_orders.hpp"

#include <algorithm>

namespace priamos::console {
namespace {

std::int8_t ActionOf(ParameterWish::Kind kind) {
  using enum ParameterWish::Kind;
  switch (kind) {
    case kRead:
      return parameter_order_t::READ;
    case kSet:
      return parameter_order_t::SET;
    case kSave:
      return parameter_order_t::SAVE;
    case kReset:
      return parameter_order_t::RESET;
  }
  return parameter_order_t::READ;
}

}  // namespace

void ParameterOrders::Know(const std::string& process, const ParameterTable& table) {
  if (const auto number = bus::ParameterProcess(process))
    known_.insert_or_assign(process, Known{*number, table});
}

bool ParameterOrders::Wish(const ParameterWish& wish) {
  const auto known = known_.find(wish.process);
  if (known == known_.end()) return false;
  if (!wish.key.empty() && known->second.table.NumberOf(wish.key) == 0) return false;
  const auto same = std::find_if(waiting_.begin(), waiting_.end(), [&](const ParameterWish& other) {
    return other.kind == wish.kind && other.process == wish.process && other.key == wish.key;
  });
  if (same != waiting_.end()) {
    *same = wish;
    return true;
  }
  if (waiting_.size() >= kMostWaiting) return false;
  waiting_.push_back(wish);
  return true;
}

std::optional<parameter_order_t> ParameterOrders::Step(Time now) {
  if (const auto again = open_.Step(now)) return again;
  if (open_.open() || waiting_.empty()) return std::nullopt;
  const ParameterWish& wish = waiting_.front();
  const Known& known = known_.at(wish.process);
  const int key = wish.key.empty() ? 0 : known.table.NumberOf(wish.key);
  open_.Give(bus::ToMessage({known.process, ActionOf(wish.kind), key, wish.value}, known.table, now), now);
  waiting_.pop_front();
  return open_.Step(now);
}

}  // namespace priamos::console
