#include "blake2b.h"
#include "parts.h"

/* What outlives the power: bounds of counters, noted ahead in blocks, and the numbers of events. */

enum { kBlock = 256, kCheck = 4, kVersion = 1 };

static uint8_t* Put(uint8_t* at, uint64_t value, int n) {
  for (int i = 0; i < n; ++i) *at++ = (uint8_t)(value >> 8 * i);
  return at;
}

static uint64_t Get(const uint8_t** at, int n) {
  uint64_t value = 0;
  for (int i = 0; i < n; ++i) value |= (uint64_t) * (*at)++ << 8 * i;
  return value;
}

static void Check(const uint8_t* bytes, size_t n, uint8_t* check) {
  pr_blake2b hash;
  pr_blake2b_init(&hash, 16, 0, 0);
  pr_blake2b_update(&hash, bytes, n);
  pr_blake2b_final(&hash, check, kCheck);
}

static size_t Size(const pr_end* end) {
  return 1 + 4 + 8 * 3 + 4 * 2 + 2 * end->config->n_channels + kCheck;
}

/* Of which link the state is: the table, and a key that opens nothing. */
static uint32_t Link(const pr_end* end) {
  uint32_t key = 0;
  for (int i = 0; i < 4; ++i) key = key << 8 | end->scope.encryption_key[i];
  return end->scope.table_hash ^ key;
}

bool pr_memory_save(pr_end* end) {
  uint8_t bytes[PR_MEMORY_BYTES];
  const size_t size = Size(end);
  uint8_t* at = Put(bytes, kVersion, 1);
  at = Put(at, Link(end), 4);
  at = Put(at, end->memory.epoch, 8);
  at = Put(at, end->memory.send_bound, 8);
  at = Put(at, end->memory.floor_bound, 8);
  at = Put(at, end->memory.stream, 4);
  at = Put(at, end->memory.peer_stream, 4);
  for (size_t i = 0; i < end->config->n_channels; ++i) {
    at = Put(at, end->memory.next[i], 1);
    at = Put(at, end->memory.known[i], 1);
  }
  Check(bytes, size - kCheck, at);
  end->memory_dirty = !end->config->save(end->config->user, bytes, size);
  return !end->memory_dirty;
}

static bool Read(pr_end* end) {
  uint8_t bytes[PR_MEMORY_BYTES], check[kCheck];
  const size_t size = Size(end);
  if (end->config->load(end->config->user, bytes, sizeof bytes) != size) return false;
  Check(bytes, size - kCheck, check);
  for (int i = 0; i < kCheck; ++i)
    if (check[i] != bytes[size - kCheck + (size_t)i]) return false;
  const uint8_t* at = bytes;
  if (Get(&at, 1) != kVersion || Get(&at, 4) != Link(end)) return false;
  end->memory.epoch = Get(&at, 8);
  end->memory.send_bound = Get(&at, 8);
  end->memory.floor_bound = Get(&at, 8);
  end->memory.stream = (uint32_t)Get(&at, 4);
  end->memory.peer_stream = (uint32_t)Get(&at, 4);
  for (size_t i = 0; i < end->config->n_channels; ++i) {
    end->memory.next[i] = (uint8_t)Get(&at, 1);
    end->memory.known[i] = (uint8_t)Get(&at, 1);
  }
  return true;
}

void pr_memory_load(pr_end* end) {
  if (!Read(end)) {
    end->memory.epoch = 0;
    end->memory.send_bound = 1;
    end->memory.floor_bound = 0;
    end->memory.stream = (uint32_t)end->config->nonce(end->config->user);
    end->memory_dirty = true;
  }
  end->next_counter = end->memory.send_bound;
  end->in.window.highest = end->memory.floor_bound;
  end->in.window.used = ~UINT64_C(0);
  /* The other end may still send counters that count as used here. */
  end->floor_due = end->memory.epoch != 0;
}

uint64_t pr_take_counter(pr_end* end) {
  if (end->next_counter >= end->memory.send_bound) {
    end->memory.send_bound = end->next_counter + kBlock;
    if (!pr_memory_save(end)) {
      end->memory.send_bound = end->next_counter;
      return 0;
    }
  }
  return end->next_counter++;
}

bool pr_note_accepted(pr_end* end, uint64_t counter) {
  const uint64_t before = end->memory.floor_bound;
  if (counter <= before) return true;
  end->memory.floor_bound = counter + kBlock;
  if (pr_memory_save(end)) return true;
  end->memory.floor_bound = before;
  return false;
}
