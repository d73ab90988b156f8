#include <map>

#include "bus/schema/packing.hpp"
#include "bus/schema/walk.hpp"
#include "fuzz_input.hpp"

namespace priamos::bus {
namespace {

/// nullptr for types that cannot be packed.
const Packer* PackerOf(const Struct& type) {
  static std::map<const Struct*, std::optional<Packer>> packers;
  const auto [at, added] = packers.try_emplace(&type);
  if (added) {
    try {
      at->second.emplace(type);
    } catch (const SchemaError&) {
    }
  }
  return at->second ? &*at->second : nullptr;
}

}  // namespace
}  // namespace priamos::bus

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace priamos::bus;
  constexpr std::int64_t kNow = 1'700'000'000'000'000;
  const TypedInput input = SplitInput(data, size);
  const Packer* packer = PackerOf(*input.type);
  if (packer == nullptr) return 0;
  if (const auto message = packer->Unpack(input.rest, kNow)) {
    Require(static_cast<bool>(Walk(*input.type, *message)));
    const auto again = packer->Pack(*message, kNow);
    Require(again.has_value() && again->refused.empty());
    Require(std::equal(again->bytes.begin(), again->bytes.end(), input.rest.begin(), input.rest.end()));
  }
  if (const auto packed = packer->Pack(WithFingerprint(*input.type, input.rest), kNow)) {
    Require(packed->bytes.size() <= packer->MaxBytes());
    Require(packer->Unpack(packed->bytes, kNow).has_value() == packed->refused.empty());
  }
  return 0;
}
