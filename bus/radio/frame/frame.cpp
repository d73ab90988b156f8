#include "bus/radio/frame/frame.hpp"

#include <sodium.h>

#include <algorithm>
#include <stdexcept>

#include "bus/radio/frame/cobs.hpp"
#include "bus/radio/frame/coded_block.hpp"

namespace priamos::bus::radio {
namespace {

constexpr std::size_t kHelloCodeBytes = 8;
constexpr std::size_t kHelloBodyBytes = 25;
constexpr std::byte kWholeCounterTag{0x80};
constexpr std::byte kHelloTag{0x81};
constexpr std::uint64_t kMaxCounter = (std::uint64_t{1} << 40) - 1;

template <class Byte>
void PutLittleEndian(std::uint64_t value, std::span<Byte> out) {
  for (Byte& b : out) {
    b = static_cast<Byte>(value & 0xFF);
    value >>= 8;
  }
}

std::uint64_t GetLittleEndian(std::span<const std::byte> bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = bytes.size(); i-- > 0;) value = value << 8 | std::to_integer<std::uint64_t>(bytes[i]);
  return value;
}

constexpr std::size_t kHeaderBytes = 22;
/// The first byte, the kind, determines the length, so that no two frames have the same hash input.
using AuthenticatedHeader = std::vector<std::uint8_t>;

constexpr std::uint8_t kOfSharedChannel = 8;

std::uint8_t SharedKind(FrameScope scope) {
  return scope.address != 0 ? kOfSharedChannel : 0;
}

void PutAddress(FrameScope scope, AuthenticatedHeader& header) {
  if (scope.address != 0) header.push_back(scope.address);
}

AuthenticatedHeader DataHeader(Direction direction, FrameScope scope, std::uint64_t epoch,
                               std::uint64_t counter, std::optional<std::uint64_t> echo) {
  AuthenticatedHeader header(kHeaderBytes + (echo ? 8 : 0));
  header[0] = static_cast<std::uint8_t>((scope.encrypted ? 3 : 1) + (echo ? 4 : 0) + SharedKind(scope));
  header[1] = static_cast<std::uint8_t>(direction);
  PutLittleEndian(epoch, std::span(header).subspan(2, 8));
  PutLittleEndian(counter, std::span(header).subspan(10, 8));
  PutLittleEndian(scope.table_hash, std::span(header).subspan(18, 4));
  if (echo) PutLittleEndian(*echo, std::span(header).subspan(kHeaderBytes, 8));
  PutAddress(scope, header);
  return header;
}

/// The one number with these lowest bytes that is at most `newest`, and less than all of them hold below it.
std::uint64_t CompleteEcho(std::span<const std::byte> low, std::uint64_t newest) {
  const std::uint64_t mask = (std::uint64_t{1} << (8 * low.size())) - 1;
  return newest - ((newest - GetLittleEndian(low)) & mask);
}

AuthenticatedHeader HelloHeader(Direction direction, FrameScope scope) {
  AuthenticatedHeader header(kHeaderBytes);
  header[0] = static_cast<std::uint8_t>(2 + SharedKind(scope));
  header[1] = static_cast<std::uint8_t>(direction);
  PutAddress(scope, header);
  return header;
}

/// BLAKE2b-256 of a text and numbers, keyed: one key for one purpose.
LinkKey Derive(const LinkKey& key, std::string_view purpose, std::span<const std::uint8_t> numbers = {}) {
  std::vector<std::uint8_t> input(purpose.begin(), purpose.end());
  input.insert(input.end(), numbers.begin(), numbers.end());
  LinkKey derived{};
  crypto_generichash(derived.data(), derived.size(), input.data(), input.size(), key.data(), key.size());
  return derived;
}

std::array<std::byte, kHelloBodyBytes> EncodeHello(const Hello& hello) {
  std::array<std::byte, kHelloBodyBytes> body{};
  const auto out = std::span(body);
  PutLittleEndian(hello.table_hash, out.subspan(0, 4));
  PutLittleEndian(hello.stream, out.subspan(4, 4));
  PutLittleEndian(hello.nonce, out.subspan(8, 8));
  PutLittleEndian(hello.echo, out.subspan(16, 8));
  body[24] = static_cast<std::byte>((hello.need ? 1U : 0U) | (hello.agreed ? 2U : 0U) |
                                    (hello.over ? 4U : 0U) | (hello.code_bytes - kShortCodeBytes) / 2 << 3);
  return body;
}

Hello DecodeHello(std::span<const std::byte> body) {
  return {.table_hash = static_cast<std::uint32_t>(GetLittleEndian(body.subspan(0, 4))),
          .stream = static_cast<std::uint32_t>(GetLittleEndian(body.subspan(4, 4))),
          .nonce = GetLittleEndian(body.subspan(8, 8)),
          .echo = GetLittleEndian(body.subspan(16, 8)),
          .need = (body[24] & std::byte{1}) != std::byte{0},
          .agreed = (body[24] & std::byte{2}) != std::byte{0},
          .over = (body[24] & std::byte{4}) != std::byte{0},
          .code_bytes = kShortCodeBytes + 2 * (std::to_integer<std::size_t>(body[24]) >> 3 & 3)};
}

std::vector<std::byte> Delimited(std::vector<std::byte> wire) {
  wire.push_back(kDelimiter);
  return wire;
}

}  // namespace

