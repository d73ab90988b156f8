#include "common/web/token_file.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <fstream>

#include "test/support/temporary_folder.hpp"
#include "test/support/thrown_reason.hpp"

namespace priamos {
namespace {

using support::ThrownReason;
using testing::HasSubstr;

class TokenFile : public testing::Test {
 protected:
  std::string Write(const std::string& text, mode_t mode = 0600) {
    std::ofstream(file_) << text;
    chmod(file_.c_str(), mode);
    return file_;
  }
  std::string ReasonOf(const std::string& text, mode_t mode = 0600) {
    Write(text, mode);
    return ThrownReason([&] { LoadAccess("127.0.0.1", file_); });
  }
  const TemporaryFolder folder_;
  const std::string file_ = folder_ / "tokens";
};

TEST_F(TokenFile, IsNotNeededOnLoopback) {
  EXPECT_TRUE(LoadAccess("127.0.0.1", "").loopback_only);
  EXPECT_TRUE(LoadAccess("::1", "").loopback_only);
  EXPECT_THAT(ThrownReason([] { LoadAccess("127.0.0.2", ""); }), HasSubstr("expected a token_file"));
  EXPECT_THAT(ThrownReason([] { LoadAccess("0.0.0.0", ""); }), HasSubstr("expected a token_file"));
  EXPECT_THAT(ThrownReason([] { LoadAccess("192.168.1.5", ""); }), HasSubstr("expected a token_file"));
}

TEST_F(TokenFile, HasATokenPerRole) {
  const auto access =
      LoadAccess("0.0.0.0", Write("# who may\n\ndriver abcdefghijklmnop # me\nviewer 0123456789-_ABCDEF\n"));
  EXPECT_FALSE(access.loopback_only);
  ASSERT_EQ(access.holders.size(), 2u);
  EXPECT_EQ(access.holders[0].role, Role::kDriver);
  EXPECT_EQ(access.holders[0].token, "abcdefghijklmnop");
  EXPECT_EQ(access.holders[0].name, "");
  EXPECT_EQ(access.holders[1].role, Role::kViewer);
  EXPECT_EQ(access.holders[1].token, "0123456789-_ABCDEF");
}

TEST_F(TokenFile, NamesWhoHoldsAToken) {
  const auto access =
      LoadAccess("0.0.0.0", Write("driver abcdefghijklmnop ada\ndriver ponmlkjihgfedcba grace-2 # nights\n"));
  ASSERT_EQ(access.holders.size(), 2u);
  EXPECT_EQ(access.holders[0].name, "ada");
  EXPECT_EQ(access.holders[1].name, "grace-2");
}

TEST_F(TokenFile, ThatSaysSomethingElseIsRefusedByItsLine) {
  for (const char* line :
       {"driver", "driver short", "driver abcdefghijklmnop more and", "driver abcdefghijklmnop a?b",
        "driver abcdefghijklmnop abcdefghijklmnopqrstuvwxyz", "admin abcdefghijklmnop",
        "driver abcdefgh?jklmnop"})
    EXPECT_THAT(ReasonOf(std::string("# first\n") + line + "\n"),
                HasSubstr("tokens:2: expected `driver TOKEN [NAME]`"))
        << line;
  EXPECT_THAT(ReasonOf("# nobody\n"), HasSubstr("expected at least one token"));
  EXPECT_THAT(ReasonOf("driver abcdefghijklmnop\nviewer abcdefghijklmnop\n"),
              HasSubstr("tokens:2: expected a token that no line before it has"));
}

TEST_F(TokenFile, ThatOthersCanReadIsRefused) {
  EXPECT_THAT(ReasonOf("driver abcdefghijklmnop\n", 0644), HasSubstr("got mode 644; next: chmod 600"));
  EXPECT_THAT(ThrownReason([&] { LoadAccess("127.0.0.1", folder_ / "none"); }),
              HasSubstr("none: expected a file with tokens, got none"));
}

}  // namespace
}  // namespace priamos
