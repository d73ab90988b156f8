#ifndef PR_LINE_CODE_H
#define PR_LINE_CODE_H

#include <stddef.h>
#include <stdint.h>

/* COBS (Cheshire, Baker 1999) of at most 254 bytes; `out` has room for n + 1. Returns the length. */
size_t pr_cobs_encode(const uint8_t* bytes, size_t n, uint8_t* out);
/* The content of what lay between two zeros; `out` has room for n. Returns its length, 0 when it is none. */
size_t pr_cobs_decode(const uint8_t* bytes, size_t n, uint8_t* out);
/* The content of a block, whose errors are not corrected: the code of the frame tells whether it has any.
   Returns its length, 0 when the bytes have not the form of a block. */
size_t pr_block_decode(const uint8_t* bytes, size_t n, uint8_t* out);

#endif