std::uint32_t KeyCheck(const LinkKey& link_key) {
  const LinkKey derived = Derive(link_key, "priamos radio 1 key check");
  const auto check = GetLittleEndian(std::as_bytes(std::span(derived).first(4)));
  return check != 0 ? static_cast<std::uint32_t>(check) : 1;
}

FrameKeys::FrameKeys(const LinkKey& link_key)
    : authentication_key_(Derive(link_key, "priamos radio 1 authentication")),
      encryption_key_(Derive(link_key, "priamos radio 1 encryption")) {
  if (sodium_init() < 0) throw std::runtime_error("libsodium cannot be started");
}

void FrameKeys::Authenticate(std::span<const std::uint8_t> header, std::span<const std::byte> body,
                             std::span<std::byte> out) const {
  std::array<std::uint8_t, 16> hash{};
  crypto_generichash_state state;
  crypto_generichash_init(&state, authentication_key_.data(), authentication_key_.size(), hash.size());
  crypto_generichash_update(&state, header.data(), header.size());
  crypto_generichash_update(&state, reinterpret_cast<const unsigned char*>(body.data()), body.size());
  crypto_generichash_final(&state, hash.data(), hash.size());
  std::transform(hash.begin(), hash.begin() + static_cast<std::ptrdiff_t>(out.size()), out.begin(),
                 [](std::uint8_t b) { return std::byte{b}; });
}

void FrameKeys::Crypt(Direction direction, std::uint64_t epoch, std::uint64_t counter,
                      std::span<const std::byte> code, std::span<std::byte> body) const {
  std::vector<std::uint8_t> scope(17);
  scope[0] = static_cast<std::uint8_t>(direction);
  PutLittleEndian(epoch, std::span(scope).subspan(1, 8));
  PutLittleEndian(counter, std::span(scope).subspan(9, 8));
  for (const std::byte b : code) scope.push_back(std::to_integer<std::uint8_t>(b));
  // A key of its own for each frame: its nonce is always the same.
  const LinkKey key = Derive(encryption_key_, "", scope);
  const std::array<std::uint8_t, crypto_stream_chacha20_ietf_NONCEBYTES> nonce{};
  auto* data = reinterpret_cast<unsigned char*>(body.data());
  crypto_stream_chacha20_ietf_xor(data, data, body.size(), nonce.data(), key.data());
}

