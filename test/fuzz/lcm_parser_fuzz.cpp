#include "bus/schema/packing.hpp"
#include "fuzz_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace priamos::bus;
  std::vector<std::string> problems;
  const Schema schema({{"fuzz.lcm", std::string(reinterpret_cast<const char*>(data), size)}}, problems);
  for (const Struct* type : schema.All()) {
    Require(schema.Find(type->full_name) == type);
    MaxEncodedSize(*type);
    try {
      const Packer packer(*type);
    } catch (const SchemaError&) {
    }
  }
  for (const std::string& problem : problems) Require(problem.starts_with("fuzz.lcm:"));
  return 0;
}
