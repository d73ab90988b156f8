"""Messages from dicts, and dicts as JSON: the inverse of decoding."""

import base64
import binascii
import math
import struct as binary

from .decoding import DEEPEST
from .model import INTEGER_BITS, STRUCT_CODES, MessageError

_LARGEST_FLOAT = 3.4028234663852886e38
_TOO_LARGE = 3.4028235677973366e38  # half a step above the largest float rounds to it
_WORDS = {"NaN": math.nan, "Infinity": math.inf, "-Infinity": -math.inf}


def encode(struct, message):
    """The message that a dict as of decode() or of json_form() stands for. Counts of arrays may be left out; every
    other field has to be there, and no other key. Raises MessageError, "pose_t.x_m: expected a number, got ..."."""
    out = bytearray(struct.fingerprint.to_bytes(8, "big"))
    _body(out, struct, message, struct.full_name, 1)
    return bytes(out)


def filled(struct, message, now_us):
    """A message with the fields that a dict leaves out: 0 or empty, time stamps now, arrays of constant size of those."""
    if not isinstance(message, dict):
        _refuse(struct.full_name, "an object", message)
    counts = {d.count for field in struct.fields for d in field.dims if d.count}
    full = {}
    for field in struct.fields:
        if field.name in message:
            value = message[field.name]
            nested = field.kind == "struct" and not field.dims
            full[field.name] = filled(field.type, value, now_us) if nested else value
        elif field.name not in counts:
            full[field.name] = _empty(field, field.dims, now_us)
    return {**message, **full}


def _empty(field, dims, now_us):
    if dims:
        if field.kind == "byte" and len(dims) == 1:
            return bytes(dims[0].size)
        return [_empty(field, dims[1:], now_us) for _ in range(dims[0].size)]
    if field.kind == "struct":
        return filled(field.type, {}, now_us)
    if field.kind == "string":
        return ""
    return now_us if field.annotation.age_us is not None else 0


def json_form(value):
    """A decoded message with what JSON has no word for as `priamos log export` writes it: arrays of bytes as base64,
    NaN and the infinities as words, a text that is no UTF-8 as {"base64": ...}."""
    if isinstance(value, dict):
        return {key: json_form(part) for key, part in value.items()}
    if isinstance(value, list):
        return [json_form(part) for part in value]
    if isinstance(value, bytes):
        return base64.b64encode(value).decode()
    if isinstance(value, float) and not math.isfinite(value):
        return "NaN" if value != value else "Infinity" if value > 0 else "-Infinity"
    if isinstance(value, str):
        raw = value.encode("utf-8", "surrogateescape")
        try:
            raw.decode()
        except UnicodeDecodeError:
            return {"base64": base64.b64encode(raw).decode()}
    return value


def _refuse(path, expected, value):
    raise MessageError(f"{path}: expected {expected}, got {str(value)[:40]}")


def _body(out, struct, message, path, depth):
    if not isinstance(message, dict):
        _refuse(path, "an object", message)
    if depth > DEEPEST:
        raise MessageError(f"{path}: structs are nested too deeply")
    names = {field.name for field in struct.fields}
    for key in message:
        if key not in names:
            raise MessageError(f"{path}.{key}: there is no such field")
    counts = {}
    for field in struct.fields:
        where = f"{path}.{field.name}"
        value = _given(struct, field, message, where)
        if field.kind in INTEGER_BITS and not field.dims:
            counts[field.name] = _whole(value, where, *_limits(field.kind))
        _level(out, field, 0, counts, value, where, depth)


def _given(struct, field, message, path):
    if field.name in message:
        return message[field.name]
    for array in struct.fields:
        for level, dimension in enumerate(array.dims):
            if dimension.count == field.name and array.name in message:
                return _extent(message[array.name], level)
    raise MessageError(f"{path}: the field is missing")


def _extent(array, level):
    if isinstance(array, (list, tuple)):
        return len(array) if level == 0 else (_extent(array[0], level - 1) if array else 0)
    raw = _bytes(array) if level == 0 else None
    return len(raw) if raw is not None else 0


def _bytes(value):
    if isinstance(value, (bytes, bytearray)):
        return bytes(value)
    try:
        return base64.b64decode(value, validate=True) if isinstance(value, str) else None
    except (binascii.Error, ValueError):
        return None


def _level(out, field, level, counts, value, path, depth):
    if level == len(field.dims):
        return _value(out, field, value, path, depth)
    dimension = field.dims[level]
    n = counts[dimension.count] if dimension.count else dimension.size
    expected = f"{n} elements, as {dimension.count} says" if dimension.count else f"{n} elements"
    if field.kind == "byte" and level + 1 == len(field.dims):
        raw = _bytes(value)
        if raw is None:
            _refuse(path, "bytes or base64", value)
        if len(raw) != n:
            _refuse(path, expected, value)
        out += raw
        return None
    if not isinstance(value, (list, tuple)):
        _refuse(path, "an array", value)
    if len(value) != n:
        _refuse(path, expected, f"{len(value)}")
    for i, element in enumerate(value):
        _level(out, field, level + 1, counts, element, f"{path}[{i}]", depth)
    return None


def _value(out, field, value, path, depth):
    if field.kind == "struct":
        return _body(out, field.type, value, path, depth + 1)
    if field.kind == "string":
        return _text(out, value, path)
    if field.kind == "float":
        value = _real(value, path)
        if math.isfinite(value) and abs(value) >= _TOO_LARGE:
            _refuse(path, "a number that fits into a float", value)
        if math.isfinite(value):
            value = min(_LARGEST_FLOAT, max(-_LARGEST_FLOAT, value))
    elif field.kind == "double":
        value = _real(value, path)
    elif field.kind == "byte":
        value = _whole(value, path, 0, 255)
    elif field.kind == "boolean":
        value = int(value) if isinstance(value, bool) else _whole(value, path, -128, 127)
    else:
        value = _whole(value, path, *_limits(field.kind))
    out += binary.pack(">" + STRUCT_CODES[field.kind], value)
    return None


def _limits(kind):
    half = 1 << INTEGER_BITS[kind] - 1
    return -half, half - 1


def _whole(value, path, low, high):
    number = value
    if isinstance(value, float) and value.is_integer():
        number = int(value)
    if isinstance(number, bool) or not isinstance(number, int) or not low <= number <= high:
        _refuse(path, f"a whole number from {low} to {high}", value)
    return number


def _real(value, path):
    if isinstance(value, str) and value in _WORDS:
        return _WORDS[value]
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        _refuse(path, "a number", value)
    try:
        return float(value)
    except OverflowError:
        return _refuse(path, "a number", value)


def _text(out, value, path):
    raw = None
    if isinstance(value, str):
        try:
            raw = value.encode("utf-8", "surrogateescape")
        except UnicodeEncodeError:
            pass
    elif isinstance(value, dict) and list(value) == ["base64"]:
        raw = _bytes(value["base64"])
    if raw is None:
        _refuse(path, "a string", value)
    out += (len(raw) + 1).to_bytes(4, "big") + raw + b"\0"
