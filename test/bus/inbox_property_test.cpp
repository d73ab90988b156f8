#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "bus/inbox.hpp"
#include "bus/node.hpp"
#include "bus/own_types.hpp"
#include "common/random.hpp"
#include "lcmtypes/channels.hpp"

// What a full inbox keeps: the newest messages, and of a safety channel every act.

namespace priamos::bus {
namespace {

constexpr std::int8_t kStop = estop_t::STOP, kRearm = estop_t::REARM;

struct Order {
  std::int8_t act = 0;
  int number = 0;  ///< in the order of arrival
};

std::int8_t ActOf(const Order& order) {
  return order.act;
}

/// Up to 3000 orders of at most `acts` acts, some of them rare.
std::vector<Order> RandomOrders(int acts) {
  Rng rng(*rc::gen::arbitrary<std::uint32_t>());
  const int count = *rc::gen::inRange(1, 3000);
  const double rare = *rc::gen::element(0.0, 0.9, 0.999);
  std::vector<Order> orders;
  for (int i = 0; i < count; ++i) {
    const int act = rng.Chance(rare) ? 0 : static_cast<int>(rng.Below(static_cast<std::uint64_t>(acts)));
    orders.push_back({static_cast<std::int8_t>(act - 128), i});
  }
  return orders;
}

RC_GTEST_PROP(InboxProperty, OrdinaryChannelKeepsTheNewestInOrderAndCountsTheOthers, ()) {
  const int count = *rc::gen::inRange(0, 2000);
  InboxQueue<Order> dut(nullptr);
  int lost = 0;
  for (int i = 0; i < count; ++i) lost += dut.Add(Time(Duration(i)), {0, i}) == Displaced::kLost;
  const auto kept = dut.TakeAll();
  RC_ASSERT(static_cast<int>(kept.size()) + lost == count);
  RC_ASSERT(kept.size() == std::min<std::size_t>(static_cast<std::size_t>(count), kInboxCapacity));
  for (std::size_t i = 0; i < kept.size(); ++i) {
    RC_ASSERT(kept[i].second.number == lost + static_cast<int>(i));
    RC_ASSERT(kept[i].first == Time(Duration(kept[i].second.number)));
  }
}

RC_GTEST_PROP(InboxProperty, SafetyChannelDeliversTheNewestOfEveryActInOrder, ()) {
  const std::vector<Order> orders = RandomOrders(*rc::gen::inRange(1, 257));
  InboxQueue<Order> dut(ActOf);
  std::map<std::int8_t, int> newest;
  for (const Order& order : orders) {
    RC_ASSERT(dut.Add(Time(), order) != Displaced::kLost);
    newest[order.act] = order.number;
  }
  std::map<std::int8_t, int> delivered;
  int last = -1;
  for (const auto& [arrival, order] : dut.TakeAll()) {
    RC_ASSERT(order.number > last);
    delivered[order.act] = last = order.number;
  }
  RC_ASSERT(delivered == newest);
}

RC_GTEST_PROP(InboxProperty, MemoryStaysBoundedUnderAFloodOfTheSafetyChannel, ()) {
  InboxQueue<Order> dut(ActOf);
  for (const Order& order : RandomOrders(256)) {
    dut.Add(Time(), order);
    RC_ASSERT(dut.size() <= kInboxCapacity);
  }
}

RC_GTEST_PROP(InboxProperty, NothingIsDisplacedFromASafetyInboxThatIsNotFull, ()) {
  std::vector<Order> orders = RandomOrders(2);
  orders.resize(std::min(orders.size(), kInboxCapacity));
  InboxQueue<Order> dut(ActOf);
  for (int round = 0; round < 2; ++round) {  // the second finds the queue as if it were new
    for (const Order& order : orders) RC_ASSERT(dut.Add(Time(), order) == Displaced::kNothing);
    RC_ASSERT(dut.TakeAll().size() == orders.size());
  }
}

class InboxOnABus : public testing::Test {
 protected:
  static estop_t Order(std::int8_t action) {
    estop_t order{};
    order.action = action;
    return order;
  }
  template <class Publisher, class Message>
  void Send(Publisher& publisher, const Message& message, int times) {
    for (int i = 0; i < times; ++i) {
      publisher.Publish(message);
      bus_.Drain();
    }
  }

  Schema schema_ = OwnTypes();
  SimulatedClock clock_{FromUtime(1'000'000)};
  LcmBus bus_{"memq://"};
  Node node_{bus_, schema_, clock_};
};

TEST_F(InboxOnABus, AnEstopBehindThousandsOfOtherOrdersIsDelivered) {
  auto dut = node_.SubscribeAll(channels::kEstop);
  auto publisher = node_.Advertise(channels::kEstop);
  Send(publisher, Order(kRearm), 5000);
  Send(publisher, Order(kStop), 1);
  const auto orders = dut.Drain();
  ASSERT_EQ(orders.size(), kInboxCapacity);
  EXPECT_EQ(orders.back().action, kStop);
  EXPECT_EQ(node_.counters().at("ESTOP").dropped, 0u);
  EXPECT_EQ(node_.counters().at("ESTOP").overwritten, 5001 - kInboxCapacity);
}

TEST_F(InboxOnABus, AnEstopBeforeThousandsOfOtherOrdersIsDeliveredBeforeThem) {
  auto dut = node_.SubscribeAll(channels::kEstop);
  auto publisher = node_.Advertise(channels::kEstop);
  Send(publisher, Order(kStop), 1);
  Send(publisher, Order(kRearm), 5000);
  const auto orders = dut.Drain();
  ASSERT_EQ(orders.size(), kInboxCapacity);
  EXPECT_EQ(orders.front().action, kStop);
}

TEST_F(InboxOnABus, AnOrdinaryInboxSaysWhatItLostAndKeepsTheNewest) {
  auto dut = node_.SubscribeAll(channels::kHealth);
  auto publisher = node_.Advertise(channels::kHealth);
  health_t newest{};
  newest.text = "newest";
  Send(publisher, health_t{}, 300);
  Send(publisher, newest, 1);
  EXPECT_EQ(dut.Drain().back().text, "newest");
  EXPECT_EQ(node_.Totals().dropped, 301 - kInboxCapacity);
  EXPECT_EQ(node_.Problems(), "HEALTH: 45 dropped");
}

}  // namespace
}  // namespace priamos::bus
