"""One end of the link: time and bytes are arguments, nothing is remembered over a restart."""

from dataclasses import dataclass

from . import bundle as b
from .events import EventReceiver, EventSender, Segment
from .frames import DOWN, UP, Codec, Data, Hello, Window, block_decode, cobs_decode
from .handshake import Handshake

KEEP_ALIVE_S, SILENCE_S, ACK_GAP_S = 0.2, 1.5, 0.25
LONGEST_INPUT, BUNDLE_BITS, OFFSET_STEPS = 300, 8 * 120, 32


@dataclass
class Delivery:
    channel: int
    packed: bytes
    bits: int
    time: float  # when it was offered there, by this clock; of a command: then or later
    valid_until: float | None = None


class End:
    """`onboard`: the robot's end. `nonce`: as Handshake wants it."""

    def __init__(self, table, link_key, onboard, nonce, now):
        self.table, self.outgoing = table, UP if onboard else DOWN
        self.codec, self.handshake = Codec(link_key, table, self.outgoing), Handshake(table, nonce, now)
        self.peer_stream = None
        self.epoch, self.counter, self.window = 0, 1, Window()
        self.input, self.heard_at, self.newest, self.newest_at = bytearray(), None, 0, now
        self.unacknowledged, self.last_ack, self.in_turn, self.confirmed = 0, now - 1, 0, 0
        self.handed, self.last_data, self.free_at, self.out = {}, now - 1, now, []
        self.history = {}  # (channel, counter) -> packed, of states with differences
        self.waiting = {}  # channel -> (packed, bits, made)
        self.made = {}  # channel -> when the newest was made that ever waited
        self.senders = {i: EventSender(c.urgent) for i, c in enumerate(table.channels)
                        if c.kind == "event" and c.direction == self.outgoing}
        self.receivers = {i: EventReceiver() for i, c in enumerate(table.channels)
                          if c.kind == "event" and c.direction != self.outgoing}

    def up(self, now):
        return self.heard_at is not None and now - self.heard_at <= SILENCE_S

    def offer(self, channel, packed, bits, now, made=None):
        """A message for an outgoing channel; False when it cannot wait. Of states and commands the newest goes. A
        command's time-to-live counts from when it was `made`, before now; one that came after a newer one is dropped."""
        c = self.table.channels[channel]
        if bits < 0 or len(packed) != -(-bits // 8):
            return False
        if c.direction != self.outgoing or bits > c.max_bits or (c.fixed_bits and bits != c.fixed_bits):
            return False
        if c.kind == "event":
            return self.senders[channel].offer(packed, bits, now)
        made = now if made is None else min(made, now)
        if made >= self.made.get(channel, made):
            self.waiting[channel] = (packed, bits, made)
            self.made[channel] = made
        return True

    # ---- what comes

    def receive(self, data, now):
        """The messages that the bytes make complete."""
        out = []
        for byte in data:
            if byte:
                self.input.append(byte)
                del self.input[LONGEST_INPUT + 1:]
                continue
            if 0 < len(self.input) <= LONGEST_INPUT:
                self._on_frame(bytes(self.input), now, out)
            self.input.clear()
        return out

    def _on_frame(self, encoded, now, out):
        # All bytes of a block are above 127, the first one of COBS is not: one code per frame.
        content = block_decode(encoded) or cobs_decode(encoded)
        if not content:
            return
        frame = self.codec.open(content, self.epoch, self.window, self.counter - 1)
        if isinstance(frame, Hello):
            self._on_hello(frame)
        elif isinstance(frame, Data):
            self._on_data(frame, now, out)

    def _on_hello(self, hello):
        pair = self.handshake.on_hello(hello, self.heard_at is not None)
        if pair is None:
            return
        self.epoch = self.codec.epoch_of(*(pair if self.outgoing == UP else reversed(pair)))
        self.counter, self.window, self.heard_at, self.confirmed, self.newest = 1, Window(), None, 0, 0
        self.handed.clear()
        self.history.clear()
        if hello.stream != self.peer_stream:
            for receiver in self.receivers.values():
                receiver.forget()
        self.peer_stream = hello.stream

    def _on_data(self, frame, now, out):
        ahead = max(0, frame.counter - self.newest)
        if ahead:
            self.newest, self.newest_at = frame.counter, now
            self.in_turn = (self.in_turn << min(ahead, 8) | 1) & 0xFF
        self.heard_at = now
        self.handshake.on_data()
        self.unacknowledged += 1
        # Of a frame overtaken by more than one other the numbers of events may mean others by now.
        late = self.newest - frame.counter > 1
        reader = b.Reader(frame.bundle)
        try:
            while reader.left >= self.table.id_bits and (number := reader.get(self.table.id_bits)):
                if number == len(self.table.channels) + 1:
                    self._control(reader, late)
                else:
                    self._message(reader, number - 1, frame, late, now, out)
        except (b.Ended, IndexError):
            pass  # what was read before counts

    def _control(self, reader, late):
        kind = reader.get(3)
        if kind == b.FRAME_ACK:
            low = reader.get(12)
            reader.get(20)
            named = self.counter - 1 - (self.counter - 1 - low & 0xFFF)
            self.confirmed = max(self.confirmed, named)
        elif kind == b.EVENT_ACK:
            channel, number = reader.get(self.table.id_bits) - 1, reader.get(8)
            reader.get(6)
            if reader.get(1):
                reader.get(16)
            if channel in self.senders and not late:
                self.senders[channel].on_ack(number)
        elif kind == b.FLOOR:
            floor = reader.get(40)
            if self.counter <= floor < self.counter + (1 << 20):
                self.counter = floor + 1
            self.confirmed = -1000
        elif kind == b.LISTEN:
            reader.get(len(self.table.channels))
        elif kind == b.NEXT_KEY:
            reader.get(32)
        elif kind > b.NEXT_KEY:
            raise b.Ended

    def _body(self, reader, c):
        bits = c.fixed_bits or 8 * reader.get(8)
        return reader.take(bits), bits

    def _message(self, reader, channel, frame, late, now, out):
        newest = frame.counter == self.newest
        c = self.table.channels[channel]
        if c.direction == self.outgoing:
            raise b.Ended
        if c.kind == "event":
            return self._events(reader, channel, c, now, [] if late else out, late)
        if c.kind == "command":
            offset = (reader.get(6) - 32) * c.ttl_us / OFFSET_STEPS / 1e6
            packed, bits = self._body(reader, c)
            handed = self.handed.get(frame.echo)
            if newest and handed is not None and handed + offset + c.ttl_us / 1e6 >= now:
                offered = handed + offset
                out.append(Delivery(channel, packed, bits, offered, offered + c.ttl_us / 1e6))
            return None
        if c.delta and reader.get(1):
            counter = frame.counter - (frame.counter - reader.get(6) & 63)
            before = self.history.get((channel, counter), bytes(-(-c.fixed_bits // 8)))
            packed, bits = b.apply_difference(c.delta, before, reader), c.fixed_bits
            newest = newest and (channel, counter) in self.history
        else:
            packed, bits = self._body(reader, c)
        if newest:
            if c.delta:
                self.history[channel, frame.counter] = packed
                # A difference refers to one of the 63 frames before it.
                self.history = {k: v for k, v in self.history.items() if frame.counter - k[1] < 64}
            out.append(Delivery(channel, packed, bits, now))
        return None

    def _events(self, reader, channel, c, now, out, late):
        number, base = reader.get(8), bool(reader.get(1))
        while True:
            first = c.one_segment or bool(reader.get(1))
            last = c.one_segment or bool(reader.get(1))
            age = b.decode_duration(reader.get(12)) if first else 0
            bits = c.fixed_bits if c.one_segment else 8 * (reader.get(5) if last else b.SEGMENT)
            segment = Segment(number, base, first, last, now - age, bits, reader.take(bits))
            for data, size, at in [] if late else self.receivers[channel].on_segment(segment):
                out.append(Delivery(channel, data, size, at))
            if c.urgent or not reader.left or not reader.get(1):
                return
            number, base = (number + 1) % 256, False

    # ---- what goes

    def step(self, now):
        """The bytes that may go on the line now; to be called every few milliseconds."""
        sent = bytearray()
        byte_s = 1 / self.table.bytes_per_s
        while self.free_at <= now + 2 * byte_s:
            if not self.out and not self._build(now):
                break
            sent.append(self.out.pop(0))
            self.free_at = max(self.free_at, now) + byte_s
            if len(self.out) == 1 and self.sending:
                self.handed[self.sending] = now
                self.handed.pop(self.sending - 256, None)
        return bytes(sent)

    def _build(self, now):
        idle = b"\0" if now - self.free_at >= 16 / self.table.bytes_per_s else b""
        self.sending = 0
        if self.handshake.due(now, self.up(now), self.heard_at is not None, self.epoch != 0):
            self.out = list(idle + self.codec.seal_hello(self.handshake.take(now, self.epoch != 0)))
            return True
        whole = self._whole(now)
        if not self.epoch or not self._data_due(now, whole):
            return False
        self.sending, self.counter, self.last_data = self.counter, self.counter + 1, now
        self.out = list(idle + self.codec.seal(self.epoch, self.sending, self._bundle(now, whole), whole, self.newest))
        return True

    def _whole(self, now):
        size = self.table.echo_bytes(self.outgoing)
        # Half of the frames that the bytes tell apart, as short as they can be: the rest is for a slower line.
        reach = 2**(8 * size - 1) * (4 + self.table.code_bytes) / self.table.bytes_per_s / 2
        echoes = not size or (self.heard_at is not None and now - self.newest_at < reach)
        return self.counter > self.confirmed + 64 or not echoes

    def _sendable(self, now, whole):
        """Channels whose newest message may go; commands that are too old are forgotten."""
        command = lambda i: self.table.channels[i].kind == "command"
        self.waiting = {i: w for i, w in self.waiting.items()
                        if not command(i) or now - w[2] <= self.table.channels[i].ttl_us / 1e6}
        return [i for i in self.waiting if not (whole and command(i))]

    def _ack_due(self, now):
        return self.unacknowledged and (self.unacknowledged >= 24 or now - self.last_ack >= ACK_GAP_S)

    def _data_due(self, now, whole):
        return (now - self.last_data >= KEEP_ALIVE_S or self._ack_due(now) or bool(self._sendable(now, whole))
                or any(r.ack_due for r in self.receivers.values())
                or any(s.due(now) for s in self.senders.values()))

    def _bundle(self, now, whole):
        w, control = b.Writer(), len(self.table.channels) + 1
        if self._ack_due(now):
            w.put(control, self.table.id_bits)
            w.put(b.FRAME_ACK, 3)
            w.put(self.newest, 12)
            # Bit i of `earlier`: the frame 1 + i before it.
            w.put(self.in_turn >> 1 & 0xF, 4)
            w.put(b.encode_duration(now - self.newest_at), 12)
            w.put(0, 4)
            self.unacknowledged, self.last_ack = 0, now
        for channel, receiver in self.receivers.items():
            if receiver.ack_due:
                w.put(control, self.table.id_bits)
                w.put(b.EVENT_ACK, 3)
                w.put(channel + 1, self.table.id_bits)
                w.put(receiver.next, 8)
                w.put(receiver.prefix(), 6)
                w.put(0, 1)
                receiver.ack_due = False
        for channel in sorted(self.senders, key=lambda i: not self.table.channels[i].urgent):
            self._put_events(w, channel, now)
        for channel in self._sendable(now, whole):
            self._put_newest(w, channel, now)
        return w.bytes()

    def _put_events(self, w, channel, now):
        c = self.table.channels[channel]
        for s in self.senders[channel].due(now):
            if w.size + self.table.id_bits + 30 + 8 * b.SEGMENT > BUNDLE_BITS:
                return
            w.put(channel + 1, self.table.id_bits)
            w.put(s.number, 8)
            w.put(s.base, 1)
            if not c.one_segment:
                w.put(s.first, 1)
                w.put(s.last, 1)
            if s.first:
                w.put(b.encode_duration(now - s.packed_at), 12)
            if not c.one_segment and s.last:
                w.put(len(s.data), 5)
            w.append(s.data, s.bits if c.one_segment else 8 * len(s.data))
            if not c.urgent:
                w.put(0, 1)
            s.sent_at = now

    def _put_newest(self, w, channel, now):
        c, (packed, bits, offered) = self.table.channels[channel], self.waiting[channel]
        if w.size + self.table.id_bits + 14 + bits > BUNDLE_BITS and w.size:
            return
        del self.waiting[channel]
        w.put(channel + 1, self.table.id_bits)
        if c.kind == "command":
            steps = int((offered - self.newest_at) * 1e6 * OFFSET_STEPS // c.ttl_us)
            w.put(min(63, max(0, steps + 32)), 6)
        elif c.delta:
            w.put(0, 1)
        if not c.fixed_bits:
            w.put(len(packed), 8)
        w.append(packed, bits if c.fixed_bits else 8 * len(packed))
