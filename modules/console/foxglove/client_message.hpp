#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "common/outcome.hpp"

namespace priamos::console {

/// What a client of the protocol foxglove.websocket.v1 asks for. It numbers its subscriptions and calls
/// itself; channels and services have the numbers that the server gave them.

/// Longest message of such a client [byte]: it may subscribe to every channel at once.
inline constexpr std::size_t kMaxClientMessage = 65536;

/// Wants the messages of channels.
struct SubscribeRequest {
  /// One channel, and the number under which the client wants its messages.
  struct Wish {
    std::uint32_t subscription = 0, channel = 0;
  };
  std::vector<Wish> wishes;
};

/// Wants them no more.
struct UnsubscribeRequest {
  std::vector<std::uint32_t> subscriptions;
};

/// Calls a service.
struct ServiceRequest {
  std::uint32_t service = 0, call = 0;
  std::string encoding, payload;
};

/// Wants the values of parameters.
struct GetParametersRequest {
  std::vector<std::string> names;  ///< none: of all
  std::string id;                  ///< returned with the answer; may be empty
};

/// A parameter is to have another value.
struct ParameterChange {
  std::string name;
  std::optional<double> value;  ///< nullopt: the client gave something that is no number
};

/// Wants parameters to be changed.
struct SetParametersRequest {
  std::vector<ParameterChange> changes;
  std::string id;  ///< returned with the answer; empty: none is wanted
};

/// Wants to hear of every change of parameters, or no more.
struct WatchParametersRequest {
  std::vector<std::string> names;  ///< none: of all
  bool on = false;
};

/// Something that the protocol knows and this server does not offer.
struct OtherRequest {
  std::string operation;
};

using ClientMessage = std::variant<SubscribeRequest, UnsubscribeRequest, ServiceRequest, GetParametersRequest,
                                   SetParametersRequest, WatchParametersRequest, OtherRequest>;

/// Reads one text message, JSON with an "op".
Outcome<ClientMessage> ReadClientText(std::string_view text);
/// Reads one binary message: its first byte says what it is, numbers are little endian.
Outcome<ClientMessage> ReadClientBytes(std::string_view bytes);

}  // namespace priamos::console
