#include "frame.h"

#include "blake2b.h"
#include "chacha20.h"
#include "line_code.h"

enum { kWhole = 0x80, kHello = 0x81, kHeader = 22, kCounterBytes = 5, kHelloCode = 8 };

static void Put(uint8_t* out, uint64_t value, size_t n) {
  for (size_t i = 0; i < n; ++i) out[i] = (uint8_t)(value >> 8 * i);
}

static uint64_t Get(const uint8_t* bytes, size_t n) {
  uint64_t value = 0;
  for (size_t i = n; i-- > 0;) value = value << 8 | bytes[i];
  return value;
}

uint32_t pr_little_endian_32(const uint8_t* bytes) {
  return (uint32_t)Get(bytes, 4);
}

static size_t LengthOf(const char* text) {
  size_t n = 0;
  while (text[n] != 0) ++n;
  return n;
}

static void Derive(const uint8_t* key, const char* purpose, const uint8_t* numbers, size_t n, uint8_t* out) {
  pr_blake2b hash;
  pr_blake2b_init(&hash, 32, key, 32);
  pr_blake2b_update(&hash, (const uint8_t*)purpose, LengthOf(purpose));
  pr_blake2b_update(&hash, numbers, n);
  pr_blake2b_final(&hash, out, 32);
}

void pr_derive_keys(pr_scope* scope, const uint8_t* link_key) {
  Derive(link_key, "priamos radio 1 authentication", 0, 0, scope->authentication_key);
  Derive(link_key, "priamos radio 1 encryption", 0, 0, scope->encryption_key);
}

uint64_t pr_epoch_of(const pr_scope* scope, uint64_t onboard_nonce, uint64_t offboard_nonce) {
  uint8_t nonces[16], hash[32];
  Put(nonces, onboard_nonce, 8);
  Put(nonces + 8, offboard_nonce, 8);
  Derive(scope->authentication_key, "epoch", nonces, sizeof nonces, hash);
  const uint64_t epoch = Get(hash, 8);
  return epoch == 0 ? 1 : epoch;
}

static void Authenticate(const pr_scope* scope, const uint8_t* header, size_t header_bytes,
                         const uint8_t* body, size_t n, uint8_t* code, size_t code_bytes) {
  pr_blake2b hash;
  pr_blake2b_init(&hash, 16, scope->authentication_key, 32);
  pr_blake2b_update(&hash, header, header_bytes);
  pr_blake2b_update(&hash, body, n);
  pr_blake2b_final(&hash, code, code_bytes);
}

static size_t DataHeader(const pr_scope* scope, uint8_t direction, uint64_t epoch, uint64_t counter,
                         const uint64_t* echo, uint8_t* out) {
  out[0] = (uint8_t)((scope->encrypted ? 3 : 1) + (echo != 0 ? 4 : 0));
  out[1] = direction;
  Put(out + 2, epoch, 8);
  Put(out + 10, counter, 8);
  Put(out + 18, scope->table_hash, 4);
  if (echo != 0) Put(out + kHeader, *echo, 8);
  return kHeader + (echo != 0 ? 8U : 0U);
}

static void Crypt(const pr_scope* scope, uint8_t direction, uint64_t epoch, uint64_t counter,
                  const uint8_t* code, uint8_t* body, size_t n) {
  uint8_t numbers[17 + 8], key[32];
  numbers[0] = direction;
  Put(numbers + 1, epoch, 8);
  Put(numbers + 9, counter, 8);
  for (size_t i = 0; i < scope->code_bytes; ++i) numbers[17 + i] = code[i];
  Derive(scope->encryption_key, "", numbers, 17U + scope->code_bytes, key);
  pr_chacha20(key, body, n);
}

static size_t Delimited(const uint8_t* content, size_t n, uint8_t* out) {
  const size_t length = pr_cobs_encode(content, n, out);
  out[length] = 0;
  return length + 1;
}

size_t pr_seal(const pr_scope* scope, uint64_t epoch, uint64_t counter, bool whole, uint8_t* bundle,
               size_t bundle_bytes, uint8_t* out) {
  uint8_t header[kHeader + 8], content[PR_MAX_CONTENT];
  size_t n = 0;
  content[n++] = whole ? kWhole : (uint8_t)(counter & 0x7F);
  if (whole) {
    Put(content + n, counter, kCounterBytes);
    n += kCounterBytes;
  }
  uint8_t code[8];
  const size_t header_bytes = DataHeader(scope, PR_UP, epoch, counter, 0, header);
  Authenticate(scope, header, header_bytes, bundle, bundle_bytes, code, scope->code_bytes);
  if (scope->encrypted) Crypt(scope, PR_UP, epoch, counter, code, bundle, bundle_bytes);
  for (size_t i = 0; i < bundle_bytes; ++i) content[n++] = bundle[i];
  for (size_t i = 0; i < scope->code_bytes; ++i) content[n++] = code[i];
  return Delimited(content, n, out);
}

static void HelloCode(const pr_scope* scope, uint8_t direction, const uint8_t* body, uint8_t* code) {
  uint8_t header[kHeader] = {2, direction};
  Authenticate(scope, header, kHeader, body, PR_HELLO_BODY, code, kHelloCode);
}

