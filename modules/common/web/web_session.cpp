#include "common/web/web_session.hpp"

#include <algorithm>
#include <array>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/detect_ssl.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <utility>
#include <variant>

namespace priamos {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;

constexpr std::uint32_t kLongestHead = 8192;
constexpr std::chrono::milliseconds kFarewell{500};
constexpr int kSendBuffer = 32768;  ///< [byte] a slow line shows few pictures, not old ones
constexpr double kNoPicture_s = 2;  ///< after that a camera is taken for one that gives none
constexpr double kDead_s = 5;       ///< without an answer to a ping; makes room when others come
constexpr double kGone_s = 30;      ///< the same, and it is closed
constexpr double kBurst_s = 1;      ///< a page that was held up says at once what it had to say
constexpr const char* kPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src "
    "'self'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

std::string Text(beast::string_view text) {
  return {text.data(), text.size()};
}

/// A field that is there once. One that is there twice may say two things to two readers: that is no text of
/// an origin or a host.
template <class Head>
std::string Once(const Head& head, http::field field) {
  return head.count(field) > 1 ? "more than one" : Text(head[field]);
}

template <class Parser>
WebRequest RequestOf(const Parser& parser) {
  const auto& head = parser.get();
  return {Text(head.method_string()),    Text(head.target()),
          Once(head, http::field::host), Once(head, http::field::origin),
          websocket::is_upgrade(head),   Text(head[http::field::sec_websocket_protocol])};
}

}  // namespace

WebSession::WebSession(WebStream::Socket socket, std::uint64_t id, WebShared& shared)
    : id_(id), shared_(shared), socket_(std::move(socket)), since_(shared.now) {}

void WebSession::Start() {
  beast::error_code ignored;
  tcp().set_option(boost::asio::ip::tcp::no_delay(true), ignored);
  if (!shared_.options.tls) return ReadHead();
  beast::async_detect_ssl(tcp(), buffer_, [self = shared_from_this()](beast::error_code error, bool begins) {
    if (error || self->phase_ == Phase::kDone) return self->Close();
    begins ? self->Secure() : self->ReadHead();  // who speaks plainly is told what is expected
  });
}

void WebSession::Secure() {
  stream().AsyncSecure(*shared_.options.tls, buffer_.data(),
                       [self = shared_from_this()](beast::error_code error, std::size_t used) {
                         if (error || self->phase_ == Phase::kDone) return self->Close();
                         self->buffer_.consume(used);
                         self->ReadHead();
                       });
}

void WebSession::ReadHead() {
  head_.emplace();
  head_->header_limit(kLongestHead);
  http::async_read_header(
      stream(), buffer_, *head_,
      [self = shared_from_this()](beast::error_code error, std::size_t) { self->OnHead(error); });
}

void WebSession::OnHead(beast::error_code error) {
  if (phase_ == Phase::kDone) return;
  if (error == http::error::end_of_stream) return Close();
  if (error) return OnHead(RefuseRequest{400, "expected an HTTP request with a head of at most 8 kB"});
  if (shared_.options.tls && !stream().secured())
    return OnHead(RefuseRequest{400, "expected https:// at the beginning of the address"});
  std::visit([this](const auto& answer) { OnHead(answer); },
             Answer(RequestOf(*head_), shared_.files, shared_.options.access, shared_.options.camera));
}

void WebSession::OnHead(const ServeFile& answer) {
  Reply(200, answer.file->type, answer.file->text, answer.head_only);
}

void WebSession::OnHead(const ServePictures& answer) {
  phase_ = Phase::kPictures;
  since_ = shared_.now;
  looking_ = Looking{answer.all, shared_.picture.number};
  if (!answer.all) return;
  beast::error_code ignored;
  tcp().set_option(boost::asio::socket_base::send_buffer_size(kSendBuffer), ignored);
  looking_->jpeg = std::make_shared<const std::string>();
  WritePicture(StreamHead(), {});
  WatchEnd();
}