std::uint64_t FrameKeys::EpochOf(std::uint64_t onboard_nonce, std::uint64_t offboard_nonce) const {
  std::array<std::uint8_t, 16> nonces{};
  PutLittleEndian(onboard_nonce, std::span(nonces).subspan(0, 8));
  PutLittleEndian(offboard_nonce, std::span(nonces).subspan(8, 8));
  const LinkKey hash = Derive(authentication_key_, "epoch", nonces);
  const std::uint64_t epoch = GetLittleEndian(std::as_bytes(std::span(hash)).first(8));
  return epoch == 0 ? 1 : epoch;
}

std::size_t FrameSealer::HeadBytes(CounterForm form) const {
  return scope_.address_bytes() + 1 + (form == CounterForm::kWhole ? kWholeCounterBytes : scope_.echo_bytes);
}

std::vector<std::byte> FrameSealer::HeadOf(CounterForm form, std::uint64_t counter,
                                           std::uint64_t echo) const {
  std::vector<std::byte> head(HeadBytes(form));
  const auto rest = std::span(head).subspan(scope_.address_bytes());
  if (scope_.address != 0) head[0] = std::byte{scope_.address};
  if (form == CounterForm::kLowBits) {
    rest[0] = static_cast<std::byte>(counter & 0x7F);
    PutLittleEndian(echo, rest.subspan(1));
  } else {
    rest[0] = kWholeCounterTag;
    PutLittleEndian(counter, rest.subspan(1));
  }
  return head;
}

std::size_t FrameSealer::MaxBlockBundle(CounterForm form) const {
  return kMaxBlockBytes - HeadBytes(form) - scope_.code_bytes;
}

std::size_t FrameSealer::WireBytes(CounterForm form, std::size_t bundle_bytes, LineCode line_code) const {
  const std::size_t content = HeadBytes(form) + bundle_bytes + scope_.code_bytes;
  const std::size_t block = line_code == LineCode::kBlock ? BlockBytes(content) : 0;
  return block > 0 ? EncodedBlockBytes(block) + 1 : content + 2;
}

std::vector<std::byte> FrameSealer::Seal(std::uint64_t epoch, std::uint64_t counter, CounterForm form,
                                         std::span<const std::byte> bundle, std::uint64_t echo,
                                         LineCode line_code) const {
  if (bundle.size() > kMaxBundleBytes || counter > kMaxCounter || epoch == 0)
    throw std::invalid_argument("radio frame: bundle too long, counter used up or no epoch");
  const bool echoes = form == CounterForm::kLowBits && scope_.echo_bytes > 0;
  std::vector<std::byte> content = HeadOf(form, counter, echo);
  const std::size_t body_at = content.size();
  content.insert(content.end(), bundle.begin(), bundle.end());
  const std::size_t block_bytes =
      line_code == LineCode::kBlock ? BlockBytes(content.size() + scope_.code_bytes) : 0;
  if (block_bytes > 0) content.resize(block_bytes - scope_.code_bytes);
  const auto body = std::span(content).subspan(body_at);
  std::vector<std::byte> code(scope_.code_bytes);
  keys_.Authenticate(
      DataHeader(direction_, scope_, epoch, counter, echoes ? std::optional(echo) : std::nullopt), body,
      code);
  if (scope_.encrypted) keys_.Crypt(direction_, epoch, counter, code, body);
  content.insert(content.end(), code.begin(), code.end());
  return Delimited(block_bytes > 0 ? EncodeBlock(content) : CobsEncode(content));
}

std::vector<std::byte> FrameSealer::Seal(const Hello& hello, LineCode line_code) const {
  const auto body = EncodeHello(hello);
  std::array<std::byte, kHelloCodeBytes> code{};
  keys_.Authenticate(HelloHeader(direction_, scope_), body, code);
  std::vector<std::byte> content(scope_.address_bytes() + 1 + body.size() + code.size());
  content.front() = std::byte{scope_.address};
  content[scope_.address_bytes()] = kHelloTag;
  std::copy(code.begin(), code.end(),
            std::copy(body.begin(), body.end(),
                      content.begin() + static_cast<std::ptrdiff_t>(scope_.address_bytes() + 1)));
  return Delimited(line_code == LineCode::kBlock ? EncodeBlock(content) : CobsEncode(content));
}

