#include "common/web/web_request.hpp"

#include <algorithm>
#include <cctype>

namespace priamos {
namespace {

constexpr std::string_view kSocket = "/socket", kFoxglove = "foxglove.websocket.v1";

/// "localhost:8080" -> "localhost", "[::1]:8080" -> "[::1]".
std::string_view NameOf(std::string_view host) {
  if (host.starts_with('[')) return host.substr(0, host.find(']') + 1);
  return host.substr(0, host.rfind(':'));
}

bool IsLoopback(std::string_view name) {
  return name == "localhost" || name == "127.0.0.1" || name == "[::1]";
}

/// Takes as long for every wrong text of one length.
bool SameSecret(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned char differs = 0;
  for (std::size_t i = 0; i < a.size(); ++i) differs |= static_cast<unsigned char>(a[i] ^ b[i]);
  return differs == 0;
}

std::string_view TokenOf(std::string_view target) {
  constexpr std::string_view kKey = "?token=";
  const auto at = target.find(kKey);
  return at == std::string_view::npos ? "" : target.substr(at + kKey.size());
}

/// Who asks; nullptr when he has no right to. Where nobody needs a token everybody may drive.
const TokenHolder* HolderOf(std::string_view token, const WebAccess& access) {
  static const TokenHolder kAnybody{Role::kDriver, "", ""};
  if (access.holders.empty()) return &kAnybody;
  for (const TokenHolder& holder : access.holders)
    if (SameSecret(token, holder.token)) return &holder;
  return nullptr;
}

/// Whether a list with commas names a protocol.
bool Offers(std::string_view protocols, std::string_view name) {
  while (!protocols.empty()) {
    const auto end = std::min(protocols.find(','), protocols.size());
    std::string_view one = protocols.substr(0, end);
    while (one.starts_with(' ')) one.remove_prefix(1);
    while (one.ends_with(' ')) one.remove_suffix(1);
    if (one == name) return true;
    protocols.remove_prefix(std::min(end + 1, protocols.size()));
  }
  return false;
}

bool IsOwnOrigin(const WebRequest& request) {
  return request.origin == "http://" + request.host || request.origin == "https://" + request.host;
}

bool MaySpeakFoxglove(const WebRequest& request, const WebAccess& access) {
  const auto& named = access.foxglove_origins;
  return request.origin.empty() || IsOwnOrigin(request) ||
         std::find(named.begin(), named.end(), request.origin) != named.end();
}

WebAnswer AnswerSocket(const WebRequest& request, const WebAccess& access, Dialect dialect) {
  if (!request.upgrade) return RefuseRequest{426, "expected a WebSocket"};
  if (dialect == Dialect::kPage && !IsOwnOrigin(request))
    return RefuseRequest{403, "expected the origin of this server's own page"};
  if (dialect == Dialect::kFoxglove && !MaySpeakFoxglove(request, access))
    return RefuseRequest{403, "expected an origin that foxglove_origins of console.toml names"};
  if (const auto* holder = HolderOf(TokenOf(request.target), access))
    return OpenSocket{holder->role, dialect, holder->name};
  return RefuseRequest{401, "expected a token; it is on the station's console: http://.../?token=..."};
}

std::optional<ServePictures> PicturesOf(std::string_view path, std::string_view camera) {
  if (camera.empty() || !path.starts_with('/') || !path.substr(1).starts_with(camera)) return std::nullopt;
  const std::string_view kind = path.substr(1 + camera.size());
  if (kind == ".mjpeg") return ServePictures{true};
  return kind == ".jpg" ? std::optional(ServePictures{false}) : std::nullopt;
}

WebAnswer AnswerPictures(const WebRequest& request, const WebAccess& access, const ServePictures& pictures) {
  if (!request.origin.empty() && !IsOwnOrigin(request))
    return RefuseRequest{403, "expected no page of another origin"};
  if (!HolderOf(TokenOf(request.target), access))
    return RefuseRequest{401, "expected a token: .../?token=..."};
  if (request.method != "GET") return RefuseRequest{405, "expected GET"};
  return pictures;
}

/// Name or address, with a port or without; no user in front of it.
bool IsHost(std::string_view text) {
  const auto fits = [](unsigned char c) {
    return std::isalnum(c) != 0 ||
           std::string_view("-.:[]").find(static_cast<char>(c)) != std::string_view::npos;
  };
  return !text.empty() && std::all_of(text.begin(), text.end(), fits);
}

}  // namespace

bool IsOrigin(std::string_view text) {
  if (text == "file://") return true;
  for (const std::string_view scheme : {"http://", "https://"})
    if (text.starts_with(scheme)) return IsHost(text.substr(scheme.size()));
  return false;
}

WebAnswer Answer(const WebRequest& request, const WebFiles& files, const WebAccess& access,
                 std::string_view camera) {
  if (!IsHost(request.host)) return RefuseRequest{400, "expected a Host"};
  if (access.loopback_only && !IsLoopback(NameOf(request.host)))
    return RefuseRequest{403, "expected localhost or 127.0.0.1 as the address"};
  if (request.method != "GET" && request.method != "HEAD") return RefuseRequest{405, "expected GET"};
  const std::string_view path = std::string_view(request.target).substr(0, request.target.find('?'));
  if (request.upgrade && Offers(request.protocols, kFoxglove) && (path == "/" || path == kSocket))
    return AnswerSocket(request, access, Dialect::kFoxglove);
  if (path == kSocket) return AnswerSocket(request, access, Dialect::kPage);
  if (path.starts_with("/parameters/") && !HolderOf(TokenOf(request.target), access))
    return RefuseRequest{401, "expected a token, as the page needs one"};
  if (const auto pictures = PicturesOf(path, camera)) return AnswerPictures(request, access, *pictures);
  const auto file = files.find(path);
  if (file == files.end()) return RefuseRequest{404, "there is no such page; the station is at /"};
  return ServeFile{&file->second, request.method == "HEAD"};
}

}  // namespace priamos
