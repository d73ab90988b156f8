#include "blake2b.h"

static const uint64_t kIv[8] = {UINT64_C(0x6a09e667f3bcc908), UINT64_C(0xbb67ae8584caa73b),
                                UINT64_C(0x3c6ef372fe94f82b), UINT64_C(0xa54ff53a5f1d36f1),
                                UINT64_C(0x510e527fade682d1), UINT64_C(0x9b05688c2b3e6c1f),
                                UINT64_C(0x1f83d9abfb41bd6b), UINT64_C(0x5be0cd19137e2179)};

/* Message word of each step; rounds 10 and 11 repeat 0 and 1. */
static const uint8_t kSigma[10][16] = {{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15},
                                       {14, 10, 4, 8, 9, 15, 13, 6, 1, 12, 0, 2, 11, 7, 5, 3},
                                       {11, 8, 12, 0, 5, 2, 15, 13, 10, 14, 3, 6, 7, 1, 9, 4},
                                       {7, 9, 3, 1, 13, 12, 11, 14, 2, 6, 5, 10, 4, 0, 15, 8},
                                       {9, 0, 5, 7, 2, 4, 10, 15, 14, 1, 11, 12, 6, 8, 3, 13},
                                       {2, 12, 6, 10, 0, 11, 8, 3, 4, 13, 7, 5, 15, 14, 1, 9},
                                       {12, 5, 1, 15, 14, 13, 4, 10, 0, 7, 6, 3, 9, 2, 8, 11},
                                       {13, 11, 7, 14, 12, 1, 3, 9, 5, 0, 15, 4, 8, 6, 2, 10},
                                       {6, 15, 14, 9, 11, 3, 0, 8, 12, 2, 13, 7, 1, 4, 10, 5},
                                       {10, 2, 8, 4, 7, 6, 1, 5, 15, 11, 9, 14, 3, 12, 13, 0}};

static uint64_t Rotate(uint64_t x, unsigned by) {
  return x >> by | x << (64 - by);
}

static uint64_t Word(const uint8_t* bytes) {
  uint64_t word = 0;
  for (int i = 7; i >= 0; --i) word = word << 8 | bytes[i];
  return word;
}

static void Mix(uint64_t* v, unsigned a, unsigned b, unsigned c, unsigned d, uint64_t x, uint64_t y) {
  v[a] += v[b] + x;
  v[d] = Rotate(v[d] ^ v[a], 32);
  v[c] += v[d];
  v[b] = Rotate(v[b] ^ v[c], 24);
  v[a] += v[b] + y;
  v[d] = Rotate(v[d] ^ v[a], 16);
  v[c] += v[d];
  v[b] = Rotate(v[b] ^ v[c], 63);
}

static void Compress(pr_blake2b* s, int is_last) {
  uint64_t v[16], m[16];
  for (int i = 0; i < 8; ++i) {
    v[i] = s->h[i];
    v[i + 8] = kIv[i];
  }
  v[12] ^= s->length;
  if (is_last) v[14] = ~v[14];
  for (int i = 0; i < 16; ++i) m[i] = Word(s->block + 8 * i);
  for (int round = 0; round < 12; ++round) {
    const uint8_t* o = kSigma[round % 10];
    /* First the columns, then the diagonals. */
    for (unsigned i = 0; i < 4; ++i) Mix(v, i, i + 4, i + 8, i + 12, m[o[2 * i]], m[o[2 * i + 1]]);
    for (unsigned i = 0; i < 4; ++i)
      Mix(v, i, (i + 1) % 4 + 4, (i + 2) % 4 + 8, (i + 3) % 4 + 12, m[o[8 + 2 * i]], m[o[9 + 2 * i]]);
  }
  for (int i = 0; i < 8; ++i) s->h[i] ^= v[i] ^ v[i + 8];
}

void pr_blake2b_init(pr_blake2b* s, size_t out_bytes, const uint8_t* key, size_t key_bytes) {
  for (int i = 0; i < 8; ++i) s->h[i] = kIv[i];
  s->h[0] ^= UINT64_C(0x01010000) ^ (uint64_t)key_bytes << 8 ^ (uint64_t)out_bytes;
  for (size_t i = 0; i < sizeof s->block; ++i) s->block[i] = i < key_bytes ? key[i] : 0;
  s->length = 0;
  s->filled = key_bytes > 0 ? sizeof s->block : 0;
  s->out_bytes = out_bytes;
}

void pr_blake2b_update(pr_blake2b* s, const uint8_t* bytes, size_t n) {
  for (size_t i = 0; i < n; ++i) {
    /* A full block waits: the last one is compressed otherwise. */
    if (s->filled == sizeof s->block) {
      s->length += s->filled;
      s->filled = 0;
      Compress(s, 0);
    }
    s->block[s->filled++] = bytes[i];
  }
}

void pr_blake2b_final(pr_blake2b* s, uint8_t* out, size_t n) {
  s->length += s->filled;
  while (s->filled < sizeof s->block) s->block[s->filled++] = 0;
  Compress(s, 1);
  for (size_t i = 0; i < n && i < s->out_bytes; ++i) out[i] = (uint8_t)(s->h[i / 8] >> 8 * (i % 8));
}
