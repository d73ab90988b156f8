#include "parts.h"

/* Agreement on an epoch: three hellos after an end has lost its memory, none otherwise. Only a hello that
   echoes the number drawn last here, before that number has proven another one, changes anything. */

enum { kRepeat_us = 300000, kAnnounce_us = 1000000, kAnswer_us = 500000, kMostAnswers = 4 };

static bool Has(const pr_nonces* nonces, uint64_t nonce) {
  for (int i = 0; i < PR_NONCES; ++i)
    if (nonces->all[i] == nonce) return true;
  return false;
}

static void Add(pr_nonces* nonces, uint64_t nonce) {
  if (Has(nonces, nonce)) return;
  nonces->all[nonces->next] = nonce;
  nonces->next = (uint8_t)((nonces->next + 1) % PR_NONCES);
}

/* Notes who asks; false when others come before it. One at most is the other end, the rest are replays of its earlier
   lives. The one whose number was drawn last, by the time in its high bits, gets every second answer. */
static bool Ask(pr_end* end, uint64_t nonce) {
  const pr_nonces* answered = &end->hello.answered;
  const bool first = !end->hello.asked, again = Has(answered, nonce);
  const uint64_t second = nonce >> 36, last = end->hello.drawn_last >> 36;
  const bool latest =
      first || second > last || (second == last && (!again || Has(answered, end->hello.drawn_last)));
  const bool newest = first || !again || Has(answered, end->hello.asking);
  if (first) end->hello.by_time = true;
  if (latest) end->hello.drawn_last = nonce;
  if (newest) end->hello.asking = nonce;
  end->hello.asked = true;
  return latest || newest;
}

static uint64_t Answered(pr_end* end) {
  const uint64_t nonce = end->hello.by_time ? end->hello.drawn_last : end->hello.asking;
  end->hello.by_time = !end->hello.by_time;
  Add(&end->hello.answered, nonce);
  return nonce;
}

static void Draw(pr_end* end) {
  end->hello.own = end->config->nonce(end->config->user);
  end->hello.used = false;
}

void pr_hello_init(pr_end* end, uint64_t now_us) {
  Draw(end);
  /* An end without an epoch asks at once; one with an epoch first gives its frames a chance. */
  end->hello.last_us = now_us < kRepeat_us ? 0 : now_us - kRepeat_us;
  end->hello.refilled_us = now_us;
  end->hello.credit_us = kMostAnswers * kAnswer_us;
}

static void ChangeEpoch(pr_end* end, uint32_t peer_stream) {
  end->memory.epoch = pr_epoch_of(&end->scope, end->hello.agreed_own, end->hello.agreed_peer);
  if (peer_stream != end->memory.peer_stream) {
    for (size_t i = 0; i < PR_MAX_CHANNELS; ++i) end->memory.known[i] = 0;
    pr_forget_held(end);
  }
  end->memory.peer_stream = peer_stream;
  end->memory.send_bound = 1;
  end->memory.floor_bound = 0;
  end->memory_dirty = true;
  end->next_counter = 1;
  end->handed_from = 1;
  end->in.window.highest = 0;
  end->in.window.used = ~UINT64_C(0);
  end->ack.confirmed = end->ack.in_turn = 0;
  end->ack.confirmed_known = true;
  end->ack.unacknowledged = 0;
  end->hello.switched = true;
  end->floor_due = false;
}

static void OnFresh(pr_end* end, const pr_hello* hello) {
  end->hello.used = true;
  end->hello.reply_due = end->hello.reply_due || !hello->agreed;
  if (hello->table_hash != end->scope.table_hash) {
    Draw(end);
    Ask(end, hello->nonce);
    end->hello.reply_due = true;
    return;
  }
  end->hello.agreed = true;
  end->hello.agreed_own = end->hello.own;
  end->hello.agreed_peer = hello->nonce;
  end->hello.asked = false;
  ChangeEpoch(end, hello->stream);
}

void pr_on_hello(pr_end* end, const pr_hello* hello, uint64_t now_us) {
  if (!end->hello.used && hello->echo == end->hello.own) {
    OnFresh(end, hello);
    return;
  }
  const bool same_table = hello->table_hash == end->scope.table_hash;
  const bool answers =
      hello->echo == end->hello.own || (end->hello.agreed && hello->echo == end->hello.agreed_own);
  if (!answers && !hello->need && same_table) return; /* an announcement */
  if (same_table && end->hello.agreed && end->hello.agreed_peer == hello->nonce) {
    /* The end that was agreed with; when its data has come, its hello is an old one. */
    if (!end->hello.switched || (!hello->need && hello->agreed)) return;
    end->hello.asked = false;
    end->hello.reply_due = true;
    return;
  }
  /* The other end has forgotten the epoch, or this is a replay: what was used must not be used again. */
  const bool heard = pr_reception_of(end, now_us) == PR_HEARD;
  if (heard && Has(&end->hello.refuted, hello->nonce)) return;
  if (!Ask(end, hello->nonce)) return;
  if (end->hello.used) Draw(end);
  end->hello.reply_due = true;
}

void pr_on_data(pr_end* end) {
  if (end->hello.asked && Has(&end->hello.answered, end->hello.asking))
    Add(&end->hello.refuted, end->hello.asking);
  end->hello.asked = false;
  end->hello.switched = false;
  end->floor_due = false;
}

static uint32_t Credit(const pr_end* end, uint64_t now_us) {
  const uint64_t credit = end->hello.credit_us + (now_us - end->hello.refilled_us);
  return credit > kMostAnswers * kAnswer_us ? kMostAnswers * kAnswer_us : (uint32_t)credit;
}

bool pr_hello_due(const pr_end* end, uint64_t now_us) {
  if (Credit(end, now_us) < kAnswer_us) return false;
  if (end->hello.reply_due) return true;
  const pr_reception reception = pr_reception_of(end, now_us);
  const uint64_t silent_us = now_us - end->hello.last_us;
  if (reception == PR_UNUSABLE || end->hello.switched) return silent_us >= kRepeat_us;
  return reception == PR_SILENT && silent_us >= kAnnounce_us;
}

pr_hello pr_take_hello(pr_end* end, uint64_t now_us) {
  const bool agreed = end->hello.agreed && !end->hello.asked;
  const uint64_t asking = end->hello.asked ? Answered(end) : 0;
  const pr_hello hello = {.table_hash = end->scope.table_hash,
                          .stream = end->memory.stream,
                          .nonce = agreed ? end->hello.agreed_own : end->hello.own,
                          .echo = agreed ? end->hello.agreed_peer : asking,
                          .need = pr_reception_of(end, now_us) == PR_UNUSABLE,
                          .agreed = agreed,
                          .over = false,
                          .code_bytes = end->scope.code_bytes};
  end->hello.credit_us = Credit(end, now_us) - kAnswer_us;
  end->hello.refilled_us = end->hello.last_us = now_us;
  end->hello.reply_due = false;
  return hello;
}
