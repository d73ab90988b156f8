#include "bus/schema/packing.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <rapidcheck.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "bus/schema/json.hpp"
#include "bus/schema/walk.hpp"
#include "encoding.hpp"
#include "lcmtypes/embedded_types.hpp"
#include "priamos/landmark_model_t.hpp"
#include "priamos/pose_t.hpp"
#include "priamos/sonar_ranges_t.hpp"
#include "random_message.hpp"

namespace priamos::bus {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr std::int64_t kNow = 1'700'000'000'000'000;

const Schema& Own() {
  static const Schema schema = Schema::FromTexts(EmbeddedTypes());
  return schema;
}

std::string ErrorOf(const std::string& text) {
  const Schema schema = SchemaOf(text);
  try {
    const Packer dut(*schema.All().front());
  } catch (const SchemaError& error) {
    return error.what();
  }
  return "no error";
}

Json PackAndBack(const Packer& dut, const Bytes& bytes) {
  const auto packed = dut.Pack(bytes, kNow);
  const auto back = dut.Unpack(packed.value().bytes, kNow);
  return ToJson(dut.type(), back.value());
}

// ---- Sizes: the figures to beat are those of DCCL 4.2 for the same content, alone and unauthenticated.

std::size_t MaxBytesOf(const std::string& text) {
  const Schema schema = SchemaOf(text);
  return Packer(*schema.All().front()).MaxBytes();
}

TEST(PackingSize, PoseAndVelocityTakeAtMost14Bytes) {
  EXPECT_LE(MaxBytesOf("struct pose { int64_t utime; // [us] @age 5000000 @step 10000: t\n"
                       "double x_m, y_m; // [m] @range -100,100 @step 0.01: position\n"
                       "double yaw_rad; // [rad] @range -3.142,3.142 @step 0.001: heading\n"
                       "double vx_m_s, vy_m_s; // [m/s] @range -1.5,1.5 @step 0.01: velocity\n"
                       "double wz_rad_s; // [rad/s] @range -2,2 @step 0.01: turn rate\n }"),
            10u);
}

TEST(PackingSize, RingOf24SonarsTakesAtMost32Bytes) {
  EXPECT_EQ(MaxBytesOf("struct sonar { int64_t utime; // [us] @age 1000000 @step 10000: t\n"
                       "double range_m[24]; // [m] @range 0,5 @step 0.01 @invalid -1: distance\n }"),
            28u);
}

TEST(PackingSize, DriveCommandTakesAtMost6Bytes) {
  EXPECT_EQ(MaxBytesOf("struct drive { double vx_m_s, vy_m_s; // [m/s] @range -1.5,1.5 @step 0.01: velocity\n"
                       "double wz_rad_s; // [rad/s] @range -2,2 @step 0.01: turn rate\n"
                       "double ttl_s; // [s] @range 0,2 @step 0.1: time to live\n"
                       "int8_t mode; // [-] @range 0,7 @step 1: mode\n }"),
            5u);
}

// ---- Values

TEST(Packing, PoseComesBackRounded) {
  const Packer dut(*Own().Find("pose_t"));
  pose_t pose{};
  pose.utime = kNow - 123'456;
  pose.x_m = -12.3456;
  pose.yaw_rad = 1.23456;
  pose.vx_m_s = 0.3;
  pose.rho_x_y = -1;
  const auto packed = dut.Pack(Encode(pose), kNow);
  ASSERT_TRUE(packed);
  EXPECT_THAT(packed->saturated, IsEmpty());
  const auto back = Decode<pose_t>(dut.Unpack(packed->bytes, kNow + 777).value());
  EXPECT_EQ(back.utime, kNow + 777 - 130'000);
  EXPECT_EQ(back.x_m, -12.35);
  EXPECT_EQ(back.yaw_rad, 1.235);
  EXPECT_EQ(back.vx_m_s, 0.3);
  EXPECT_EQ(back.vy_m_s, 0);
  EXPECT_EQ(back.rho_x_y, -1);
}

TEST(Packing, OutOfRangeSaturatesAndIsReportedOncePerField) {
  const Packer dut(*Own().Find("sonar_ranges_t"));
  sonar_ranges_t ranges{};
  ranges.utime = kNow;
  ranges.range_m[0] = 7;
  ranges.range_m[1] = -3;
  ranges.range_m[2] = -1;
  ranges.range_m[3] = std::numeric_limits<double>::quiet_NaN();
  const auto packed = dut.Pack(Encode(ranges), kNow);
  ASSERT_TRUE(packed);
  EXPECT_THAT(packed->saturated, ElementsAre(1));
  EXPECT_EQ(dut.fields()[1].name, "range_m[]");
  const auto back = Decode<sonar_ranges_t>(dut.Unpack(packed->bytes, kNow).value());
  EXPECT_EQ(back.range_m[0], 5);
  EXPECT_EQ(back.range_m[1], 0);
  EXPECT_EQ(back.range_m[2], -1);
  EXPECT_EQ(back.range_m[3], -1);
}

/// A NaN would arrive as 0, an infinity as the end of the range: a velocity, a place that nobody meant.
TEST(Packing, AMessageWithWhatIsNoNumberIsRefused) {
  const Packer pose(*Own().Find("pose_t")), ranges(*Own().Find("sonar_ranges_t"));
  for (const double value :
       {std::nan(""), std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}) {
    pose_t message{};
    message.utime = kNow;
    message.x_m = value;
    const auto packed = pose.Pack(Encode(message), kNow);
    ASSERT_EQ(packed->refused.size(), 1u) << value;
    EXPECT_EQ(pose.fields()[packed->refused[0]].name, "x_m");
    EXPECT_THAT(packed->bytes, IsEmpty());
    EXPECT_THAT(packed->saturated, IsEmpty());
    sonar_ranges_t sonar{};
    sonar.utime = kNow;
    sonar.range_m[7] = value;
    EXPECT_EQ(ranges.Pack(Encode(sonar), kNow)->refused.empty(), std::isnan(value)) << "a NaN is @invalid";
  }
}

/// Fields 0 and 1 refuse what is out of range: the one is an enumeration, the other is marked.
constexpr const char* kModes =
    "struct s { const int8_t IDLE = 0, FAILED = 5;\n"
    "int8_t mode; // [-] @range 0,5: IDLE, ...\n"
    "double part; // [-] @range 0,1 @step 0.25 @refuse: of it\n"
    "int8_t level; // [-] @range 0,5: how high\n }";

TEST(Packing, AValueOutOfRangeIsRefusedWhereTheNearestOneMeansSomethingElse) {
  const Schema schema = SchemaOf(kModes);
  const Packer dut(*schema.Find("s"));
  const auto pack = [&](int mode, double part, int level) {
    return dut
        .Pack(MessageBuilder(dut.type())
                  .Put(static_cast<std::int8_t>(mode))
                  .Put(part)
                  .Put(static_cast<std::int8_t>(level))
                  .bytes(),
              0)
        .value();
  };
  EXPECT_THAT(pack(5, 1, 5).refused, IsEmpty());
  for (const int mode : {6, 9, -1, 127}) {
    EXPECT_THAT(pack(mode, 1, 5).refused, ElementsAre(0)) << mode;
    EXPECT_THAT(pack(mode, 1, 5).bytes, IsEmpty()) << mode;
  }
  EXPECT_THAT(pack(9, 1.2, 9).refused, ElementsAre(0, 1));
  EXPECT_THAT(pack(0, std::nan(""), 0).refused, ElementsAre(1));
  EXPECT_THAT(pack(0, 1.1, 0).refused, IsEmpty()) << "within half a step";
  EXPECT_THAT(pack(0, 0, 9).refused, IsEmpty()) << "a level has a nearest value";
  EXPECT_THAT(pack(0, 0, 9).saturated, ElementsAre(2));
  EXPECT_FALSE(pack(0, 0, 9).bytes.empty());
}

TEST(Packing, RefusedAreAlsoTextsCountsStampsAndElementsOfNestedArrays) {
  const Schema schema = SchemaOf(
      "struct s { int64_t utime; // [us] @age 1000 @step 1 @refuse: when\n"
      "string name; // [ascii] @max 3 @refuse: who\n"
      "int8_t n; // [-] @range 0,2 @refuse: how many\n"
      "part p[n]; // [-] @max 2: parts\n }\n"
      "struct part { int8_t kind; // [-] @range 0,2 @refuse: which\n }");
  const Packer dut(*schema.Find("s"));
  const auto refused = [&](std::int64_t stamp, const std::string& name, std::vector<int> kinds) {
    MessageBuilder message(dut.type());
    message.Put(stamp).Text(name).Put(static_cast<std::int8_t>(kinds.size()));
    for (const int kind : kinds) message.Put(static_cast<std::int8_t>(kind));
    return dut.Pack(message.bytes(), 5000).value().refused;
  };
  EXPECT_THAT(refused(4500, "abc", {0, 2}), IsEmpty());
  EXPECT_THAT(refused(3000, "abc", {}), ElementsAre(0));
  EXPECT_THAT(refused(4500, "abcd", {}), ElementsAre(1));
  EXPECT_THAT(refused(4500, "\xe4", {}), ElementsAre(1));
  EXPECT_THAT(refused(4500, "abc", {0, 1, 2}), ElementsAre(2));
  EXPECT_THAT(refused(4500, "abc", {0, 3}), ElementsAre(3));
}

TEST(Packing, ACountIsNoEnumerationWhateverItsCommentNames) {
  const Schema schema = SchemaOf(
      "struct s { const int8_t MOST = 2;\n int8_t n; // [-] @range 0,2: at most MOST\n byte b[n]; // [-] "
      "@max 2: b\n }");
  const Packer dut(*schema.Find("s"));
  const auto packed =
      dut.Pack(MessageBuilder(dut.type()).Put(std::int8_t{3}).Put('a').Put('b').Put('c').bytes(), 0);
  EXPECT_THAT(packed->refused, IsEmpty());
  EXPECT_THAT(packed->saturated, ElementsAre(0));
}

TEST(Packing, CodesBeyondTheRangeOfAnEnumerationAreRefusedNotClamped) {
  const Schema schema = SchemaOf(
      "struct s { const int8_t IDLE = 0;\n int8_t mode; // [-] @range 0,5: IDLE, ...\n byte rest; // [-] "
      "@range 0,31: rest\n }");
  const Packer dut(*schema.Find("s"));
  ASSERT_EQ(dut.MaxBits(), 8U);
  for (int code = 0; code < 8; ++code) {
    const auto back = dut.Unpack(Bytes{static_cast<std::byte>(code << 5)}, 0);
    ASSERT_EQ(back.has_value(), code <= 5) << code;
    if (!back) continue;
    EXPECT_EQ(ToJson(dut.type(), *back).at("mode"), code);
  }
}

TEST(Packing, RefusingChangesNeitherBitsNorCodes) {
  std::string without = kModes;
  without.erase(without.find(" @refuse"), 8);
  const Schema one = SchemaOf(kModes), other = SchemaOf(without);
  const Packer a(*one.Find("s")), b(*other.Find("s"));
  for (std::size_t i = 0; i < a.fields().size(); ++i) {
    EXPECT_EQ(a.fields()[i].codes, b.fields()[i].codes);
    EXPECT_EQ(a.fields()[i].bits, b.fields()[i].bits);
  }
  EXPECT_TRUE(a.fields()[1].refuse);
  EXPECT_FALSE(b.fields()[1].refuse);
}

TEST(Packing, TimeStampsTravelAsAgeAndNeverWrap) {
  const Schema schema = SchemaOf("struct s { int64_t utime; // [us] @age 1000000 @step 1000: t\n }");
  const Packer dut(*schema.Find("s"));
  EXPECT_EQ(dut.MaxBits(), 10u);
  const auto received = [&](std::int64_t stamp, std::int64_t sent) {
    const auto packed = dut.Pack(MessageBuilder(dut.type()).Put(stamp).bytes(), sent);
    const auto back = dut.Unpack(packed.value().bytes, 5'000'000);  // the receiver's clock is another one
    return std::pair(ReadInteger(back.value().data() + 8, 8), packed->saturated.size());
  };
  EXPECT_EQ(received(kNow - 400'000, kNow), std::pair(std::int64_t{4'600'000}, std::size_t{0}));
  EXPECT_EQ(received(kNow - 400'001, kNow).first, 4'599'000) << "never younger than it was";
  EXPECT_EQ(received(kNow - 400'999, kNow).first, 4'599'000);
  EXPECT_EQ(received(kNow - 1'000'001, kNow), std::pair(std::int64_t{4'000'000}, std::size_t{1}));
  EXPECT_EQ(received(kNow - 2'000'000, kNow), std::pair(std::int64_t{4'000'000}, std::size_t{1}));
  EXPECT_EQ(received(kNow + 2'000'000, kNow), std::pair(std::int64_t{5'000'000}, std::size_t{1}));
  EXPECT_EQ(received(0, kNow).first, 4'000'000);
  EXPECT_EQ(received(std::numeric_limits<std::int64_t>::min(), kNow).first, 4'000'000);
  EXPECT_EQ(received(std::numeric_limits<std::int64_t>::max(), -kNow).first, 5'000'000);
}

TEST(Packing, IntegersOfStepOneAreExact) {
  const Schema schema = SchemaOf(
      "struct s { int32_t a; // [tick] @range -2147483648,2147483647 @step 1: a\n"
      "int64_t b; // [-] @range -9223372036854775808,9223372036854775807: b\n"
      "int16_t c; // [-] @range 100,107: c\n byte d; boolean e; }");
  const Packer dut(*schema.Find("s"));
  EXPECT_EQ(dut.MaxBits(), 32u + 64 + 3 + 8 + 1);
  const Bytes bytes = MessageBuilder(dut.type())
                          .Put<std::int32_t>(-2147483647)
                          .Put<std::int64_t>(-9223372036854775807)
                          .Put<std::int16_t>(105)
                          .Put<std::uint8_t>(200)
                          .Put<std::int8_t>(1)
                          .bytes();
  EXPECT_EQ(dut.Unpack(dut.Pack(bytes, 0).value().bytes, 0), bytes);
}

TEST(Packing, BooleansTakeOneBitAndAnyOtherByteIsTrue) {
  const Schema schema = SchemaOf("struct s { boolean b[9]; }");
  const Packer dut(*schema.Find("s"));
  EXPECT_EQ(dut.MaxBits(), 9u);
  MessageBuilder builder(dut.type());
  for (int i = 0; i < 9; ++i) builder.Put(static_cast<std::int8_t>(i == 3 ? 7 : 0));
  const auto packed = dut.Pack(builder.bytes(), 0);
  EXPECT_EQ(packed->bytes, (Bytes{std::byte{0x10}, std::byte{0}}));
}

TEST(Packing, FloatsComeBackAsFloats) {
  const Schema schema = SchemaOf("struct s { float f; // [m] @range -1,1 @step 0.001 @invalid 9.9: f\n }");
  const Packer dut(*schema.Find("s"));
  for (const float value : {0.125F, -1.0F, 9.9F}) {
    const Bytes bytes = MessageBuilder(dut.type()).Put(value).bytes();
    EXPECT_EQ(dut.Unpack(dut.Pack(bytes, 0).value().bytes, 0), bytes) << value;
  }
}

// ---- Texts and arrays

TEST(Packing, TextsAreCutAtTheirMaximumAndNotWithinACharacter) {
  const Schema schema = SchemaOf("struct s { string t; // [utf8] @max 4: t\n }");
  const Packer dut(*schema.Find("s"));
  EXPECT_EQ(dut.MaxBits(), 3u + 32);
  const auto back = [&](const std::string& text) {
    return PackAndBack(dut, MessageBuilder(dut.type()).Text(text).bytes())["t"].get<std::string>();
  };
  EXPECT_EQ(back(""), "");
  EXPECT_EQ(back("abcd"), "abcd");
  EXPECT_EQ(back("abcde"), "abcd");
  EXPECT_EQ(back("abc\xC3\xA4"), "abc");
  EXPECT_EQ(back("ab\xC3\xA4"), "ab\xC3\xA4");
  EXPECT_EQ(back("a\xF0\x9F\x98\x80"), "a");
  EXPECT_THAT(dut.Pack(MessageBuilder(dut.type()).Text("abcde").bytes(), 0)->saturated, ElementsAre(0));
}

TEST(Packing, AsciiTextsTakeSevenBitsACharacter) {
  const Schema schema = SchemaOf("struct s { string t; // [ascii] @max 8: t\n }");
  const Packer dut(*schema.Find("s"));
  EXPECT_EQ(dut.MaxBits(), 4u + 56);
  const Bytes umlaut = MessageBuilder(dut.type()).Text("B\xC3\xA4R").bytes();
  EXPECT_EQ(PackAndBack(dut, umlaut)["t"], "B??R");
  EXPECT_THAT(dut.Pack(umlaut, 0)->saturated, ElementsAre(0));
}

TEST(Packing, ArraysTakeOnlyTheBitsOfWhatIsThere) {
  const Packer dut(*Own().Find("landmark_model_t"));
  landmark_model_t model{};
  EXPECT_EQ(dut.Pack(Encode(model), 0)->bytes.size(), 9u);
  model.n_edges = 2;
  model.edges.resize(2);
  model.edges[1].z2_m = 2.0;
  const auto packed = dut.Pack(Encode(model), 0);
  EXPECT_LE(packed->bytes.size(), 37u);
  const auto back = Decode<landmark_model_t>(dut.Unpack(packed->bytes, 0).value());
  ASSERT_EQ(back.n_edges, 2);
  EXPECT_EQ(back.edges[1].z2_m, 2.0);
}

TEST(Packing, ArraysBeyondTheirMaximumAreCutAndReported) {
  const Schema schema = SchemaOf(
      "struct s { int8_t n; // [-] @range 0,2: n\n p a[n]; // [-] @max 3: a\n boolean last; }\n"
      "struct p { int8_t m; byte b[m]; // [-] @max 2: b\n string t; // [utf8] @max 1: t\n }");
  const Packer dut(*schema.Find("s"));
  MessageBuilder builder(dut.type());
  builder.Put<std::int8_t>(3);
  builder.Put<std::int8_t>(3).Put('a').Put('b').Put('c').Text("x");
  builder.Put<std::int8_t>(0).Text("y");
  builder.Put<std::int8_t>(1).Put('d').Text("long, but never sent");
  builder.Put<std::int8_t>(1);
  EXPECT_EQ(PackAndBack(dut, builder.bytes()).dump(),
            R"({"n":2,"a":[{"m":2,"b":"YWI=","t":"x"},{"m":0,"b":"","t":"y"}],"last":true})");
  EXPECT_THAT(dut.Pack(builder.bytes(), 0)->saturated, ElementsAre(0, 1));
}

TEST(Packing, MultiDimensionalArrays) {
  const Schema schema = SchemaOf(
      "struct s { int8_t n; int8_t m; double a[n][2][m]; // [m] @max 3,2 @range 0,1 @step 0.5: a\n"
      " string t[n]; // [ascii] @max 3,4: t\n }");
  const Packer dut(*schema.Find("s"));
  EXPECT_EQ(dut.MaxBits(), 2u + 2 + 3 * 2 * 2 * 2 + 3 * (3 + 28));
  const Json json = Json::parse(R"({"n":2,"m":1,"a":[[[0.0],[0.5]],[[1.0],[0.0]]],"t":["a","bcde"]})");
  EXPECT_EQ(PackAndBack(dut, FromJson(dut.type(), json)), json);
}

// ---- Properties

/// The largest error packing may make in a value of `field`.
double Tolerance(const Field& field) {
  const double step = field.annotation.step ? field.annotation.step->value : 1;
  if (field.kind == Kind::kFloat) return 0.5 * step + 1e-6 * std::abs(field.annotation.max->value);
  if (field.annotation.age_us) return step - 1;
  return IsInteger(field.kind) ? std::floor(0.5 * step) : 0.50001 * step;
}

void ExpectClose(const Struct& type, const Json& sent, const Json& received);

void ExpectFieldClose(const Field& field, const Json& sent, const Json& received) {
  if (sent.is_array()) {
    RC_ASSERT(sent.size() == received.size());
    for (std::size_t i = 0; i < sent.size(); ++i) ExpectFieldClose(field, sent[i], received[i]);
  } else if (field.kind == Kind::kStruct) {
    ExpectClose(*field.type, sent, received);
  } else if (IsInteger(field.kind)) {
    RC_ASSERT(std::abs(sent.get<std::int64_t>() - received.get<std::int64_t>()) <= Tolerance(field));
  } else if (sent.is_number()) {
    RC_ASSERT(std::abs(sent.get<double>() - received.get<double>()) <= Tolerance(field));
  } else {
    RC_ASSERT(sent == received);
  }
}

void ExpectClose(const Struct& type, const Json& sent, const Json& received) {
  for (const Field& field : type.fields) ExpectFieldClose(field, sent[field.name], received[field.name]);
}

TEST(PackingProperty, MessagesOfEveryTypeComeBackWithinHalfAStep) {
  for (const Struct* type : Own().All()) {
    const Packer dut(*type);
    EXPECT_TRUE(rc::check(type->full_name, [&](std::uint64_t seed) {
      Rng rng(seed);
      const Bytes bytes = RandomMessage(*type, Values::kInRange, rng, kNow);
      const auto packed = dut.Pack(bytes, kNow);
      RC_ASSERT(packed.has_value());
      RC_ASSERT(packed->saturated.empty());
      RC_ASSERT(packed->refused.empty());
      RC_ASSERT(packed->bytes.size() <= dut.MaxBytes());
      const auto back = dut.Unpack(packed->bytes, kNow);
      RC_ASSERT(back.has_value());
      ExpectClose(*type, ToJson(*type, bytes), ToJson(*type, *back));
      RC_ASSERT(dut.Pack(*back, kNow)->bytes == packed->bytes);
    }));
  }
}

TEST(PackingProperty, AnyMessageGivesOneWithinItsRanges) {
  for (const Struct* type : Own().All()) {
    const Packer dut(*type);
    EXPECT_TRUE(rc::check(type->full_name, [&](std::uint64_t seed) {
      Rng rng(seed);
      const auto packed = dut.Pack(RandomMessage(*type, Values::kAny, rng), kNow);
      RC_ASSERT(packed.has_value());
      if (!packed->refused.empty()) return RC_ASSERT(packed->bytes.empty());
      const auto back = dut.Unpack(packed->bytes, kNow);
      RC_ASSERT(back.has_value());
      const auto again = dut.Pack(*back, kNow);
      RC_ASSERT(again->bytes == packed->bytes);
      RC_ASSERT(again->saturated.empty());
    }));
  }
}

TEST(PackingProperty, HostileBitsAreRefusedOrGiveAWellFormedMessage) {
  for (const Struct* type : Own().All()) {
    const Packer dut(*type);
    EXPECT_TRUE(rc::check(type->full_name, [&](const std::vector<std::uint8_t>& noise, bool fit) {
      Bytes bytes(noise.size());
      for (std::size_t i = 0; i < noise.size(); ++i) bytes[i] = std::byte{noise[i]};
      if (fit) bytes.resize(dut.MaxBytes());
      const auto message = dut.Unpack(bytes, kNow);
      if (!message) return;
      RC_ASSERT(static_cast<bool>(Walk(*type, *message)));
      RC_ASSERT(dut.Pack(*message, kNow)->bytes == bytes);
    }));
  }
}

TEST(Packing, RefusesWhatWalkRefuses) {
  const Packer dut(*Own().Find("pose_t"));
  EXPECT_EQ(dut.Pack(Bytes(20), 0), std::nullopt);
}

TEST(Packing, UnpackRefusesLengthFillAndCodesThatNobodySends) {
  const Schema schema =
      SchemaOf("struct s { int8_t a; // [-] @range 0,4: a\n int8_t b; // [-] @range 0,15: b\n }");
  const Packer dut(*schema.Find("s"));  // 3 + 4 bits
  const auto unpack = [&](std::initializer_list<int> values) {
    Bytes bytes;
    for (const int v : values) bytes.push_back(static_cast<std::byte>(v));
    return dut.Unpack(bytes, 0).has_value();
  };
  EXPECT_TRUE(unpack({0b10011110}));
  EXPECT_FALSE(unpack({0b10011111}));
  EXPECT_FALSE(unpack({0b10111110}));
  EXPECT_FALSE(unpack({}));
  EXPECT_FALSE(unpack({0b10011110, 0}));
}

TEST(Packing, UnpackFrontTakesOneMessageAfterTheOther) {
  const Packer dut(*Own().Find("pose_t"));
  pose_t pose{};
  pose.x_m = 1;
  Bytes bytes = dut.Pack(Encode(pose), 0)->bytes;
  const Bytes second = dut.Pack(Encode(pose_t{}), 0)->bytes;
  bytes.insert(bytes.end(), second.begin(), second.end());
  std::span<const std::byte> rest = bytes;
  EXPECT_EQ(Decode<pose_t>(dut.UnpackFront(rest, 0).value()).x_m, 1);
  EXPECT_EQ(Decode<pose_t>(dut.UnpackFront(rest, 0).value()).x_m, 0);
  EXPECT_TRUE(rest.empty());
  EXPECT_EQ(dut.UnpackFront(rest, 0), std::nullopt);
}

// ---- Types that cannot be packed

TEST(Packing, RefusesTypesWithFileLineAndField) {
  EXPECT_EQ(ErrorOf("package p;\nstruct s {\n double x; }"), "t.lcm:3: p.s.x: packing needs @range");
  EXPECT_EQ(ErrorOf("struct s { double x; // [m] @range 0,1: x\n }"), "t.lcm:1: s.x: packing needs @step");
  EXPECT_EQ(ErrorOf("struct s { int8_t x; }"), "t.lcm:1: s.x: packing needs @range");
  EXPECT_EQ(ErrorOf("struct s { string x; }"),
            "t.lcm:1: s.x: packing needs @max, the largest length of the text");
  EXPECT_EQ(ErrorOf("struct s { int8_t n; byte x[n]; }"),
            "t.lcm:1: s.x: packing needs @max here or @range at n");
  EXPECT_EQ(ErrorOf("struct s { int8_t n; byte x[n]; // [-] @max 200: x\n }"),
            "t.lcm:1: s.n: a int8_t cannot count to 200");
  EXPECT_EQ(ErrorOf("struct s { int8_t x; // [-] @range 0,200: x\n }"),
            "t.lcm:1: s.x: @range is beyond what int8_t can hold");
  EXPECT_EQ(ErrorOf("struct s { int8_t x; // [-] @range 0,2 @invalid 300: x\n }"),
            "t.lcm:1: s.x: @invalid is no value of int8_t");
  EXPECT_EQ(ErrorOf("struct s { int8_t x; // [-] @range 0,2 @step 0.5: x\n }"),
            "t.lcm:1: s.x: @range and @step of an integer are whole numbers");
  EXPECT_EQ(ErrorOf("struct s { double x; // [m] @range 0,1e9 @step 1e-9: x\n }"),
            "t.lcm:1: s.x: @range has more than 2^52 steps");
  EXPECT_EQ(ErrorOf("struct s { float x; // [m] @range 0,1e39 @step 1e30: x\n }"),
            "t.lcm:1: s.x: @range is beyond what the type can hold");
  EXPECT_EQ(ErrorOf("struct s { int32_t t; // [us] @age 1000 @step 1: t\n }"),
            "t.lcm:1: s.t: a time stamp with @age is an int64_t");
  EXPECT_EQ(ErrorOf("struct s { int64_t t; // [us] @age 1000: t\n }"),
            "t.lcm:1: s.t: packing needs @step, whole microseconds");
  EXPECT_EQ(ErrorOf("struct s { double x; // [m] @range 1,0 @step 1: x\n }"),
            "t.lcm:1: s.x: the second number of @range is not above the first");
  EXPECT_EQ(ErrorOf("struct s { int8_t n; int8_t m; byte x[n][m]; // [-] @max 2: x\n }"),
            "t.lcm:1: s.x: @max has 1 numbers for 2 variable dimensions");
  EXPECT_EQ(ErrorOf("struct s { int8_t n; // [-] @range 0,1: n\n s x[n]; }"),
            "t.lcm:1: s has a type in it that contains itself, which cannot be packed");
  EXPECT_EQ(ErrorOf("struct s { double x[65535]; // [m] @range 0,1 @step 1: x\n }"),
            "t.lcm:1: s may have more than 65535 bytes, which cannot be packed");
  EXPECT_EQ(ErrorOf("struct s { e x[2147483647][2147483647][2147483647]; } struct e { }"),
            "no error");  // sorted by name: `e` comes first, and an empty type is packed in no bits
  EXPECT_EQ(ErrorOf("struct s { boolean x; // [-] @refuse: x\n }"),
            "t.lcm:1: s.x: @refuse is for fields with a range, and a boolean has none");
  EXPECT_EQ(ErrorOf("struct a { e x; // [-] @refuse: x\n } struct e { }"),
            "t.lcm:1: a.x: @refuse belongs to the fields of the struct");
  EXPECT_EQ(ErrorOf("struct a { e x[2147483647][2147483647][2147483647]; } struct e { }"),
            "t.lcm:1: a.x: more than 65535 values cannot be packed");
}

TEST(Packing, BitTableNamesEveryField) {
  const Packer dut(*Own().Find("landmark_model_t"));
  std::vector<std::string> names;
  for (const PackedField& field : dut.fields()) names.push_back(field.name);
  EXPECT_THAT(names, ElementsAre("landmark_id", "x_m", "y_m", "yaw_rad", "n_edges", "edges[].x1_m",
                                 "edges[].y1_m", "edges[].z1_m", "edges[].x2_m", "edges[].y2_m",
                                 "edges[].z2_m", "edges[].visible_from_rad", "edges[].visible_to_rad",
                                 "edges[].side", "edges[].grey_ratio"));
  const std::string table = FormatBitTable(dut);
  EXPECT_NE(table.find("-2.5..2.5 by 0.002"), std::string::npos) << table;
  EXPECT_NE(table.find(std::to_string(dut.MaxBits()) + " bits"), std::string::npos) << table;
}

/// 46 lines of text may hold 2^45 structs, each without a byte.
TEST(Packing, RefusesTypesThatDoubleOften) {
  std::string text = "struct c45_t {}";
  for (int i = 44; i >= 0; --i) text += fmt::format("struct c{0}_t {{ c{1}_t a; c{1}_t b; }}", i, i + 1);
  const Schema schema = SchemaOf(text);
  EXPECT_THROW(Packer(*schema.Find("c0_t")), SchemaError);
  EXPECT_NO_THROW(Packer(*schema.Find("c40_t")));
}

}  // namespace
}  // namespace priamos::bus
