"""Agreement on an epoch: only a hello that echoes the number drawn last here changes anything, and once."""

import secrets
import time

from .frames import Hello

REPEAT_S, ANNOUNCE_S, ANSWER_S = 0.3, 1.0, 0.1


def timed_nonce():
    """A random number that says when it was drawn: 28 bits of the second before 36 of chance."""
    return (int(time.time()) & 0xFFFFFFF) << 36 | secrets.randbits(36)


class Handshake:
    """`nonce`: a function that draws 36 unpredictable bits behind the low 28 of the second of the day's clock
    (timed_nonce). Of those who ask, all but one at most are replays of the other end's earlier lives: the one whose
    number was drawn last gets every second answer."""

    def __init__(self, table, nonce, now):
        self.table, self.nonce = table, nonce
        self.stream, self.own, self.used = nonce() & 0xFFFFFFFF, nonce(), False
        self.agreed, self.asking, self.reply_due, self.last = None, None, False, now - 1
        self.drawn_last, self.by_time = 0, True

    def on_hello(self, hello, heard):
        """The two numbers of a new epoch, own and peer's, or None. `heard`: data of the epoch in use has come.
        Raises ValueError with one sentence when the other end has another table."""
        if not self.used and hello.echo == self.own:
            return self._agree(hello)
        answers = hello.echo == self.own or (self.agreed and hello.echo == self.agreed[0])
        if not answers and not hello.need and hello.table_hash == self.table.hash:
            return None  # an announcement
        if self.agreed and self.agreed[1] == hello.nonce:
            self.reply_due = self.reply_due or (not heard and (hello.need or not hello.agreed))
            return None
        if self.used:
            self.own, self.used = self.nonce(), False
        self._ask(hello.nonce)
        return None

    def _ask(self, nonce):
        if self.asking is None:
            self.drawn_last, self.by_time = 0, True
        self.drawn_last = nonce if nonce >> 36 >= self.drawn_last >> 36 else self.drawn_last
        self.asking, self.reply_due = nonce, True

    def _agree(self, hello):
        if hello.table_hash != self.table.hash:
            self.own = self.nonce()
            self._ask(hello.nonce)
            raise ValueError(f"expected the channel table {self.table.hash:08x} at the other end, got "
                             f"{hello.table_hash:08x}: print the table of its link.toml")
        self.used, self.asking, self.agreed = True, None, (self.own, hello.nonce)
        self.reply_due = self.reply_due or not hello.agreed
        return self.agreed

    def on_data(self):
        """Notes that data of the epoch in use came: who asked before it is not the other end."""
        self.asking = None

    def _answered(self):
        if self.asking is None:
            return 0
        self.by_time = not self.by_time
        return self.asking if self.by_time else self.drawn_last

    def due(self, now, up, heard, has_epoch):
        if self.reply_due:
            return now - self.last >= ANSWER_S
        return not up and now - self.last >= (ANNOUNCE_S if has_epoch and heard else REPEAT_S)

    def take(self, now, has_epoch):
        """The hello to be sent now."""
        agreed = self.agreed is not None and self.asking is None
        own, peer = self.agreed if agreed else (self.own, self._answered())
        self.reply_due, self.last = False, now
        return Hello(self.table.hash, self.stream, own, peer, not has_epoch, agreed, False, self.table.code_bytes)
