#ifndef PR_FRAME_H
#define PR_FRAME_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Frames as PROTOCOL.md has them: this end seals those that go up, to the workstation, and opens those that
   come down. */
enum {
  PR_MAX_BUNDLE = 240,  /* [byte] */
  PR_MAX_CONTENT = 255, /* [byte] of a frame, before COBS */
  PR_HELLO_BODY = 25,   /* [byte] */
  PR_UP = 0,
  PR_DOWN = 1
};

typedef struct {
  uint8_t authentication_key[32];
  uint8_t encryption_key[32];
  uint32_t table_hash;
  uint8_t code_bytes; /* 4, 6 or 8 */
  uint8_t echo_bytes; /* of short frames that come down */
  bool encrypted;
} pr_scope;

typedef struct {
  uint32_t table_hash, stream;
  uint64_t nonce, echo;
  bool need, agreed, over;
  uint8_t code_bytes;
} pr_hello;

/* Counters of frames that came: each is accepted once. */
typedef struct {
  uint64_t highest;
  uint64_t used; /* bit i: highest - i */
} pr_window;

typedef enum { PR_NOTHING, PR_HELLO, PR_DATA } pr_frame_kind;

typedef struct {
  uint64_t counter;
  bool has_echo;
  uint64_t echo; /* counter of a frame of this end */
  uint8_t bundle[PR_MAX_BUNDLE];
  size_t bundle_bytes;
} pr_data;

/* Derives the two keys of a link key of 32 bytes. */
void pr_derive_keys(pr_scope* scope, const uint8_t* link_key);
/* The epoch of two fresh random numbers; never 0. */
uint64_t pr_epoch_of(const pr_scope* scope, uint64_t onboard_nonce, uint64_t offboard_nonce);

/* Seals a data frame, its counter whole or its lowest bits. `out` has room for PR_MAX_CONTENT + 2; returns
   the bytes for the line, zero at the end included. `bundle` is encrypted in place. */
size_t pr_seal(const pr_scope* scope, uint64_t epoch, uint64_t counter, bool whole, uint8_t* bundle,
               size_t bundle_bytes, uint8_t* out);
size_t pr_seal_hello(const pr_scope* scope, const pr_hello* hello, uint8_t* out);

/* Opens the content of a frame that came down. One code is computed. `sent`: newest counter of this end. */
pr_frame_kind pr_open(const pr_scope* scope, uint64_t epoch, pr_window* window, uint64_t sent,
                      const uint8_t* content, size_t n, pr_data* data, pr_hello* hello);

/* The first four bytes as a number. */
uint32_t pr_little_endian_32(const uint8_t* bytes);

#endif
