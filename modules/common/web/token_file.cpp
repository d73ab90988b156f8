#include "common/web/token_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "common/input/private_file.hpp"

namespace priamos {
namespace {

constexpr std::size_t kShortest = 16, kLongest = 64, kLongestName = 24, kMostHolders = 100;

bool IsWord(const std::string& text, std::size_t shortest, std::size_t longest) {
  const auto fits = [](unsigned char c) { return std::isalnum(c) != 0 || c == '-' || c == '_'; };
  return text.size() >= shortest && text.size() <= longest && std::all_of(text.begin(), text.end(), fits);
}

void ReadLine(const std::string& line, const std::string& place, WebAccess& access) {
  std::istringstream words(line.substr(0, line.find('#')));
  std::string role, token, name, more;
  if (!(words >> role)) return;
  const bool known = role == "driver" || role == "viewer";
  const bool has_token = bool(words >> token) && IsWord(token, kShortest, kLongest);
  const bool has_name = bool(words >> name);
  if (!known || !has_token || (has_name && !IsWord(name, 1, kLongestName)) || words >> more)
    throw std::runtime_error(
        fmt::format("{}: expected `driver TOKEN [NAME]` or `viewer TOKEN [NAME]`, the token {} to {} "
                    "letters, digits, - and _, "
                    "the name at most {}",
                    place, kShortest, kLongest, kLongestName));
  const auto same = [&](const TokenHolder& holder) { return holder.token == token; };
  if (std::any_of(access.holders.begin(), access.holders.end(), same))
    throw std::runtime_error(fmt::format("{}: expected a token that no line before it has", place));
  if (access.holders.size() == kMostHolders)
    throw std::runtime_error(fmt::format("{}: expected at most {} tokens", place, kMostHolders));
  access.holders.push_back({role == "driver" ? Role::kDriver : Role::kViewer, token, name});
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
  if (access.holders.empty())
    throw std::runtime_error(fmt::format("{}: expected at least one token, got none", file));
  return access;
}

}  // namespace priamos
