#include "common/web/web_server.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <map>
#include <stdexcept>
#include <utility>

#include "common/web/web_session.hpp"

namespace priamos {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;

/// Most steps of connections within one Poll: a flood waits for the next one.
constexpr int kMostSteps = 400;
/// Between two pictures of somebody who asks for one after the other.
constexpr double kWatched_s = 1;

asio::ip::address AddressOf(const std::string& text) {
  boost::system::error_code error;
  auto address = asio::ip::make_address(text, error);
  if (error)
    throw std::runtime_error(
        fmt::format("address: expected a numeric address of this host, got \"{}\"", text));
  return address;
}

}  // namespace

class WebServer::Impl {
 public:
  Impl(const WebServerOptions& options, const WebFiles& files, WebListener& listener)
      : options_(options), files_(files), shared_{options_, files_, listener}, acceptor_(io_) {
    shared_.make_room = [this] { return EndADeadOne(); };
    Listen(AddressOf(options.address));
    Accept();
  }

  void Poll(Time now) {
    shared_.now = now;
    if (!std::exchange(accepting_, true)) Accept();
    io_.restart();
    for (int i = 0; i < kMostSteps && io_.poll_one() > 0; ++i) {
    }
    for (const auto& [id, session] : sessions_) {
      session->OfferPicture();
      session->CheckTime();
    }
    std::erase_if(sessions_, [](const auto& s) { return s.second->phase() == WebSession::Phase::kDone; });
  }

  bool Send(std::uint64_t client, std::string message, bool binary) {
    const auto session = sessions_.find(client);
    return session != sessions_.end() && session->second->Send(std::move(message), binary);
  }
  bool Queue(std::uint64_t client, std::string message, bool binary) {
    const auto session = sessions_.find(client);
    return session != sessions_.end() && session->second->Queue(std::move(message), binary);
  }

  void ShowPicture(Time exposed, std::string jpeg) {
    WebPicture& picture = shared_.picture;
    picture = {picture.number + 1, exposed, std::make_shared<const std::string>(std::move(jpeg))};
  }
  bool is_watched() const { return shared_.watched && Seconds(shared_.now - *shared_.watched) <= kWatched_s; }

  std::string address() const {
    const auto at = acceptor_.local_endpoint();
    const std::string host = at.address().to_string();
    return fmt::format("{}://{}:{}/", options_.tls ? "https" : "http",
                       at.address().is_v6() ? "[" + host + "]" : host, at.port());
  }
  int sockets() const { return shared_.sockets; }
  const WebCounters& counters() const { return shared_.counters; }

 private:
  void Listen(const asio::ip::address& address) {
    boost::system::error_code error;
    const int ports = options_.port == 0 ? 1 : std::max(1, options_.ports);
    for (int port = options_.port; port < options_.port + ports; ++port) {
      acceptor_.close(error);
      const tcp::endpoint at(address, static_cast<unsigned short>(port));
      acceptor_.open(at.protocol(), error);
      if (!error) acceptor_.set_option(tcp::acceptor::reuse_address(true), error);
      if (!error) acceptor_.bind(at, error);
      if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
      if (!error) return;
    }
    throw std::runtime_error(fmt::format("no port from {} to {} of {} can be had: {}; next: another port",
                                         options_.port, options_.port + ports - 1, options_.address,
                                         error.message()));
  }

  void Accept() {
    acceptor_.async_accept([this](boost::system::error_code error, tcp::socket socket) {
      if (!error) Take(std::move(socket));
      accepting_ = !options_.tls;  // to shake hands costs up to a millisecond: one within a Poll
      if (accepting_) Accept();
    });
  }

  /// When there are too many, who has not said what he wants for longest makes room.
  void Take(tcp::socket socket) {
    if (static_cast<int>(sessions_.size()) >= options_.max_connections && !MakeRoom()) {
      ++shared_.counters.crowded;
      return;
    }
    const std::uint64_t id = ++last_id_;
    const auto session = std::make_shared<WebSession>(std::move(socket), id, shared_);
    sessions_.emplace(id, session);
    session->Start();
  }

  bool MakeRoom() {
    for (auto it = sessions_.begin(); it != sessions_.end(); ++it) {
      if (it->second->phase() == WebSession::Phase::kSocket) continue;
      it->second->Close();
      sessions_.erase(it);
      ++shared_.counters.crowded;
      return true;
    }
    return false;
  }

  /// Pages that answer nothing keep nobody out.
  bool EndADeadOne() {
    const auto dead = std::find_if(sessions_.begin(), sessions_.end(),
                                   [](const auto& session) { return session.second->SeemsDead(); });
    if (dead == sessions_.end()) return false;
    ++shared_.counters.slow;
    dead->second->Close();
    return true;
  }

  WebServerOptions options_;
  const WebFiles& files_;
  asio::io_context io_{1};
  WebShared shared_;
  tcp::acceptor acceptor_;
  bool accepting_ = true;  ///< false: the rest waits for the next Poll
  std::uint64_t last_id_ = 0;
  std::map<std::uint64_t, std::shared_ptr<WebSession>> sessions_;  ///< by age
};

WebServer::WebServer(const WebServerOptions& options, const WebFiles& files, WebListener& listener)
    : impl_(std::make_unique<Impl>(options, files, listener)) {}
WebServer::~WebServer() = default;
void WebServer::Poll(Time now) {
  impl_->Poll(now);
}
bool WebServer::Send(std::uint64_t client, std::string message, bool binary) {
  return impl_->Send(client, std::move(message), binary);
}
bool WebServer::Queue(std::uint64_t client, std::string message, bool binary) {
  return impl_->Queue(client, std::move(message), binary);
}
void WebServer::ShowPicture(Time exposed, std::string jpeg) {
  impl_->ShowPicture(exposed, std::move(jpeg));
}
bool WebServer::is_watched() const {
  return impl_->is_watched();
}
std::string WebServer::address() const {
  return impl_->address();
}
int WebServer::sockets() const {
  return impl_->sockets();
}
const WebCounters& WebServer::counters() const {
  return impl_->counters();
}

}  // namespace priamos
