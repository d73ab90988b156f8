#include "bits.h"
#include "parts.h"

/* Events that come: each of one segment, in order and once. Those behind a missing one are kept, as far as
   there is room, and the acknowledgement says which. */

static pr_held* Find(pr_end* end, size_t channel, uint8_t number) {
  for (int i = 0; i < PR_HELD; ++i) {
    pr_held* held = &end->held[i];
    if (held->used && held->channel == channel && held->number == number) return held;
  }
  return 0;
}

static void Hold(pr_end* end, size_t channel, uint8_t number, const uint8_t* packed, size_t bits,
                 uint64_t time_us) {
  if (bits > 8 * PR_EVENT_BYTES || Find(end, channel, number) != 0) return;
  for (int i = 0; i < PR_HELD; ++i) {
    pr_held* held = &end->held[i];
    if (held->used) continue;
    held->used = true;
    held->channel = (uint8_t)channel;
    held->number = number;
    held->bits = (uint8_t)bits;
    held->time_us = time_us;
    for (size_t k = 0; k < (bits + 7) / 8; ++k) held->packed[k] = packed[k];
    return;
  }
}

void pr_forget_held(pr_end* end) {
  for (int i = 0; i < PR_HELD; ++i) end->held[i].used = false;
}

/* What is kept and would come before the next one was delivered in another life. */
static void ForgetBefore(pr_end* end, size_t channel, uint8_t next) {
  for (int i = 0; i < PR_HELD; ++i)
    if (end->held[i].channel == channel && (uint8_t)(end->held[i].number - next) >= 128)
      end->held[i].used = false;
}

static void DeliverHeld(pr_end* end, size_t channel) {
  pr_held* held;
  while ((held = Find(end, channel, end->memory.next[channel])) != 0) {
    held->used = false;
    ++end->memory.next[channel];
    pr_deliver(end, channel, held->packed, held->bits, held->time_us, 0);
  }
}

static void OnEvent(pr_end* end, size_t channel, uint8_t number, bool base, const uint8_t* packed,
                    size_t bits, uint64_t time_us) {
  if (!end->memory.known[channel]) {
    if (!base) return;
    end->memory.known[channel] = 1;
    end->memory.next[channel] = number;
    end->memory_dirty = true;
  }
  end->event_ack_due[channel] = true;
  const uint8_t ahead = (uint8_t)(number - end->memory.next[channel]);
  if (ahead >= 128) return; /* delivered before: its acknowledgement was lost */
  /* Before the oldest one that is not acknowledged none is missing, whatever this end remembers. */
  if (ahead > 0 && !base) {
    Hold(end, channel, number, packed, bits, time_us);
    return;
  }
  end->memory.next[channel] = (uint8_t)(number + 1);
  end->memory_dirty = true;
  ForgetBefore(end, channel, end->memory.next[channel]);
  pr_deliver(end, channel, packed, bits, time_us, 0);
  DeliverHeld(end, channel);
}

bool pr_take_events(pr_end* end, pr_bit_reader* in, size_t channel, const pr_arrival* arrival) {
  const pr_channel* c = &end->config->channels[channel];
  uint8_t number = (uint8_t)pr_get(in, 8);
  bool base = pr_get(in, 1) != 0;
  for (;; ++number, base = false) {
    const bool fixed = c->fixed_bits > 0;
    const bool first = fixed || pr_get(in, 1) != 0;
    const bool last = fixed || pr_get(in, 1) != 0;
    const uint64_t age_us = first ? pr_decode_duration((uint16_t)pr_get(in, 12)) : 0;
    const size_t bits = fixed ? c->fixed_bits : 8 * (last ? (size_t)pr_get(in, 5) : PR_EVENT_BYTES);
    uint8_t packed[(8 * 31) / 8];
    if (bits > 8 * sizeof packed || in->at + bits > in->size) return false;
    pr_get_bytes(in, packed, bits);
    const uint64_t time_us = arrival->now_us > age_us ? arrival->now_us - age_us : 0;
    /* A number of long ago may name another event; this one is repeated. */
    if (first && last && arrival->behind <= 1) OnEvent(end, channel, number, base, packed, bits, time_us);
    if (c->urgent || in->at >= in->size || pr_get(in, 1) == 0) return true;
  }
}

uint16_t pr_held_behind_next(const pr_end* end, size_t channel) {
  uint16_t held = 0;
  for (int i = 0; i < PR_HELD; ++i) {
    const uint8_t behind = (uint8_t)(end->held[i].number - end->memory.next[channel] - 1);
    if (end->held[i].used && end->held[i].channel == channel && behind < 16)
      held = (uint16_t)(held | 1U << behind);
  }
  return held;
}
