#include "console/web/web_session.hpp"

#include <algorithm>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <utility>
#include <variant>

namespace priamos::console {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;

constexpr std::uint32_t kLongestHead = 8192;
constexpr std::chrono::milliseconds kFarewell{500};
constexpr double kBurst_s = 1;  ///< a page that was held up says at once what it had to say
constexpr const char* kPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; connect-src 'self'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

std::string Text(beast::string_view text) {
  return {text.data(), text.size()};
}

template <class Parser>
WebRequest RequestOf(const Parser& parser) {
  const auto& head = parser.get();
  return {Text(head.method_string()),    Text(head.target()),
          Text(head[http::field::host]), Text(head[http::field::origin]),
          websocket::is_upgrade(head),   Text(head[http::field::sec_websocket_protocol])};
}

}  // namespace

WebSession::WebSession(boost::asio::ip::tcp::socket socket, std::uint64_t id, WebShared& shared)
    : id_(id), shared_(shared), socket_(std::move(socket)), since_(shared.now) {}

void WebSession::Start() {
  head_.emplace();
  head_->header_limit(kLongestHead);
  beast::error_code ignored;
  tcp().set_option(boost::asio::ip::tcp::no_delay(true), ignored);
  http::async_read_header(
      tcp(), buffer_, *head_,
      [self = shared_from_this()](beast::error_code error, std::size_t) { self->OnHead(error); });
}

void WebSession::OnHead(beast::error_code error) {
  if (phase_ == Phase::kDone) return;
  if (error == http::error::end_of_stream) return Close();
  if (error) return OnHead(RefuseRequest{400, "expected an HTTP request with a head of at most 8 kB"});
  std::visit([this](const auto& answer) { OnHead(answer); },
             Answer(RequestOf(*head_), shared_.files, shared_.options.access));
}

void WebSession::OnHead(const ServeFile& answer) {
  Reply(200, answer.file->type, answer.file->text, answer.head_only);
}

void WebSession::OnHead(const RefuseRequest& answer) {
  ++shared_.counters.requests;
  refusal_ = answer.reason + "\n";
  Reply(static_cast<unsigned>(answer.status), "text/plain; charset=utf-8", refusal_, false);
}

void WebSession::Reply(unsigned status, std::string_view type, std::string_view text, bool head_only) {
  phase_ = Phase::kReply;
  since_ = shared_.now;
  auto& reply = reply_.emplace();
  reply.result(status);
  reply.set(http::field::content_type, beast::string_view(type.data(), type.size()));
  reply.set(http::field::cache_control, "no-cache");
  reply.set("Content-Security-Policy", kPolicy);
  reply.set("X-Content-Type-Options", "nosniff");
  reply.set("Referrer-Policy", "no-referrer");
  reply.content_length(text.size());
  reply.keep_alive(false);
  if (!head_only) reply.body() = beast::span<const char>(text.data(), text.size());
  http::async_write(tcp(), reply,
                    [self = shared_from_this()](beast::error_code, std::size_t) { self->Close(); });
}

void WebSession::OnHead(const OpenSocket& answer) {
  if (shared_.sockets >= shared_.options.max_sockets)
    return OnHead(RefuseRequest{503, "there are as many pages as this station serves"});
  const bool foxglove = answer.dialect == Dialect::kFoxglove;
  socket_.read_message_max(foxglove ? shared_.options.max_client_message : shared_.options.max_message);
  // Who broke the protocol is told so, and given a moment to close his end.
  socket_.set_option(websocket::stream_base::timeout{kFarewell, websocket::stream_base::none(), false});
  if (foxglove)
    socket_.set_option(websocket::stream_base::decorator([](websocket::response_type& reply) {
      reply.set(http::field::sec_websocket_protocol, "foxglove.websocket.v1");
    }));
  socket_.async_accept(head_->get(), [self = shared_from_this(), answer](beast::error_code error) {
    if (self->phase_ == Phase::kDone) return;
    if (error) return self->Close();
    self->Accepted(answer);
  });
}

void WebSession::Accepted(const OpenSocket& answer) {
  phase_ = Phase::kSocket;
  dialect_ = answer.dialect;
  counted_ = shared_.now;
  allowance_ = shared_.options.messages_per_s * kBurst_s;
  socket_.auto_fragment(false);
  joined_ = true;
  ++shared_.sockets;
  beast::error_code gone;
  const auto other_end = tcp().remote_endpoint(gone);
  shared_.listener.Joined(id_, {answer.role, answer.dialect, gone ? "" : other_end.address().to_string()});
  Read();
}

void WebSession::Read() {
  buffer_.clear();
  socket_.async_read(
      buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) { self->OnMessage(error); });
}

void WebSession::OnMessage(beast::error_code error) {
  if (phase_ == Phase::kDone) return;
  const bool gone = error == websocket::error::closed || error == boost::asio::error::eof ||
                    error == boost::asio::error::connection_reset;
  if (gone) return Close();
  const auto data = buffer_.data();
  const std::string_view text(static_cast<const char*>(data.data()), data.size());
  const bool understood = dialect_ == Dialect::kFoxglove || socket_.got_text();
  if (error || !understood || !MaySay() || !shared_.listener.Said(id_, text, socket_.got_binary())) {
    ++shared_.counters.messages;
    return Close();
  }
  Read();
}

bool WebSession::MaySay() {
  const double rate = shared_.options.messages_per_s;
  allowance_ = std::min(rate * kBurst_s, allowance_ + rate * Seconds(shared_.now - counted_));
  counted_ = shared_.now;
  if (allowance_ < 1) return false;
  allowance_ -= 1;
  return true;
}

bool WebSession::Send(std::string text) {
  return waiting_.empty() && Queue(std::move(text), false);
}

bool WebSession::Queue(std::string message, bool binary) {
  if (phase_ != Phase::kSocket || waiting_bytes_ + message.size() > shared_.options.max_waiting) return false;
  waiting_bytes_ += message.size();
  waiting_.push_back({std::move(message), binary});
  if (waiting_.size() == 1) Write();
  return true;
}

void WebSession::Write() {
  since_ = shared_.now;
  socket_.binary(waiting_.front().binary);
  socket_.async_write(boost::asio::buffer(waiting_.front().bytes),
                      [self = shared_from_this()](beast::error_code error, std::size_t) {
                        if (error) return self->Close();
                        self->waiting_bytes_ -= self->waiting_.front().bytes.size();
                        self->waiting_.pop_front();
                        if (!self->waiting_.empty() && self->phase_ == Phase::kSocket) self->Write();
                      });
}

void WebSession::CheckTime() {
  if (phase_ == Phase::kDone || (phase_ == Phase::kSocket && waiting_.empty())) return;
  const auto& options = shared_.options;
  const double limit_s = phase_ == Phase::kHead ? options.head_timeout_s : options.write_timeout_s;
  if (Seconds(shared_.now - since_) <= limit_s) return;
  ++shared_.counters.slow;
  Close();
}

void WebSession::Close() {
  if (phase_ == Phase::kDone) return;
  phase_ = Phase::kDone;
  beast::error_code ignored;
  tcp().shutdown(boost::asio::ip::tcp::socket::shutdown_both, ignored);
  tcp().close(ignored);
  if (!std::exchange(joined_, false)) return;
  --shared_.sockets;
  shared_.listener.Left(id_);
}

}  // namespace priamos::console
