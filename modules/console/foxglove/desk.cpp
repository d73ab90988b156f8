#include "console/foxglove/desk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace priamos::console {

void Desk::set_services(std::vector<OfferedService> services, Doer doer) {
  services_ = std::move(services);
  doer_ = std::move(doer);
}

std::uint32_t Desk::Offer(OfferedChannel channel) {
  channels_.push_back(std::move(channel));
  const auto id = static_cast<std::uint32_t>(channels_.size());
  for (const auto& [client, wishes] : subscriptions_)
    Send(client, AdvertiseText(id, {&channels_.back(), 1}), false);
  return id;
}

void Desk::Join(Client client) {
  subscriptions_.try_emplace(client);
  Send(client, ServerInfo(name_, session_, static_cast<bool>(clerk_)), false);
  Send(client, AdvertiseText(1, channels_), false);
  if (!services_.empty()) Send(client, AdvertiseServicesText(services_), false);
}

void Desk::Leave(Client client) {
  const auto gone = subscriptions_.extract(client);
  if (gone.empty() || !watcher_) return;
  std::set<std::uint32_t> watched;
  for (const auto& [subscription, channel] : gone.mapped()) watched.insert(channel);
  for (const std::uint32_t channel : watched) watcher_(client, channel, false);
}

std::optional<Refusal> Desk::Take(Client client, std::string_view message, bool binary) {
  if (!subscriptions_.contains(client)) return std::nullopt;
  const auto request = binary ? ReadClientBytes(message) : ReadClientText(message);
  if (!request) return Refusal{request.reason()};
  return std::visit([&](const auto& r) { return Take(client, r); }, *request);
}

std::optional<Refusal> Desk::Take(Client client, const SubscribeRequest& request) {
  auto& wishes = subscriptions_[client];
  for (const auto& wish : request.wishes) {
    if (wish.channel < 1 || wish.channel > channels_.size()) {
      Warn(client, fmt::format("there is no channel {}", wish.channel));
      continue;
    }
    if (wishes.size() >= kMostSubscriptions)
      return Refusal{fmt::format("expected at most {} subscriptions", kMostSubscriptions)};
    const bool watched = Watches(client, wish.channel);
    // A number that is in use stays with its channel, as the protocol has it.
    if (!wishes.try_emplace(wish.subscription, wish.channel).second) continue;
    if (!watched && watcher_) watcher_(client, wish.channel, true);
  }
  return std::nullopt;
}

std::optional<Refusal> Desk::Take(Client client, const UnsubscribeRequest& request) {
  auto& wishes = subscriptions_[client];
  for (const std::uint32_t subscription : request.subscriptions) {
    const auto gone = wishes.extract(subscription);
    if (!gone.empty() && !Watches(client, gone.mapped()) && watcher_) watcher_(client, gone.mapped(), false);
  }
  return std::nullopt;
}

std::optional<Refusal> Desk::Take(Client client, const ServiceRequest& request) {
  const bool known = request.service >= 1 && request.service <= services_.size();
  std::optional<Refusal> refusal = known ? std::nullopt : std::optional(Refusal{"there is no such service"});
  if (!refusal && request.encoding != "json") refusal = Refusal{"expected the encoding json"};
  if (!refusal) refusal = doer_(client, request.service, request.payload);
  if (refusal)
    Send(client, CallFailureText(request.service, request.call, refusal->reason), false);
  else
    Send(client, CallAnswerBytes(request.service, request.call, R"({"done":true})"), true);
  return std::nullopt;
}

std::optional<Refusal> Desk::Take(Client client, const GetParametersRequest& request) {
  return HandOver(client, request);
}
std::optional<Refusal> Desk::Take(Client client, const SetParametersRequest& request) {
  return HandOver(client, request);
}
std::optional<Refusal> Desk::Take(Client client, const WatchParametersRequest& request) {
  return HandOver(client, request);
}

std::optional<Refusal> Desk::HandOver(Client client, const ParameterRequest& request) {
  if (!clerk_) return Take(client, OtherRequest{"parameters"});
  clerk_(client, request);
  return std::nullopt;
}

std::optional<Refusal> Desk::Take(Client client, const OtherRequest& request) {
  Warn(client, fmt::format("this station does not offer {}", request.operation));
  return std::nullopt;
}

bool Desk::Watches(Client client, std::uint32_t channel) const {
  const auto found = subscriptions_.find(client);
  return found != subscriptions_.end() &&
         std::any_of(found->second.begin(), found->second.end(),
                     [&](const auto& wish) { return wish.second == channel; });
}

bool Desk::IsWanted(std::uint32_t channel) const {
  return std::any_of(subscriptions_.begin(), subscriptions_.end(),
                     [&](const auto& client) { return Watches(client.first, channel); });
}

void Desk::Publish(std::uint32_t channel, Time time, std::string_view json) {
  for (const auto& [client, wishes] : subscriptions_) Publish(client, channel, time, json);
}

void Desk::Publish(Client client, std::uint32_t channel, Time time, std::string_view json) {
  const auto found = subscriptions_.find(client);
  if (found == subscriptions_.end()) return;
  for (const auto& [subscription, wanted] : found->second)
    if (wanted == channel) Send(client, MessageBytes(subscription, time, json), true);
}

void Desk::TellTime(Time now) {
  for (const auto& [client, wishes] : subscriptions_) Send(client, TimeBytes(now), true);
}

void Desk::Send(Client client, std::string message, bool binary) {
  if (!sink_(client, std::move(message), binary)) ++dropped_;
}

}  // namespace priamos::console
