#include "common/web/picture_client.hpp"

#include <fmt/format.h>

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/http/write.hpp>
#include <regex>
#include <utility>

#include "common/text/number_text.hpp"
#include "common/web/picture_text.hpp"

namespace priamos {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using asio::ip::tcp;

constexpr std::uint32_t kLongestPictureHead = 4096;
constexpr std::uint64_t kMostBytes = 1 << 20;
constexpr double kPatience_s = 3;  ///< for a connection, or a picture
constexpr double kAgain_s = 1;     ///< after a failure

/// Seconds that a field of the head gives; 0 for none, and for what is no time.
double SecondsIn(const http::response<http::string_body>& answer, std::string_view field) {
  const auto text = answer[beast::string_view(field.data(), field.size())];
  const auto seconds = NumberOf<double>(std::string_view(text.data(), text.size()));
  return seconds && *seconds >= 0 && *seconds < 3600 ? *seconds : 0;
}

}  // namespace

std::optional<PictureAddress> ReadPictureAddress(const std::string& text) {
  static const std::regex kAddress(R"(http://(([A-Za-z0-9.-]+|\[[0-9a-fA-F:]+\]):([0-9]{1,5})))");
  std::smatch parts;
  if (!std::regex_match(text, parts, kAddress)) return std::nullopt;
  const auto port = NumberOf<int>(parts.str(3));
  if (!port || *port < 1 || *port > 65535) return std::nullopt;
  std::string host = parts.str(2);
  if (host.starts_with('[')) host = host.substr(1, host.size() - 2);
  return PictureAddress{host, parts.str(3), parts.str(1), ""};
}

class PictureClient::Impl {
 public:
  explicit Impl(PictureAddress from) : from_(std::move(from)), resolver_(io_), socket_(io_) {}

  void Poll(bool wanted, Time now) {
    now_ = now;
    io_.restart();
    io_.poll();
    if (!wanted) return Rest();
    if (busy_ && Seconds(now - since_) > kPatience_s) Fail("no answer");
    if (!busy_ && now >= next_) Begin();
  }

  std::optional<FetchedPicture> Take() { return std::exchange(newest_, std::nullopt); }
  const std::string& problem() const { return problem_; }

 private:
  void Rest() {
    Drop();
    problem_.clear();
    next_ = {};
    newest_.reset();
  }

  /// What is under way ends, and its end counts no more.
  void Drop() {
    ++round_;
    busy_ = false;
    resolver_.cancel();
    beast::error_code ignored;
    socket_.close(ignored);
  }

  void Fail(const std::string& why) {
    Drop();
    problem_ =
        fmt::format("http://{}{}: {}", from_.authority, from_.target.substr(0, from_.target.find('?')), why);
    next_ = now_ + FromSeconds(kAgain_s);
  }

  /// `then` goes on if nothing failed and nobody has dropped the connection meanwhile.
  template <class Result, class Then>
  auto Step(Then then) {
    return [this, round = round_, then](beast::error_code error, const Result& result) {
      if (round != round_) return;
      if (error) return Fail(error.message());
      then(result);
    };
  }

  void Begin() {
    busy_ = true;
    since_ = now_;
    buffer_.clear();
    beast::error_code error;
    const auto numeric = resolver_.resolve(
        from_.host, from_.port, tcp::resolver::numeric_host | tcp::resolver::numeric_service, error);
    if (!error) return Connect(numeric);  // nobody need be asked
    using Found = tcp::resolver::results_type;
    resolver_.async_resolve(from_.host, from_.port,
                            Step<Found>([this](const Found& found) { Connect(found); }));
  }

  void Connect(const tcp::resolver::results_type& found) {
    asio::async_connect(socket_, found, Step<tcp::endpoint>([this](const tcp::endpoint&) { Ask(); }));
  }

  void Ask() {
    since_ = now_;
    request_ = {http::verb::get, from_.target, 11};
    request_.set(http::field::host, from_.authority);
    http::async_write(socket_, request_, Step<std::size_t>([this](std::size_t) { Listen(); }));
  }

  void Listen() {
    parser_.emplace();
    parser_->header_limit(kLongestPictureHead);
    parser_->body_limit(kMostBytes);
    http::async_read(socket_, buffer_, *parser_, Step<std::size_t>([this](std::size_t) { Heard(); }));
  }

  void Heard() {
    auto answer = parser_->release();
    if (answer.result() != http::status::ok) return Fail(fmt::format("{}", answer.result_int()));
    if (answer[http::field::content_type] != "image/jpeg") return Fail("expected a picture");
    const double age_s =
        SecondsIn(answer, kAgeField) + Seconds(now_ - since_) - SecondsIn(answer, kWaitField);
    newest_ = {std::move(answer.body()), now_ - FromSeconds(std::max(age_s, 0.0))};
    problem_.clear();
    Ask();
  }

  const PictureAddress from_;
  asio::io_context io_{1};
  tcp::resolver resolver_;
  tcp::socket socket_;
  beast::flat_buffer buffer_;
  http::request<http::empty_body> request_;
  std::optional<http::response_parser<http::string_body>> parser_;
  std::optional<FetchedPicture> newest_;
  std::string problem_;
  bool busy_ = false;
  std::uint64_t round_ = 0;  ///< connection
  Time now_{}, since_{}, next_{};
};

PictureClient::PictureClient(PictureAddress from) : impl_(std::make_unique<Impl>(std::move(from))) {}
PictureClient::~PictureClient() = default;
void PictureClient::Poll(bool wanted, Time now) {
  impl_->Poll(wanted, now);
}
std::optional<FetchedPicture> PictureClient::Take() {
  return impl_->Take();
}
const std::string& PictureClient::problem() const {
  return impl_->problem();
}

}  // namespace priamos
