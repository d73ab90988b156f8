#include "common/web/tls_files.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <fstream>

#include "test/support/temporary_folder.hpp"
#include "test/support/thrown_reason.hpp"
#include "test/support/web/self_signed.hpp"

namespace priamos {
namespace {

using support::ThrownReason;
using testing::AllOf;
using testing::HasSubstr;

class TlsFiles : public testing::Test {
 protected:
  TlsFiles() { WriteSelfSigned(certificate_, key_); }
  std::string ReasonOf(const std::string& certificate, const std::string& key) {
    return ThrownReason([&] { LoadTls(certificate, key); });
  }
  std::string Write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    chmod((folder_ / name).c_str(), 0600);
    return folder_ / name;
  }
  const TemporaryFolder folder_;
  const std::string certificate_ = folder_ / "host.pem", key_ = folder_ / "host.key";
};

TEST_F(TlsFiles, AreLoaded) {
  EXPECT_NE(LoadTls(certificate_, key_), nullptr);
}

TEST_F(TlsFiles, ThatAreNotThereOrSomethingElseAreNamed) {
  EXPECT_THAT(ReasonOf(folder_ / "none", key_), HasSubstr("none: expected a file with a certificate"));
  EXPECT_THAT(ReasonOf(certificate_, folder_ / "none"),
              HasSubstr("none: expected a file with a private key"));
  EXPECT_THAT(ReasonOf(key_, key_), HasSubstr("host.key: expected a certificate as PEM, got: "));
  EXPECT_THAT(ReasonOf(Write("empty", ""), key_), HasSubstr("empty: expected a certificate as PEM"));
  EXPECT_THAT(ReasonOf(certificate_, Write("noise", "-----BEGIN PRIVATE KEY-----\nAAAA\n")),
              HasSubstr("noise: expected the certificate's private key as PEM, without a password, got: "));
}

TEST_F(TlsFiles, KeyOfAnotherCertificateIsRefused) {
  const std::string other = folder_ / "other.key";
  WriteSelfSigned(folder_ / "other.pem", other);
  EXPECT_THAT(ReasonOf(certificate_, other), AllOf(HasSubstr("other.key"), HasSubstr("mismatch")));
}

TEST_F(TlsFiles, KeyOfAnotherTypeIsRefused) {
  const std::unique_ptr<EVP_PKEY, void (*)(EVP_PKEY*)> key(EVP_RSA_gen(2048), EVP_PKEY_free);
  const std::string other = Write("rsa.key", "");
  const std::unique_ptr<FILE, int (*)(FILE*)> file(std::fopen(other.c_str(), "w"), std::fclose);
  PEM_write_PrivateKey(file.get(), key.get(), nullptr, nullptr, 0, nullptr, nullptr);
  std::fflush(file.get());
  EXPECT_THAT(ReasonOf(certificate_, other),
              AllOf(HasSubstr("rsa.key: expected the private key of"), HasSubstr("host.pem")));
}

TEST_F(TlsFiles, KeyThatOthersCanReadIsRefused) {
  chmod(key_.c_str(), 0640);
  EXPECT_THAT(ReasonOf(certificate_, key_), HasSubstr("got mode 640; next: chmod 600"));
}

}  // namespace
}  // namespace priamos
