#include "bus/schema/text_codec.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

namespace priamos::bus {
namespace {

std::string Encoded(std::string_view text) {
  return ToBase64(std::as_bytes(std::span(text)));
}

std::optional<std::string> Decoded(std::string_view text) {
  const auto bytes = FromBase64(text);
  if (!bytes) return std::nullopt;
  return std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size());
}

TEST(Base64, TestVectorsOfRfc4648) {
  const std::pair<const char*, const char*> vectors[] = {{"", ""},
                                                         {"f", "Zg=="},
                                                         {"fo", "Zm8="},
                                                         {"foo", "Zm9v"},
                                                         {"foob", "Zm9vYg=="},
                                                         {"fooba", "Zm9vYmE="},
                                                         {"foobar", "Zm9vYmFy"}};
  for (const auto& [plain, coded] : vectors) {
    EXPECT_EQ(Encoded(plain), coded);
    EXPECT_EQ(Decoded(coded), plain);
  }
}

TEST(Base64, RefusesWhatIsNone) {
  for (const char* text : {"Z", "Zg", "Zg=", "Z===", "====", "Zg==Zg==", "Z g=", "Zm9-"}) {
    EXPECT_EQ(Decoded(text), std::nullopt) << text;
  }
}

TEST(Utf8, AcceptsEveryLengthAndTheLimits) {
  for (const char* text : {"", "a", "\xC2\x80", "\xDF\xBF", "\xE0\xA0\x80", "\xED\x9F\xBF", "\xEE\x80\x80",
                           "\xF0\x90\x80\x80", "\xF4\x8F\xBF\xBF"}) {
    EXPECT_TRUE(IsUtf8(text));
  }
}

TEST(Utf8, RefusesOverlongSurrogateTooLargeAndTorn) {
  for (const char* text : {"\x80", "\xC0\x80", "\xC1\xBF", "\xE0\x9F\xBF", "\xED\xA0\x80", "\xF0\x8F\xBF\xBF",
                           "\xF4\x90\x80\x80", "\xF8\x88\x80\x80\x80", "\xFF", "\xE2\x82", "\xC2 "}) {
    EXPECT_FALSE(IsUtf8(text));
  }
}

TEST(Utf8, OtherBytesAreTakenForLatin1) {
  EXPECT_EQ(Utf8Of("sch\xF6n [\xB5m], sch\xC3\xB6n"), "sch\xC3\xB6n [\xC2\xB5m], sch\xC3\xB6n");
  EXPECT_EQ(Utf8Of("a\x80z\x9Bz"), "a\xEF\xBF\xBDz\xEF\xBF\xBDz") << "control characters of a terminal";
  EXPECT_EQ(Utf8Of("\xE2\x82"), "\xC3\xA2\xEF\xBF\xBD") << "torn";
  EXPECT_EQ(Utf8Of(""), "");
}

RC_GTEST_PROP(Utf8Property, AnyBytesBecomeUtf8AndUtf8Stays, (const std::string& bytes)) {
  const std::string text = Utf8Of(bytes);
  RC_ASSERT(IsUtf8(text));
  RC_ASSERT(Utf8Of(text) == text);
  RC_ASSERT(!IsUtf8(bytes) || text == bytes);
}

}  // namespace
}  // namespace priamos::bus
