"""Events of one channel: in segments, in order, exactly once while both ends live."""

from dataclasses import dataclass

from .bundle import SEGMENT

WINDOW = 56


@dataclass
class Segment:
    number: int
    base: bool
    first: bool
    last: bool
    packed_at: float  # of the event; only of its first segment
    bits: int
    data: bytes
    sent_at: float | None = None


class EventSender:
    """Segments that wait for their acknowledgement."""

    def __init__(self, urgent):
        self.repeat_s = 0.06 if urgent else 0.4
        self.segments, self.next = [], 0

    def offer(self, packed, bits, now):
        pieces = [packed[i:i + SEGMENT] for i in range(0, len(packed), SEGMENT)] or [b""]
        if len(self.segments) + len(pieces) > WINDOW:
            return False
        for i, piece in enumerate(pieces):
            last = i == len(pieces) - 1
            size = bits - 8 * SEGMENT * i if last else 8 * SEGMENT
            self.segments.append(Segment(self.next, False, i == 0, last, now, size, piece))
            self.next = (self.next + 1) % 256
        return True

    def due(self, now):
        """The segments to be sent now, the oldest first."""
        due = [s for s in self.segments if s.sent_at is None or now - s.sent_at >= self.repeat_s]
        for s in due:
            s.base = s is self.segments[0]
        return due

    def on_ack(self, next_number):
        done = (next_number - self.segments[0].number) % 256 if self.segments else 0
        if done <= len(self.segments):
            del self.segments[:done]


class EventReceiver:
    """Delivers an event when all of it, and of those before it, is there."""

    def __init__(self):
        self.forget()

    def forget(self):
        self.next, self.held, self.ack_due = None, {}, False

    def on_segment(self, segment):
        """The events that this segment makes complete: data, bits and time."""
        begins = segment.base and segment.first
        if self.next is None:
            if not begins:
                return []
            self.next = segment.number
        self.ack_due = True
        ahead = (segment.number - self.next) % 256
        if ahead >= 128:
            return []  # delivered before: its acknowledgement was lost
        if ahead and begins:
            self._advance(ahead)
            ahead = 0
        if ahead < WINDOW:
            self.held.setdefault(ahead, segment)
        events = []
        while (event := self._complete()) is not None:
            events.append(event)
        return events

    def prefix(self):
        return next(i for i in range(WINDOW + 1) if i not in self.held)

    def _complete(self):
        if 0 not in self.held or not self.held[0].first:
            return None
        n = 0
        while n in self.held and not self.held[n].last:
            n += 1
        if n not in self.held:
            return None
        pieces = [self.held[i] for i in range(n + 1)]
        self._advance(n + 1)
        return b"".join(p.data for p in pieces), sum(p.bits for p in pieces), pieces[0].packed_at

    def _advance(self, n):
        self.next = (self.next + n) % 256
        self.held = {i - n: s for i, s in self.held.items() if i >= n}
