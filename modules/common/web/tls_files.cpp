#include "common/web/tls_files.hpp"

#include <fmt/format.h>
#include <openssl/err.h>
#include <openssl/ssl.h>

#include <boost/asio/ssl/context.hpp>
#include <stdexcept>

#include "common/input/private_file.hpp"

namespace priamos {
namespace {

namespace asio = boost::asio;
using asio::ssl::context;

/// Why a text was not taken, with the file it is from.
void Check(const boost::system::error_code& error, const std::string& file, const char* expected) {
  if (error)
    throw std::runtime_error(fmt::format("{}: expected {}, got: {}", file, expected, error.message()));
}

}  // namespace

std::shared_ptr<context> LoadTls(const std::string& certificate_file, const std::string& key_file) {
  const std::string chain = ReadPublicFile(certificate_file, "a certificate");
  const std::string key = ReadPrivateFile(key_file, "a private key");
  auto tls = std::make_shared<context>(context::tls_server);
  tls->set_options(context::default_workarounds | context::no_tlsv1 | context::no_tlsv1_1);
  // Without a terminal to ask, a key with a password is one that cannot be read.
  tls->set_password_callback([](std::size_t, context::password_purpose) { return std::string(); });
  boost::system::error_code error;
  tls->use_certificate_chain(asio::buffer(chain), error);
  Check(error, certificate_file, "a certificate as PEM");
  tls->use_private_key(asio::buffer(key), context::pem, error);
  Check(error, key_file, "the certificate's private key as PEM, without a password");
  // OpenSSL itself compares those of one type only.
  if (SSL_CTX_check_private_key(tls->native_handle()) != 1) {
    ERR_clear_error();
    throw std::runtime_error(key_file + ": expected the private key of " + certificate_file +
                             ", got one of another type");
  }
  return tls;
}

}  // namespace priamos
