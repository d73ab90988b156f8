#include "bits.h"
#include "parts.h"

/* What a frame that came carries. */

uint16_t pr_encode_duration(uint64_t us) {
  const uint64_t ms = (us + 500) / 1000;
  for (unsigned exponent = 0; exponent < 8; ++exponent) {
    const uint64_t unit = UINT64_C(1) << 2 * exponent;
    const uint64_t mantissa = (ms + unit / 2) / unit;
    if (mantissa < 512) return (uint16_t)(exponent << 9 | mantissa);
  }
  return 0xFFF;
}

uint64_t pr_decode_duration(uint16_t code) {
  return ((uint64_t)(code & 0x1FFU) << 2 * (code >> 9 & 7U)) * 1000;
}

/* Body of a message, its size before it when that varies; false when it cannot be. */
static bool TakeBody(pr_bit_reader* in, const pr_channel* c, uint8_t* body, size_t* bits) {
  *bits = c->fixed_bits > 0 ? c->fixed_bits : 8 * (size_t)pr_get(in, 8);
  if (*bits > 8 * PR_MAX_BUNDLE || in->at + *bits > in->size) return false;
  pr_get_bytes(in, body, *bits);
  return true;
}

void pr_deliver(pr_end* end, size_t channel, const uint8_t* packed, size_t bits, uint64_t time_us,
                uint64_t valid_until_us) {
  const pr_delivery delivery = {channel, packed, bits, time_us, valid_until_us};
  end->config->deliver(end->config->user, &delivery);
}

/* A command is as old as the frame of this end that it echoes, less what passed there since: it cannot be
   older, however long a modem has held either. */
static void OnCommand(pr_end* end, size_t channel, int offset, const uint8_t* packed, size_t bits,
                      const pr_arrival* arrival) {
  const int64_t ttl_us = end->config->channels[channel].ttl_us;
  if (arrival->ahead == 0 || !arrival->has_echo || arrival->echo < end->handed_from) return;
  if (arrival->echo >= end->next_counter || end->next_counter - arrival->echo > PR_HANDED) return;
  const uint32_t ago_us = (uint32_t)arrival->now_us - end->handed_us[arrival->echo % PR_HANDED];
  const int64_t steps = offset - 32;
  const int64_t offset_us = steps >= 0 ? steps * ttl_us / 32 : -((-steps * ttl_us + 31) / 32);
  const int64_t offered_us = (int64_t)arrival->now_us - (int64_t)ago_us + offset_us;
  if (offered_us + ttl_us < (int64_t)arrival->now_us) return;
  pr_deliver(end, channel, packed, bits, offered_us < 0 ? 0 : (uint64_t)offered_us,
          (uint64_t)(offered_us + ttl_us));
}

static bool TakeMessage(pr_end* end, pr_bit_reader* in, size_t channel, const pr_arrival* arrival) {
  const pr_channel* c = &end->config->channels[channel];
  uint8_t body[PR_MAX_BUNDLE];
  size_t bits = 0;
  if (c->direction != PR_DOWN) return false;
  if (c->channel_class == PR_EVENT) return pr_take_events(end, in, channel, arrival);
  const int offset = c->channel_class == PR_COMMAND ? (int)pr_get(in, 6) : 0;
  if (!TakeBody(in, c, body, &bits)) return false;
  if (c->channel_class == PR_COMMAND)
    OnCommand(end, channel, offset, body, bits, arrival);
  else if (arrival->ahead > 0)
    pr_deliver(end, channel, body, bits, arrival->now_us, 0);
  return true;
}

static void OnFrameAck(pr_end* end, uint64_t low) {
  const uint64_t sent = end->next_counter - 1;
  const uint64_t back = (sent - low) & 0xFFF;
  if (back > sent) return;
  if (!end->ack.confirmed_known || sent - back > end->ack.confirmed) end->ack.confirmed = sent - back;
  end->ack.confirmed_known = true;
}

static void OnFloor(pr_end* end, uint64_t floor) {
  end->ack.confirmed_known = false;
  if (floor < end->next_counter || floor - end->next_counter > UINT64_C(1) << 20) return;
  end->next_counter = floor + 1;
  end->handed_from = end->next_counter;
}

static bool TakeControl(pr_end* end, pr_bit_reader* in) {
  switch (pr_get(in, 3)) {
    case PR_FRAME_ACK: {
      const uint64_t low = pr_get(in, 12);
      pr_get(in, 4 + 12 + 4);
      if (!in->failed) OnFrameAck(end, low);
      return true;
    }
    case PR_EVENT_ACK: /* of events, which this end does not send */
      pr_get(in, end->id_bits);
      pr_get(in, 8 + 6);
      if (pr_get(in, 1) != 0) pr_get(in, 16);
      return true;
    case PR_FLOOR: {
      const uint64_t floor = pr_get(in, 40);
      if (!in->failed) OnFloor(end, floor);
      return true;
    }
    case PR_LISTEN: {
      const uint64_t wanted = pr_get(in, (unsigned)end->config->n_channels);
      if (!in->failed) end->wanted = wanted;
      return true;
    }
    case PR_NEXT_KEY:
      pr_get(in, 32);
      return true;
    case PR_OVER:
    case PR_FORGET:
      return true;
    default:
      return false;
  }
}

void pr_take_bundle(pr_end* end, const uint8_t* bundle, size_t n, const pr_arrival* arrival) {
  pr_bit_reader in = {bundle, 8 * n, 0, false};
  while (in.at + end->id_bits <= in.size) {
    const size_t id = (size_t)pr_get(&in, end->id_bits);
    if (id == 0 || id > end->config->n_channels + 1) return;
    const bool control = id == end->config->n_channels + 1;
    if (!(control ? TakeControl(end, &in) : TakeMessage(end, &in, id - 1, arrival)) || in.failed) return;
  }
}
