#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace priamos {

/// A file of the page, compiled in.
struct WebFile {
  std::string_view type;  ///< MIME
  std::string_view text;
};
/// By target, "/app.js".
using WebFiles = std::map<std::string, WebFile, std::less<>>;

/// What somebody may do who is connected.
enum class Role { kViewer, kDriver };

/// What somebody speaks over a WebSocket.
enum class Dialect {
  kPage,      ///< the page of this server
  kFoxglove,  ///< foxglove.websocket.v1: Foxglove, Lichtblick, programs
};

/// Whether a text can be the origin of a page: `https://app.foxglove.dev`, `http://host:8080`, or `file://`.
/// One with a path, or a pattern, never equals what a browser says.
bool IsOrigin(std::string_view text);

/// Who may connect from elsewhere, and how he is called in what is written down.
struct TokenHolder {
  Role role = Role::kViewer;
  std::string token;
  std::string name{};  ///< empty: it is shared by several
};

/// Who may connect.
struct WebAccess {
  bool loopback_only = true;           ///< names of this machine's loopback alone are taken for the Host
  std::vector<TokenHolder> holders{};  ///< none: nobody needs a token (loopback)
  std::vector<std::string> foxglove_origins{};  ///< foreign pages that may speak kFoxglove
};

/// The parts of a request's head that decide.
struct WebRequest {
  std::string method, target, host, origin;
  bool upgrade = false;     ///< asks for a WebSocket
  std::string protocols{};  ///< that it offers to speak over one, separated by commas
};

/// The answer is a file.
struct ServeFile {
  const WebFile* file = nullptr;
  bool head_only = false;
};
/// The answer is a WebSocket.
struct OpenSocket {
  Role role = Role::kViewer;
  Dialect dialect = Dialect::kPage;
  std::string who{};   ///< name of the token's holder; empty: it has none
  std::string from{};  ///< numeric address of the other end
};
/// The answer is the next picture of the server's camera, or all that come.
struct ServePictures {
  bool all = false;
};
/// The answer is a refusal, with the status of HTTP and a sentence.
struct RefuseRequest {
  int status = 400;
  std::string reason;
};
using WebAnswer = std::variant<ServeFile, OpenSocket, ServePictures, RefuseRequest>;

/// What becomes of a request. A page of another origin gets no socket, nor does one that reached this server
/// by a foreign name (DNS rebinding). The page itself is public, what is
/// below /parameters/ is not; its socket needs the token, as
/// /socket?token=..., when there is one. Who offers foxglove.websocket.v1 gets it at / too; he needs an
/// origin that is named, or none at all, as programs have that are no browser. `camera`: name of the camera
/// whose pictures are at /NAME.jpg and /NAME.mjpeg, with the token, when there is one; empty: there is none.
WebAnswer Answer(const WebRequest& request, const WebFiles& files, const WebAccess& access,
                 std::string_view camera = {});

}  // namespace priamos
