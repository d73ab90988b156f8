// Pictures from a server to a client, over real sockets of the loopback and in simulated time.

#include "common/web/picture_client.hpp"

#include <gmock/gmock.h>

#include "common/web/web_server.hpp"
#include "test/support/web/web_client.hpp"

namespace priamos {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

class Pictures : public testing::Test, public WebListener {
 protected:
  Pictures() { Start(""); }

  void Start(const std::string& token) {
    WebServerOptions options;
    options.camera = "olga/third";
    if (!token.empty()) options.access.holders = {{Role::kViewer, token}};
    server_ = std::make_unique<WebServer>(options, files_, *this);
    const std::string address = server_->address();
    from_ = *ReadPictureAddress(address.substr(0, address.size() - 1));
    from_.target = "/olga/third.jpg";
  }
  void Turn() { server_->Poll(now_ += Duration(1000)); }
  /// Polls both ends until something came, or for so many steps.
  std::optional<FetchedPicture> Fetch(PictureClient& client, int most_steps = 2000) {
    std::optional<FetchedPicture> picture;
    for (int i = 0; i < most_steps && !(picture = client.Take()); ++i) {
      Turn();
      client.Poll(true, now_);
    }
    return picture;
  }
  std::string Ask(const std::string& target, const std::string& more = "") {
    WebClient client(std::stoi(from_.port), [this] { Turn(); });
    client.Say("GET " + target + " HTTP/1.1\r\nHost: " + from_.authority + "\r\n" + more + "\r\n");
    return client.HearAll();
  }

  void Joined(std::uint64_t, const OpenSocket&) override {}
  bool Said(std::uint64_t, std::string_view, bool) override { return false; }
  void Left(std::uint64_t) override {}

  const WebFiles files_;
  Time now_{std::chrono::seconds(100)};
  std::unique_ptr<WebServer> server_;
  PictureAddress from_;
};

TEST_F(Pictures, ComeOneAfterTheOtherWithTheirAge) {
  PictureClient client(from_);
  EXPECT_FALSE(Fetch(client, 200)) << "there was none yet";
  EXPECT_TRUE(server_->is_watched());
  const Time first = now_ - FromSeconds(0.2);
  server_->ShowPicture(first, "JPEG one");
  const auto one = Fetch(client);
  ASSERT_TRUE(one);
  EXPECT_EQ(one->jpeg, "JPEG one");
  EXPECT_LE(one->exposed, first + Duration(1000)) << "never younger than it is";
  EXPECT_NEAR(Seconds(now_ - one->exposed), Seconds(now_ - first), 0.1);
  EXPECT_FALSE(Fetch(client, 100)) << "the same one is not sent twice";
  server_->ShowPicture(now_, std::string(300'000, 'x'));
  const auto two = Fetch(client);
  ASSERT_TRUE(two);
  EXPECT_EQ(two->jpeg.size(), 300'000u);
}

TEST_F(Pictures, NobodyLooksAnyMore) {
  PictureClient client(from_);
  server_->ShowPicture(now_, "JPEG");
  Fetch(client, 100);
  client.Poll(false, now_);
  for (int i = 0; i < 3500; ++i) Turn();
  EXPECT_FALSE(server_->is_watched());
}

TEST_F(Pictures, WhoseHostIsSilentSaysWhy) {
  PictureClient client(from_);
  EXPECT_FALSE(Fetch(client, 6000));  // the camera gives none: the server says so
  EXPECT_THAT(client.problem(), HasSubstr("503"));
  server_.reset();
  PictureClient other(from_);
  for (int i = 0; i < 2000 && other.problem().empty(); ++i) other.Poll(true, now_ += Duration(1000));
  EXPECT_THAT(other.problem(), HasSubstr("refused"));
  other.Poll(false, now_);
  EXPECT_THAT(other.problem(), IsEmpty()) << "nobody looks";
}

TEST_F(Pictures, OfAnotherRobotAreNotShown) {
  from_.target = "/berta/third.jpg";
  PictureClient client(from_);
  server_->ShowPicture(now_, "JPEG");
  EXPECT_FALSE(Fetch(client, 300));
  EXPECT_THAT(client.problem(), HasSubstr("404"));
}

TEST_F(Pictures, NeedTheToken) {
  Start("viewer-token-0123456");
  PictureClient stranger(from_);
  EXPECT_FALSE(Fetch(stranger, 300));
  EXPECT_THAT(stranger.problem(), HasSubstr("401"));
  from_.target += "?token=viewer-token-0123456";
  PictureClient friendly(from_);
  Fetch(friendly, 300);
  EXPECT_THAT(friendly.problem(), IsEmpty());
  server_->ShowPicture(now_, "JPEG");
  EXPECT_TRUE(Fetch(friendly));
}

TEST_F(Pictures, AreAStreamForWhoeverWants) {
  WebClient viewer(std::stoi(from_.port), [this] { Turn(); });
  viewer.Say("GET /olga/third.mjpeg HTTP/1.1\r\nHost: " + from_.authority + "\r\n\r\n");
  const auto has = [](const char* what) {
    return [what](const std::string& text) { return text.find(what) != std::string::npos; };
  };
  EXPECT_THAT(viewer.Hear(has("\r\n\r\n")), HasSubstr("multipart/x-mixed-replace; boundary=picture"));
  server_->ShowPicture(now_, "JPEG one");
  EXPECT_THAT(viewer.Hear(has("one\r\n")),
              HasSubstr("--picture\r\nContent-Type: image/jpeg\r\nContent-Length: 8\r\n"));
  server_->ShowPicture(now_, "JPEG two");
  EXPECT_THAT(viewer.Hear(has("two\r\n")), HasSubstr("JPEG two\r\n"));
  viewer.Close();
  for (int i = 0; i < 1500; ++i) Turn();
  EXPECT_FALSE(server_->is_watched()) << "who went away looks no more";
}

TEST_F(Pictures, AreForNoPageOfAnotherOrigin) {
  EXPECT_THAT(Ask("/olga/third.jpg", "Origin: http://evil.example\r\n"), StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(Ask("/olga/third.jpgx"), StartsWith("HTTP/1.1 404"));
  EXPECT_THAT(Ask("/olga/third"), StartsWith("HTTP/1.1 404"));
}

TEST(PictureAddressTest, IsHostAndPort) {
  const auto address = ReadPictureAddress("http://[::1]:8090");
  ASSERT_TRUE(address);
  EXPECT_EQ(address->host, "::1");
  EXPECT_EQ(address->authority, "[::1]:8090");
  EXPECT_TRUE(ReadPictureAddress("http://head.local:80"));
  for (const char* wrong : {"", "head.local:80", "http://head", "http://:80", "http://a:0", "http://a:70000",
                            "https://a:1", "http://a:1/", "http://a b:1", "http://a:1\r\nX: y"})
    EXPECT_FALSE(ReadPictureAddress(wrong)) << wrong;
}

}  // namespace
}  // namespace priamos
