#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <tuple>

#include "bus/schema/packing.hpp"
#include "bus/type_files.hpp"
#include "lcm_rules.hpp"
#include "lcmtypes/channels.hpp"
#include "lcmtypes/embedded_types.hpp"
#include "test/support/project_files.hpp"

namespace priamos::bus {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<Schema::Source> Files() {
  return ReadTypeFiles(PRIAMOS_SOURCE_DIR "/lcmtypes");
}

/// Without what a user of the clone is about to add.
std::vector<Schema::Source> ProjectsOwn() {
  auto files = Files();
  const auto own = ProjectFiles("lcmtypes");
  std::erase_if(files, [&](const Schema::Source& source) {
    return std::find(own.begin(), own.end(), "lcmtypes" / std::filesystem::path(source.file).filename()) ==
           own.end();
  });
  return files;
}

// ---- The rules themselves: each is shown to find what it is there for.

std::vector<std::string> ViolationsIn(const std::string& field) {
  return Violations(Schema({{"t.lcm", "// About it.\nstruct s {\n" + field + "\n}"}}));
}

TEST(LcmRules, AcceptADocumentedField) {
  EXPECT_THAT(ViolationsIn("double x_m;  // [m] @frame map @range 0,1 @step 0.1: position of the base"),
              IsEmpty());
  EXPECT_THAT(ViolationsIn("int64_t utime_exposure;  // [us] @age 1000 @step 10: when"), IsEmpty());
  EXPECT_THAT(ViolationsIn("boolean on;  // [-]: whether"), IsEmpty());
  EXPECT_THAT(ViolationsIn("string text;  // [utf8] @max 10: why"), IsEmpty());
}

TEST(LcmRules, FindAFieldWithoutUnit) {
  EXPECT_THAT(ViolationsIn("boolean on;  // whether"), ElementsAre("t.lcm:3: s.on: no unit in brackets"));
}

TEST(LcmRules, FindAnUnreadableAnnotation) {
  EXPECT_THAT(
      ViolationsIn("boolean on;  // [-] @rnge 0,1: whether"),
      ElementsAre("t.lcm:3: s.on: the tag @rnge is not known", "t.lcm:3: s.on: the tag @rnge is not known"));
}

TEST(LcmRules, FindAFieldWithoutBound) {
  for (const char* field : {"double v_m_s;  // [m/s]: speed", "double v_m_s;  // [m/s] @range 0,1: speed",
                            "double v_m_s;  // [m/s] @step 1: speed", "int64_t utime;  // [us]: when",
                            "string text;  // [utf8]: why"}) {
    EXPECT_THAT(ViolationsIn(field), ::testing::Contains(::testing::HasSubstr("no bound:"))) << field;
  }
  EXPECT_THAT(ViolationsIn("int8_t n;  // [-] @range 0,3 @step 1: count\n boolean on[n];  // [-]: whether"),
              ElementsAre("t.lcm:4: s.on: no bound: @range and @step, @age and @step, or @max"));
}

TEST(LcmRules, FindANameThatDoesNotTellTheUnit) {
  for (const char* field :
       {"double speed;  // [m/s] @range 0,1 @step 1: speed",
        "double speed_m;  // [m/s] @range 0,1 @step 1: value",
        "double turn_rad_s;  // [s] @range 0,1 @step 1: value",
        "double way_m;  // [-] @range 0,1 @step 1: value", "double heat_k;  // [K] @range 0,1 @step 1: value",
        "int64_t time;  // [us] @age 10 @step 1: value", "string text;  // [-] @max 3: value"}) {
    EXPECT_THAT(ViolationsIn(field), ElementsAre(::testing::HasSubstr("the name does not tell the unit")))
        << field;
  }
}

TEST(LcmRules, FindACoordinateWithoutFrame) {
  for (const char* name : {"x_m", "y2_m", "yaw_rad"}) {
    const std::string unit = std::string(name).ends_with("_m") ? "[m]" : "[rad]";
    EXPECT_THAT(ViolationsIn("double " + std::string(name) + ";  // " + unit + " @range 0,1 @step 1: value"),
                ElementsAre(::testing::EndsWith(": a coordinate needs @frame")));
  }
}

TEST(LcmRules, FindAFieldOrTypeWithoutMeaning) {
  EXPECT_THAT(ViolationsIn("boolean on;  // [-]:"), ElementsAre("t.lcm:3: s.on: no meaning after the colon"));
  EXPECT_THAT(Violations(Schema({Schema::Source{"t.lcm", "struct s { }"}})),
              ElementsAre("t.lcm:1: s: has no comment before it"));
}

TEST(LcmRules, FindATypeThatIsTooLarge) {
  EXPECT_THAT(ViolationsIn("boolean on[1392];  // [-]: whether"), IsEmpty());
  EXPECT_THAT(ViolationsIn("boolean on[1393];  // [-]: whether"),
              ElementsAre("t.lcm:2: s: may have 1401 bytes, 1400 are allowed"));
}

TEST(LcmRules, FindATypeThatCannotBePacked) {
  EXPECT_THAT(ViolationsIn("int8_t n;  // [-] @range 0,300 @step 1: count"),
              ElementsAre("t.lcm:3: s.n: @range is beyond what int8_t can hold"));
}

// ---- lcmtypes/

TEST(LcmTypes, KeepTheRules) {
  EXPECT_THAT(Violations(Schema(ProjectsOwn())), IsEmpty());
}

TEST(LcmTypes, AreOnePackageWithOneTypePerFileOfItsName) {
  const Schema schema(ProjectsOwn());
  EXPECT_EQ(schema.All().size(), ProjectsOwn().size());
  for (const Struct* type : schema.All()) {
    EXPECT_EQ(type->package, "priamos") << type->file;
    EXPECT_EQ(std::filesystem::path(type->file).stem(), type->name);
  }
}

TEST(LcmTypes, EmbeddedTextsAreTheFiles) {
  std::set<std::pair<std::string, std::string>> files;
  for (const Schema::Source& source : Files()) {
    files.emplace(std::filesystem::path(source.file).filename(), source.text);
  }
  std::set<std::pair<std::string, std::string>> embedded;
  for (const TypeText& text : EmbeddedTypes())
    embedded.emplace(std::filesystem::path(text.file).filename(), text.text);
  EXPECT_EQ(embedded, files);
}

/// Of every field that says which of several things it is, another value would be another thing.
/// The nearest number is that of something else.
TEST(LcmTypes, RefuseOutsideTheRangeOfAnEnumerationOrAnIdentity) {
  const Schema schema(ProjectsOwn());
  const std::set<std::string> identities{"session",     "sequence", "request_id",
                                         "landmark_id", "path_id",  "order_id"};
  std::set<std::string> refusing;
  for (const Struct* type : schema.All()) {
    const Packer packer(*type);
    for (const PackedField& field : packer.fields()) {
      if (identities.contains(field.name))
        EXPECT_TRUE(field.refuse) << type->name << "." << field.name;
      else if (field.refuse && field.name.find('.') == std::string::npos)
        refusing.insert(type->name + "." + field.name);
    }
  }
  EXPECT_THAT(
      refusing,
      ElementsAre("alarm_t.severity", "camera_frame_t.camera", "camera_trigger_t.cameras", "claim_t.state",
                  "door_found_t.id", "door_found_t.state", "door_seen_t.hinge", "drive_command_t.driver",
                  "drive_status_t.driver", "drive_status_t.limit", "drive_status_t.mode",
                  "drive_status_t.refusal", "estop_t.action", "estop_t.driver", "feature_t.kind",
                  "health_t.state", "landmark_edge_t.side", "landmark_fix_t.side", "landmark_fix_t.verdict",
                  "landmark_view_t.camera", "landmark_view_t.side", "landmark_view_t.verdict",
                  "lease_request_t.action", "lease_request_t.driver", "look_request_t.side",
                  "map_command_t.action", "mission_command_t.mission", "mission_result_t.outcome",
                  "mission_status_t.mission", "mission_status_t.phase", "mission_step_t.mission",
                  "obstacle_line_t.verdict", "obstacle_segment_t.kind", "parameter_order_t.action",
                  "parameter_order_t.process", "parameter_order_t.value", "parameter_value_t.outcome",
                  "parameter_value_t.process", "parameter_value_t.value", "pose_correction_t.verdict",
                  "probe_t.kind", "process_order_t.action", "process_report_t.outcome",
                  "process_state_t.state", "scene_object_t.id", "scene_object_t.kind", "simulation_t.state",
                  "view_edge_t.kind", "world_touch_t.kind"));
}

// ---- lcmtypes/channels.hpp

template <class Function>
void ForEachChannel(Function function) {
  std::apply([&](const auto&... channel) { (function(channel), ...); }, channels::kAll);
}

TEST(Channels, NamesCannotBeTakenForRegularExpressions) {
  std::set<std::string_view> names;
  ForEachChannel([&](const auto& channel) {
    EXPECT_FALSE(channel.name.empty());
    EXPECT_EQ(channel.name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_"), std::string_view::npos)
        << channel.name;
    EXPECT_TRUE(names.insert(channel.name).second) << channel.name << " is there twice";
  });
}

TEST(Channels, TypesAreKnownToTheSchema) {
  const Schema schema = Schema::FromTexts(EmbeddedTypes());
  ForEachChannel([&](const auto& channel) {
    using Message = typename std::decay_t<decltype(channel)>::Message;
    const Struct* type = schema.Find("priamos." + std::string(Message::getTypeName()));
    ASSERT_NE(type, nullptr) << channel.name;
    EXPECT_EQ(type->fingerprint, static_cast<std::uint64_t>(Message::getHash())) << channel.name;
  });
}

TEST(Channels, WhatHasARateGetsStale) {
  ForEachChannel([](const auto& channel) {
    EXPECT_EQ(channel.rate_hz > 0, channel.stale_after.count() > 0) << channel.name;
    if (channel.rate_hz > 0) {
      EXPECT_GT(channel.stale_after.count() * channel.rate_hz, 1000)
          << channel.name << " is stale between two messages";
    }
  });
}

}  // namespace
}  // namespace priamos::bus
