"""Messages as few bits, as the radio carries them: bus/schema/README.md, "Packing, byte exact"."""

import math
import struct as binary

from .bits import Ended, Reader, Writer
from .decoding import decode, short_float
from .encoding import encode
from .model import INTEGER_BITS, SIZES, MessageError, Number, SchemaError
from .schema import reaches_recursion

_MOST_ENCODED, _MOST_ROWS, _MOST_VALUES = 65535, 10000, 65535


class Packed:
    """A packed message. `saturated`: fields with a value that was sent as the nearest possible one; `refused`: fields
    for which there is no such value, so that there are no bytes."""

    def __init__(self, data, bits, saturated, refused):
        self.bytes, self.bits, self.saturated, self.refused = data, bits, saturated, refused


class Packer:
    """Packs messages of one annotated type. Raises SchemaError, `file:line: type.field: ...`, when a field lacks what
    packing needs."""

    def __init__(self, struct):
        if reaches_recursion(struct):
            raise SchemaError(f"{struct.file}:{struct.line}: {struct.full_name} has a type in it that contains itself, "
                              "which cannot be packed")
        self.struct, self.rows, self.max_bits = struct, 0, 0
        self.plan = self._plan(struct, "", 1)
        size = _largest(struct)
        if size is None or size + 8 > _MOST_ENCODED:
            raise SchemaError(f"{struct.file}:{struct.line}: {struct.full_name} may have more than {_MOST_ENCODED} bytes, "
                              "which cannot be packed")

    def pack(self, message, now_us):
        """`message`: encoded, or a dict. Time stamps travel as their age at `now_us`. Raises MessageError."""
        if isinstance(message, dict):
            message = encode(self.struct, message)
        state = _Packing(now_us)
        state.body(self.plan, decode(self.struct, message))
        if state.refused:
            return Packed(b"", 0, state.saturated, state.refused)
        return Packed(state.out.bytes(), state.out.size, state.saturated, [])

    def unpack(self, packed, now_us):
        """The message as a dict, its time stamps by the receiver's clock. Raises MessageError for bytes that are no
        packed message of the type."""
        reader = Reader(packed)
        try:
            message = _unpack_body(self.plan, reader, now_us)
        except (Ended, ValueError):
            raise MessageError(f"{self.struct.full_name}: {len(packed)} bytes are no packed message of it") from None
        if reader.left >= 8 or reader.get(reader.left):
            raise MessageError(f"{self.struct.full_name}: there are bits behind the last field")
        return message

    # ---- the plan

    def _plan(self, struct, prefix, repeats):
        return [self._step(struct, field, prefix, repeats) for field in struct.fields]

    def _step(self, struct, field, prefix, repeats):
        def fail(sentence):
            raise SchemaError(struct.where(field) + sentence)

        if field.annotation.problem:
            fail(field.annotation.problem)
        variable = sum(1 for d in field.dims if d.count)
        given = len(field.annotation.sizes)
        if given not in (0, variable + (field.kind == "string")) and not (field.kind == "string" and given == 1):
            fail(f"@max has {given} numbers for {variable} variable dimensions")
        for i, dimension in enumerate(field.dims):
            most = max_count(struct, field, i)
            if most is None:
                fail(f"packing needs @max here or @range at {dimension.text}")
            repeats *= most
            if repeats > _MOST_VALUES:
                fail(f"more than {_MOST_VALUES} values cannot be packed")
        self.rows += 1
        if self.rows > _MOST_ROWS:
            fail("the type has too many fields to pack")
        name = prefix + field.name + "[]" * len(field.dims)
        if field.kind == "struct":
            if field.annotation.refuse:
                fail("@refuse belongs to the fields of the struct")
            return _Step(field, name, self._plan(field.type, name + ".", repeats))
        code = _code(struct, field, fail)
        self.max_bits += repeats * (code.bits + (code.most * code.width if isinstance(code, _Text) else 0))
        if field.annotation.refuse and field.kind == "boolean":
            fail("@refuse is for fields with a range, and a boolean has none")
        refuse = field.annotation.refuse or (not isinstance(code, _Count) and struct.is_enumeration(field))
        return _Step(field, name, code, refuse)


class _Step:
    def __init__(self, field, name, code, refuse=False):
        self.field, self.name, self.code, self.refuse = field, name, code, refuse


def max_count(struct, field, index):
    """Largest count of a dimension: its size, `@max`, or the upper end of the count's `@range`; None without."""
    dimension = field.dims[index]
    if not dimension.count:
        return dimension.size
    end = next(f for f in struct.fields if f.name == dimension.count).annotation.max
    bounds = [end.integer] if end is not None and end.integer is not None and end.integer >= 0 else []
    variable = [i for i, d in enumerate(field.dims) if d.count]
    if len(field.annotation.sizes) == len(variable) + (field.kind == "string"):
        bounds.append(field.annotation.sizes[variable.index(index)])
    return min(bounds, default=None)


