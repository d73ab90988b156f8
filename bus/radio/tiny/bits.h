#ifndef PR_BITS_H
#define PR_BITS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Writes numbers bit by bit, most significant first, into a buffer that the caller has set to zero. */
typedef struct {
  uint8_t* bytes;
  size_t room; /* [bit] */
  size_t bits; /* written */
} pr_bit_writer;

void pr_put(pr_bit_writer* w, uint64_t value, unsigned bits);
void pr_put_bytes(pr_bit_writer* w, const uint8_t* bytes, size_t bits);

/* Reads them back. What is beyond the end reads as zero and sets `failed`. */
typedef struct {
  const uint8_t* bytes;
  size_t size; /* [bit] */
  size_t at;
  bool failed;
} pr_bit_reader;

uint64_t pr_get(pr_bit_reader* r, unsigned bits);
/* `out` gets the bits from its first one on, the rest of its last byte zero. */
void pr_get_bytes(pr_bit_reader* r, uint8_t* out, size_t bits);

#endif