size_t pr_seal_hello(const pr_scope* scope, const pr_hello* hello, uint8_t* out) {
  uint8_t content[1 + PR_HELLO_BODY + kHelloCode] = {kHello};
  uint8_t* const body = content + 1;
  Put(body, hello->table_hash, 4);
  Put(body + 4, hello->stream, 4);
  Put(body + 8, hello->nonce, 8);
  Put(body + 16, hello->echo, 8);
  body[24] = (uint8_t)((hello->need ? 1 : 0) | (hello->agreed ? 2 : 0) | (hello->over ? 4 : 0) |
                       (hello->code_bytes - 4) / 2 << 3);
  HelloCode(scope, PR_UP, body, body + PR_HELLO_BODY);
  return Delimited(content, sizeof content, out);
}

/* Takes as long for every difference. */
static bool Same(const uint8_t* a, const uint8_t* b, size_t n) {
  uint8_t difference = 0;
  for (size_t i = 0; i < n; ++i) difference = (uint8_t)(difference | (a[i] ^ b[i]));
  return difference == 0;
}

static pr_frame_kind OpenHello(const pr_scope* scope, const uint8_t* content, size_t n, pr_hello* hello) {
  uint8_t code[kHelloCode];
  const uint8_t* const body = content + 1;
  if (n != 1 + PR_HELLO_BODY + kHelloCode) return PR_NOTHING;
  HelloCode(scope, PR_DOWN, body, code);
  if (!Same(code, body + PR_HELLO_BODY, kHelloCode)) return PR_NOTHING;
  hello->table_hash = pr_little_endian_32(body);
  hello->stream = pr_little_endian_32(body + 4);
  hello->nonce = Get(body + 8, 8);
  hello->echo = Get(body + 16, 8);
  hello->need = (body[24] & 1) != 0;
  hello->agreed = (body[24] & 2) != 0;
  hello->over = (body[24] & 4) != 0;
  hello->code_bytes = (uint8_t)(4 + 2 * (body[24] >> 3 & 3));
  return PR_HELLO;
}

static bool Fresh(const pr_window* w, uint64_t counter) {
  if (counter > w->highest) return true;
  return w->highest - counter < 64 && (w->used >> (w->highest - counter) & 1) == 0;
}

static void Use(pr_window* w, uint64_t counter) {
  if (counter > w->highest) {
    const uint64_t ahead = counter - w->highest;
    w->used = ahead < 64 ? w->used << ahead : 0;
    w->highest = counter;
  }
  w->used |= UINT64_C(1) << (w->highest - counter);
}

/* Counter and echo as they must be completed; returns where the bundle begins, 0 for no frame. */
static size_t ReadHead(const pr_scope* scope, const pr_window* window, uint64_t sent, const uint8_t* content,
                       size_t n, pr_data* data) {
  if (content[0] > kWhole) return 0;
  data->has_echo = content[0] != kWhole && scope->echo_bytes > 0;
  const size_t at = 1U + (content[0] == kWhole ? (size_t)kCounterBytes : scope->echo_bytes);
  if (n < at + scope->code_bytes || n - at - scope->code_bytes > PR_MAX_BUNDLE) return 0;
  if (content[0] == kWhole) {
    data->counter = Get(content + 1, kCounterBytes);
    return at;
  }
  const uint64_t first = window->highest < 31 ? 0 : window->highest - 31;
  data->counter = first + ((content[0] - first) & 0x7F);
  const uint64_t mask = (UINT64_C(1) << 8 * scope->echo_bytes) - 1;
  data->echo = sent - ((sent - Get(content + 1, scope->echo_bytes)) & mask);
  return at;
}

pr_frame_kind pr_open(const pr_scope* scope, uint64_t epoch, pr_window* window, uint64_t sent,
                      const uint8_t* content, size_t n, pr_data* data, pr_hello* hello) {
  uint8_t header[kHeader + 8], code[8];
  if (n < 1U + scope->code_bytes) return PR_NOTHING;
  if (content[0] == kHello) return OpenHello(scope, content, n, hello);
  const size_t at = ReadHead(scope, window, sent, content, n, data);
  if (at == 0 || epoch == 0) return PR_NOTHING;
  data->bundle_bytes = n - at - scope->code_bytes;
  for (size_t i = 0; i < data->bundle_bytes; ++i) data->bundle[i] = content[at + i];
  const uint8_t* const came = content + n - scope->code_bytes;
  if (scope->encrypted) Crypt(scope, PR_DOWN, epoch, data->counter, came, data->bundle, data->bundle_bytes);
  const size_t header_bytes =
      DataHeader(scope, PR_DOWN, epoch, data->counter, data->has_echo ? &data->echo : 0, header);
  Authenticate(scope, header, header_bytes, data->bundle, data->bundle_bytes, code, scope->code_bytes);
  if (!Same(code, came, scope->code_bytes) || !Fresh(window, data->counter)) return PR_NOTHING;
  Use(window, data->counter);
  return PR_DATA;
}
