#pragma once

#include <optional>

#include "common/time.hpp"

namespace priamos {

/// An order that is sent again until it is answered, because the way to who obeys it may lose it: every
/// second, for 8 s. `Order` has a request_id, by which who obeys it knows a repetition.
template <class Order>
class RepeatedOrder {
 public:
  void Give(const Order& order, Time now) {
    order_ = order;
    given_ = now;
    sent_.reset();
  }
  /// Takes an answer; false when it is not to the order that is open.
  bool Answered(int request_id) {
    if (!order_ || order_->request_id != request_id) return false;
    order_.reset();
    return true;
  }
  bool open() const { return order_.has_value(); }

  /// The order when it is time to send it; nothing after the time in which an answer is waited for.
  std::optional<Order> Step(Time now) {
    if (order_ && now - given_ > kWaited) order_.reset();
    if (!order_ || (sent_ && now - *sent_ < kAgain)) return std::nullopt;
    sent_ = now;
    return order_;
  }

 private:
  static constexpr Duration kAgain = std::chrono::seconds(1), kWaited = std::chrono::seconds(8);

  std::optional<Order> order_;
  Time given_{};
  std::optional<Time> sent_;
};

}  // namespace priamos
