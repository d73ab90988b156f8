#ifndef PRIAMOS_RADIO_H
#define PRIAMOS_RADIO_H

/* The onboard end of a PRIAMOS radio link for a microcontroller: sends states, takes commands and events such
   as the emergency stop. No allocation, no clock, no I/O: time, bytes and memory are arguments. README.md
   says what it leaves out, ../PROTOCOL.md how the bytes look. */

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "frame.h"

#ifndef PR_MAX_CHANNELS
#define PR_MAX_CHANNELS 24
#endif
#ifndef PR_STATES /* states that can wait at once, one for each channel that this end sends */
#define PR_STATES 4
#endif
#ifndef PR_STATE_BYTES /* longest of them, packed */
#define PR_STATE_BYTES 64
#endif
#ifndef PR_HELD /* events that are kept until one before them has come, 40 bytes each */
#define PR_HELD 8
#endif
#if PR_STATE_BYTES > 112
#error "PR_STATE_BYTES: expected at most 112, what fits a frame"
#endif

enum { PR_STATE = 0, PR_EVENT = 1, PR_COMMAND = 2, PR_DELTA_STATE = 3 };

/* A line of the channel table of PROTOCOL.md; `priamos link table --c` prints them. */
typedef struct {
  const char* name;
  uint64_t meaning;      /* fingerprint XOR the hash of the bit table */
  uint8_t direction;     /* PR_UP: this end sends it; PR_DOWN */
  uint8_t channel_class; /* PR_STATE ... */
  uint16_t fixed_bits;   /* 0: the size varies */
  uint16_t max_bits;
  uint32_t ttl_us;    /* of a command, else 0 */
  bool urgent;        /* not in the table's hash: as link.toml has it */
  const char* widths; /* of a PR_DELTA_STATE: "15,13,3"; else null */
} pr_channel;

/* A message that came. `packed` is valid during the call. */
typedef struct {
  size_t channel;
  const uint8_t* packed;
  size_t bits;
  uint64_t time_us;        /* when it was offered there, by this clock; of a command: then or later */
  uint64_t valid_until_us; /* of a command: obey it until then; else 0 */
} pr_delivery;

typedef struct {
  const pr_channel* channels; /* in the order of link.toml */
  size_t n_channels;
  const uint8_t* key; /* 32 bytes */
  bool encrypted;
  uint8_t code_bytes;            /* 4, 6 or 8, as at the other end */
  uint32_t bytes_per_s;          /* of the line */
  uint32_t keep_alive_us;        /* longest silence of this end; 250000, at most 8000000 */
  uint32_t silence_us;           /* the link is down after so long without a frame; 1500000 */
  void* user;                    /* first argument of the functions */
  /* An unpredictable number. Where there is a clock or a count of starts, its low 28 bits stand before 36 unpredictable
     ones: the other end then tells this life from recorded earlier ones at once. */
  uint64_t (*nonce)(void* user);
  /* Reads what was saved last into `bytes`, and returns its length; 0: nothing. */
  size_t (*load)(void* user, uint8_t* bytes, size_t room);
  /* Keeps it over a loss of power, before it returns true. Called once per 256 frames, and per event. */
  bool (*save)(void* user, const uint8_t* bytes, size_t n);
  void (*deliver)(void* user, const pr_delivery* delivery);
} pr_config;

/* Bytes that `load` and `save` have room for. */
enum { PR_MEMORY_BYTES = 54 + 2 * PR_MAX_CHANNELS };

enum { PR_NONCES = 8, PR_HANDED = 256, PR_RX = 256, PR_BUNDLE = 120 };

/* The last random numbers that something was noted of. */
typedef struct {
  uint64_t all[PR_NONCES];
  uint8_t next;
} pr_nonces;

enum { PR_EVENT_BYTES = 26 }; /* longest event, packed */

/* An event that came before one that is missing. */
typedef struct {
  uint64_t time_us;
  uint8_t channel, number, bits;
  bool used;
  uint8_t packed[PR_EVENT_BYTES];
} pr_held;

/* One end. Its members are its own; they are here so that the caller can place it. */
typedef struct {
  const pr_config* config;
  pr_scope scope;
  uint8_t id_bits;
  struct { /* what is saved */
    uint64_t epoch, send_bound, floor_bound;
    uint32_t stream, peer_stream;
    uint8_t next[PR_MAX_CHANNELS], known[PR_MAX_CHANNELS]; /* of events */
  } memory;
  bool memory_dirty;
  uint64_t next_counter;
  bool floor_due;

  struct { /* agreement on an epoch */
    uint64_t own, agreed_own, agreed_peer, asking, drawn_last;
    bool used, agreed, asked, by_time, reply_due, switched;
    pr_nonces answered, refuted;
    uint64_t last_us, refilled_us;
    uint32_t credit_us; /* for answers */
  } hello;

  struct { /* reception */
    pr_window window;
    uint8_t bytes[PR_RX];
    size_t n;
    bool too_long, heard;
    uint64_t heard_us, tries_us, newest_us;
    uint32_t tries_credit_us;
    uint8_t unusable;
  } in;

  struct { /* acknowledgements of frames */
    uint64_t confirmed, in_turn, last_us;
    bool confirmed_known, ever;
    uint8_t unacknowledged;
  } ack;
  bool event_ack_due[PR_MAX_CHANNELS];
  pr_held held[PR_HELD];
  uint64_t wanted; /* bit i: somebody listens to channel i */

  uint64_t save_at_us; /* not before, after it failed */
  uint32_t handed_us[PR_HANDED]; /* when the frame of a counter, modulo PR_HANDED, was handed over */
  uint64_t handed_from;          /* counters before it are not remembered */
  uint64_t last_step_us;

  struct {
    uint8_t packed[PR_STATE_BYTES];
    uint16_t bits; /* 0: free */
    uint8_t channel;
  } states[PR_STATES];

  uint8_t out[PR_BUNDLE + 20];
  size_t out_n, out_at;
  uint64_t out_counter; /* of the data frame that is being sent; 0: a hello */
  uint64_t line_free_us, last_data_us;
} pr_end;

typedef enum {
  PR_OK = 0,
  PR_BAD_TABLE,   /* more than PR_MAX_CHANNELS, or a channel that this end cannot serve: see README.md */
  PR_BAD_CONFIG,  /* a null pointer, a code of another length, a line without bytes */
  PR_BAD_MESSAGE, /* not a state of this end, of another size than the table says, or too long */
  PR_FULL         /* PR_STATES others wait */
} pr_status;

/* Makes an end from what was saved. `config` must outlive it. */
pr_status pr_init(pr_end* end, const pr_config* config, uint64_t now_us);
/* Offers a state of which the newest is sent; `packed` is copied. */
pr_status pr_offer(pr_end* end, size_t channel, const uint8_t* packed, size_t bits);
/* Writes the bytes that may go on the line now, at most `room`, and returns their number. To be called every
   1 or 2 ms; the bytes must not leave before `now_us`, which never decreases. */
size_t pr_step(pr_end* end, uint64_t now_us, uint8_t* out, size_t room);
/* Takes bytes of the line, read at `now_us` or before. */
void pr_receive(pr_end* end, const uint8_t* bytes, size_t n, uint64_t now_us);
/* Whether a frame came of late. */
bool pr_up(const pr_end* end, uint64_t now_us);
/* Whether somebody at the other end listens to an on-request channel. */
bool pr_wanted(const pr_end* end, size_t channel);
/* Hash of the channel table, which both ends must share. */
uint32_t pr_table_hash(const pr_config* config);

#endif
