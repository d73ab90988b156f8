#include "common/web/token_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "common/input/private_file.hpp"

namespace priamos {
namespace {

constexpr std::size_t kShortest = 16, kLongest = 64;

bool IsToken(const std::string& text) {
  const auto fits = [](unsigned char c) { return std::isalnum(c) != 0 || c == '-' || c == '_'; };
  return text.size() >= kShortest && text.size() <= kLongest && std::all_of(text.begin(), text.end(), fits);
}

void ReadLine(const std::string& line, const std::string& place, WebAccess& access) {
  std::istringstream words(line.substr(0, line.find('#')));
  std::string role, token, more;
  if (!(words >> role)) return;
  const bool known = role == "driver" || role == "viewer";
  if (!known || !(words >> token) || words >> more || !IsToken(token))
    throw std::runtime_error(fmt::format(
        "{}: expected `driver TOKEN` or `viewer TOKEN`, the token {} to {} letters, digits, - and _", place,
        kShortest, kLongest));
  (role == "driver" ? access.driver_token : access.viewer_token) = token;
}

}  // namespace

bool IsLoopback(const std::string& address) {
  return address == "127.0.0.1" || address == "::1";
}

WebAccess LoadAccess(const std::string& address, const std::string& file) {
  WebAccess access;
  access.loopback_only = IsLoopback(address);
  if (file.empty() && !access.loopback_only)
    throw std::runtime_error(
        fmt::format("address {}: expected a token_file, because others than this host reach it; next: "
                    "127.0.0.1 and ssh -L, or a "
                    "token_file",
                    address));
  if (file.empty()) return access;
  std::istringstream in(ReadPrivateFile(file, "tokens"));
  int number = 0;
  for (std::string line; std::getline(in, line);)
    ReadLine(line, fmt::format("{}:{}", file, ++number), access);
  if (access.driver_token.empty() && access.viewer_token.empty())
    throw std::runtime_error(fmt::format("{}: expected at least one token, got none", file));
  if (access.driver_token == access.viewer_token)
    throw std::runtime_error(fmt::format("{}: expected different tokens for driver and viewer", file));
  return access;
}

}  // namespace priamos
