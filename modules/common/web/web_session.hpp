#pragma once

#include <array>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/span_body.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "common/time.hpp"
#include "common/web/picture_text.hpp"
#include "common/web/web_listener.hpp"
#include "common/web/web_options.hpp"
#include "common/web/web_stream.hpp"

namespace priamos {

/// What the connections of one server share.
struct WebShared {
  const WebServerOptions& options;
  const WebFiles& files;
  WebListener& listener;
  WebCounters counters{};
  int sockets = 0;  ///< open WebSockets
  Time now{};       ///< of the Poll that runs
  WebPicture picture{};
  std::function<bool()> make_room{};  ///< ends a WebSocket that seems dead; false: there is none
  std::optional<Time> watched{};      ///< when somebody looked at pictures last
};

/// One connection: a request, and then a file, a refusal, pictures, or a WebSocket until somebody closes it.
class WebSession : public std::enable_shared_from_this<WebSession> {
 public:
  /// What the connection is used for now.
  enum class Phase { kHead, kReply, kPictures, kSocket, kDone };

  WebSession(WebStream::Socket socket, std::uint64_t id, WebShared& shared);

  void Start();
  /// Sends a message over its WebSocket; false when it has not taken the one before. Each is followed by a
  /// ping: who has ever answered one gets the next message when he has answered the last, so that none waits
  /// in a line that is too thin for all, where nobody could see how old it grows.
  bool Send(std::string message, bool binary);
  /// Sends a message after those that wait; false when too much does.
  bool Queue(std::string message, bool binary);
  /// Sends the newest picture to who looks, has not had it, and has taken the one before.
  void OfferPicture();
  /// Ends it when it is overdue.
  void CheckTime();
  void Close();

  Phase phase() const { return phase_; }
  /// Whether it is a WebSocket whose other end has answered nothing for long.
  bool SeemsDead() const;

 private:
  using Socket = boost::beast::websocket::stream<WebStream>;

  void Secure();
  void ReadHead();
  void OnHead(boost::beast::error_code error);
  void OnHead(const ServeFile& answer);
  void OnHead(const OpenSocket& answer);
  void OnHead(const ServePictures& answer);
  void OnHead(const RefuseRequest& answer);
  void WatchEnd();
  void Ping();
  double UnansweredFor_s() const;
  void WritePicture(std::string head, std::string_view end);
  void Reply(unsigned status, std::string_view type, std::string_view text, bool head_only);
  void Accepted(const OpenSocket& answer);
  void Write();
  void Read();
  void OnMessage(boost::beast::error_code error);
  bool MaySay();
  WebStream& stream() { return socket_.next_layer(); }
  WebStream::Socket& tcp() { return stream().socket(); }

  const std::uint64_t id_;
  WebShared& shared_;
  Socket socket_;
  boost::beast::flat_buffer buffer_;
  std::optional<boost::beast::http::request_parser<boost::beast::http::empty_body>> head_;
  std::optional<boost::beast::http::response<boost::beast::http::span_body<const char>>> reply_;
  std::string refusal_;
  /// Of who looks at pictures.
  struct Looking {
    bool all = false;       ///< not only at the next one
    std::uint64_t had = 0;  ///< number of the picture sent last, or of the newest one when it began
    std::string head{};     ///< what is being sent
    std::shared_ptr<const std::string> jpeg{};
  };
  std::optional<Looking> looking_;
  std::array<char, 64> unwanted_{};  ///< of who looks nothing is expected
  /// A message on its way.
  struct Outgoing {
    std::string bytes;
    bool binary = false;
  };
  std::deque<Outgoing> waiting_;  ///< for the WebSocket; it is sending the first one
  std::size_t waiting_bytes_ = 0;
  Phase phase_ = Phase::kHead;
  Dialect dialect_ = Dialect::kPage;
  bool joined_ = false;
  bool pinging_ = false;  ///< a ping is not answered yet
  bool has_ponged_ = false;
  Time pinged_{};
  Time since_{};          ///< when the connection came, or what is being sent was begun
  double allowance_ = 0;  ///< messages that the page may still send at once
  Time counted_{};
};

}  // namespace priamos