/// Who looks at all that come is gone when his end is closed.
void WebSession::WatchEnd() {
  stream().async_read_some(boost::asio::buffer(unwanted_),
                           [self = shared_from_this()](beast::error_code, std::size_t) { self->Close(); });
}

void WebSession::OfferPicture() {
  if (phase_ != Phase::kPictures) return;
  shared_.watched = shared_.now;
  const WebPicture& picture = shared_.picture;
  if (looking_->jpeg || picture.number == looking_->had) return;
  looking_->had = picture.number;
  looking_->jpeg = picture.jpeg;
  if (looking_->all) return WritePicture(PartHead(picture, shared_.now), kPartEnd);
  WritePicture(PictureHead(picture, shared_.now - since_, shared_.now), {});
}

void WebSession::WritePicture(std::string head, std::string_view end) {
  since_ = shared_.now;
  looking_->head = std::move(head);
  const std::array<boost::asio::const_buffer, 3> parts{boost::asio::buffer(looking_->head),
                                                       boost::asio::buffer(*looking_->jpeg),
                                                       boost::asio::buffer(end.data(), end.size())};
  boost::asio::async_write(stream(), parts,
                           [self = shared_from_this()](beast::error_code error, std::size_t) {
                             if (error || self->phase_ != Phase::kPictures) return self->Close();
                             self->looking_->jpeg.reset();
                             if (self->looking_->all) return;
                             self->phase_ = Phase::kHead;  // for the next one
                             self->since_ = self->shared_.now;
                             self->ReadHead();
                           });
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
  http::async_write(stream(), reply, [self = shared_from_this()](beast::error_code error, std::size_t) {
    if (error || self->phase_ == Phase::kDone) return self->Close();
    self->stream().AsyncFinish([self](beast::error_code) { self->Close(); });
  });
}

void WebSession::OnHead(const OpenSocket& answer) {
  if (shared_.sockets >= shared_.options.max_sockets && !shared_.make_room())
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
  socket_.control_callback([this](websocket::frame_type kind, beast::string_view) {
    if (kind != websocket::frame_type::pong) return;
    pinging_ = false;
    has_ponged_ = true;
  });
  joined_ = true;
  ++shared_.sockets;
  beast::error_code gone;
  const auto other_end = tcp().remote_endpoint(gone);
  OpenSocket opened = answer;
  if (!gone) opened.from = other_end.address().to_string();
  shared_.listener.Joined(id_, opened);
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

bool WebSession::Send(std::string message, bool binary) {
  if ((pinging_ && has_ponged_) || !waiting_.empty() || !Queue(std::move(message), binary)) return false;
  Ping();
  return true;
}

void WebSession::Ping() {
  if (pinging_) return;
  pinging_ = true;
  pinged_ = shared_.now;
  socket_.async_ping({}, [self = shared_from_this()](beast::error_code) {});
}

/// Time since the ping that the other end of a WebSocket has not answered; 0: it has, or there is none.
double WebSession::UnansweredFor_s() const {
  return phase_ == Phase::kSocket && pinging_ ? Seconds(shared_.now - pinged_) : 0;
}

bool WebSession::SeemsDead() const {
  return UnansweredFor_s() > kDead_s;
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
  if (has_ponged_ && UnansweredFor_s() > kGone_s) {
    ++shared_.counters.slow;
    return Close();
  }
  if (phase_ == Phase::kDone || (phase_ == Phase::kSocket && waiting_.empty())) return;
  const auto& options = shared_.options;
  const bool waits = phase_ == Phase::kPictures && !looking_->jpeg;
  if (waits && looking_->all) return;
  const double limit_s = waits                    ? kNoPicture_s
                         : phase_ == Phase::kHead ? options.head_timeout_s
                                                  : options.write_timeout_s;
  if (Seconds(shared_.now - since_) <= limit_s) return;
  if (waits) {
    refusal_ = "the camera gives no pictures\n";
    return Reply(503, "text/plain; charset=utf-8", refusal_, false);
  }
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

}  // namespace priamos