void FrameOpener::SetEpoch(std::uint64_t epoch, std::uint64_t floor) {
  epoch_ = epoch;
  window_ = ReplayWindow(floor);
}

bool FrameOpener::Addressed(std::span<const std::byte> content) const {
  return scope_.address == 0 || (!content.empty() && content.front() == std::byte{scope_.address});
}

Opened FrameOpener::Open(std::span<const std::byte> content, std::uint64_t newest_sent) {
  if (content.size() < 1 + scope_.code_bytes) return Reject::kMalformed;
  return content.front() == kHelloTag ? OpenHello(content) : OpenData(content, newest_sent);
}

std::optional<FrameHead> FrameOpener::Look(std::span<const std::byte> content,
                                           std::uint64_t newest_sent) const {
  if (content.size() < 1 + scope_.code_bytes) return std::nullopt;
  if (content.front() == kHelloTag) {
    if (content.size() != 1 + kHelloBodyBytes + kHelloCodeBytes) return std::nullopt;
    return FrameHead{.hello = true};
  }
  const auto head = HeadOf(content, newest_sent);
  if (!head) return std::nullopt;
  return FrameHead{.counter = head->counter, .echo = head->echo};
}

std::optional<FrameOpener::DataHead> FrameOpener::HeadOf(std::span<const std::byte> content,
                                                         std::uint64_t newest_sent) const {
  if (content[0] > kWholeCounterTag) return std::nullopt;
  DataHead head{.body_at = 1,
                .counter = window_.Reconstruct(std::to_integer<std::uint8_t>(content[0])),
                .echo = std::nullopt};
  const bool whole = content[0] == kWholeCounterTag;
  head.body_at += whole ? kWholeCounterBytes : scope_.echo_bytes;
  if (content.size() < head.body_at + scope_.code_bytes) return std::nullopt;
  if (whole) head.counter = GetLittleEndian(content.subspan(1, kWholeCounterBytes));
  if (!whole && scope_.echo_bytes > 0)
    head.echo = CompleteEcho(content.subspan(1, scope_.echo_bytes), newest_sent);
  return head;
}

Opened FrameOpener::OpenData(std::span<const std::byte> content, std::uint64_t newest_sent) {
  const auto head = HeadOf(content, newest_sent);
  if (!head) return Reject::kMalformed;
  if (epoch_ == 0) return Reject::kNoEpoch;
  const auto body = content.subspan(head->body_at, content.size() - head->body_at - scope_.code_bytes);
  const auto code = content.last(scope_.code_bytes);
  DataFrame frame{head->counter, {body.begin(), body.end()}, head->echo};
  if (scope_.encrypted) keys_.Crypt(direction_, epoch_, head->counter, code, frame.bundle);
  if (!Proves(code, *head, frame.bundle)) return Reject::kBadCode;
  if (!window_.Fresh(head->counter)) return Reject::kReplayed;
  window_.Use(head->counter);
  return frame;
}

bool FrameOpener::Proves(std::span<const std::byte> code, const DataHead& head,
                         std::span<const std::byte> bundle) const {
  std::vector<std::byte> right(code.size());
  keys_.Authenticate(DataHeader(direction_, scope_, epoch_, head.counter, head.echo), bundle, right);
  return sodium_memcmp(right.data(), code.data(), code.size()) == 0;
}

Opened FrameOpener::OpenHello(std::span<const std::byte> content) const {
  if (content.size() != 1 + kHelloBodyBytes + kHelloCodeBytes) return Reject::kMalformed;
  const auto body = content.subspan(1, kHelloBodyBytes);
  std::array<std::byte, kHelloCodeBytes> code{};
  keys_.Authenticate(HelloHeader(direction_, scope_), body, code);
  if (sodium_memcmp(code.data(), content.last(kHelloCodeBytes).data(), code.size()) != 0)
    return Reject::kBadCode;
  return DecodeHello(body);
}

}  // namespace priamos::bus::radio
