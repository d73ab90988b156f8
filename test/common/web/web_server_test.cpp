// The server on real sockets of the loopback: what browsers do, and what nobody should.

#include "common/web/web_server.hpp"

#include <gmock/gmock.h>

#include <memory>

#include "common/random.hpp"
#include "test/support/thrown_reason.hpp"
#include "test/support/web/web_client.hpp"

namespace priamos {
namespace {

using support::ThrownReason;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kPing("\x89\0", 2), kPong = WebClient::Frame("", 0x8a);
const WebFiles kFiles{{"/", {"text/html", "<p>page</p>"}}};

class WebServerTest : public testing::Test, public WebListener {
 protected:
  WebServerTest() { Start({}); }

  void Start(WebServerOptions options) {
    options.port = 0;
    server_ = std::make_unique<WebServer>(options, kFiles, *this);
    const std::string address = server_->address();
    host_ = address.substr(7, address.size() - 8);
    port_ = std::stoi(address.substr(address.rfind(':') + 1));
  }
  void Turn() { server_->Poll(now_ += Duration(step_us_)); }
  void Turn(double seconds) {
    for (const Time end = now_ + FromSeconds(seconds); now_ < end;) Turn();
  }
  std::unique_ptr<WebClient> Client() {
    return std::make_unique<WebClient>(port_, [this] { Turn(); });
  }
  std::unique_ptr<WebClient> Page() {
    auto client = Client();
    EXPECT_TRUE(client->Upgrade("http://" + host_, "/socket", host_));
    return client;
  }
  std::string Answer(const std::string& request) {
    const auto client = Client();
    client->Say(request);
    return client->HearAll();
  }

  void Joined(std::uint64_t client, const OpenSocket& socket) override {
    pages_.push_back(client);
    dialect_ = socket.dialect;
    who_ = socket.who + " from " + socket.from;
  }
  bool Said(std::uint64_t, std::string_view text, bool binary) override {
    said_.emplace_back(binary ? "binary: " + std::string(text) : text);
    return text != "rude";
  }
  void Left(std::uint64_t client) override { std::erase(pages_, client); }

