#include "bits.h"

void pr_put(pr_bit_writer* w, uint64_t value, unsigned bits) {
  for (unsigned i = bits; i-- > 0 && w->bits < w->room; ++w->bits)
    if ((value >> i & 1) != 0)
      w->bytes[w->bits / 8] = (uint8_t)(w->bytes[w->bits / 8] | 0x80U >> w->bits % 8);
}

void pr_put_bytes(pr_bit_writer* w, const uint8_t* bytes, size_t bits) {
  for (size_t i = 0; i < bits; ++i) pr_put(w, (unsigned)bytes[i / 8] >> (7 - i % 8) & 1U, 1);
}

uint64_t pr_get(pr_bit_reader* r, unsigned bits) {
  uint64_t value = 0;
  for (unsigned i = 0; i < bits; ++i) {
    const bool there = r->at < r->size;
    r->failed = r->failed || !there;
    value = value << 1 | (there ? (unsigned)r->bytes[r->at / 8] >> (7 - r->at % 8) & 1U : 0U);
    if (there) ++r->at;
  }
  return value;
}

void pr_get_bytes(pr_bit_reader* r, uint8_t* out, size_t bits) {
  for (size_t i = 0; i < (bits + 7) / 8; ++i) {
    const size_t left = bits - 8 * i;
    const unsigned n = left < 8 ? (unsigned)left : 8U;
    out[i] = (uint8_t)(pr_get(r, n) << (8 - n));
  }
}
