#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "console/foxglove/client_message.hpp"
#include "console/foxglove/server_message.hpp"

namespace priamos::console {

/// Who of the Foxglove clients has subscribed to what, and what they are sent. Pure: what is to be sent goes
/// to a function, and what is called is answered by one.
class Desk {
 public:
  using Client = std::uint64_t;
  /// Sends text or bytes; false when the client takes no more.
  using Sink = std::function<bool(Client, std::string message, bool binary)>;
  /// Does what a call of the service of this number asks for; returns why not, nullopt when it is done.
  using Doer = std::function<std::optional<Refusal>(Client, std::uint32_t service, std::string_view json)>;
  /// What a subscription, or its end, changes: a client now wants messages of these channels, or does not.
  using Watcher = std::function<void(Client, std::uint32_t channel, bool on)>;

  /// A client's subscriptions beyond this many are refused.
  static constexpr std::size_t kMostSubscriptions = 1000;

  Desk(std::string name, std::string session, Sink sink)
      : name_(std::move(name)), session_(std::move(session)), sink_(std::move(sink)) {}

  /// What a client asks for of parameters.
  using ParameterRequest = std::variant<GetParametersRequest, SetParametersRequest, WatchParametersRequest>;
  using ParameterClerk = std::function<void(Client, const ParameterRequest&)>;

  void set_services(std::vector<OfferedService> services, Doer doer);
  /// Offers parameters: who asks for some is handed to `clerk`.
  void set_parameters(ParameterClerk clerk) { clerk_ = std::move(clerk); }
  void set_watcher(Watcher watcher) { watcher_ = std::move(watcher); }
  /// Offers a channel to all clients; its number.
  std::uint32_t Offer(OfferedChannel channel);

  void Join(Client client);
  void Leave(Client client);
  /// What a client said, in a text or in bytes; the reason when it must be cut off.
  std::optional<Refusal> Take(Client client, std::string_view message, bool binary);

  bool IsWanted(std::uint32_t channel) const;
  /// Sends a message to everybody who has subscribed to its channel.
  void Publish(std::uint32_t channel, Time time, std::string_view json);
  /// Sends a message to one client, which has subscribed just now.
  void Publish(Client client, std::uint32_t channel, Time time, std::string_view json);
  void TellTime(Time now);
  /// Values of parameters for one client; `id` of the request that they answer, empty: of none.
  void SendParameters(Client client, std::span<const ShownParameter> parameters, std::string_view id) {
    Send(client, ParameterValuesText(parameters, id), false);
  }
  /// A sentence for the person at the client.
  void Warn(Client client, std::string_view sentence) { Send(client, WarningText(sentence), false); }

  std::size_t clients() const { return subscriptions_.size(); }
  /// Messages that clients were too slow to take.
  std::uint64_t dropped() const { return dropped_; }

 private:
  std::optional<Refusal> Take(Client client, const SubscribeRequest& request);
  std::optional<Refusal> Take(Client client, const UnsubscribeRequest& request);
  std::optional<Refusal> Take(Client client, const ServiceRequest& request);
  std::optional<Refusal> Take(Client client, const GetParametersRequest& request);
  std::optional<Refusal> Take(Client client, const SetParametersRequest& request);
  std::optional<Refusal> Take(Client client, const WatchParametersRequest& request);
  std::optional<Refusal> Take(Client client, const OtherRequest& request);
  std::optional<Refusal> HandOver(Client client, const ParameterRequest& request);
  bool Watches(Client client, std::uint32_t channel) const;
  void Send(Client client, std::string message, bool binary);

  std::string name_, session_;
  Sink sink_;
  Doer doer_;
  Watcher watcher_;
  ParameterClerk clerk_;
  std::vector<OfferedChannel> channels_;  ///< number 1 is the first
  std::vector<OfferedService> services_;
  std::map<Client, std::map<std::uint32_t, std::uint32_t>> subscriptions_;  ///< subscription -> channel
  std::uint64_t dropped_ = 0;
};

}  // namespace priamos::console
