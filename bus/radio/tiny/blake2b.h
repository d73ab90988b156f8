#ifndef PR_BLAKE2B_H
#define PR_BLAKE2B_H

#include <stddef.h>
#include <stdint.h>

/* BLAKE2b (RFC 7693), in pieces, with a key of up to 64 bytes or none. */
typedef struct {
  uint64_t h[8];
  uint8_t block[128];
  uint64_t length; /* bytes taken so far, the key's block included */
  size_t filled;   /* bytes in `block` */
  size_t out_bytes;
} pr_blake2b;

/* Begins a hash of `out_bytes` (1 to 64) bytes; `key_bytes` is 0 without a key. */
void pr_blake2b_init(pr_blake2b* s, size_t out_bytes, const uint8_t* key, size_t key_bytes);
void pr_blake2b_update(pr_blake2b* s, const uint8_t* bytes, size_t n);
/* Writes the first `n` bytes of the hash, at most `out_bytes`; the state is used up. */
void pr_blake2b_final(pr_blake2b* s, uint8_t* out, size_t n);

#endif
