#pragma once

#include <memory>
#include <string>

namespace boost::asio::ssl {
class context;
}

namespace priamos {

/// What a server needs for TLS 1.2 and 1.3: `certificate_file` holds its certificate and those that vouch for
/// it, `key_file` its private key, both as PEM; only its owner may read the key. Throws std::runtime_error,
/// `file: expected ..., got ...`, when they are not so or do not belong together.
std::shared_ptr<boost::asio::ssl::context> LoadTls(const std::string& certificate_file,
                                                   const std::string& key_file);

}  // namespace priamos
