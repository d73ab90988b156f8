#include <tuple>

#include "bus/schema/walk.hpp"
#include "fuzz_input.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::bus {
namespace {

/// lcm-gen's decoder takes all of what passed, if the channels carry the type.
template <class T>
void DecodeIf(std::uint64_t fingerprint, std::span<const std::byte> message) {
  if (static_cast<std::uint64_t>(T::getHash()) != fingerprint) return;
  T decoded;
  const int size = static_cast<int>(message.size());
  Require(decoded.decode(message.data(), 0, size) == size);
}

void WalkAndDecode(const Struct& type, std::span<const std::byte> message) {
  if (!Walk(type, message)) return;
  std::apply(
      [&](const auto&... channel) {
        (DecodeIf<typename std::decay_t<decltype(channel)>::Message>(type.fingerprint, message), ...);
      },
      channels::kAll);
}

}  // namespace
}  // namespace priamos::bus

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace priamos::bus;
  const TypedInput input = SplitInput(data, size);
  WalkAndDecode(*input.type, input.rest);
  WalkAndDecode(*input.type, WithFingerprint(*input.type, input.rest));
  return 0;
}
