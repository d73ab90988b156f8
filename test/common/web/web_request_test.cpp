#include "common/web/web_request.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace priamos {
namespace {

const WebFiles kFiles{{"/", {"text/html", "page"}}, {"/app.js", {"text/javascript", "script"}}};
const std::string kHost = "localhost:8080", kOrigin = "http://localhost:8080";

WebRequest Get(const std::string& target) {
  return {"GET", target, kHost, "", false};
}
WebRequest Socket(const std::string& origin = kOrigin, const std::string& target = "/socket") {
  return {"GET", target, kHost, origin, true};
}

/// Status of a refusal; 0 for what is served.
int StatusOf(const WebRequest& request, const WebAccess& access = {}) {
  const WebAnswer answer = Answer(request, kFiles, access);
  const auto* refusal = std::get_if<RefuseRequest>(&answer);
  return refusal == nullptr ? 0 : refusal->status;
}

TEST(WebRequest, FilesAreServedByTheirName) {
  const auto page = std::get<ServeFile>(Answer(Get("/"), kFiles, {}));
  EXPECT_EQ(page.file->text, "page");
  EXPECT_FALSE(page.head_only);
  EXPECT_EQ(std::get<ServeFile>(Answer(Get("/?token=abc"), kFiles, {})).file->text, "page");
  WebRequest head = Get("/app.js");
  head.method = "HEAD";
  EXPECT_TRUE(std::get<ServeFile>(Answer(head, kFiles, {})).head_only);
}

TEST(WebRequest, NothingElseIsThere) {
  for (const char* target : {"", "*", "/index", "//", "/../../etc/passwd", "/%2e%2e/", "/app.js/",
                             "http://x/", "/socket/", "/app.js%00"})
    EXPECT_EQ(StatusOf(Get(target)), 404) << target;
  for (const char* method : {"POST", "PUT", "DELETE", "CONNECT", "get", ""}) {
    WebRequest request = Get("/");
    request.method = method;
    EXPECT_EQ(StatusOf(request), 405) << method;
  }
}

TEST(WebRequest, APageOfAnotherOriginGetsNoSocket) {
  EXPECT_EQ(StatusOf(Socket()), 0);
  for (const char* origin : {"", "null", "http://evil.example", "http://localhost:8081", "http://localhost",
                             "http://localhost:8080.evil.example", "file://", "ftp://localhost:8080"})
    EXPECT_EQ(StatusOf(Socket(origin)), 403) << origin;
  EXPECT_EQ(StatusOf(Get("/socket")), 426);
}

TEST(WebRequest, AForeignNameOfThisHostIsRefused) {
  for (const char* host : {"localhost", "127.0.0.1:8080", "[::1]:8080", "localhost:1"}) {
    WebRequest request = Get("/");
    request.host = host;
    EXPECT_EQ(StatusOf(request), 0) << host;
  }
  for (const char* host :
       {"evil.example:8080", "localhost.evil.example", "127.0.0.1.evil.example:8080", "[::2]", ":80"}) {
    WebRequest request = Get("/");
    request.host = host;
    EXPECT_EQ(StatusOf(request), 403) << host;
  }
  WebRequest nobody = Get("/");
  nobody.host = "";
  EXPECT_EQ(StatusOf(nobody), 400);
}

TEST(WebRequest, ATokenTellsDriverFromViewer) {
  const WebAccess access{
      true, {{Role::kDriver, "driver-driver-driver", "ada"}, {Role::kViewer, "viewer-viewer-viewer"}}};
  const auto role = [&](const std::string& token) {
    return std::get<OpenSocket>(Answer(Socket(kOrigin, "/socket?token=" + token), kFiles, access)).role;
  };
  EXPECT_EQ(role("driver-driver-driver"), Role::kDriver);
  EXPECT_EQ(role("viewer-viewer-viewer"), Role::kViewer);
  EXPECT_EQ(
      std::get<OpenSocket>(Answer(Socket(kOrigin, "/socket?token=driver-driver-driver"), kFiles, access)).who,
      "ada");
  for (const char* target :
       {"/socket", "/socket?token=", "/socket?token=driver", "/socket?token=driver-driver-driverX"})
    EXPECT_EQ(StatusOf(Socket(kOrigin, target), access), 401) << target;
  EXPECT_EQ(StatusOf(Get("/"), access), 0) << "the page itself is public";
}

TEST(WebRequest, ATokenForOneRoleOpensNoOther) {
  const WebAccess drivers{true, {{Role::kDriver, "driver-driver-driver"}}};
  EXPECT_EQ(StatusOf(Socket(kOrigin, "/socket?token="), drivers), 401);
  const WebAccess viewers{true, {{Role::kViewer, "viewer-viewer-viewer"}}};
  EXPECT_EQ(StatusOf(Socket(kOrigin, "/socket?token="), viewers), 401);
}

RC_GTEST_PROP(WebRequestProperty, WhateverIsAskedForOnlyTheOwnPageOpensASocket,
              (const std::string& method, const std::string& target, const std::string& host,
               const std::string& origin, bool upgrade)) {
  const WebAnswer answer = Answer({method, target, host, origin, upgrade}, kFiles, {});
  if (!std::holds_alternative<OpenSocket>(answer)) return;
  RC_ASSERT(upgrade && (origin == "http://" + host || origin == "https://" + host));
}

WebRequest FoxgloveSocket(const std::string& origin, const std::string& target = "/") {
  return {"GET", target, kHost, origin, true, "other.v2, foxglove.websocket.v1"};
}

TEST(WebRequest, AProgramOrANamedPageMaySpeakFoxglove) {
  WebAccess access;
  access.foxglove_origins = {"https://app.foxglove.dev", "file://"};
  for (const char* origin : {"", "http://localhost:8080", "https://app.foxglove.dev", "file://"}) {
    for (const char* target : {"/", "/socket"}) {
      const auto socket = std::get<OpenSocket>(Answer(FoxgloveSocket(origin, target), kFiles, access));
      EXPECT_EQ(socket.dialect, Dialect::kFoxglove) << origin;
      EXPECT_EQ(socket.role, Role::kDriver) << origin;
    }
  }
  for (const char* origin :
       {"null", "http://app.foxglove.dev", "https://app.foxglove.dev.evil.example", "file:///"})
    EXPECT_EQ(StatusOf(FoxgloveSocket(origin), access), 403) << origin;
  EXPECT_EQ(StatusOf(FoxgloveSocket("https://app.foxglove.dev")), 403) << "nobody named it";
}

TEST(WebRequest, WhoSpeaksFoxgloveNeedsTheTokenAndTheNameOfThisHostToo) {
  const WebAccess access{
      true, {{Role::kDriver, "driver-driver-driver", "ada"}, {Role::kViewer, "viewer-viewer-viewer"}}};
  EXPECT_EQ(StatusOf(FoxgloveSocket(""), access), 401);
  EXPECT_EQ(
      std::get<OpenSocket>(Answer(FoxgloveSocket("", "/?token=viewer-viewer-viewer"), kFiles, access)).role,
      Role::kViewer);
  WebRequest request = FoxgloveSocket("");
  request.host = "evil.example:8080";
  EXPECT_EQ(StatusOf(request), 403);
}

TEST(WebRequest, AnotherProtocolIsNotFoxglove) {
  for (const char* protocols :
       {"", "foxglove.websocket.v10", "xfoxglove.websocket.v1", ",,", "foxglove.sdk.v1"}) {
    WebRequest request = FoxgloveSocket("", "/socket");
    request.protocols = protocols;
    EXPECT_EQ(StatusOf(request), 403) << protocols << ": a page without an origin";
  }
}

TEST(IsOrigin, IsWhatABrowserSays) {
  for (const char* good : {"https://app.foxglove.dev", "http://10.0.0.5:8080", "http://[::1]:80", "file://"})
    EXPECT_TRUE(IsOrigin(good)) << good;
  for (const char* bad :
       {"", "*", "https://*", "https://", "app.foxglove.dev", "https://a.b/", "null", "file:///x"})
    EXPECT_FALSE(IsOrigin(bad)) << bad;
}

}  // namespace
}  // namespace priamos
