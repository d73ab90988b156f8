#include "bus/log/csv_table.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "bus/schema/schema.hpp"

namespace priamos::bus {
namespace {

std::string Table(const std::string& lcm, const std::string& type, const std::string& json) {
  const Schema schema(std::vector<Schema::Source>{{"t.lcm", lcm}});
  const Struct& s = *schema.Find(std::string_view(type));
  const CsvTable dut(s);
  std::ostringstream out;
  dut.WriteHeader(out);
  LogEvent event;
  event.utime = 5;
  event.number = 6;
  event.bytes = FromJson(s, Json::parse(json));
  dut.WriteRow(out, event);
  return out.str();
}

TEST(CsvTable, NestedStructsAndFixedArraysGetColumns) {
  EXPECT_EQ(Table("struct p_t { double x; int32_t n[2]; }\nstruct t { p_t p[2]; string s; }", "t",
                  R"({"p":[{"x":1.5,"n":[1,2]},{"x":-0.25,"n":[3,4]}],"s":"a,b"})"),
            "log_utime,log_number,p[0].x,p[0].n[0],p[0].n[1],p[1].x,p[1].n[0],p[1].n[1],s\r\n"
            "5,6,1.5,1,2,-0.25,3,4,\"a,b\"\r\n");
}

TEST(CsvTable, VariableArraysAreOneColumnOfJson) {
  EXPECT_EQ(
      Table("struct t { int8_t n; double x[n]; byte b[3]; }", "t", R"({"n":2,"x":[1.5,2.5],"b":"AAEC"})"),
      "log_utime,log_number,n,x,b\r\n5,6,2,\"[1.5,2.5]\",AAEC\r\n");
}

TEST(CsvTable, TypesThatContainThemselvesAreOneColumn) {
  EXPECT_EQ(Table("struct t { int8_t n; t kids[n]; }", "t", R"({"n":0,"kids":[]})"),
            "log_utime,log_number,n,kids\r\n5,6,0,[]\r\n");
}

TEST(CsvTable, TooManyColumnsAreASentence) {
  const Schema schema(std::vector<Schema::Source>{{"t.lcm", "struct t { double x[100000]; }"}});
  EXPECT_THROW(CsvTable(*schema.Find(std::string_view("t"))), SchemaError);
}

}  // namespace
}  // namespace priamos::bus
