#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/time.hpp"

namespace priamos::console {

/// The name by which the two ends of the WebSocket agree on the protocol. Specification:
/// https://github.com/foxglove/ws-protocol.
inline constexpr std::string_view kFoxgloveProtocol = "foxglove.websocket.v1";

/// A stream of JSON messages that clients may subscribe to.
struct OfferedChannel {
  std::string topic;
  std::string schema_name;  ///< of the type; foxglove.* are the ones that the panels know
  std::string schema;       ///< JSON schema
};

/// Something that clients may have done.
struct OfferedService {
  std::string name;
  std::string request_schema;  ///< JSON schema of what is to be sent
};

/// A parameter that clients may see, and change.
struct ShownParameter {
  std::string name;
  double value = 0;
};

/// Texts of the server.
/// `parameters`: whether it shows parameters.
std::string ServerInfo(std::string_view name, std::string_view session, bool parameters);
/// `channels` with the numbers from `first` on.
std::string AdvertiseText(std::uint32_t first, std::span<const OfferedChannel> channels);
/// `services` with the numbers from 1 on.
std::string AdvertiseServicesText(std::span<const OfferedService> services);
/// `id`: of the request that is answered; empty: none.
std::string ParameterValuesText(std::span<const ShownParameter> parameters, std::string_view id);
/// A sentence for the person at the client.
std::string WarningText(std::string_view sentence);
std::string CallFailureText(std::uint32_t service, std::uint32_t call, std::string_view reason);

/// Binary messages of the server.
std::string MessageBytes(std::uint32_t subscription, Time time, std::string_view payload);
std::string TimeBytes(Time now);
std::string CallAnswerBytes(std::uint32_t service, std::uint32_t call, std::string_view json);

}  // namespace priamos::console
