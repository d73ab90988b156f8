#pragma once

#include <openssl/ssl.h>

#include <memory>
#include <string>
#include <utility>

#include "test/support/web/web_client.hpp"

namespace priamos {

/// A browser's end of one TLS connection over a WebClient, which turns the server while it waits.
class TlsClient {
 public:
  explicit TlsClient(std::unique_ptr<WebClient> line, int newest_version = TLS1_3_VERSION)
      : line_(std::move(line)), context_(SSL_CTX_new(TLS_client_method())) {
    SSL_CTX_set_security_level(context_.get(), 0);  // it may offer what no server should take
    SSL_CTX_set_max_proto_version(context_.get(), newest_version);
    tls_.reset(SSL_new(context_.get()));
    in_ = BIO_new(BIO_s_mem());
    out_ = BIO_new(BIO_s_mem());
    SSL_set_bio(tls_.get(), in_, out_);
    SSL_set_connect_state(tls_.get());
  }

  /// Whether the server shakes hands.
  bool Connect() {
    Hear([this](const std::string&) { return SSL_is_init_finished(tls_.get()) != 0; });
    return SSL_is_init_finished(tls_.get()) != 0;
  }
  void Say(const std::string& text) {
    SSL_write(tls_.get(), text.data(), static_cast<int>(text.size()));
    Flush();
  }
  /// What has come after waiting until `done` holds of it, the end of the connection, or 2 s.
  template <class Done>
  std::string Hear(const Done& done) {
    Take();
    line_->Hear([&](const std::string& coded) {
      if (coded.size() > taken_) Take(coded);
      return done(heard_);
    });
    return heard_;
  }
  /// What has come until the server said that nothing more does, which is answered.
  std::string HearAll() {
    return Hear([this](const std::string&) { return was_finished(); });
  }
  /// Whether the server said that nothing more comes.
  bool was_finished() const { return (SSL_get_shutdown(tls_.get()) & SSL_RECEIVED_SHUTDOWN) != 0; }
  WebClient& line() { return *line_; }

 private:
  void Take(const std::string& coded = {}) {
    if (coded.size() > taken_) BIO_write(in_, coded.data() + taken_, static_cast<int>(coded.size() - taken_));
    taken_ = std::max(taken_, coded.size());
    char clear[4096];
    for (int n = 0; (n = SSL_read(tls_.get(), clear, sizeof clear)) > 0;)
      heard_.append(clear, static_cast<std::size_t>(n));
    if (was_finished()) SSL_shutdown(tls_.get());
    Flush();
  }
  void Flush() {
    char coded[4096];
    for (int n = 0; (n = BIO_read(out_, coded, sizeof coded)) > 0;)
      line_->Say(std::string(coded, static_cast<std::size_t>(n)));
  }

  struct Free {
    void operator()(SSL* p) const { SSL_free(p); }
    void operator()(SSL_CTX* p) const { SSL_CTX_free(p); }
  };
  std::unique_ptr<WebClient> line_;
  std::unique_ptr<SSL_CTX, Free> context_;
  std::unique_ptr<SSL, Free> tls_;
  BIO *in_ = nullptr, *out_ = nullptr;  ///< of tls_
  std::size_t taken_ = 0;
  std::string heard_;
};

}  // namespace priamos