  std::unique_ptr<WebServer> server_;
  std::string host_;
  int port_ = 0;
  std::int64_t step_us_ = 1000;
  Time now_{std::chrono::seconds(100)};
  std::vector<std::uint64_t> pages_;
  std::vector<std::string> said_;
  Dialect dialect_ = Dialect::kPage;
  std::string who_;
};

TEST_F(WebServerTest, ServesThePageOnce) {
  const std::string answer = Answer("GET / HTTP/1.1\r\nHost: " + host_ + "\r\n\r\n");
  EXPECT_THAT(answer, testing::StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(answer, HasSubstr("Content-Security-Policy: default-src 'none'"));
  EXPECT_THAT(answer, testing::EndsWith("\r\n\r\n<p>page</p>"));
  EXPECT_THAT(Answer("GET /../x HTTP/1.1\r\nHost: " + host_ + "\r\n\r\n"), HasSubstr("404"));
  EXPECT_EQ(server_->counters().requests, 1u);
}

TEST_F(WebServerTest, TakesNoHostThatIsThereTwice) {
  const std::string host = "Host: " + host_ + "\r\n";
  EXPECT_THAT(Answer("GET / HTTP/1.1\r\n" + host + "Host: evil.example\r\n\r\n"),
              testing::StartsWith("HTTP/1.1 400"));
  EXPECT_THAT(Answer("GET / HTTP/1.1\r\nHost: " + host_ + "@evil.example\r\n\r\n"),
              testing::StartsWith("HTTP/1.1 400"));
  EXPECT_FALSE(Client()->Upgrade("http://" + host_, "/socket", host_, "Origin: http://evil.example\r\n"));
}

TEST_F(WebServerTest, TalksWithAPageInBothDirections) {
  const auto page = Page();
  ASSERT_THAT(pages_, testing::SizeIs(1));
  page->Say(WebClient::Frame("hello"));
  Turn(0.05);
  EXPECT_THAT(said_, ElementsAre("hello"));
  EXPECT_TRUE(server_->Send(pages_[0], std::string(300, 'x')));
  const std::string heard = page->Hear([](const std::string& t) { return t.size() >= 306; });
  EXPECT_THAT(heard, testing::EndsWith(std::string(300, 'x') + kPing));
  page->Close();
  Turn(0.05);
  EXPECT_THAT(pages_, IsEmpty());
  EXPECT_FALSE(server_->Send(1, "nobody"));
  EXPECT_EQ(server_->counters().messages, 0u) << "to leave is no fault";
}

TEST_F(WebServerTest, KnowsWhoJoinedByTheTokenAndFromWhere) {
  Page();
  EXPECT_EQ(who_, " from 127.0.0.1");
  WebServerOptions options;
  options.access.holders = {{Role::kDriver, "abcdefghijklmnop", "ada"}};
  Start(options);
  EXPECT_TRUE(Client()->Upgrade("http://" + host_, "/socket?token=abcdefghijklmnop", host_));
  EXPECT_EQ(who_, "ada from 127.0.0.1");
}

TEST_F(WebServerTest, WhoAnswersPingsGetsTheNextMessageWhenHeHasTheLast) {
  const auto page = Page();
  const auto send = [&] { return server_->Send(pages_[0], "news"); };
  EXPECT_TRUE(send());
  Turn(0.01);
  EXPECT_TRUE(send()) << "who answers no pings at all is not waited for";
  page->Say(kPong);
  Turn(0.01);
  EXPECT_TRUE(send());
  Turn(0.01);
  EXPECT_FALSE(send()) << "it may still be on the line";
  page->Say(kPong);
  Turn(0.01);
  EXPECT_TRUE(send());
  step_us_ = 100'000;
  Turn(31);
  EXPECT_THAT(pages_, IsEmpty()) << "it is gone";
}

TEST_F(WebServerTest, PagesThatAnswerNothingKeepNobodyOut) {
  WebServerOptions options;
  options.max_sockets = 2;
  Start(options);
  const auto dead = Page(), alive = Page();
  for (const auto id : pages_) EXPECT_TRUE(server_->Send(id, "news"));
  Turn(0.01);
  alive->Say(kPong);
  EXPECT_FALSE(Client()->Upgrade("http://" + host_, "/socket", host_)) << "both may be alive";
  step_us_ = 100'000;
  Turn(6);
  EXPECT_TRUE(Client()->Upgrade("http://" + host_, "/socket", host_));
  dead->HearAll();
  EXPECT_TRUE(dead->ended());
  EXPECT_FALSE(alive->ended());
}

TEST_F(WebServerTest, CutsOffWhoSaysWhatNobodyMaySay) {
  const std::vector<std::string> rude{
      WebClient::Frame("rude"),
      WebClient::Frame(std::string(513, 'x')),
      WebClient::Frame("binary", 0x82),
      WebClient::Frame("\xff\xfe"),
      WebClient::Frame("reserved bits", 0xf1),
      WebClient::Frame(std::string(300, 'x'), 0x01) + WebClient::Frame(std::string(300, 'x'), 0x80),
      std::string("\x81\x05hello", 7),  // not masked
  };
  for (const std::string& frame : rude) {
    const auto page = Page();
    page->Say(frame);
    page->HearAll();
    EXPECT_TRUE(page->ended()) << testing::PrintToString(frame);
    page->Close();
    Turn(0.1);
    EXPECT_THAT(pages_, IsEmpty());
  }
  EXPECT_EQ(server_->counters().messages, rude.size());
}

TEST_F(WebServerTest, SpeaksFoxgloveWithWhoOffersItInTextAndBytesInTheirOrder) {
  const auto client = Client();
  ASSERT_TRUE(client->Upgrade("", "/", host_, "Sec-WebSocket-Protocol: foxglove.websocket.v1\r\n"));
  EXPECT_THAT(client->head(), HasSubstr("Sec-WebSocket-Protocol: foxglove.websocket.v1"));
  EXPECT_EQ(dialect_, Dialect::kFoxglove);
  client->Say(WebClient::Frame(std::string(2000, 'x')));
  client->Say(WebClient::Frame("call", 0x82));
  Turn(0.05);
  EXPECT_THAT(said_, ElementsAre(std::string(2000, 'x'), "binary: call"));
  EXPECT_TRUE(server_->Queue(pages_[0], "text", false));
  EXPECT_TRUE(server_->Queue(pages_[0], "more", true));
  EXPECT_EQ(client->Hear([](const std::string& t) { return t.size() >= 12; }), "\x81\x04text\x82\x04more");
}

TEST_F(WebServerTest, WhatMayWaitForAClientIsBounded) {
  WebServerOptions options;
  options.max_waiting = 1000;
  Start(options);
  const auto page = Page();
  EXPECT_FALSE(server_->Queue(pages_[0], std::string(1001, 'x'), true));
  EXPECT_TRUE(server_->Queue(pages_[0], std::string(600, 'x'), true));
  EXPECT_FALSE(server_->Queue(pages_[0], std::string(600, 'x'), true));
  page->Hear([](const std::string& t) { return t.size() >= 604; });
  EXPECT_TRUE(server_->Queue(pages_[0], std::string(600, 'x'), true));
}

TEST_F(WebServerTest, CutsOffWhoTalksTooMuchAndNobodyElse) {
  const auto page = Page(), quiet = Page();
  for (int i = 0; i < 150; ++i) page->Say(WebClient::Frame("again"));
  Turn(0.2);
  EXPECT_TRUE(page->ended()) << said_.size();
  EXPECT_LE(said_.size(), 130u);
  EXPECT_FALSE(quiet->ended());
  EXPECT_THAT(pages_, testing::SizeIs(1));
}

TEST_F(WebServerTest, RefusesAnotherOriginAndTooManyPages) {
  EXPECT_FALSE(Client()->Upgrade("http://evil.example", "/socket", host_));
  WebServerOptions options;
  options.max_sockets = 2;
  Start(options);
  const auto first = Page(), second = Page();
  EXPECT_FALSE(Client()->Upgrade("http://" + host_, "/socket", host_));
  first->Close();
  Turn(0.05);
  const auto third = Page();
}

TEST_F(WebServerTest, WhoNeverFinishesARequestIsPutOut) {
  std::vector<std::unique_ptr<WebClient>> slow;
  for (int i = 0; i < 10; ++i) {
    slow.push_back(Client());
    slow.back()->Say("GET / HTT");
  }
  Turn(4.8);
  EXPECT_FALSE(slow[0]->ended());
  Turn(0.5);
  for (const auto& client : slow) EXPECT_TRUE(client->ended());
  EXPECT_EQ(server_->counters().slow, 10u);
}

TEST_F(WebServerTest, WhoReadsNothingIsPutOutAndDelaysNobody) {
  const auto deaf = Page(), page = Page();
  const std::string much(1'000'000, 'x');
  int taken = 0;
  for (int i = 0; i < 8000; ++i) {
    taken += server_->Send(pages_[0], much);
    if (i % 100 == 0) server_->Send(pages_[1], "beat");
    Turn();
    if (pages_.size() < 2) break;
    if (i % 10 == 0) page->ended();
  }
  EXPECT_THAT(pages_, testing::SizeIs(1));
  EXPECT_LT(taken, 20);
  EXPECT_EQ(server_->counters().slow, 1u);
}

TEST_F(WebServerTest, AFloodOfConnectionsLeavesThePageItsPlace) {
  const auto page = Page();
  std::vector<std::unique_ptr<WebClient>> flood;
  for (int i = 0; i < 1000; ++i) {
    flood.push_back(Client());
    if (i % 2 == 0) flood.back()->Say("GET /");
    Turn();
    if (flood.size() > 300) flood.erase(flood.begin());
  }
  page->Say(WebClient::Frame("still here"));
  Turn(0.1);
  EXPECT_THAT(said_, ElementsAre("still here"));
  const auto late = Page();
  EXPECT_THAT(pages_, testing::SizeIs(2)) << "who says at once what he wants finds room";
  EXPECT_GT(server_->counters().crowded, 500u);
}

TEST_F(WebServerTest, AnyBytesEndInAnAnswerOrTheEnd) {
  Rng rng = Rng::Stream(7, "bytes");
  for (int i = 0; i < 300; ++i) {
    const auto client = Client();
    std::string bytes = i % 2 == 0 ? "GET / HTTP/1.1\r\nHost: localhost\r\n\r\n" : std::string(200, ' ');
    for (int k = 0; k < 1 + i % 20; ++k) bytes[rng.Below(bytes.size())] = static_cast<char>(rng.Below(256));
    client->Say(bytes);
    Turn(0.002);
  }
  Turn(6);
  EXPECT_THAT(Answer("GET / HTTP/1.1\r\nHost: " + host_ + "\r\n\r\n"), HasSubstr("page"));
}

TEST_F(WebServerTest, RequestsWithABodyOrAnEndlessHeadAreRefused) {
  EXPECT_THAT(Answer("POST / HTTP/1.1\r\nHost: " + host_ + "\r\nContent-Length: 1000000\r\n\r\n"),
              HasSubstr("40"));
  EXPECT_THAT(Answer("GET / HTTP/1.1\r\nHost: " + host_ + "\r\nX: " + std::string(20000, 'x')),
              HasSubstr("400"));
}

TEST_F(WebServerTest, SeveralStationsShareAHost) {
  WebServerOptions options;
  options.port = port_;
  options.ports = 20;
  const WebServer second(options, kFiles, *this);
  EXPECT_NE(second.address(), server_->address());
  options.ports = 1;
  EXPECT_THAT(ThrownReason([&] { WebServer(options, kFiles, *this); }),
              HasSubstr("can be had: Address already in use; next: another port"));
  options.address = "station.example";
  EXPECT_THAT(ThrownReason([&] { WebServer(options, kFiles, *this); }),
              HasSubstr("expected a numeric address"));
}

}  // namespace
}  // namespace priamos
