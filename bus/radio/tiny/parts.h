#ifndef PR_PARTS_H
#define PR_PARTS_H

#include "bits.h"
#include "priamos_radio.h"

/* What the parts of an end are to each other. */

/* How well this end can use what the other one sends. */
typedef enum { PR_HEARD, PR_SILENT, PR_UNUSABLE } pr_reception;

/* Reads what was saved; without it, or after another table, begins without an epoch and with a new stream. */
void pr_memory_load(pr_end* end);
bool pr_memory_save(pr_end* end);
/* The counter for the next frame; 0 when it could not be noted. */
uint64_t pr_take_counter(pr_end* end);
/* Notes that a frame of this counter is accepted; false when it could not be noted. */
bool pr_note_accepted(pr_end* end, uint64_t counter);

void pr_hello_init(pr_end* end, uint64_t now_us);
void pr_on_hello(pr_end* end, const pr_hello* hello, uint64_t now_us);
/* Notes that data of the epoch in use came. */
void pr_on_data(pr_end* end);
bool pr_hello_due(const pr_end* end, uint64_t now_us);
pr_hello pr_take_hello(pr_end* end, uint64_t now_us);

pr_reception pr_reception_of(const pr_end* end, uint64_t now_us);

/* A frame that was accepted; `ahead`: by how much its counter is the highest so far, 0 when it is not;
   `behind`: by how much it was overtaken. */
typedef struct {
  uint64_t now_us;
  uint64_t ahead;
  uint64_t behind;
  bool has_echo;
  uint64_t echo;
} pr_arrival;
/* Takes the entries of a bundle; what cannot be read ends it. */
void pr_take_bundle(pr_end* end, const uint8_t* bundle, size_t n, const pr_arrival* arrival);

void pr_deliver(pr_end* end, size_t channel, const uint8_t* packed, size_t bits, uint64_t time_us,
                uint64_t valid_until_us);

/* A run of segments of one channel, each a whole event; false when it cannot be read. */
bool pr_take_events(pr_end* end, pr_bit_reader* in, size_t channel, const pr_arrival* arrival);
/* Bit i: event i + 1 behind the next one of the channel is here already. */
uint16_t pr_held_behind_next(const pr_end* end, size_t channel);
void pr_forget_held(pr_end* end);

/* Durations in 12 bits: exponent of 4 and mantissa, in ms. */
uint16_t pr_encode_duration(uint64_t us);
uint64_t pr_decode_duration(uint16_t code);

/* Entries of control, by their number in a bundle. */
enum { PR_FRAME_ACK, PR_EVENT_ACK, PR_FLOOR, PR_LISTEN, PR_OVER, PR_FORGET, PR_NEXT_KEY };

#endif
