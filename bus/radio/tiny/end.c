#include "bits.h"
#include "line_code.h"
#include "parts.h"

/* The end itself: bytes of the line to frames, and what waits to frames for the line. */

enum { kFrameAckGap_us = 250000, kFramesPerAck = 24, kAhead = 2, kIdleBytes = 16, kTriesBurst = 8 };
enum { kUnusableAfter = 3, kLongGap_us = 60000000, kSaveAgain_us = 100000 };

static uint64_t ByteTime(const pr_end* end) {
  return (1000000 + end->config->bytes_per_s - 1) / end->config->bytes_per_s;
}

bool pr_up(const pr_end* end, uint64_t now_us) {
  return end->in.heard && now_us - end->in.heard_us <= end->config->silence_us;
}

pr_reception pr_reception_of(const pr_end* end, uint64_t now_us) {
  if (end->memory.epoch == 0) return PR_UNUSABLE;
  if (pr_up(end, now_us)) return PR_HEARD;
  return end->in.unusable >= kUnusableAfter ? PR_UNUSABLE : PR_SILENT;
}

pr_status pr_offer(pr_end* end, size_t channel, const uint8_t* packed, size_t bits) {
  if (channel >= end->config->n_channels || bits == 0 || bits > 8 * PR_STATE_BYTES) return PR_BAD_MESSAGE;
  const pr_channel* c = &end->config->channels[channel];
  const bool is_state = c->channel_class == PR_STATE || c->channel_class == PR_DELTA_STATE;
  if (c->direction != PR_UP || !is_state || bits > c->max_bits ||
      (c->fixed_bits > 0 && bits != c->fixed_bits))
    return PR_BAD_MESSAGE;
  int slot = -1;
  for (int i = 0; i < PR_STATES; ++i)
    if (end->states[i].bits > 0 && end->states[i].channel == channel) slot = i;
  for (int i = 0; i < PR_STATES && slot < 0; ++i)
    if (end->states[i].bits == 0) slot = i;
  if (slot < 0) return PR_FULL;
  for (size_t i = 0; i < (bits + 7) / 8; ++i) end->states[slot].packed[i] = packed[i];
  end->states[slot].bits = (uint16_t)bits;
  end->states[slot].channel = (uint8_t)channel;
  return PR_OK;
}

/* ---- what comes ---- */

/* At most as many codes are computed as frames fit on the line: nobody guesses faster. */
static bool MayTry(pr_end* end, uint64_t now_us) {
  const uint64_t each_us = (3U + end->scope.code_bytes) * ByteTime(end);
  const uint64_t most_us = kTriesBurst * each_us;
  uint64_t credit_us = end->in.tries_credit_us + (now_us - end->in.tries_us);
  if (credit_us > most_us) credit_us = most_us;
  end->in.tries_us = now_us;
  end->in.tries_credit_us = (uint32_t)(credit_us < each_us ? credit_us : credit_us - each_us);
  return credit_us >= each_us;
}

static void OnData(pr_end* end, const pr_data* data, uint64_t highest_before, uint64_t now_us) {
  if (!pr_note_accepted(end, data->counter))
    return; /* else it might be accepted again after a loss of power */
  const uint64_t ahead = data->counter > highest_before ? data->counter - highest_before : 0;
  const bool link_back = !pr_up(end, now_us);
  end->in.heard = true;
  end->in.heard_us = now_us;
  end->in.unusable = 0;
  if (ahead > 0) {
    end->in.newest_us = now_us;
    end->ack.in_turn = (ahead < 64 ? end->ack.in_turn << ahead : 0) | 1;
  }
  if (end->ack.unacknowledged < 255) ++end->ack.unacknowledged;
  if (link_back) end->ack.ever = false;
  pr_on_data(end);
  const uint64_t behind = end->in.window.highest - data->counter;
  const pr_arrival arrival = {now_us, ahead, behind, data->has_echo, data->echo};
  pr_take_bundle(end, data->bundle, data->bundle_bytes, &arrival);
}

static void OnContent(pr_end* end, const uint8_t* content, size_t n, uint64_t now_us) {
  if (n == 0 || !MayTry(end, now_us)) return;
  pr_data data;
  pr_hello hello;
  const uint64_t highest = end->in.window.highest;
  switch (pr_open(&end->scope, end->memory.epoch, &end->in.window, end->next_counter - 1, content, n, &data,
                  &hello)) {
    case PR_HELLO:
      pr_on_hello(end, &hello, now_us);
      break;
    case PR_DATA:
      OnData(end, &data, highest, now_us);
      break;
    case PR_NOTHING:
      if (end->in.unusable < 255) ++end->in.unusable;
      break;
  }
}

static void OnFrame(pr_end* end, uint64_t now_us) {
  uint8_t content[PR_RX];
  const size_t block = pr_block_decode(end->in.bytes, end->in.n, content);
  const size_t n = block > 0 ? block : pr_cobs_decode(end->in.bytes, end->in.n, content);
  OnContent(end, content, n, now_us);
}

void pr_receive(pr_end* end, const uint8_t* bytes, size_t n, uint64_t now_us) {
  for (size_t i = 0; i < n; ++i) {
    if (bytes[i] != 0) {
      if (end->in.n < PR_RX)
        end->in.bytes[end->in.n++] = bytes[i];
      else
        end->in.too_long = true;
      continue;
    }
    if (!end->in.too_long && end->in.n > 0) OnFrame(end, now_us);
    end->in.n = 0;
    end->in.too_long = false;
  }
}

/* ---- what goes ---- */