def _max_text(field):
    sizes = field.annotation.sizes
    return sizes[-1] if len(sizes) in (1, sum(1 for d in field.dims if d.count) + 1) else None


def _largest(struct):
    total = 0
    for field in struct.fields:
        if field.kind == "string":
            length = _max_text(field)
            size = None if length is None else length + 5
        else:
            size = _largest(field.type) if field.kind == "struct" else SIZES[field.kind]
        for i in range(len(field.dims)):
            count = max_count(struct, field, i)
            size = None if size is None or count is None else size * count
        if size is None:
            return None
        total += size
    return total


def _code(struct, field, fail):
    a = field.annotation
    bounds = [max_count(struct, array, i) for array in struct.fields for i, d in enumerate(array.dims)
              if d.count == field.name]
    if bounds:
        return _count_code(field, min((b for b in bounds if b is not None), default=_limits(field.kind)[1]), fail)
    if field.kind == "boolean":
        return _Boolean()
    if field.kind == "string":
        most = _max_text(field)
        if most is None:
            fail("packing needs @max, the largest length of the text")
        return _Text(most, 7 if a.unit == "ascii" else 8)
    if field.kind in ("float", "double"):
        return _real_code(field, fail)
    return _age_code(field, fail) if a.age_us is not None else _integer_code(field, fail)


def _count_code(field, most, fail):
    a = field.annotation
    if most > _limits(field.kind)[1]:
        fail(f"a {field.kind} cannot count to {most}")
    if a.invalid is not None or (a.step is not None and a.step.integer != 1):
        fail("a count has neither @invalid nor a @step but 1")
    return _Count(0, max(most, 1), 1, None)


def _limits(kind):
    if kind == "byte":
        return 0, 255
    half = 1 << INTEGER_BITS[kind] - 1
    return -half, half - 1


def _real_code(field, fail):
    a = field.annotation
    if a.min is None:
        fail("packing needs @range")
    if a.step is None:
        fail("packing needs @step")
    largest = 3.4028234663852886e38 if field.kind == "float" else 1.7976931348623157e308 / 4
    if max(-a.min.value, a.max.value) > largest:
        fail("@range is beyond what the type can hold")
    if not (a.max.value - a.min.value) / a.step.value <= 2.0**52:
        fail("@range has more than 2^52 steps")
    invalid = None if a.invalid is None else a.invalid.value
    return _Real(a.min.value, a.max.value, a.step.value, _single(invalid) if field.kind == "float" else invalid)


def _single(value):
    return None if value is None else binary.unpack(">f", binary.pack(">f", value))[0]


def _integer_code(field, fail):
    a = field.annotation
    low, high = _limits(field.kind)
    if a.min is None and field.kind != "byte":
        fail("packing needs @range")
    least, most, step = a.min or Number(0, 0), a.max or Number(255, 255), a.step or Number(1, 1)
    if None in (least.integer, most.integer, step.integer):
        fail("@range and @step of an integer are whole numbers")
    if least.integer < low or most.integer > high:
        fail(f"@range is beyond what {field.kind} can hold")
    if a.invalid is not None and (a.invalid.integer is None or not low <= a.invalid.integer <= high):
        fail(f"@invalid is no value of {field.kind}")
    code = _Integer(least.integer, most.integer, step.integer, a.invalid.integer if a.invalid else None)
    if code.bits > 64:
        fail("@range leaves no code for @invalid")
    return code


def _age_code(field, fail):
    a = field.annotation
    if field.kind != "int64_t":
        fail("a time stamp with @age is an int64_t")
    if a.step is None or a.step.integer is None:
        fail("packing needs @step, whole microseconds")
    if a.invalid is not None:
        fail("a time stamp with @age has no @invalid")
    return _Age(0, a.age_us, a.step.integer, None)


# ---- codes: encode(value) gives (code, saturated)


class _Boolean:
    bits, last = 1, 1

    def encode(self, value):
        return int(value != 0), False

    def decode(self, code):
        return bool(code)


class _Real:
    def __init__(self, low, high, step, invalid):
        self.low, self.high, self.step, self.invalid = low, high, step, invalid
        self.steps = int(_round((high - low) / step))
        self.last = self.steps + (invalid is not None)
        self.bits, self.per_unit = self.last.bit_length(), 0
        if _nearly_whole(1 / step) and _nearly_whole(low / step):
            self.per_unit, self.low_per_unit = _round(1 / step), _round(low / step)

    def encode(self, value):
        if self.invalid is not None and (value == self.invalid or value != value):
            return self.steps + 1, False
        lost = value != value
        if lost:
            value = min(max(0.0, self.low), self.high)
        steps = (value - self.low) / self.step
        code = int(min(max(_round(steps) if math.isfinite(steps) else steps, 0.0), float(self.steps)))
        return code, lost or abs(value - self.decode(code)) > self.step * 0.50001

    def decode(self, code):
        if code > self.steps:
            return self.invalid
        value = (self.low_per_unit + code) / self.per_unit if self.per_unit > 0 else self.low + code * self.step
        return min(max(value, self.low), self.high)


