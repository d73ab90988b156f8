#pragma once

#include <cstdint>
#include <string_view>

#include "common/web/web_request.hpp"

namespace priamos {

/// What was refused since the start.
struct WebCounters {
  std::uint64_t requests = 0;  ///< wrong path, method, origin, token, or no HTTP
  std::uint64_t messages = 0;  ///< pages cut off for what they sent
  std::uint64_t crowded = 0;   ///< connections closed because there were too many
  std::uint64_t slow = 0;      ///< connections closed because nothing came or went
};

/// Who wants to know what pages do. Called from WebServer::Poll only.
class WebListener {
 public:
  virtual ~WebListener() = default;
  virtual void Joined(std::uint64_t client, const OpenSocket& socket) = 0;
  /// One message of a client; false cuts it off. Pages speak text alone, others are `binary` too.
  virtual bool Said(std::uint64_t client, std::string_view message, bool binary) = 0;
  virtual void Left(std::uint64_t client) = 0;
};

}  // namespace priamos