static bool FrameAckDue(const pr_end* end, uint64_t now_us) {
  return end->ack.unacknowledged > 0 && (end->ack.unacknowledged >= kFramesPerAck || !end->ack.ever ||
                                         now_us - end->ack.last_us >= kFrameAckGap_us);
}

static bool DataDue(const pr_end* end, uint64_t now_us) {
  if (now_us - end->last_data_us >= end->config->keep_alive_us || FrameAckDue(end, now_us)) return true;
  for (size_t i = 0; i < end->config->n_channels; ++i)
    if (end->event_ack_due[i]) return true;
  for (int i = 0; i < PR_STATES; ++i)
    if (end->states[i].bits > 0) return true;
  return false;
}

static void PutControl(pr_end* end, pr_bit_writer* w, unsigned kind) {
  pr_put(w, end->config->n_channels + 1, end->id_bits);
  pr_put(w, kind, 3);
}

static void PutAcknowledgements(pr_end* end, pr_bit_writer* w, uint64_t now_us) {
  if (FrameAckDue(end, now_us)) {
    PutControl(end, w, PR_FRAME_ACK);
    pr_put(w, end->in.window.highest & 0xFFF, 12);
    pr_put(w, end->ack.in_turn >> 1 & 0xF, 4);
    pr_put(w, pr_encode_duration(now_us - end->in.newest_us), 12);
    pr_put(w, 0, 4); /* losses are not measured */
    end->ack.unacknowledged = 0;
    end->ack.ever = true;
    end->ack.last_us = now_us;
  }
  if (end->floor_due) {
    PutControl(end, w, PR_FLOOR);
    pr_put(w, end->memory.floor_bound, 40);
  }
  for (size_t i = 0; i < end->config->n_channels; ++i) {
    if (!end->event_ack_due[i] || w->bits + 64 > w->room) continue;
    PutControl(end, w, PR_EVENT_ACK);
    pr_put(w, i + 1, end->id_bits);
    pr_put(w, end->memory.next[i], 8);
    const uint16_t held = pr_held_behind_next(end, i);
    pr_put(w, 0, 6); /* the next one is missing */
    pr_put(w, held != 0, 1);
    if (held != 0) pr_put(w, held, 16);
    end->event_ack_due[i] = false;
  }
}

static void PutStates(pr_end* end, pr_bit_writer* w) {
  for (int i = 0; i < PR_STATES; ++i) {
    const size_t bits = end->states[i].bits;
    const pr_channel* c = &end->config->channels[end->states[i].channel];
    if (bits == 0 || w->bits + end->id_bits + 9 + bits > w->room) continue;
    pr_put(w, end->states[i].channel + 1U, end->id_bits);
    if (c->channel_class == PR_DELTA_STATE) pr_put(w, 0, 1);
    if (c->fixed_bits == 0) pr_put(w, (bits + 7) / 8, 8);
    pr_put_bytes(w, end->states[i].packed, c->fixed_bits > 0 ? bits : (bits + 7) / 8 * 8);
    end->states[i].bits = 0;
  }
}

static void BuildData(pr_end* end, uint64_t now_us) {
  uint8_t bundle[PR_BUNDLE] = {0};
  const uint64_t counter = pr_take_counter(end);
  if (counter == 0) return;
  pr_bit_writer w = {bundle, 8 * sizeof bundle, 0};
  PutAcknowledgements(end, &w, now_us);
  PutStates(end, &w);
  const bool whole = !end->ack.confirmed_known || counter > end->ack.confirmed + 64;
  end->out_n =
      pr_seal(&end->scope, end->memory.epoch, counter, whole, bundle, (w.bits + 7) / 8, end->out + 1);
  end->out_counter = counter;
  end->last_data_us = now_us;
}

/* The next frame, behind a zero when the line was idle; false when nothing is to be said. */
static bool Build(pr_end* end, uint64_t now_us) {
  if (end->memory_dirty) return false; /* no acknowledgement leaves before what it says is kept */
  end->out_n = 0;
  end->out[0] = 0;
  if (pr_hello_due(end, now_us)) {
    const pr_hello hello = pr_take_hello(end, now_us);
    end->out_n = pr_seal_hello(&end->scope, &hello, end->out + 1);
    end->out_counter = 0;
  } else if (end->memory.epoch != 0 && DataDue(end, now_us)) {
    BuildData(end, now_us);
  }
  if (end->out_n == 0) return false;
  const bool idle = now_us > end->line_free_us && now_us - end->line_free_us >= kIdleBytes * ByteTime(end);
  end->out_at = idle ? 0 : 1;
  ++end->out_n; /* with the zero before it */
  return true;
}

size_t pr_step(pr_end* end, uint64_t now_us, uint8_t* out, size_t room) {
  /* 32 bits of time would not tell a frame of before so long a pause from a new one. */
  if (now_us - end->last_step_us > kLongGap_us) end->handed_from = end->next_counter;
  end->last_step_us = now_us;
  /* At once after events were handed on, whatever is on the line: a reset in between would double them. */
  if (end->memory_dirty && now_us >= end->save_at_us && !pr_memory_save(end))
    end->save_at_us = now_us + kSaveAgain_us;
  size_t n = 0;
  while (n < room && end->line_free_us <= now_us + kAhead * ByteTime(end)) {
    if (end->out_at >= end->out_n && !Build(end, now_us)) break;
    out[n++] = end->out[end->out_at++];
    end->line_free_us = (end->line_free_us > now_us ? end->line_free_us : now_us) + ByteTime(end);
    /* Noise can stand in for the zero at the end. */
    if (end->out_counter != 0 && end->out_at + 1 == end->out_n)
      end->handed_us[end->out_counter % PR_HANDED] = (uint32_t)now_us;
  }
  return n;
}
