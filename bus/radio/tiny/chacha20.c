#include "chacha20.h"

static uint32_t Rotate(uint32_t x, unsigned by) {
  return x << by | x >> (32 - by);
}

static void Mix(uint32_t* x, unsigned a, unsigned b, unsigned c, unsigned d) {
  x[a] += x[b];
  x[d] = Rotate(x[d] ^ x[a], 16);
  x[c] += x[d];
  x[b] = Rotate(x[b] ^ x[c], 12);
  x[a] += x[b];
  x[d] = Rotate(x[d] ^ x[a], 8);
  x[c] += x[d];
  x[b] = Rotate(x[b] ^ x[c], 7);
}

static void Block(const uint32_t* state, uint8_t* out) {
  uint32_t x[16];
  for (int i = 0; i < 16; ++i) x[i] = state[i];
  for (int round = 0; round < 10; ++round) {
    for (unsigned i = 0; i < 4; ++i) Mix(x, i, i + 4, i + 8, i + 12);
    for (unsigned i = 0; i < 4; ++i) Mix(x, i, (i + 1) % 4 + 4, (i + 2) % 4 + 8, (i + 3) % 4 + 12);
  }
  for (int i = 0; i < 64; ++i) out[i] = (uint8_t)((x[i / 4] + state[i / 4]) >> 8 * (i % 4));
}

void pr_chacha20(const uint8_t* key, uint8_t* bytes, size_t n) {
  /* "expand 32-byte k", the key, the counter, the nonce. */
  uint32_t state[16] = {0x61707865, 0x3320646e, 0x79622d32, 0x6b206574};
  uint8_t stream[64];
  for (int i = 31; i >= 0; --i) state[4 + i / 4] = state[4 + i / 4] << 8 | key[i];
  for (size_t i = 0; i < n; ++i) {
    if (i % 64 == 0) {
      Block(state, stream);
      ++state[12];
    }
    bytes[i] = (uint8_t)(bytes[i] ^ stream[i % 64]);
  }
}
