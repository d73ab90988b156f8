#include "bus/radio/message_receiver.hpp"

#include <algorithm>
#include <utility>

namespace priamos::bus::radio {

MessageReceiver::MessageReceiver(const ChannelTable& table)
    : table_(&table), events_(table.size()), histories_(table.size()), counters_(table.size()) {}

void MessageReceiver::OnState(StateEntry entry, const Arrival& arrival, std::vector<Delivery>& out) {
  const ValueWidths& widths = table_->at(entry.channel).delta;
  MessageHistory& history = histories_[entry.channel];
  bool usable = arrival.newest;
  if (usable && entry.baseline) {
    const auto* baseline = history.Find(BaselineCounter(arrival.counter, *entry.baseline));
    auto whole = baseline != nullptr ? ApplyDelta(widths, baseline->packed, entry.packed) : std::nullopt;
    usable = whole.has_value();
    forget_due_ = forget_due_ || !usable;
    if (usable) entry.packed = std::move(*whole);
  }
  if (!usable) {
    ++counters_[entry.channel].late;
    return;
  }
  if (!widths.empty()) history.Note(arrival.counter, entry.packed);
  Deliver({entry.channel, std::move(entry.packed), arrival.sent_at}, entry.bits, out);
}

void MessageReceiver::OnCommand(CommandEntry entry, const Arrival& arrival, std::vector<Delivery>& out) {
  const Time offered = arrival.echoed.value_or(Time{}) + entry.offset;
  const Time valid_until = offered + table_->at(entry.channel).ttl;
  if (!arrival.newest || !arrival.echoed || valid_until < arrival.now) {
    ++counters_[entry.channel].late;
    return;
  }
  Deliver({entry.channel, std::move(entry.packed), offered, valid_until}, entry.bits, out);
}

bool MessageReceiver::OnEvent(const EventEntry& entry, const Arrival& arrival, std::vector<Delivery>& out) {
  EventReceiver& receiver = events_[entry.channel];
  const bool known = receiver.known();
  auto events = receiver.OnSegment(entry.segment, arrival.sent_at);
  for (EventReceiver::Event& event : events)
    Deliver({entry.channel, std::move(event.packed), event.packed_at}, event.bits, out);
  const bool news = !events.empty() || receiver.known() != known;
  urgent_news_ = urgent_news_ || (news && table_->at(entry.channel).urgent);
  return news;
}

void MessageReceiver::Deliver(Delivery delivery, std::size_t bits, std::vector<Delivery>& out) {
  ++counters_[delivery.channel].delivered;
  counters_[delivery.channel].bits += bits;
  out.push_back(std::move(delivery));
}

void MessageReceiver::OnEpochChanged() {
  for (MessageHistory& history : histories_) history.Clear();
}

void MessageReceiver::ForgetEvents() {
  for (EventReceiver& receiver : events_) receiver.Forget();
}

bool MessageReceiver::AckDue() const {
  return std::any_of(events_.begin(), events_.end(), [](const EventReceiver& r) { return r.ack_due(); });
}

bool MessageReceiver::UrgentAckDue() const {
  for (std::size_t i = 0; i < events_.size(); ++i)
    if (events_[i].ack_due() && table_->at(i).urgent) return true;
  return false;
}

MessageReceiver::Loaded MessageReceiver::Load(BundleBuilder& bundle, bool urgent_only) {
  Loaded loaded{.forget = !urgent_only && std::exchange(forget_due_, false),
                .news = std::exchange(urgent_news_, false),
                .acks = {}};
  if (loaded.forget) bundle.Add(ForgetEntry{});
  for (std::size_t i = 0; i < events_.size(); ++i) {
    if (!events_[i].ack_due() || (urgent_only && !table_->at(i).urgent)) continue;
    if (!bundle.Add(EventAckEntry{i, events_[i].ack()})) break;
    events_[i].set_ack_due(false);
    loaded.acks.push_back(i);
  }
  return loaded;
}

void MessageReceiver::Return(const Loaded& loaded) {
  forget_due_ = forget_due_ || loaded.forget;
  urgent_news_ = urgent_news_ || loaded.news;
  for (const std::size_t channel : loaded.acks) events_[channel].set_ack_due(true);
}

}  // namespace priamos::bus::radio
