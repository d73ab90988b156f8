// Connections that are encrypted: the server with a certificate, and clients that are right, old, plain or
// rude.

#include "common/web/web_stream.hpp"

#include <gmock/gmock.h>

#include <memory>
#include <vector>

#include "common/random.hpp"
#include "common/web/tls_files.hpp"
#include "common/web/web_server.hpp"
#include "test/support/temporary_folder.hpp"
#include "test/support/web/self_signed.hpp"
#include "test/support/web/tls_client.hpp"

namespace priamos {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

const WebFiles kFiles{{"/", {"text/html", "<p>page</p>"}}};
constexpr const char* kRequest = "GET / HTTP/1.1\r\nHost: localhost\r\n\r\n";

class SecuredServer : public testing::Test, public WebListener {
 protected:
  SecuredServer() {
    const TemporaryFolder folder;
    WriteSelfSigned(folder / "host.pem", folder / "host.key");
    WebServerOptions options;
    options.tls = LoadTls(folder / "host.pem", folder / "host.key");
    options.camera = "third";
    server_ = std::make_unique<WebServer>(options, kFiles, *this);
    const std::string address = server_->address();
    port_ = std::stoi(address.substr(address.rfind(':') + 1));
  }
  void Turn() { server_->Poll(now_ += std::chrono::milliseconds(1)); }
  std::unique_ptr<WebClient> Line() {
    return std::make_unique<WebClient>(port_, [this] { Turn(); });
  }
  void Joined(std::uint64_t client, const OpenSocket&) override { pages_.push_back(client); }
  bool Said(std::uint64_t, std::string_view text, bool) override {
    said_.emplace_back(text);
    return true;
  }
  void Left(std::uint64_t client) override { std::erase(pages_, client); }

  std::unique_ptr<WebServer> server_;
  int port_ = 0;
  Time now_{std::chrono::seconds(100)};
  std::vector<std::uint64_t> pages_;
  std::vector<std::string> said_;
};

TEST_F(SecuredServer, ServesThePageAndSaysThatItIsWhole) {
  EXPECT_THAT(server_->address(), StartsWith("https://"));
  TlsClient client(Line());
  ASSERT_TRUE(client.Connect());
  client.Say(kRequest);
  const std::string answer = client.HearAll();
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(answer, EndsWith("<p>page</p>"));
  EXPECT_TRUE(client.was_finished());
}

TEST_F(SecuredServer, TalksWithAPageInBothDirections) {
  TlsClient client(Line());
  ASSERT_TRUE(client.Connect());
  client.Say(
      "GET /socket HTTP/1.1\r\nHost: localhost\r\nOrigin: https://localhost\r\nUpgrade: websocket\r\n"
      "Connection: Upgrade\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: "
      "dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n");
  EXPECT_THAT(client.Hear([this](const std::string&) { return !pages_.empty(); }),
              StartsWith("HTTP/1.1 101"));
  ASSERT_THAT(pages_, testing::SizeIs(1));
  client.Say(WebClient::Frame("hello"));
  client.Hear([this](const std::string&) { return !said_.empty(); });
  EXPECT_THAT(said_, testing::ElementsAre("hello"));
  EXPECT_TRUE(server_->Send(pages_[0], std::string(50'000, 'x')));
  const auto whole = [](const std::string& t) { return t.find(std::string(50'000, 'x')) != t.npos; };
  EXPECT_TRUE(whole(client.Hear(whole)));
  client.line().Close();
  for (int i = 0; i < 20; ++i) Turn();
  EXPECT_THAT(pages_, testing::IsEmpty());
}

TEST_F(SecuredServer, GivesPicturesOneAfterTheOther) {
  TlsClient client(Line());
  ASSERT_TRUE(client.Connect());
  for (int i = 1; i <= 3; ++i) {
    const std::string picture(1000, static_cast<char>('0' + i));
    client.Say("GET /third.jpg HTTP/1.1\r\nHost: localhost\r\n\r\n");
    for (int turn = 0; turn < 20; ++turn) Turn();
    server_->ShowPicture(now_, picture);
    EXPECT_THAT(client.Hear([&](const std::string& t) { return t.ends_with(picture); }), EndsWith(picture));
  }
}

TEST_F(SecuredServer, TellsWhoSpeaksPlainly) {
  const auto client = Line();
  client->Say(kRequest);
  const std::string answer = client->HearAll();
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 400"));
  EXPECT_THAT(answer, HasSubstr("expected https://"));
  EXPECT_THAT(answer, testing::Not(HasSubstr("page</p>")));
}

TEST_F(SecuredServer, TakesNoProtocolThatIsBroken) {
  EXPECT_TRUE(TlsClient(Line(), TLS1_2_VERSION).Connect());
  EXPECT_FALSE(TlsClient(Line(), TLS1_1_VERSION).Connect());
}

TEST_F(SecuredServer, OutlivesWhoBeginsAndSaysNoiseOrNothing) {
  Rng random(3);
  std::vector<std::unique_ptr<WebClient>> silent;
  for (int i = 0; i < 60; ++i) {
    std::string noise(1 + random.Below(300), '\0');
    for (char& c : noise) c = static_cast<char>(random.Below(256));
    auto client = Line();
    client->Say(i % 2 == 0 ? "\x16\x03\x01" + noise : "\x16\x03");
    Turn();
    if (i % 2 != 0) silent.push_back(std::move(client));
  }
  TlsClient client(Line());
  ASSERT_TRUE(client.Connect());
  for (int i = 0; i < 6000; ++i) Turn();
  EXPECT_GE(server_->counters().slow, silent.size()) << "who does not shake hands in time is closed";
}

}  // namespace
}  // namespace priamos
