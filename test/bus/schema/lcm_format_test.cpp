#include "bus/schema/lcm_format.hpp"

#include <gmock/gmock.h>

#include "bus/own_types.hpp"
#include "bus/schema/packing.hpp"
#include "bus/schema/schema.hpp"
#include "bus/type_files.hpp"
#include "test/bus/schema/encoding.hpp"

namespace priamos::bus {
namespace {

/// What two definitions have in common when they are packed alike.
std::string BitsOf(const Struct& type) {
  try {
    return FormatBitTable(Packer(type));
  } catch (const SchemaError& error) {
    const std::string sentence = error.what();
    return sentence.substr(sentence.rfind(": "));  // without file and line
  }
}

void ExpectTheSameAgain(const Schema& schema) {
  for (const Struct* type : schema.All()) {
    const Schema again = SchemaOf(FormatLcm(*type));
    const Struct* same = again.Find(type->full_name);
    ASSERT_NE(same, nullptr) << FormatLcm(*type);
    EXPECT_EQ(same->fingerprint, type->fingerprint) << type->full_name;
    EXPECT_EQ(BitsOf(*same), BitsOf(*type));
    EXPECT_EQ(same->doc, type->doc);
    ASSERT_EQ(same->constants.size(), type->constants.size());
    for (std::size_t i = 0; i < type->constants.size(); ++i)
      EXPECT_EQ(same->constants[i].text, type->constants[i].text);
  }
}

TEST(LcmFormat, OwnAndForeignTypesComeBackTheSame) {
  ExpectTheSameAgain(OwnTypes());
  ExpectTheSameAgain(Schema(ReadTypeFiles(PRIAMOS_SOURCE_DIR "/test/bus/schema/foreign")));
}

TEST(LcmFormat, ACommentAboveAFieldDoesNotHideTheAnnotationBehindIt) {
  const Schema schema = SchemaOf(R"(struct s {
  const int8_t DOWN = -0x10, UP = 1;
  // Read [3] first.
  int8_t n;  // [-] @range 0,3 @step 1: count
  /* several
     lines */ byte raw[n];
})");
  EXPECT_EQ(FormatLcm(*schema.Find("s")), R"(struct s {
  const int8_t DOWN = -0x10;
  const int8_t UP = 1;
  // Read [3] first.
  int8_t n;  // [-] @range 0,3 @step 1: count
  byte raw[n];  // several lines
}
)");
  ExpectTheSameAgain(schema);
}

TEST(LcmFormat, EveryTypeInItComesAlongOfWhateverPackage) {
  const Schema schema = SchemaOf(
      "struct z { int8_t n; } package b; struct y { a.x q; } package a; struct x { int8_t k; }"
      " package c; struct w { b.y l[2]; b.y more; }");
  EXPECT_EQ(SchemaOf(FormatLcm(*schema.Find("c.w"))).All().size(), 3u);
  ExpectTheSameAgain(schema);
}

}  // namespace
}  // namespace priamos::bus
