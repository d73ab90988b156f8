#include "common/input/section_place.hpp"

#include <gtest/gtest.h>

#include <sstream>
#include <vector>

#include "common/config.hpp"
#include "common/config_printer.hpp"

namespace priamos {
namespace {

struct Wheel {
  double radius_m = 0.1;
  SectionPlace place{};
  void Describe(Archive& a) {
    a.Number("radius_m", radius_m, {"m", 0, 1, "radius"});
    NotePlace(a, place);
  }
};

struct Cart {
  std::string name;
  std::vector<Wheel> wheels;
  SectionPlace place{};
  void Describe(Archive& a) {
    a.Text("name", name, "name");
    a.List("wheel", wheels, "wheels");
    NotePlace(a, place);
  }
};

TEST(SectionPlace, NamesFileLineAndKey) {
  const auto dut = ParseConfig<Cart>("cart.toml", "\nname = 'a'\n\n[[wheel]]\nradius_m = 0.2\n[[wheel]]\n");
  EXPECT_EQ(dut.place.Of("name"), "cart.toml:2:name");
  EXPECT_EQ(dut.wheels.at(0).place.Of("radius_m"), "cart.toml:5:wheel[0].radius_m");
  EXPECT_EQ(dut.wheels.at(1).place.Of("radius_m"), "cart.toml:6:wheel[1].radius_m")
      << "the section leaves it out";
}

TEST(SectionPlace, NamesTheOverrideAKeyCameFrom) {
  const auto dut = LoadConfig<Cart>(ConfigSource{"", {"name=b"}});
  EXPECT_EQ(dut.place.Of("name"), "--set name=b: name");
}

TEST(SectionPlace, StaysWhenTheConfigurationIsPrinted) {
  auto dut = ParseConfig<Cart>("cart.toml", "\nname = 'a'\n");
  std::ostringstream out;
  dut.Describe(*MakeConfigPrinter(out));
  EXPECT_EQ(dut.place.Of("name"), "cart.toml:2:name");
}

TEST(SectionPlace, OfNoFileIsTheKey) {
  EXPECT_EQ(SectionPlace{}.Of("name"), "name");
}

TEST(SectionPlace, MakesNoOtherConfiguration) {
  EXPECT_EQ(ParseConfig<Cart>("a", "name = 'a'").place, SectionPlace{});
}

}  // namespace
}  // namespace priamos
