#ifndef PR_CHACHA20_H
#define PR_CHACHA20_H

#include <stddef.h>
#include <stdint.h>

/* Combines `bytes` with the ChaCha20 key stream (RFC 8439) of a key of 32 bytes, block counter 0 and a nonce
   of zeros. The key must be of this frame alone. */
void pr_chacha20(const uint8_t* key, uint8_t* bytes, size_t n);

#endif
