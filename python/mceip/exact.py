"""Exact numbers of answers: fractions of any length, and intervals of them in decimals."""

from __future__ import annotations

from collections.abc import Sequence
from decimal import Decimal
from fractions import Fraction
from numbers import Rational, Real
from typing import NamedTuple

#: Digits that are read at once: Python itself reads 4300 at most.
DIGITS = 4000

#: Significant digits of a printed end at most.
MOST_SIGNIFICANT = 12


class Interval(NamedTuple):
    """All numbers from `lower` to `upper`, both included.

    Its text is in decimals: of a number itself where they end soon, else rounded outwards, so that
    what is printed encloses the interval.
    """

    lower: Fraction
    upper: Fraction

    def __str__(self) -> str:
        if self.lower == self.upper:
            return number_text(self.lower)
        places = places_of(self)
        scale = Fraction(10) ** places
        below = decimal_text((self.lower * scale).__floor__(), places)
        above = decimal_text((self.upper * scale).__ceil__(), places)
        return f"[{below}, {above}]"

    def __repr__(self) -> str:
        return str(self)

    def __contains__(self, number: object) -> bool:
        """Does a number lie in the interval?"""
        if not isinstance(number, Real):
            return False
        exact = number if isinstance(number, Rational) else float(number)
        return bool(self.lower <= exact <= self.upper)


def range_text(lower: Fraction, upper: Fraction) -> str:
    """A range at each number of which something is proved, rounded inwards: all that is printed lies
    in it."""
    scale = Fraction(10) ** (MOST_SIGNIFICANT - magnitude(upper))
    below, above = (lower * scale).__ceil__(), (upper * scale).__floor__()
    if below > above:
        return f"[{lower}, {upper}]"
    places = MOST_SIGNIFICANT - magnitude(upper)
    return f"[{decimal_text(below, places)}, {decimal_text(above, places)}]"


def places_of(interval: Interval) -> int:
    """Decimal places that show how narrow an interval is, and not too many digits."""
    lower, upper = interval
    width = 2 - magnitude(upper - lower)
    significant = MOST_SIGNIFICANT - magnitude(max(abs(lower), abs(upper)))
    return min(width, significant)


def magnitude(number: Fraction) -> int:
    """About the number of digits before the decimal point of a positive number."""
    bits = number.numerator.bit_length() - number.denominator.bit_length()
    return round(bits * 0.30103)


def number_text(number: Fraction) -> str:
    """A number as decimals where they end soon, else as a fraction."""
    for places in range(MOST_SIGNIFICANT + 1):
        scaled = number * 10**places
        if scaled.denominator == 1 and abs(scaled.numerator) < 10 ** (MOST_SIGNIFICANT + 3):
            return decimal_text(scaled.numerator, places)
    is_short = max(number.numerator.bit_length(), number.denominator.bit_length()) < DIGITS
    return str(number) if is_short else f"a fraction of about 1e{magnitude(number) - 1:+d}"


def short_text(number: Fraction) -> str:
    """A number to ten digits."""
    try:
        return f"{float(number):.10g}"
    except OverflowError:
        return number_text(number)


def known_text(number: float, enclosure: Interval, most: int = 10) -> str:
    """A number with the digits that its enclosure determines and one more; `most` if exact."""
    lower, upper = enclosure
    if lower == upper:
        return f"{number:.{most}g}"
    known = magnitude(max(abs(lower), abs(upper))) - magnitude(upper - lower)
    return f"{number:.{min(max(known, 0) + 2, most)}g}"


def decimal_text(digits: int, places: int) -> str:
    """digits / 10^places without zeros at its end."""
    number = Decimal(digits).scaleb(-places).normalize()
    exponent = number.adjusted()
    return f"{number:f}" if -5 <= exponent < 16 else f"{number:e}"


def fraction_of(text: str) -> Fraction:
    """A fraction or a decimal of any length."""
    numerator, is_fraction, denominator = text.partition("/")
    if is_fraction:
        return Fraction(integer_of(numerator), integer_of(denominator))
    return Fraction(text) if len(text) <= DIGITS else Fraction(integer_of(text))


def integer_of(text: str) -> int:
    """An integer of any length."""
    if len(text) <= DIGITS:
        return int(text)
    if text.startswith("-"):
        return -integer_of(text[1:])
    tail = len(text) // 2
    shift: int = 10**tail
    return integer_of(text[:-tail]) * shift + integer_of(text[-tail:])


def interval_of(ends: Sequence[str]) -> Interval:
    """An interval whose ends are spelt."""
    lower, upper = ends
    return Interval(fraction_of(lower), fraction_of(upper))


def fraction_or_none(text: str | None) -> Fraction | None:
    """The number that is spelt, if one is."""
    return None if text is None else fraction_of(text)