class _Integer:
    def __init__(self, low, high, step, invalid):
        self.low, self.span, self.step, self.invalid = low, high - low, step, invalid
        self.steps = _quotient(self.span, step)
        self.last = self.steps + (invalid is not None)
        self.bits = self.last.bit_length()

    def encode(self, value):
        if self.invalid is not None and value == self.invalid:
            return self.steps + 1, False
        above = value - self.low
        if above < 0:
            return 0, -above > self.step // 2
        if above > self.span:
            return self.steps, above - self.span > self.step // 2
        return min(_quotient(above, self.step), self.steps), False

    def decode(self, code):
        return self.invalid if code > self.steps else self.low + min(code * self.step, self.span)


class _Count(_Integer):
    pass


class _Age(_Integer):
    def encode_up(self, age):
        code, saturated = self.encode(age)
        if self.decode(code) >= age:
            return code, saturated
        return (code + 1, False) if code < self.last else (self.last, True)


class _Text:
    def __init__(self, most, width):
        self.most, self.last, self.bits, self.width = most, most, most.bit_length(), width


def _round(value):
    """Half away from zero."""
    whole = math.floor(abs(value))
    return math.copysign(whole + (abs(value) - whole >= 0.5), value)


def _nearly_whole(value):
    return abs(value) < 2.0**52 and abs(value - _round(value)) <= 1e-12 * abs(value)


def _quotient(dividend, divisor):
    whole, rest = divmod(dividend, divisor)
    return whole + (rest > 0 and rest >= divisor - rest)


# ---- messages


class _Packing:
    def __init__(self, now_us):
        self.now_us, self.out, self.saturated, self.refused = now_us, Writer(), [], []

    def body(self, plan, message):
        counts = {}
        for step in plan:
            self._level(step, 0, counts, message[step.field.name])

    def _level(self, step, level, counts, value):
        if level == len(step.field.dims):
            return self._value(step, counts, value)
        dimension = step.field.dims[level]
        kept = counts[dimension.count] if dimension.count else dimension.size
        for element in value[:kept]:
            self._level(step, level + 1, counts, element)
        return None

    def _value(self, step, counts, value):
        code = step.code
        if isinstance(code, list):
            return self.body(code, value)
        if isinstance(code, _Text):
            return self._text(step, value.encode("utf-8", "surrogateescape"))
        if isinstance(code, _Real) and not math.isfinite(value) and not (value != value and code.invalid is not None):
            return self._report(step, self.refused)  # no number: there is no nearest one
        if isinstance(code, _Age):
            number, saturated = code.encode_up(min(max(self.now_us - value, -2**63), 2**63 - 1))
        else:
            number, saturated = code.encode(_single(value) if step.field.kind == "float" else value)
        if isinstance(code, _Count):
            counts[step.field.name] = code.decode(number)
        self.out.put(number, code.bits)
        if saturated:
            self._report(step)
        return None

    def _text(self, step, raw):
        code, length = step.code, min(len(raw), step.code.most)
        if length < len(raw):
            # Not in the middle of an UTF-8 sequence, if it is UTF-8.
            cut = length
            while cut > 0 and length - cut < 3 and raw[cut] & 0xC0 == 0x80:
                cut -= 1
            length = cut if raw[cut] & 0xC0 != 0x80 else length
            self._report(step)
        self.out.put(length, code.bits)
        for byte in raw[:length]:
            if code.width == 7 and byte > 127:
                byte = ord("?")
                self._report(step)
            self.out.put(byte, code.width)

    def _report(self, step, names=None):
        names = names if names is not None else self.refused if step.refuse else self.saturated
        if step.name not in names:
            names.append(step.name)


def _unpack_body(plan, reader, now_us):
    message, counts = {}, {}

    def level(step, depth):
        if depth == len(step.field.dims):
            return _unpack_value(step, reader, now_us)
        dimension = step.field.dims[depth]
        n = counts[dimension.count] if dimension.count else dimension.size
        values = [level(step, depth + 1) for _ in range(n)]
        return bytes(values) if step.field.kind == "byte" and depth + 1 == len(step.field.dims) else values

    for step in plan:
        message[step.field.name] = level(step, 0)
        if isinstance(step.code, _Count):
            counts[step.field.name] = message[step.field.name]
    return message


def _unpack_value(step, reader, now_us):
    code = step.code
    if isinstance(code, list):
        return _unpack_body(code, reader, now_us)
    number = reader.get(code.bits)
    if number > code.last:
        raise ValueError("no code of the field")
    if isinstance(code, _Text):
        raw = bytes(reader.get(code.width) for _ in range(number))
        return raw.decode("utf-8", "surrogateescape")
    if isinstance(code, _Age):
        return max(now_us - code.decode(number), -2**63)
    value = code.decode(number)
    return short_float(_single(value)) if step.field.kind == "float" else value
