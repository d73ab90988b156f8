#include "blake2b.h"
#include "parts.h"

/* The table as both ends hash it, and what of it this end can serve. */

static void Text(pr_blake2b* hash, const char* text) {
  size_t n = 0;
  while (text[n] != 0) ++n;
  pr_blake2b_update(hash, (const uint8_t*)text, n);
}

static void Number(pr_blake2b* hash, uint64_t value, unsigned base, unsigned digits) {
  char text[21];
  size_t at = sizeof text;
  text[--at] = 0;
  do {
    text[--at] = "0123456789abcdef"[value % base];
    value /= base;
    digits -= digits > 0 ? 1 : 0;
  } while (value > 0 || digits > 0);
  Text(hash, text + at);
}

uint32_t pr_table_hash(const pr_config* config) {
  pr_blake2b hash;
  uint8_t out[4];
  pr_blake2b_init(&hash, 16, 0, 0);
  Text(&hash, config->encrypted ? "priamos radio 1 table sealed" : "priamos radio 1 table clear");
  if (config->code_bytes != 4) {
    Text(&hash, " code ");
    Number(&hash, config->code_bytes, 10, 1);
  }
  Text(&hash, "\n");
  for (size_t i = 0; i < config->n_channels; ++i) {
    const pr_channel* c = &config->channels[i];
    const uint64_t columns[] = {c->direction, c->channel_class, c->fixed_bits, c->max_bits, c->ttl_us};
    Text(&hash, c->name);
    Text(&hash, " ");
    Number(&hash, c->meaning, 16, 16);
    for (size_t k = 0; k < sizeof columns / sizeof columns[0]; ++k) {
      Text(&hash, " ");
      Number(&hash, columns[k], 10, 1);
    }
    if (c->channel_class == PR_DELTA_STATE) {
      Text(&hash, " ");
      Text(&hash, c->widths);
    }
    Text(&hash, "\n");
  }
  pr_blake2b_final(&hash, out, sizeof out);
  return pr_little_endian_32(out);
}

static bool Serves(const pr_channel* c) {
  if (c->name == 0 || c->direction > PR_DOWN || c->channel_class > PR_DELTA_STATE) return false;
  if (c->channel_class == PR_DELTA_STATE && (c->direction == PR_DOWN || c->widths == 0)) return false;
  if (c->channel_class == PR_COMMAND) return c->direction == PR_DOWN && c->ttl_us > 0;
  /* An event that comes must be one segment. */
  return c->channel_class != PR_EVENT || c->direction == PR_UP || c->max_bits <= 8 * PR_EVENT_BYTES;
}

/* Of so many frames, 32 bits of time tell when each was handed over. */
static const uint32_t kLongestKeepAlive_us = 8000000;

static bool HasCommands(const pr_config* config) {
  for (size_t i = 0; i < config->n_channels; ++i)
    if (config->channels[i].channel_class == PR_COMMAND) return true;
  return false;
}

pr_status pr_init(pr_end* end, const pr_config* config, uint64_t now_us) {
  const bool code = config->code_bytes == 4 || config->code_bytes == 6 || config->code_bytes == 8;
  if (!code || config->channels == 0 || config->bytes_per_s == 0 || config->keep_alive_us > kLongestKeepAlive_us ||
      config->key == 0 || config->nonce == 0 || config->load == 0 ||
      config->save == 0 || config->deliver == 0)
    return PR_BAD_CONFIG;
  if (config->n_channels == 0 || config->n_channels > PR_MAX_CHANNELS) return PR_BAD_TABLE;
  for (size_t i = 0; i < config->n_channels; ++i)
    if (!Serves(&config->channels[i])) return PR_BAD_TABLE;
  uint8_t* const bytes = (uint8_t*)end;
  for (size_t i = 0; i < sizeof *end; ++i) bytes[i] = 0;
  end->config = config;
  while ((UINT32_C(1) << end->id_bits) < config->n_channels + 2) ++end->id_bits;
  pr_derive_keys(&end->scope, config->key);
  end->scope.table_hash = pr_table_hash(config);
  end->scope.encrypted = config->encrypted;
  end->scope.code_bytes = config->code_bytes;
  end->scope.echo_bytes = (uint8_t)(!HasCommands(config) ? 0 : config->bytes_per_s <= 2000 ? 1 : 2);
  pr_memory_load(end);
  pr_hello_init(end, now_us);
  end->last_step_us = now_us;
  return PR_OK;
}

bool pr_wanted(const pr_end* end, size_t channel) {
  return channel < end->config->n_channels && (end->wanted >> channel & 1) != 0;
}
