"""Intervals in decimals: what is printed encloses what is meant."""

import random
from fractions import Fraction

import pytest

from mceip.exact import Interval, fraction_of, known_text, number_text


@pytest.mark.parametrize(
    "ends, expected",
    [
        (("0.25", "0.25"), "0.25"),
        (("1/3", "1/3"), "1/3"),
        (("-1/3", "1/7"), "[-0.34, 0.15]"),
        (("0", "1/1000000000000000000000"), "[0, 1e-21]"),
        (("1e-300", "2e-300"), "[1e-300, 2e-300]"),
        (("1e400", "2e400"), "[1e+400, 2e+400]"),
        (("1.9999999999999999", "2.0000000000000001"), "[1.999999999999, 2.000000000001]"),
    ],
)
def test_intervals_in_decimals(ends, expected):
    assert str(Interval(*map(fraction_of, ends))) == expected


@pytest.mark.parametrize(
    "number, ends, expected",
    [
        (1.5500001, ("1.2", "1.9"), "1.6"),
        (1234.5678, ("1234", "1235"), "1234.6"),
        (1 / 3, ("0.33333", "0.33334"), "0.3333333"),
        (2 / 3, ("2/3", "2/3"), "0.6666666667"),
        (0.0, ("-0.1", "0.1"), "0"),
    ],
)
def test_numbers_have_the_digits_that_are_known(number, ends, expected):
    assert known_text(number, Interval(*map(fraction_of, ends))) == expected


def test_what_is_printed_encloses():
    rng = random.Random(7)
    for _ in range(2_000):
        scale = Fraction(10) ** rng.randint(-40, 40)
        middle = Fraction(rng.randint(-(10**9), 10**9), 10**6)
        width = Fraction(rng.randint(1, 10**6), 10 ** rng.randint(1, 30))
        interval = Interval((middle - width) * scale, (middle + width) * scale)

        below, above = str(interval)[1:-1].split(", ")

        assert Fraction(below) <= interval.lower and interval.upper <= Fraction(above)
        assert Fraction(above) - Fraction(below) <= 200 * max(
            interval.upper - interval.lower, abs(middle * scale) * Fraction(1, 10**11)
        )


def test_a_number_of_many_digits_is_not_printed_whole():
    long = fraction_of("9" * 5000)
    assert number_text(long) == "a fraction of about 1e+4999"
    assert len(number_text(1 / long)) < 40
