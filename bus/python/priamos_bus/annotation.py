"""The annotation in the comment of a field: see bus/schema/README.md."""

import math
import re

from .model import Annotation, Number

_REAL = re.compile(r"-?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?", re.ASCII)
_WHOLE = re.compile(r"-?\d+", re.ASCII)


def parse_number(text):
    """A decimal number, nothing before or behind it; else None."""
    if not _REAL.fullmatch(text):
        return None
    value = float(text)
    if not math.isfinite(value):
        return None
    whole = int(text) if len(text) < 25 and _WHOLE.fullmatch(text) else None
    return Number(value, whole if whole is not None and -2**63 <= whole < 2**63 else None)


class _Problem(Exception):
    pass


def parse_annotation(comment):
    """A comment that does not begin with a bracket is all meaning; one that cannot be read sets `problem`."""
    comment = comment.strip(" \t")
    if not comment.startswith("["):
        return Annotation(meaning=comment)
    annotation = Annotation()
    try:
        _read(annotation, comment[1:])
        _check(annotation)
    except _Problem as problem:
        annotation.problem = str(problem)
    return annotation


def _take(text, stops):
    end = next((i for i, c in enumerate(text) if c in stops), len(text))
    return text[:end], text[end:]


def _read(annotation, text):
    unit, text = _take(text, "]")
    annotation.unit = unit.strip(" \t")
    if not text:
        raise _Problem("the bracket of the unit is not closed")
    if not annotation.unit:
        raise _Problem("the unit is empty, [-] means a plain number")
    text = text[1:].strip(" \t")
    while text:
        if text[0] == ":":
            annotation.meaning = text[1:].strip(" \t")
            return
        if text[0] != "@":
            raise _Problem("expected a @tag or a colon before the meaning")
        tag, text = _take(text[1:], " \t:")
        text = text.strip(" \t")
        if tag == "refuse":
            if annotation.refuse:
                raise _Problem("@refuse is there twice")
            annotation.refuse = True
            continue
        value, text = _take(text, " \t:")
        _apply(annotation, tag, value)
        text = text.strip(" \t")


def _apply(a, tag, value):
    def wrong(expected):
        return _Problem(f"@{tag} expects {expected}, got '{value}'")

    if tag == "frame":
        if not value or a.frame:
            raise wrong("one word")
        a.frame = value
    elif tag in ("step", "invalid"):
        number = parse_number(value)
        if number is None or getattr(a, tag) is not None:
            raise wrong("one number")
        setattr(a, tag, number)
    elif tag == "range":
        parts = [parse_number(part) for part in value.split(",")]
        if len(parts) != 2 or a.min is not None or None in parts:
            raise wrong("two numbers A,B")
        a.min, a.max = parts
    elif tag == "max":
        if a.sizes:
            raise wrong("whole numbers, once")
        for part in value.split(","):
            number = parse_number(part)
            if number is None or number.integer is None or not 1 <= number.integer <= 65535:
                raise wrong("whole numbers from 1 to 65535")
            a.sizes.append(number.integer)
    elif tag == "age":
        number = parse_number(value)
        if number is None or number.integer is None or number.integer < 1 or a.age_us is not None:
            raise wrong("microseconds, a whole number above 0")
        a.age_us = number.integer
    else:
        raise _Problem(f"the tag @{tag} is not known")


def _check(a):
    if a.min is not None and not a.min.value < a.max.value:
        raise _Problem("the second number of @range is not above the first")
    if a.step is not None and not a.step.value > 0:
        raise _Problem("@step is not above 0")
    if a.age_us is not None and a.min is not None:
        raise _Problem("a time stamp has @age or @range, not both")
