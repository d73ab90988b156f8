#include "line_code.h"

size_t pr_cobs_encode(const uint8_t* bytes, size_t n, uint8_t* out) {
  size_t code_at = 0, end = 1;
  for (size_t i = 0; i < n; ++i) {
    if (bytes[i] != 0) {
      out[end++] = bytes[i];
      continue;
    }
    out[code_at] = (uint8_t)(end - code_at);
    code_at = end++;
  }
  out[code_at] = (uint8_t)(end - code_at);
  return end;
}

size_t pr_cobs_decode(const uint8_t* bytes, size_t n, uint8_t* out) {
  size_t length = 0;
  for (size_t at = 0; at < n;) {
    const size_t code = bytes[at];
    if (code == 0 || at + code > n) return 0;
    for (size_t i = 1; i < code; ++i) out[length++] = bytes[at + i];
    at += code;
    if (at < n && code < 255) out[length++] = 0;
  }
  return length;
}

size_t pr_block_decode(const uint8_t* bytes, size_t n, uint8_t* out) {
  static const uint8_t kContents[7] = {11, 14, 17, 21, 24, 28, 34};
  enum { kParity = 8 };
  size_t content = 0;
  for (int i = 0; i < 7; ++i)
    if (n == (kContents[i] * 8U + 6U) / 7U + kParity) content = kContents[i];
  if (content == 0) return 0;
  uint32_t bits = 0;
  unsigned held = 0;
  size_t length = 0;
  for (size_t i = 0; i < n; ++i) {
    if ((bytes[i] & 0x80) == 0) return 0;
    bits = (bits << 7 | (bytes[i] & 0x7FU)) & 0xFFFFU;
    held += 7;
    if (held < 8 || length == content) continue;
    held -= 8;
    out[length++] = (uint8_t)(bits >> held);
  }
  return content;
}
