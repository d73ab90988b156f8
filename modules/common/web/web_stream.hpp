#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/beast/websocket/teardown.hpp>
#include <optional>
#include <utility>

namespace priamos {

/// A connection over TCP, plain until it is secured by TLS: a stream as Boost.Beast's operations need one.
/// Its address must not change.
class WebStream {
 public:
  using Socket = boost::asio::ip::tcp::socket;
  using executor_type = Socket::executor_type;

  explicit WebStream(Socket socket) : socket_(std::move(socket)) {}
  WebStream(const WebStream&) = delete;
  WebStream& operator=(const WebStream&) = delete;

  executor_type get_executor() { return socket_.get_executor(); }
  /// For what concerns TCP alone: options, addresses, closing.
  Socket& socket() { return socket_; }
  bool secured() const { return tls_.has_value(); }

  /// Shakes hands as the server; `begun` is what the client has sent of it. Everything after it is encrypted.
  template <class Buffers, class Handler>
  void AsyncSecure(boost::asio::ssl::context& context, const Buffers& begun, Handler&& handler) {
    tls_.emplace(socket_, context);
    tls_->async_handshake(boost::asio::ssl::stream_base::server, begun, std::forward<Handler>(handler));
  }
  /// Tells the other end that nothing more comes, which only TLS has a message for.
  template <class Handler>
  void AsyncFinish(Handler&& handler) {
    if (!tls_) return handler(boost::system::error_code{});
    tls_->async_shutdown(std::forward<Handler>(handler));
  }

  template <class Buffers, class Handler>
  void async_read_some(const Buffers& buffers, Handler&& handler) {
    if (tls_) return tls_->async_read_some(buffers, std::forward<Handler>(handler));
    socket_.async_read_some(buffers, std::forward<Handler>(handler));
  }
  template <class Buffers, class Handler>
  void async_write_some(const Buffers& buffers, Handler&& handler) {
    if (tls_) return tls_->async_write_some(buffers, std::forward<Handler>(handler));
    socket_.async_write_some(buffers, std::forward<Handler>(handler));
  }

 private:
  Socket socket_;
  std::optional<boost::asio::ssl::stream<Socket&>> tls_;
};

/// Ends a WebSocket's connection after its farewell; Beast finds it by its name.
template <class Handler>
void async_teardown(boost::beast::role_type role, WebStream& stream, Handler&& handler) {
  boost::beast::websocket::async_teardown(role, stream.socket(), std::forward<Handler>(handler));
}

/// Closes the connection of a WebSocket that is overdue; Beast finds it by its name.
inline void beast_close_socket(WebStream& stream) {
  boost::system::error_code ignored;
  stream.socket().close(ignored);
}

}  // namespace priamos
