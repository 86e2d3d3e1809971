#!/usr/bin/env python3
"""A second checker of mceip-certificate/1, mceip-critical/1, mceip-presence/1 and mceip-stability/1, written from the pages of spec/ alone (no line of
the Rust program was read).

    python3 spec/checker.py PROBLEM CERTIFICATE

Prints ACCEPTED (exit 0), UNDECIDED (3: a cover with open leaves) or REJECTED with the reason (1); files that cannot be read end with one
line on stderr and exit 2. Standard library only; all arithmetic is exact (int and Fraction). References: F = formats.md, C = certificates.md.
"""
import hashlib
import json
import os
import re
import sys
from fractions import Fraction as Q
from math import gcd, isqrt, lcm
from types import SimpleNamespace

MAX_SIDE = 1_000_000  # the largest order of a matrix (F)


class Unreadable(Exception):
    """The file says nothing that could be judged: exit 2."""


class Rejected(Exception):
    """An obligation is not met: exit 1."""


def demand(condition, reason):
    if not condition:
        raise Rejected(reason)


# ---------------------------------------------------------------- reading

class Spelt(str):
    """A JSON number, kept as it is spelt."""


NUMBER = re.compile(r"([+-]?)(?:([0-9]+)(?:\.([0-9]*))?|\.([0-9]+))(?:[eE]([+-]?)0*([0-9]*))?")
RATIO = re.compile(r"([+-]?[0-9]+)/([+-]?[0-9]+)")


def number(s):
    """The exact value of a string or JSON number (F, first paragraph)."""
    if not isinstance(s, str) or len(s) > 100_000:
        raise Unreadable("not a number, or one of more than 100000 characters")
    if m := RATIO.fullmatch(s):
        if int(m[2]) == 0:
            raise Unreadable("zero denominator")
        return Q(int(m[1]), int(m[2]))
    m = NUMBER.fullmatch(s)
    if not m or s[-1] in "eE+-":
        raise Unreadable(f"not a number: {s[:40]!r}")
    sign, whole, frac, bare, exponent_sign, exponent = m.groups("")
    if len(exponent) > 3 or int(exponent or 0) > 400:
        raise Unreadable("decimal exponent beyond 400")
    frac += bare
    value = int(whole + frac) * (-1 if sign == "-" else 1)
    e = int(exponent_sign + (exponent or "0")) - len(frac)
    return Q(value * 10**e) if e >= 0 else Q(value, 10**-e)


def integer(s, low=None, high=None):
    q = number(s)
    if q.denominator != 1 or (low is not None and q < low) or (high is not None and q > high):
        raise Unreadable(f"not an integer in its range: {s[:40]!r}")
    return int(q)


def counter(s, low=0, high=None):
    """An index, weight or exponent: a JSON number spelt as an integer; -0 is none."""
    if not isinstance(s, Spelt) or not re.fullmatch(r"-?[0-9]+", s) or s == "-0":
        raise Unreadable("an integer as a JSON number was expected")
    return integer(s, low, high)


def index(s, n):
    return counter(s, 0, n - 1)


def text_of(s):
    """A JSON string."""
    if not isinstance(s, str) or isinstance(s, Spelt):
        raise Unreadable("a string was expected")
    return s


def place_in(s, n):
    """An index in a certificate: one that names nothing is a claim not met."""
    i = counter(s)
    demand(i < n, f"no index {i}")
    return i


def sequence(x):
    if not isinstance(x, list):
        raise Unreadable("a list was expected")
    return x


def fields(obj, required, optional=""):
    """The values of an object's fields, in the order named; unknown fields are refused."""
    if not isinstance(obj, dict):
        raise Unreadable("an object was expected")
    required, optional = required.split(), optional.split()
    for key in obj:
        if key not in required and key not in optional:
            raise Unreadable(f"unknown field {key[:40]!r}")
    for key in required:
        if key not in obj:
            raise Unreadable(f"missing field {key!r}")
    return [obj.get(key) for key in required + optional]


def read_json(path):
    def pairs(items):
        out = {}
        for key, value in items:
            if key in out:
                raise Unreadable(f"duplicate field {key[:40]!r}")
            out[key] = value
        return out

    def constant(name):
        raise Unreadable(f"{name} is not a number")

    try:
        with open(path, encoding="utf-8", newline="") as f:
            text = f.read()
        if re.search(r"\\u[dD][89a-fA-F]", text):
            json.dumps(json.loads(text), ensure_ascii=False).encode()  # half of a pair of surrogates is no character
        return json.loads(text, object_pairs_hook=pairs, parse_int=Spelt, parse_float=Spelt, parse_constant=constant)
    except (OSError, ValueError, RecursionError) as e:
        raise Unreadable(f"{path}: {type(e).__name__}: {e}") from None


def nearest_double(q):
    try:
        return Q(q.numerator / q.denominator)  # Python divides integers correctly rounded
    except OverflowError:
        raise Unreadable("beyond the doubles") from None


def read_window(obj, unknown=None):
    """A window; `unknown` of a problem: its min may be negative for eigenvalue."""
    lo, hi = fields({} if obj is None else obj, "", "min max")
    lo, hi = Q(0) if lo is None else number(lo), None if hi is None else number(hi)
    if (lo < 0 and unknown != "eigenvalue") or (hi is not None and hi < max(lo, 0)):
        raise Unreadable("window: 0 <= min <= max; for eigenvalue a problem's min may be negative")
    return lo, hi


# ---------------------------------------------------------------- the shape of a certificate
#
# The whole file is read before any obligation is looked at: what is malformed is never a rejection (F, Versions). A shape
# is a function that raises Unreadable.

class Maybe:
    """A field that may be left out, and null in its place unless `null` says otherwise."""

    def __init__(self, item, null=True):
        self.item, self.null = item, null

    def __call__(self, x):
        if x is not None or not self.null:
            self.item(x)


def list_of(item, length=None):
    def shape(x):
        if length not in (None, len(sequence(x))):
            raise Unreadable(f"a list of {length} was expected")
        for v in x:
            item(v)
    return shape


def record(**items):
    """An object with these fields; a `Maybe` may be left out."""
    optional = [key for key, item in items.items() if isinstance(item, Maybe)]

    def shape(x):
        fields(x, " ".join(key for key in items if key not in optional), " ".join(optional))
        for key, v in x.items():
            items[key](v)
    return shape


def one_of(*words, **kinds):
    """One of some words, or an object with one key."""
    def shape(x):
        if isinstance(x, dict) and len(x) == 1 and set(x) <= set(kinds):
            (kind, v), = x.items()
            kinds[kind](v)
        elif not isinstance(x, str) or x not in words:
            raise Unreadable("a word or an object with one key was expected, got another one")
    return shape


def flag(x):
    if not isinstance(x, bool):
        raise Unreadable("true or false was expected")


def place(x):
    counter(x, 0, 2**64 - 1)


def exponent(x):
    counter(x, 0, 2**32 - 1)


def weight(x):
    counter(x, -(2**63), 2**63 - 1)


def whole(x):
    if not re.fullmatch("-?[0-9]{1,4000}", x if isinstance(x, str) else ""):
        integer(x)


def end(x):
    """The end of a piece: null is infinity, and may not be left out."""
    if x is not None:
        number(x)


RATIONALS, INTEGERS, PLACES = list_of(number), list_of(whole), list_of(place)
INTERVAL, VECTOR = list_of(number, 2), list_of(INTEGERS)
ROOT_OF = {"support": PLACES, "biactive": PLACES, "polynomial": INTEGERS, "interval": INTERVAL}
CLAIM = one_of(
    exact_solution=record(x=list_of(RATIONALS), **ROOT_OF),
    lifted_solution=record(v=list_of(RATIONALS), w=list_of(RATIONALS), **ROOT_OF),
    enclosed_solution=record(support=PLACES, center=RATIONALS, radius=RATIONALS, preconditioner=list_of(INTEGERS), exponent=exponent))
FACTOR = record(first=PLACES, rows=list_of(INTEGERS), exponent=exponent)
MATRIX = record(exponent=exponent, rows=list_of(INTEGERS))
ANCHOR = record(center=number, reversed=Maybe(flag, null=False), right=list_of(MATRIX), left=list_of(MATRIX))
CONDENSATION = record(
    sigma=number, stiffness_factor=FACTOR, mass_sigma=number, mass_factor=Maybe(FACTOR), anchors=list_of(ANCHOR),
    tail=Maybe(record(**{"from": number, "factor": FACTOR, "mass_factor": Maybe(FACTOR)})))
OUTCOME = one_of("solution", "absent", negative_x=place, negative_y=place, claim=place, infinity=INTEGERS)
ROOT = record(
    pivot=place, interval=INTERVAL, inverse=list_of(INTEGERS), inverse_exponent=exponent, left=INTEGERS, right=INTEGERS,
    exponent=exponent, outcome=OUTCOME)


def alone_row(x):
    if len(sequence(x)) != 2:
        raise Unreadable("a row of alone is [j, weights]")
    place(x[0])
    VECTOR(x[1])


REASON = one_of(none=VECTOR, some=record(x=VECTOR, alone=Maybe(record(pivot=place, rows=list_of(alone_row)))))
SUPPORT = record(points=list_of(record(polynomial=INTEGERS, interval=INTERVAL, reason=place)), cells=PLACES, reasons=list_of(REASON))
LDL_FACTOR = record(rows=list_of(RATIONALS), diagonal=RATIONALS)
NODE = one_of(
    "positive_definite", "negative_definite", "tail", "open", split=number, branch=place, farkas=list_of(weight),
    weighted_definite=list_of(weight), ldl=record(lower=LDL_FACTOR, upper=LDL_FACTOR), root=ROOT, support=SUPPORT)
PIECE = record(max=end, anchor=Maybe(place), tree=list_of(NODE))
PART_FIELDS = {
    "window": record(min=number, max=Maybe(number)), "claims": list_of(CLAIM),
    "complete_set": Maybe(record(condensation=Maybe(CONDENSATION), pieces=list_of(PIECE)))}
CERTIFICATE = record(
    format=text_of, problem_sha256=text_of, unknown=one_of("lambda2", "mu", "eigenvalue"), negative=Maybe(record(**PART_FIELDS)), **PART_FIELDS)


class Matrix:
    """Sparse by rows: rows[i] is {j: value}, zeros left out."""

    def __init__(self, rows, cols, what):
        if rows > MAX_SIDE or cols > MAX_SIDE:
            raise Unreadable(f"{what}: too large")
        self.cols, self.rows = cols, [{} for _ in range(rows)]
        self.seen = set()

    def put(self, i, j, v, symmetric):
        for a, b in {(i, j), (j, i)} if symmetric else {(i, j)}:
            if (a, b) in self.seen:
                raise Unreadable("matrix entry given twice")
            self.seen.add((a, b))
            if v:
                self.rows[a][b] = v

    def entries(self):
        head = [f"{len(self.rows)} {self.cols}"]
        return head + [f"{i} {j} {r[j]}" for i, r in enumerate(self.rows) for j in sorted(r)]


def read_dense(lists, what):
    lists = [sequence(r) for r in sequence(lists)]
    m = Matrix(len(lists), len(lists[0]) if lists else 0, what)
    for i, row in enumerate(lists):
        if len(row) != m.cols:
            raise Unreadable(f"{what}: ragged")
        m.rows[i] = {j: q for j, v in enumerate(row) if (q := number(v))}
    return m


def place_of(word, last=None):
    """A size, or with `last` an index from 1: digits alone."""
    if not re.fullmatch("[0-9]+", word) or (last is not None and not 1 <= int(word) <= last):
        raise Unreadable(f"Matrix Market: not a size or an index: {word[:40]!r}")
    return int(word)


def words_of(line):
    """Words of a Matrix Market line: blanks and tabs stand between them, and nothing else."""
    return [word for word in re.split("[ \t]+", line) if word]


def read_market(name, folder, what):
    if not isinstance(name, str) or os.path.isabs(name) or ".." in re.split(r"[/\\]", name):
        raise Unreadable(f"{what}: the file must be beside or below the problem file")
    path = os.path.join(folder, name)
    if not os.path.isfile(path) or not os.path.realpath(path).startswith(os.path.realpath(folder) + os.sep):
        raise Unreadable(f"{what}: no such regular file beside the problem: {name}")
    try:
        with open(path, encoding="utf-8", newline="") as f:
            lines = f.read().replace("\r\n", "\n").split("\n")  # a CR alone ends no line
    except (OSError, ValueError) as e:
        raise Unreadable(f"{what}: {e}") from None
    head = words_of(lines[0].lower()) if lines else []
    if len(head) != 5 or head[:2] != ["%%matrixmarket", "matrix"] or head[2] not in ("coordinate", "array") \
            or head[3] not in ("real", "integer", "double") or head[4] not in ("general", "symmetric"):
        raise Unreadable(f"{what}: Matrix Market header")
    body = [words for line in lines[1:] if not line.startswith("%") and (words := words_of(line))]
    symmetric = head[4] == "symmetric"
    if not body or len(body[0]) != (3 if head[2] == "coordinate" else 2):
        raise Unreadable(f"{what}: Matrix Market sizes")
    size = [place_of(w) for w in body[0]]
    m = Matrix(size[0], size[1], what)
    if symmetric and size[0] != size[1]:
        raise Unreadable(f"{what}: not square")
    if head[2] == "coordinate":
        if len(body) - 1 != size[2] or any(len(w) != 3 for w in body[1:]):
            raise Unreadable(f"{what}: number of entries")
        for w in body[1:]:
            i, j = place_of(w[0], size[0]), place_of(w[1], size[1])
            if symmetric and i < j:
                raise Unreadable(f"{what}: the lower triangle of a symmetric matrix was expected")
            m.put(i - 1, j - 1, number(w[2]), symmetric)
        return m
    places = [(i, j) for j in range(size[1]) for i in range(j if symmetric else 0, size[0])]
    if len(body) - 1 != len(places) or any(len(w) != 1 for w in body[1:]):
        raise Unreadable(f"{what}: number of entries")
    for (i, j), w in zip(places, body[1:]):
        m.put(i, j, number(w[0]), symmetric)
    return m


def read_matrix(obj, folder, what):
    if isinstance(obj, list):
        return read_dense(obj, what)
    if not isinstance(obj, dict):
        raise Unreadable(f"{what}: a matrix was expected")
    given = {key: v for key, v in obj.items() if v is not None or key == "symmetric"}
    symmetric, read_as = given.pop("symmetric", False), given.pop("read_as", None)
    if symmetric not in (True, False) or not isinstance(symmetric, bool):
        raise Unreadable(f"{what}: symmetric")
    if read_as not in (None, "f64", "exact"):
        raise Unreadable(f"{what}: read_as")
    for key in obj:
        if key not in ("dense", "rows", "cols", "entries", "matrix_market", "symmetric", "read_as"):
            raise Unreadable(f"{what}: unknown field {key[:40]!r}")
    if set(given) == {"matrix_market"} and not symmetric:
        m = read_market(given["matrix_market"], folder, what)
    elif set(given) == {"dense"} and not symmetric:
        m = read_dense(given["dense"], what)
    elif set(given) == {"rows", "cols", "entries"}:
        m = Matrix(counter(given["rows"], 0, MAX_SIDE), counter(given["cols"], 0, MAX_SIDE), what)
        for e in sequence(given["entries"]):
            if len(sequence(e)) != 3:
                raise Unreadable(f"{what}: an entry is [i, j, v]")
            i, j = index(e[0], len(m.rows)), index(e[1], m.cols)
            if symmetric and (i >= m.cols or j >= len(m.rows)):
                raise Unreadable(f"{what}: not square")
            m.put(i, j, number(e[2]), symmetric)
    else:
        raise Unreadable(f"{what}: one of dense, entries with rows and cols, matrix_market was expected")
    if read_as == "f64":
        m.rows = [{j: d for j, v in r.items() if (d := nearest_double(v))} for r in m.rows]
    return m


def read_radius(obj, matrix, folder, what):
    """The rows of a radius of K or M (F, Radii), none where it is not given."""
    if obj is None:
        return []
    if matrix is None or not isinstance(obj, dict) or len(obj) != 1:
        raise Unreadable(f"{what}: one radius of a matrix that is given was expected")
    (kind, value), = obj.items()
    if kind == "matrix":
        radius = read_matrix(value, folder, what)
        if (len(radius.rows), radius.cols) != (len(matrix.rows), matrix.cols):
            raise Unreadable(f"{what}: order")
        rows = radius.rows
    elif kind in ("absolute", "relative"):
        r = number(value)
        of = (lambda v: r) if kind == "absolute" else (lambda v: r * abs(v))
        rows = [{j: of(v) for j, v in row.items() if of(v)} for row in matrix.rows]
    else:
        raise Unreadable(f"{what}: absolute, relative or matrix was expected")
    if any(v < 0 or rows[j].get(i) != v for i, row in enumerate(rows) for j, v in row.items()):
        raise Unreadable(f"{what}: a negative entry, or not symmetric")
    return rows


class Problem:
    """The pencil (a, b: rows {j: value}), free and complementarity indices, the digest."""

    def __init__(self, path):
        doc = read_json(path)
        if not isinstance(doc, dict) or doc.get("format") != "mceip-problem/1":
            raise Unreadable("format: mceip-problem/1 was expected")
        _, self.unknown, window, pencil, system, _, _, *words = fields(doc, "format unknown", "window pencil system coordinates warnings name comment")
        for word in words:
            Maybe(text_of)(word)
        if self.unknown not in ("lambda2", "mu", "eigenvalue") or (pencil is None) == (system is None):
            raise Unreadable("unknown is lambda2, mu or eigenvalue; exactly one of pencil and system")
        if self.unknown == "eigenvalue" and pencil is None:
            raise Unreadable("eigenvalue is the unknown of a pencil only")
        read_window(window, self.unknown)
        folder = os.path.dirname(os.path.abspath(path))
        self.system = None
        self.radii = None  # of K and M by rows, and the share of each variable (C, 5.22)
        self.halves = []  # (right, left) for each particle in contact with zero reaction
        self.curved = False  # a particle has a geometric stiffness (F, Curvature)
        self.spread = None
        text = ["mceip-canonical/1", f"unknown {self.unknown}"]
        text += self.read_pencil(pencil, folder) if system is None else self.read_system(system, folder)
        self.digest = hashlib.sha256("".join(line + "\n" for line in text).encode()).hexdigest()
        is_free = set(self.free)
        self.s = [i for i in range(self.n) if i not in is_free]

    def read_pencil(self, obj, folder):
        *_, c, free = fields(obj, "a b", "c free")
        names = "ab" if c is None else "abc"
        named = [(name, read_matrix(obj[name], folder, name)) for name in names]
        self.n = len(named[0][1].rows)
        if self.n == 0 or any((len(m.rows), m.cols) != (self.n, self.n) for _, m in named):
            raise Unreadable("the matrices of a pencil must be square, of one order")
        free = [index(i, self.n) for i in sequence(obj.get("free", []))]
        if self.unknown == "eigenvalue" and free or self.unknown != "eigenvalue" and c is not None or len(set(free)) < len(free):
            raise Unreadable("free: an index twice, or one at all for eigenvalue; c: for eigenvalue alone")
        self.free, self.powers = sorted(free), [m.rows for _, m in named]
        text = ["pencil", " ".join(["free", *map(str, self.free)])]
        self.a, self.b = self.powers if len(self.powers) == 2 else linear_form(*self.powers)
        if len(self.powers) == 3:
            self.free, self.n = list(range(self.n, 2 * self.n)), 2 * self.n
        for name, m in named:
            head, *entries = m.entries()
            text += [f"{name} {head}", *entries]
        return text

    def reflected(self):
        """The problem in s = -t (C, 5.2)."""
        a, b, *c = self.powers
        b = [{j: -v for j, v in row.items()} for row in b]
        a, b = linear_form(a, b, *c) if c else (a, b)
        return SimpleNamespace(**{**vars(self), "a": a, "b": b})

    def read_system(self, obj, folder):
        k, particles, m, mu, radii = fields(obj, "stiffness particles", "mass friction radii")
        k = read_matrix(k, folder, "stiffness")
        m = None if m is None else read_matrix(m, folder, "mass")
        mu = None if mu is None else number(mu)
        if mu is not None and mu <= 0:
            raise Unreadable("friction must be positive (X8)")
        order = len(k.rows)
        for x in (k,) if m is None else (k, m):
            if (len(x.rows), x.cols) != (order, order) or any(x.rows[j].get(i) != v for i, r in enumerate(x.rows) for j, v in r.items()):
                raise Unreadable("stiffness and mass must be symmetric, of one order")
        if self.unknown == "lambda2" and (m is None or mu is None):
            raise Unreadable("lambda2 needs mass and friction")
        of_k, of_m = fields({} if radii is None else radii, "", "stiffness mass")
        of_k = read_radius(of_k, k, folder, "radius of K")
        of_m = read_radius(of_m, m, folder, "radius of M")
        text = ["system"] + ([] if mu is None else [f"friction {mu}"])
        taken, held, trial, test, slips, sticks, zeros = set(), set(), [], [], [], [], []
        exact, shares = not any(of_k) and not any(of_m), []
        for p in sequence(particles):
            t, n, state, tangent, normal, sign, factor, ends, stiffness = self.read_particle(p, order, mu)
            if taken & {t, n} or t == n:
                raise Unreadable("a dof in two particles")
            taken |= {t, n}
            text += particle_lines(t, n, state, sign, tangent, normal, factor)
            if ends is not None:  # C, 5.22: the middle and the share
                exact, factor = False, sum(ends) / 2
                text.append(f"friction_factor_range {ends[0]} {ends[1]}")
            if stiffness:
                self.curved = True
                text.append(f"geometric_stiffness {stiffness}")
            friction = {d: factor * c for d, c in normal.items()}
            if state != "free":
                held |= {t, n}
            if state == "stick":
                sticks += [t, n]
            elif state == "slip":  # E10: v = -S x tangent; E11: y = -(S w_T + mu w_N)
                turning = (1 + (factor * mu) ** 2) * stiffness if stiffness and mu is not None else Q(0)  # K.1
                slips.append((tangent, normal, friction, sign, turning))
                shares.append(Q(0) if ends is None else (ends[1] - ends[0]) / (ends[1] + ends[0]))
                trial.append({d: -sign * c for d, c in tangent.items()})
                test.append(({d: -sign * c for d, c in tangent.items()}, {d: -c for d, c in friction.items()}))
            elif state == "zero":
                zeros.append((tangent, normal, friction))
        free = [d for d in range(order) if d not in held]
        self.system = k.rows, None if m is None else m.rows, mu, slips, sticks, zeros, free
        for tangent, normal, friction in zeros:  # Z.3: gap, right, left
            self.halves.append((len(free) + len(trial) + 1, len(free) + len(trial) + 2))
            for vector, s in ((normal, -1), (tangent, 1), (tangent, -1)):
                trial.append({d: s * c for d, c in vector.items()})
                test.append((trial[-1], {} if vector is normal else {d: -c for d, c in friction.items()}))
        trial = [{d: Q(1)} for d in free] + trial
        test = [({d: Q(1)}, {}) for d in free] + test
        self.changes = test, trial
        if self.unknown == "lambda2":  # E15
            rows = [{d: u.get(d, 0) + mu * w.get(d, 0) for d in {*u, *w}} for u, w in test]
            self.a, self.b = project(rows, k.rows, trial), project(rows, m.rows, trial)
            for i, (*_, turning) in enumerate(slips, len(free)):
                self.a[i] = {j: v for j, v in plus(self.a[i], {i: turning}).items() if v}
        else:  # E21
            self.a, self.b = project([u for u, _ in test], k.rows, trial), project([w for _, w in test], k.rows, trial)
        self.n, self.free = len(trial), list(range(len(free)))
        if not slips:
            raise Unreadable("particles: expected one in impending slip")
        if zeros and not exact:
            raise Unreadable("radii beside a particle in state zero")
        if self.curved and (self.unknown != "lambda2" or not exact):
            raise Unreadable("a curved system has the unknown lambda2 and no radii")
        if not exact:
            self.radii = of_k, of_m, [Q(0)] * len(free) + shares
        text += matrix_lines(k, m)
        for name, x in (("stiffness", of_k), ("mass", of_m)):
            if any(x):
                text.append(f"{name}_radius {order} {order}")
                text += [f"{i} {j} {r[j]}" for i, r in enumerate(x) for j in sorted(r)]
        return text

    @staticmethod
    def read_particle(obj, order, mu):
        t, n, state, sign, direction, frame, factor, ends, reaction, curvature, name = fields(
            obj, "tangential normal state",
            "sign normal_direction frame friction_factor friction_factor_range reaction curvature name")
        Maybe(text_of)(name)
        t, n = index(t, order), index(n, order)
        if state not in ("free", "stick", "slip", "zero") or (sign is not None) != (state == "slip"):
            raise Unreadable("state is free, stick, slip or zero; sign exactly for slip")
        sign = None if sign is None else counter(sign, -1, 1)
        direction = 1 if direction is None else counter(direction, -1, 1)
        if sign not in (None, 1, -1) or direction not in (1, -1):
            raise Unreadable("sign and normal_direction are 1 or -1")
        c = [[Q(1), Q(0)], [Q(0), Q(1)]]
        if frame is not None:
            c = [[number(v) for v in sequence(r)] for r in sequence(frame)]
            if [len(r) for r in c] != [2, 2] or c[0] != [c[1][1], -c[1][0]] or c[0][0] ** 2 + c[0][1] ** 2 != 1:
                raise Unreadable("frame: not a rotation")
        factor = Q(1) if factor is None else number(factor)
        if factor <= 0:
            raise Unreadable("friction_factor must be positive")
        if ends is not None:
            ends = pair(ends)
            if not (0 <= ends[0] < ends[1] and ends[0] <= factor <= ends[1]):
                raise Unreadable("friction_factor_range: 0 <= lo < hi, the factor between")
        if reaction is not None:  # E7
            rn, rt = map(number, fields(reaction, "normal tangential"))
            bound = None if mu is None else -factor * mu * rn
            bad = (rn or rt) if state in ("free", "zero") else rn >= 0
            bad = bad or (state == "slip" and (rt * sign <= 0 or (mu is not None and abs(rt) != bound)))
            if bad or (state == "stick" and mu is not None and abs(rt) >= bound):
                raise Unreadable("reaction against (7), state or sign")
        stiffness = Q(0)
        if curvature is not None:
            value, pressure = map(number, fields(curvature, "value normal_reaction"))
            if state != "slip" or pressure >= 0 or (reaction is not None and rn != pressure):
                raise Unreadable("curvature: of a slip particle, with the normal reaction r_N < 0 at equilibrium")
            stiffness = value * pressure
        tangent, normal = {t: Q(1)}, {n: Q(direction)}
        if frame is not None:
            tangent = {t: c[0][0], n: c[0][1]}
            normal = {t: direction * c[1][0], n: direction * c[1][1]}
        return t, n, state, tangent, normal, sign, factor, ends, stiffness


def particle_lines(t, n, state, sign, tangent, normal, factor):
    """A particle in the text of a digest."""
    text = [f"particle {t} {n} {state}" + (f" {sign}" if state == "slip" else "")]
    for name, vector in (("tangent", tangent), ("normal", normal)):
        text.append(" ".join([name] + [f"{d} {vector[d]}" for d in vector]))
    return text + ([f"friction_factor {factor}"] if factor != 1 else [])


def matrix_lines(k, m):
    """Stiffness and mass in the text of a digest."""
    text = []
    for name, x in (("stiffness", k), ("mass", m)):
        if x is not None:
            e = x.entries()
            text += [f"{name} {e[0]}", *e[1:]]
    return text


def project(test, k, trial):
    """Rows test' K trial (E16), sparse."""
    by_dof = {}
    for j, v in enumerate(trial):
        for d, c in v.items():
            if c:
                by_dof.setdefault(d, []).append((j, c))
    out = []
    for u in test:
        row = {}
        for d, c in u.items():
            if c:
                for e, v in k[d].items():
                    for j, g in by_dof.get(e, ()):
                        row[j] = row.get(j, 0) + c * v * g
        out.append({j: v for j, v in row.items() if v})
    return out


def linear_form(a, b, c):
    """The pencil in x and z = x/(1 + t) of a + t b + t^2 c (C, 5.2)."""
    n, upper = len(a), []
    for a_i, b_i, c_i in zip(a, b, c):
        row = {**plus(b_i, c_i, -1), **{n + j: v for j, v in plus(plus(a_i, b_i, -1), c_i).items()}}
        upper.append({j: v for j, v in row.items() if v})
    return upper + [{i: Q(-1), n + i: Q(1)} for i in range(n)], c + [{n + i: Q(1)} for i in range(n)]


def integral_rows(p):
    """Per row: the least positive integer f and the integral rows f A, f B."""
    out = []
    for a, b in zip(p.a, p.b):
        f = lcm(1, *(v.denominator for v in a.values()), *(v.denominator for v in b.values()))
        out.append((f, {j: int(v * f) for j, v in a.items()}, {j: int(v * f) for j, v in b.items()}))
    return out


# ---------------------------------------------------------------- claims

def horner(poly, a, b):
    """Interval Horner of an integer polynomial on [a, b], scaled by a positive number."""
    q = lcm(a.denominator, b.denominator)
    a, b, power, lo, hi = int(a * q), int(b * q), 1, 0, 0
    for c in reversed(poly):
        products = (lo * a, lo * b, hi * a, hi * b)
        lo, hi = min(products) + c * power, max(products) + c * power
        power *= q
    return lo, hi


def strip(poly):
    while poly and poly[-1] == 0:
        poly = poly[:-1]
    return poly


def remainder(y, p):
    """A positive multiple of y mod p (p with positive leading coefficient)."""
    y = strip(list(y))
    while len(y) >= len(p):
        lead, shift = y[-1], len(y) - len(p)
        y = [c * p[-1] for c in y]
        for i, c in enumerate(p):
            y[shift + i] -= lead * c
        y = strip(y)
        g = gcd(*y) if y else 1
        y = [c // g for c in y]
    return y


def remainders(list_of_y, p):
    """All of them mod p, multiplied by one positive number, if one is much longer than p."""
    steps = max(map(len, list_of_y), default=0) + 1 - len(p)
    if steps <= 2:
        return list_of_y
    out = []
    for y in list_of_y:
        y = strip(list(y))
        for _ in range(steps):
            lead, shift = (y[-1], len(y) - len(p)) if len(y) >= len(p) else (0, 0)
            y = [c * p[-1] for c in y]
            if lead:
                for i, c in enumerate(p):
                    y[shift + i] -= lead * c
            y = strip(y)
        out.append(y)
    return out


def ascending(items, allowed):
    demand(all(i < j for i, j in zip(items, items[1:])) and set(items) <= set(allowed), "1: not an ascending list of complementarity variables")


def one_half(p, support):
    demand(not any(set(pair) <= set(support) for pair in p.halves), "1: a particle with zero reaction slides both ways")


def isolated(poly, x, a, b):
    """Sizes, and [a, b] isolates one root of p: obligations 1 and 2. Returns p with a positive leading coefficient."""
    longest = max(map(len, x))
    demand(max(len(poly), longest) <= 512, "1: more than 512 coefficients")
    bits = max([rational_bits(a) + rational_bits(b), *(abs(c).bit_length() for c in poly), *(rational_bits(c) for r in x for c in r)])
    work = len(x) * ((len(poly) + longest) * bits)**2
    Budget.claims -= min(work, 2**43)
    demand((len(poly) + longest) * bits <= 2**21, "1: too much work")
    demand(work <= 2**43, "1: too much work for all rows")
    demand(Budget.claims >= 0, "1: the claims of the file take more work than their budget")
    excess = max(longest - len(poly), 0)
    demand(excess <= 1 or excess * bits <= 2**13, "1: x has too many coefficients beyond those of the polynomial")
    poly = strip(poly)  # 2
    demand(len(poly) >= 2 and a <= b, "2: degree or interval")
    if poly[-1] < 0:
        poly = [-c for c in poly]
    ends = horner(poly, a, a)[0], horner(poly, b, b)[0]
    if a == b:
        demand(ends[0] == 0, "2: not a root")
    else:
        low, high = horner([k * c for k, c in enumerate(poly)][1:], a, b)
        demand((ends[0] > 0) != (ends[1] > 0) and 0 not in ends and (low > 0 or high < 0), "2: not exactly one root")
    return poly


def exact_solution(p, rows, window, obj):
    support, biactive, poly, interval, x = fields(obj, "support biactive polynomial interval x")
    support, biactive = ([place_in(i, p.n) for i in sequence(l)] for l in (support, biactive))
    poly = [integer(c) for c in sequence(poly)]
    x = [[number(c) for c in sequence(r)] for r in sequence(x)]
    a, b = pair(interval)
    ascending(support, p.s)  # 1
    ascending(biactive, p.s)
    demand(not set(support) & set(biactive), "1: a variable both in the support and biactive")
    one_half(p, support)
    demand(len(x) == p.n, "1: one polynomial per variable")
    poly = isolated(poly, x, a, b)
    inside(window, a, b, "3")
    scale = lcm(1, *(c.denominator for r in x for c in r))
    x = remainders([[int(c * scale) for c in r] for r in x], poly)
    longest = max(map(len, x))
    reduced = [remainder(r, poly) for r in x]
    for i in p.s:  # 4
        if i in set(support):
            demand(horner(reduced[i], a, b)[0] > 0, f"4: x_{i} > 0")
        else:
            demand(not reduced[i], f"4: x_{i} = 0")
    if not support:
        demand(any((e := horner(reduced[i], a, b))[0] > 0 or e[1] < 0 for i in p.free), "4: x may be zero")
    zero = {*p.free, *support, *biactive}
    for i, (_, ra, rb) in enumerate(rows):  # 5
        y = [0] * (longest + 1)
        for row, shift in ((ra, 0), (rb, 1)):
            for j, v in row.items():
                for k, c in enumerate(x[j]):
                    y[k + shift] += v * c
        y = remainder(y, poly)
        demand(not y if i in zero else horner(y, a, b)[0] > 0, f"5: y_{i}")
    return support, biactive, a, b


def lifted_solution(p, rows, window, obj):
    """v and w over all dofs: the lines of (9), from K, M, mu and the states (C, 5.4)."""
    support, biactive, poly, interval, v, w = fields(obj, "support biactive polynomial interval v w")
    support, biactive = ([place_in(i, p.n) for i in sequence(l)] for l in (support, biactive))
    poly = [integer(c) for c in sequence(poly)]
    v, w = ([[number(c) for c in sequence(r)] for r in sequence(l)] for l in (v, w))
    a, b = pair(interval)
    demand(p.system is not None, "lifted: the problem is no system")
    k, m, mu, slips, sticks, zeros, free = p.system
    ascending(support, p.s)
    ascending(biactive, p.s)
    demand(not set(support) & set(biactive), "lifted 1: a variable both in the support and biactive")
    one_half(p, support)
    demand(len(v) == len(w) == len(k), "lifted 1: one polynomial per dof")
    poly = isolated(poly, v + w, a, b)
    inside(window, a, b, "3")
    both = remainders(v + w, poly)
    v, w = both[:len(v)], both[len(v):]

    def plus(*terms):
        """A positive multiple of the sum of factor t^shift g, mod p."""
        out = [Q(0)] * (max((len(g) + shift for _, g, shift in terms), default=0))
        for factor, g, shift in terms:
            for i, c in enumerate(g):
                out[i + shift] += factor * c
        scale = lcm(1, *(c.denominator for c in out))
        return remainder([int(c * scale) for c in out], poly)

    def along(direction, factor, values, shift=0):
        return [(factor * c, values[d], shift) for d, c in direction.items() if c]
    for i in range(len(k)):
        terms = [(x, v[j], 0) for j, x in k[i].items()] + [(Q(-1), w[i], 0)]
        if p.unknown == "lambda2":
            terms += [(x, v[j], 1) for j, x in m[i].items()]
        demand(not plus(*terms), f"lifted 2: (lambda^2 M + K) v = w at dof {i}")
    for i in free:
        demand(not plus((Q(1), w[i], 0)), f"lifted 3: w_f = 0 at dof {i}")
    for i in sticks:
        demand(not plus((Q(1), v[i], 0)), f"lifted 4: v_d = 0 at dof {i}")

    def cone(tangent, friction, sign, turning=Q(0)):
        """S w_T + mu w_N, and (1 + mu^2) g S v_T on a curved obstacle."""
        if p.unknown == "lambda2":
            return plus(*along(tangent, Q(sign), w), *along(friction, mu, w), *along(tangent, sign * turning, v))
        return plus(*along(tangent, Q(sign), w), *along(friction, Q(1), w, 1))

    def complementary(place, rate, force, other=False):
        """rate < 0 on the support, else rate = 0 (unless the other half slides); force = 0 or < 0."""
        if place in support:
            demand(horner(rate, a, b)[1] < 0 and not force, f"lifted 6: variable {place} slips")
            return
        demand(other or not rate, f"lifted 6: variable {place} has no rate")
        if place in biactive:
            demand(not force, f"lifted 6: variable {place} is biactive")
        else:
            demand(horner(force, a, b)[1] < 0, f"lifted 6: variable {place} rests")
    for place, (tangent, normal, friction, sign, turning) in enumerate(slips, len(free)):
        demand(not plus(*along(normal, Q(1), v)), f"lifted 5: v_N = 0 at variable {place}")
        complementary(place, plus(*along(tangent, Q(sign), v)), cone(tangent, friction, sign, turning))
    for (right, left), (tangent, normal, friction) in zip(p.halves, zeros):
        complementary(right - 1, plus(*along(normal, Q(1), v)), plus(*along(normal, Q(1), w)))
        complementary(right, plus(*along(tangent, Q(-1), v)), cone(tangent, friction, -1), left in support)
        complementary(left, plus(*along(tangent, Q(1), v)), cone(tangent, friction, 1), right in support)
    if not support:
        demand(any((e := horner(plus((Q(1), v[i], 0)), a, b))[0] > 0 or e[1] < 0 for i in free), "lifted 7: v may be zero")
    return support, biactive, a, b


def pair(obj):
    if len(sequence(obj)) != 2:
        raise Unreadable("an interval is [a, b]")
    return number(obj[0]), number(obj[1])


def inside(window, a, b, item):
    demand(window[0] <= a and (window[1] is None or b <= window[1]), f"{item}: outside the window")


def over_common(values):
    q = lcm(1, *(v.denominator for v in values))
    return [int(v * q) for v in values], q


def vanishing_with(p, support):
    """The halves whose rows vanish with those of the support, by the lemma of Z.3 (halves in the support are named too)."""
    return {i for right, left in p.halves if right - 1 in support for i in (right, left) if {right, left} & set(support)}


def enclosed_solution(p, rows, window, obj):
    support, center, radius, y, exponent = fields(obj, "support center radius preconditioner exponent")
    support = [place_in(i, p.n) for i in sequence(support)]
    center, radius = ([number(v) for v in sequence(l)] for l in (center, radius))
    exponent = counter(exponent)
    y = [[integer(v) for v in sequence(r)] for r in sequence(y)]
    ascending(support, p.s)  # 1
    one_half(p, support)
    vanishing = vanishing_with(p, support)
    active = sorted([*p.free, *support])
    m = len(active)
    demand(support and len(center) == len(radius) == len(y) == m + 1 and all(len(r) == m + 1 for r in y), "1: lengths")
    demand(all(r > 0 for r in radius) and exponent <= 65_536, "1: radii or exponent")
    place = {i: k for k, i in enumerate(active)}
    (*c, t), qc = over_common(center)  # units 1/qc
    (*r, rt), qr = over_common(radius)  # units 1/qr
    # The rows of F'(c) in units 1/qc, of F(c) in 1/qc^2, of d in 1/qr^2.
    jac, value, d = [], [], []
    for i in active:
        _, ra, rb = rows[i]
        row = {place[j]: v * qc for j, v in ra.items() if j in place}
        for j, v in rb.items():
            if j in place:
                row[place[j]] = row.get(place[j], 0) + v * t
        value.append(sum(v * c[k] for k, v in row.items()))
        row[m] = sum(v * c[place[j]] for j, v in rb.items() if j in place)
        jac.append(list(row.items()))
        d.append(2 * rt * sum(abs(v) * r[place[j]] for j, v in rb.items() if j in place))
    jac.append([(place[i], qc) for i in support])
    value.append(sum(c[place[i]] for i in support) * qc - qc * qc)
    d.append(0)
    for i, row in enumerate(y):  # 2, multiplied by 2^exponent qc^2 qr^2
        product = [0] * (m + 1)
        for f, line in zip(row, jac):
            if f:
                for k, v in line:
                    product[k] += f * v
        product[i] -= qc << exponent
        left = abs(sum(f * v for f, v in zip(row, value))) * qr * qr
        left += sum(abs(v) * q for v, q in zip(product, [*r, rt])) * qc * qr + sum(abs(f) * v for f, v in zip(row, d)) * qc * qc
        demand(left < ([*r, rt][i] * qc * qc * qr) << exponent, f"2: Krawczyk, component {i}")
    low, high = center[m] - radius[m], center[m] + radius[m]  # 3
    inside(window, low, high, "3")
    demand(all(center[place[i]] > radius[place[i]] for i in support), "3: x > 0")
    for i in p.s:
        if i not in place and i not in vanishing:
            _, ra, rb = rows[i]
            mid = slack = Q(0)
            for j in {*ra, *rb} & set(place):
                k, a, b = place[j], ra.get(j, 0), rb.get(j, 0)
                e = a + center[m] * b
                mid += e * center[k]
                slack += abs(e) * radius[k] + radius[m] * abs(b) * radius[k]
            slack += radius[m] * abs(sum(b * center[place[j]] for j, b in rb.items() if j in place))
            demand(mid > slack, f"3: y_{i} > 0")
    return support, [], low, high


# ---------------------------------------------------------------- the regions' matrices

class Ends:
    """M0, M1, R0, R1, D (integers, in units of 1/unit); `unbounded`: the second end is a direction. T(lo) is within R0 of M0, T(hi) within R1 of M1."""

    def __init__(self, m0, m1, r0, r1, d, unit, unbounded):
        self.both, self.d, self.unit, self.unbounded = ((m0, r0), (m1, r1)), d, unit, unbounded

    def chord(self, lo):
        """s T(t), s = lo / t from 1 to 0, of T(lo) and the direction B that these ends are: the ends T(lo) and lo B."""
        (m0, r0), (m1, r1) = self.both
        p, q = lo.numerator, lo.denominator

        def times(factor, m):
            return [[factor * v for v in row] for row in m]
        s0, s1 = times(q, r0), times(p, r1)
        d = [[v + w for v, w in zip(rv, rw)] for rv, rw in zip(s0, s1)]
        return Ends(times(q, m0), times(p, m1), s0, s1, d, self.unit * q, True)


BITS = 128


def rational_bits(q):
    return abs(q.numerator).bit_length() + q.denominator.bit_length()


def affordable(ns, coefficients, lo, hi, bound_bits=0):
    """The matrices of a region have a largest size (C, Limits)."""
    bits = BITS + bound_bits + rational_bits(lo) + (0 if hi is None else rational_bits(hi))
    demand(ns * ns * coefficients * bits <= 2**29, "a region's matrices are too large")


def words(bits):
    return bits // 64 + 1


def spend_matrix(ns, coefficients, entry_words, center_bits, lo, hi):
    """The matrices of all regions have a largest work (C, Limits)."""
    powers = coefficients * words(BITS + center_bits + rational_bits(lo) + (0 if hi is None else rational_bits(hi)))
    Budget.matrices -= ns * ns * (powers * (entry_words + powers) + 256)
    demand(Budget.matrices >= 0, "matrices of regions: more work than the file's budget")


def row_bits(rows, part):
    """The bits of the longest entry of A (1) or of B (2) in each integral row, at least 1."""
    return [max(1, *(abs(v).bit_length() for v in row[part].values()), 1) for row in rows]


def with_radii(ends, r0, r1, shares):
    """The ends with these radii added, then each row of the matrices times a number within its
    share of 1 (C, 5.22, Ends)."""
    widened = []
    for (m, r), more in zip(ends.both, (r0, r1)):
        r = [[x + y for x, y in zip(*of_row)] for of_row in zip(r, more)]
        widened.append([
            [x + ceil(d * (abs(c) + x)) for c, x in zip(*of_row)]
            for d, *of_row in zip(shares, m, r)])
    (m0, _), (m1, _) = ends.both
    return Ends(m0, m1, *widened, ends.d, ends.unit, ends.unbounded)


class PlainPencil:
    """No free variables: T(lo) and T(hi) themselves, rows scaled (C, Matrices of a region)."""

    def __init__(self, p, rows, bits=None):
        self.parts, bits = [], bits or row_bits(rows, 1)
        for b, (_, *both) in zip(bits, rows):
            # Rounded down to units of 2^-128 where 2^b exceeds 2^128; the radius is one unit each then.
            x, y = ([(row.get(j, 0) << BITS) >> b for j in range(p.n)] for row in both)
            self.parts.append((x, y, int(b > BITS)))
        self.p, self.n, self.paid = p, p.n, None
        self.numbers = 0
        self.spread = None
        if p.spread is not None:  # scaled as the rows they belong to, in units of 2^-128
            scales = [Q(f << BITS, 2**b) for b, (f, _, _) in zip(bits, rows)]
            self.spread = [
                [[ceil(r.get(j, 0) * s) for j in range(p.n)] for r, s in zip(x, scales)]
                for x in p.spread[:2]]

    def name(self, _anchor):
        pass

    def reversed(self, _anchor):
        return False

    def ends(self, lo, hi, _anchor):
        affordable(self.n, 1, lo, hi)
        if self.paid != (lo, hi):
            self.paid = lo, hi
            spend_matrix(self.n, 1, words(BITS), 0, lo, hi)
        q = lcm(lo.denominator, 1 if hi is None else hi.denominator)

        def at(t):
            s = int(t * q)
            return [[q * v + s * w for v, w in zip(a, b)] for a, b, _ in self.parts], [[(q + abs(s)) * r] * self.n for _, _, r in self.parts]
        m0, r0 = at(lo)
        if hi is None:
            m1, r1, d = [[q * w for w in b] for _, b, _ in self.parts], [[q * r] * self.n for _, _, r in self.parts], None
        else:
            m1, r1 = at(hi)
            d = [[int((hi - lo) * q) * 2 * r] * self.n for _, _, r in self.parts]  # T' and (M1 - M0)/(hi - lo): one unit, generously two
        ends = Ends(m0, m1, r0, r1, d, q << BITS, hi is None)
        if self.spread is None:
            return ends

        def at_data(x, y):
            """x RA + y RB."""
            return [[int(x * v + y * w) for v, w in zip(*of_row)] for of_row in zip(*self.spread)]
        upper = at_data(0, q) if hi is None else at_data(q, q * hi)
        return with_radii(ends, at_data(q, q * lo), upper, self.p.spread[2])


def covered(s, n, factor, strict, what):
    """S (rows {j: Fraction}, symmetric) is covered by L: S - L L' diagonally dominant (C, Condensation)."""
    if factor is None:
        demand(not strict and all(all(j == i or not v for j, v in row.items()) and row.get(i, 0) >= 0 for i, row in enumerate(s)), f"{what}: not a non-negative diagonal")
        return
    first, rows, exponent = fields(factor, "first rows exponent")
    exponent = integer(exponent, 0)
    demand(exponent <= 4096, f"{what}: exponent of the factor")
    first = [integer(i, 0) for i in sequence(first)]
    rows = [[integer(v) for v in sequence(r)] for r in sequence(rows)]
    demand(len(first) == len(rows) == n and all(f <= i and f + len(r) == i + 1 for i, (f, r) in enumerate(zip(first, rows))), f"{what}: shape of the factor")
    scale = lcm(1, *(v.denominator for r in s for v in r.values()))
    diagonal, off = [0] * n, [0] * n
    for i in range(n):
        for j in range(min(first[i], *s[i].keys(), i) if s[i] else first[i], i + 1):
            start = max(first[i], first[j])
            dot = sum(a * b for a, b in zip(rows[i][start - first[i]:], rows[j][start - first[j]:])) if start <= j else 0
            e = (int(s[i].get(j, 0) * scale) << 2 * exponent) - dot * scale
            if i == j:
                diagonal[i] = e
            else:
                off[i] += abs(e)
                off[j] += abs(e)
    demand(all(d > o if strict else d >= o for d, o in zip(diagonal, off)), f"{what}: not diagonally dominant")


def plus(a, b, factor=1):
    out = dict(a)
    for j, v in b.items():
        out[j] = out.get(j, 0) + factor * v
    return out


def transpose(m):
    t = [{} for _ in m]
    for i, r in enumerate(m):
        for j, v in r.items():
            t[j][i] = v
    return t


def symmetric_part(m):
    return [{j: v / 2 for j, v in plus(r, c).items()} for r, c in zip(m, transpose(m))]


def read_coefficients(lists, nf, ns):
    """Matrices in units of 2^-E, E their largest exponent: (coefficients as columns, E)."""
    out = []
    for m in sequence(lists):
        exponent, rows = fields(m, "exponent rows")
        rows = [[integer(v) for v in sequence(r)] for r in sequence(rows)]
        demand(len(rows) == nf and all(len(r) == ns for r in rows), "anchor: shape")
        out.append((integer(exponent, 0), rows))
    demand(len(out) <= 8 and all(e <= 4096 for e, _ in out), "anchor: number of coefficients or exponent")
    top = max((e for e, _ in out), default=0)
    return [[[v << (top - e) for v in column] for column in zip(*rows)] for e, rows in out], top


def root_up(num, den, fine):
    """An integer that is at least sqrt(num)/den in units of 2^-fine."""
    return (isqrt(num << 2 * fine) + 1) // den + 1


def norm_up(vector, fine):
    q = sum((x * x for x in vector), Q(0))
    return root_up(q.numerator * q.denominator, q.denominator, fine) if q else 0


FINE = 64  # bits below the units of all matrices; a center of b bits is raised to powers, each of which takes b bits more


class CondensedPencil:
    """Free variables: the Schur complement, enclosed from an anchor (C, Condensation)."""

    def __init__(self, p, rows, obj, bits=None, intervals=()):
        sigma, self.stiffness, mass_sigma, anchors, mass, self.tail = fields(obj, "sigma stiffness_factor mass_sigma anchors", "mass_factor tail")
        self.p, self.sigma, self.tau = p, number(sigma), number(mass_sigma)
        self.bound_bits = rational_bits(self.sigma) + rational_bits(self.tau)
        self.place = {i: k for k, i in enumerate(p.free)}
        nf = len(p.free)
        aff, bff = ([{self.place[j]: v for j, v in m[i].items() if j in self.place} for i in p.free] for m in (p.a, p.b))
        demand(self.sigma > 0 and self.tau >= 0 and self.stiffness is not None, "condensation 1: sigma, mass_sigma")
        exact = [{}] * p.n, [{}] * p.n
        for k, (m, bound, factor, what) in enumerate((
                (aff, self.sigma, self.stiffness, "stiffness"), (bff, self.tau, mass, "mass"))):
            radius = (p.spread or exact)[k]
            off = [sum(v for j, v in radius[i].items() if j in self.place) for i in p.free]
            s = [plus(r, {i: -bound - off[i]}) for i, r in enumerate(symmetric_part(m))]
            covered(s, nf, factor, False, f"condensation 1: {what}")
        self.aff_norm, self.bff_norm = (  # of rows and of columns
            max((sum(abs(v) for v in r.values()) for r in m + transpose(m)), default=Q(0)) for m in (aff, bff))
        self.tail_from = None
        if self.tail is not None:  # hypothesis 2
            start, factor, mass_factor = fields(self.tail, "from factor", "mass_factor")
            self.tail_from = number(start)
            symmetric = [symmetric_part(m) for m in ([plus(a, b, self.tail_from) for a, b in zip(p.a, p.b)], p.b)]
            demand(factor is not None, "condensation 2: no factor")
            covered(symmetric[0], p.n, factor, True, "condensation 2: stiffness")
            covered(symmetric[1], p.n, mass_factor, False, "condensation 2: mass")
        self.bits = [[of[i] for i in p.s] for of in bits or [row_bits(rows, k) for k in (1, 2)]]
        self.scales = [[Q(rows[i][0], 2**b) for i, b in zip(p.s, of)] for of in self.bits]
        self.common = lcm(1, *(rows[i][0] for i in p.free))
        self.longest = max((abs(v).bit_length() for _, ra, rb in rows for r in (ra, rb) for v in r.values()), default=0)
        self.longest += self.common.bit_length()
        self.coefficients, self.words, self.costs = [], [], []
        self.numbers = 0
        self.unnamed = [self.read_anchor(a) for a in sequence(anchors)]
        self.anchors = [None] * len(self.unnamed)
        self.cache = {}
        self.intervals, self.reach = intervals, [None] * len(self.unnamed)

    def name(self, anchor):
        """A piece names this anchor, or none: the first time it is expanded, which takes memory."""
        if anchor is not None and self.anchors[anchor] is None:
            Budget.anchors -= self.costs[anchor]
            demand(Budget.anchors >= 0, "anchors: expansions of more bits than the file's budget")
            if self.p.spread is not None:
                self.reach[anchor] = self.of_data(anchor)
            self.anchors[anchor] = self.expand(*self.unnamed[anchor])

    def of_data(self, anchor):
        """P, Q and E for all that the pieces of this anchor cover, the columns of Q and the rows of
        E scaled (C, 5.22, Ends)."""
        center, backwards, w, ew, v, ev = self.unnamed[anchor]
        ends = []
        for lo, hi, name in self.intervals:
            if name == anchor:
                demand(lo > 0 if backwards else hi is not None, "Unbounded: a piece with an anchor")
                ends += ([Q(0) if hi is None else 1 / hi, 1 / lo]) if backwards else [lo, hi]
        delta, last = max(abs(t - center) for t in ends), max(ends)
        demand(max(delta, last) < 2**4096, "TooLarge: what an anchor serves")
        ra, rb = self.p.spread[1::-1] if backwards else self.p.spread[:2]
        r = [plus(x, y, last) for x, y in zip(ra, rb)]

        def size(coefficients, exponent):
            """Of each column the sum of |coefficient| delta^k."""
            out = [[Q(0)] * len(free) for _ in s]
            for k, columns in enumerate(coefficients):
                f = delta**k / 2**exponent
                for column, values in zip(out, columns):
                    column[:] = [x + f * abs(y) for x, y in zip(column, values)]
            return out
        free, s, scales = self.p.free, self.p.s, self.scales[backwards]
        w, v = size(w, ew), size(v, ev)

        def times(i, column):
            return sum(x * column[self.place[j]] for j, x in r[i].items() if j in self.place)
        p = [[r[i].get(j, 0) + times(i, right) for i in free] for j, right in zip(s, w)]
        q = [[f * (r[i].get(j, 0) + times(j, left)) for j in free]
             for i, left, f in zip(s, v, scales)]
        e = [[f * (r[i].get(j, 0) + times(i, right) + dot(left, x)) for j, right, x in zip(s, w, p)]
             for i, left, f in zip(s, v, scales)]
        return p, q, e

    def read_anchor(self, obj):
        """What an anchor is expanded from, within its limits."""
        center, right, left, backwards = fields(obj, "center right left", "reversed")
        if "reversed" in obj and not isinstance(backwards, bool):
            raise Unreadable("anchor: reversed")
        demand(not backwards or self.tau > 0, "condensation 3: a reversed anchor needs mass_sigma > 0")
        center, nf, ns = number(center), len(self.p.free), len(self.p.s)
        (w, ew), (v, ev) = read_coefficients(right, nf, ns), read_coefficients(left, nf, ns)
        self.coefficients.append(len(w) + len(v) + 1)
        of_anchor = sum(max((abs(x).bit_length() for m in e for c in m for x in c), default=0) for e in (w, v))
        bits = ew + ev + of_anchor + self.longest + rational_bits(center)
        demand(ns * ns * self.coefficients[-1] * bits <= 2**29, "an anchor's expansion is too large")
        self.costs.append(ns * ns * max(len(w) + len(v), 2) * (512 + bits))
        self.numbers += nf * ns * (len(w) + len(v))
        largest = max(self.bits[1 if backwards else 0], default=1)
        self.words.append(words((self.common * center.denominator).bit_length() + ew + ev + largest))
        return center, bool(backwards), w, ew, v, ev

    def expand(self, center, backwards, w, ew, v, ev):
        """Z (coefficients, units of 2^-fine, rounded down), and column norms of V, l, r_<, r by power of d, rounded up."""
        p, place, nf, ns = self.p, self.place, len(self.p.free), len(self.p.s)
        a, b = (p.b, p.a) if backwards else (p.a, p.b)
        scale = self.scales[1 if backwards else 0]
        t0 = [plus(x, y, center) for x, y in zip(a, b)]
        den = lcm(1, *(x.denominator for m in (t0, b) for r in m for x in r.values()))
        t0, t1 = ([{j: int(x * den) for j, x in r.items()} for r in m] for m in (t0, b))
        spot = {i: k for k, i in enumerate(p.s)}
        f = [[{place[j]: x for j, x in m[i].items() if j in place} for i in p.free] for m in (t0, t1)]
        sf = [[[(place[j], x) for j, x in m[i].items() if j in place] for i in p.s] for m in (t0, t1)]

        def residual(f, columns, exponent, given):
            """given - F columns by powers of d, units 1/(den 2^exponent)."""
            f0, f1 = ([list(line.items()) for line in m] for m in f)
            out = [[[0] * nf for _ in range(ns)] for _ in range(max(len(columns) + 1, 2))]
            for k in (0, 1):
                for (row, col), x in given[k].items():
                    out[k][col][row] += x << exponent
            for k, coefficient in enumerate(columns):
                for col, vector in enumerate(coefficient):
                    for rows, target in ((f0, out[k][col]), (f1, out[k + 1][col])):
                        for i, line in enumerate(rows):
                            if line:
                                target[i] -= sum([x * vector[j] for j, x in line])
            return out
        fs = [{(place[i], spot[j]): x for i in p.free for j, x in m[i].items() if j in spot} for m in (t0, t1)]
        sft = [{(j, i): x for i, line in enumerate(m) for j, x in line} for m in sf]
        r, l = residual(f, w, ew, fs), residual([transpose(m) for m in f], v, ev, sft)  # l = T_sf' - F' V
        low = len(w)  # powers below belong to r_<
        # Z = T_ss - T_sf W - V' r_>, units 1/(den 2^(ew + ev))
        z = [[[0] * ns for _ in range(ns)] for _ in range(len(v) + len(r))]
        for k, m in enumerate((t0, t1)):
            for i, row in enumerate(p.s):
                for j, x in m[row].items():
                    if j in spot:
                        z[k][i][spot[j]] += x << (ew + ev)
                for e, coefficient in enumerate(w):
                    for j, vector in enumerate(coefficient):
                        z[k + e][i][j] -= sum([x * vector[c] for c, x in sf[k][i]]) << ev
        for e in range(low, len(r)):
            for k, coefficient in enumerate(v):
                for i in range(ns):
                    for j in range(ns):
                        if any(r[e][j]):
                            z[k + e][i][j] -= sum([x * y for x, y in zip(coefficient[i], r[e][j])])
        while len(z) > 1 and not any(map(any, z[-1])):
            z.pop()
        unit = den << (ew + ev)
        fine = FINE + max(192, unit.bit_length()) + (len(z) - 1) * abs(int(center)).bit_length()
        fixed = [[[(x * s.numerator << fine) // (s.denominator * unit) for x in row] for row, s in zip(m, scale)] for m in z]

        def norms(coefficients, d):
            return [[root_up(sum([x * x for x in column]), d, fine) for column in c] if any(map(any, c)) else [0] * ns for c in coefficients]
        nv, nl, nr = norms(v, 1 << ev), norms(l, den << ev), norms(r, den << ew)
        for n in (nv, nl):
            for c in n:
                c[:] = [-(-x * s.numerator // s.denominator) for x, s in zip(c, scale)]
        nrl = [c if k < low else [0] * ns for k, c in enumerate(nr)]
        linear = len(z) <= 2 and not (self.aff_norm if backwards else self.bff_norm) and all(not any(c) for n, top in ((nr, 1), (nrl, 1), (nl, 2), (nv, 2)) for c in n[top:])
        return center, fine, fixed, nv, nl, nrl, nr, linear, bool(backwards)

    def reversed(self, anchor):
        return anchor is not None and self.anchors[anchor][-1]

    def ends(self, lo, hi, anchor):
        demand(anchor is not None, "a leaf of a piece without an anchor")
        key = lo, hi, anchor
        affordable(len(self.p.s), self.coefficients[anchor], lo, hi, self.bound_bits)
        if key not in self.cache:
            if len(self.cache) > 8:
                self.cache.clear()
            spend_matrix(len(self.p.s), self.coefficients[anchor], self.words[anchor], rational_bits(self.anchors[anchor][0]) + self.bound_bits, lo, hi)
            ends = (self.backwards if self.reversed(anchor) else self.enclose)(lo, hi, anchor)
            if self.p.spread is not None:
                e = [[ceil(x * ends.unit) for x in row] for row in self.reach[anchor][2]]
                ends = with_radii(ends, e, e, [self.p.spread[2][i] for i in self.p.s])
            self.cache[key] = ends
        return self.cache[key]

    def backwards(self, lo, hi, anchor):
        """A reversed anchor: T(t) / t in s = 1 / t, the first end still that of lo. s = 0 is not part of the window."""
        demand(lo > 0, "a reversed anchor and a region that begins at 0")
        ends = self.enclose(Q(0) if hi is None else 1 / hi, 1 / lo, anchor)
        return Ends(ends.both[1][0], ends.both[0][0], ends.both[1][1], ends.both[0][1], ends.d, ends.unit, hi is None)

    def enclose(self, lo, hi, anchor):
        """Units of 2^-fine; everything rounded outward."""
        center, fine, z, nv, nl, nrl, nr, linear, reverse = self.anchors[anchor]
        sigma, tau, norm = (self.tau, self.sigma, self.aff_norm) if reverse else (self.sigma, self.tau, self.bff_norm)
        ns, s = len(z[0]), sigma + lo * tau
        demand(hi is not None or linear, "an infinite interval and a family that is not linear")

        def up(n, d, derivative=0):
            """Norms of columns, or of their derivative, for |d'| <= d."""
            out = [Q(0)] * ns
            for k, c in enumerate(n):
                if k >= derivative and any(c):
                    f = d ** (k - derivative) * (k if derivative else 1)
                    out = [o + f * x for o, x in zip(out, c)]
            return [-(-o.numerator // o.denominator) for o in out]

        def outer(*terms):
            """Sum of factor a_i b_j, rounded up to units."""
            terms = [(f.numerator, f.denominator << fine, a, b) for f, a, b in terms]
            return [[sum(-(-n * a[i] * b[j] // q) for n, q, a, b in terms) for j in range(ns)] for i in range(ns)]

        def at(t):
            """Z(t) rounded, and what rounding may have cost."""
            powers = [(t - center) ** k for k in range(len(z))]
            q = lcm(1, *(x.denominator for x in powers))
            powers = [int(x * q) for x in powers]
            return [[sum(f * m[i][j] for f, m in zip(powers, z)) // q for j in range(ns)] for i in range(ns)], 1 + -(-sum(map(abs, powers)) // q)

        of_p, of_q, _ = self.reach[anchor] or [[()] * ns] * 3
        of_p, of_q = ([norm_up(c, fine) for c in of] for of in (of_p, of_q))

        def remainders(d):
            l, r = ([x + y for x, y in zip(up(n, d), of)] for n, of in ((nl, of_q), (nr, of_p)))
            return outer((Q(1), up(nv, d), up(nrl, d)), (1 / s, l, r))
        one = Q(1)
        if hi is None:
            m0, cost = at(lo)
            r0 = [[x + cost for x in row] for row in remainders(abs(lo - center))]
            m1 = z[1] if len(z) > 1 else [[0] * ns for _ in range(ns)]
            zero = [0] * ns
            r1 = outer((one, nv[1] if len(nv) > 1 else zero, nrl[0]), (1 / s, nl[1], nr[0]))
            return Ends(m0, m1, r0, [[x + 1 for x in row] for row in r1], None, 1 << fine, True)
        delta, width = max(abs(lo - center), abs(hi - center)), hi - lo
        (m0, c0), (m1, c1) = at(lo), at(hi)
        cost = max(c0, c1)
        bend = [[Q(0)] * ns for _ in range(ns)]
        for k in range(2, len(z)):
            f = k * (k - 1) * delta ** (k - 2)
            bend = [[b + f * (abs(x) + 1) for b, x in zip(rb, rz)] for rb, rz in zip(bend, z[k])]
        if linear:
            r0, r1 = remainders(abs(lo - center)), remainders(abs(hi - center))
        else:
            r0 = r1 = remainders(delta)
        extra = width * width / 8
        r0, r1 = ([[x + cost + -(-(extra * b).numerator // (extra * b).denominator) for x, b in zip(rr, rb)] for rr, rb in zip(r, bend)] for r in (r0, r1))
        v, l, rl, r = (up(n, delta) for n in (nv, nl, nrl, nr))
        dv, dl, drl, dr = (up(n, delta, 1) for n in (nv, nl, nrl, nr))
        slope = outer((one, dv, rl), (one, v, drl), (1 / s, dl, r), (1 / s, l, dr), (norm / (sigma * s), l, r))
        # Rounding of Z(lo), Z(hi) and of the coefficients of Z' on top of the two items of the page.
        rough = sum((k * delta ** (k - 1) for k in range(1, len(z))), Q(0))
        d = [[ceil(width * width * b + width * (x + rough)) + 2 * cost for x, b in zip(rx, rb)] for rx, rb in zip(slope, bend)]
        return Ends(m0, m1, r0, r1, d, 1 << fine, False)


def ceil(q):
    return -(-q.numerator // q.denominator)


# ---------------------------------------------------------------- leaves

REST, OPEN, MOVING = "rest", "open", "moving"


def farkas(list_of_ends, state, weights):
    n = len(state)
    demand(len(sequence(weights)) == n, "farkas: length")
    w = [counter(x, -(2**63), 2**63 - 1) for x in weights]
    demand(all(x >= 0 or st == MOVING for x, st in zip(w, state)), "farkas: a negative weight")
    may = [j for j in range(n) if state[j] != REST]
    strict = set()
    for j in may:
        is_strict = True
        for ends in list_of_ends:
            c = [sum(x * m[i][j] + abs(x) * r[i][j] for i, x in enumerate(w) if x) for m, r in ends.both]
            demand(max(c) <= 0, f"farkas: column {j}")
            is_strict = is_strict and c[0] < 0 and (c[1] < 0 or ends.unbounded)
        if is_strict:
            strict.add(j)
    demand(strict >= set(may) or any(state[j] == MOVING for j in strict), "farkas: not strict")


def diagonal(kind, weights, n):
    """The weights d of a definite leaf (C, Definite leaves)."""
    return [integer(x) for x in weights] if kind == "weighted_definite" else [1 if kind == "positive_definite" else -1] * n


def definite(list_of_ends, state, d):
    demand(len(d) == len(state), "definite: length")
    may = [j for j in range(len(state)) if state[j] != REST]
    for ends, e, (m, r) in [(ends, e, of) for ends in list_of_ends for e, of in enumerate(ends.both)]:
        s = [[d[i] * m[i][j] + m[j][i] * d[j] for j in may] for i in may]
        radius = [sum(abs(d[i]) * r[i][j] + r[j][i] * abs(d[j]) for j in may) for i in may]
        if e == 1 and ends.unbounded and not any(map(any, s)) and not any(radius):
            continue
        for i, x in enumerate(radius):
            s[i][i] -= x
        demand(positive_definite(s), "definite: not so")


def ldl(p, lo, hi, state, obj):
    """Exact factors of sym(A + tB) at both ends (C, Leaves)."""
    resting = {i for i, st in zip(p.s, state) if st == REST}
    active = [i for i in range(p.n) if i not in resting]
    n, sign = len(active), None
    for end, factor, (ka, kb) in zip((0, 1), fields(obj, "lower upper"), ((1, lo), (0, 1) if hi is None else (1, hi))):
        rows, diagonal = fields(factor, "rows diagonal")
        rows, diagonal = [[number(v) for v in sequence(r)] for r in sequence(rows)], [number(v) for v in sequence(diagonal)]
        demand(len(diagonal) == len(rows) == n <= 128 and all(len(r) == i for i, r in enumerate(rows)), "ldl: lengths")
        bits = max((abs(v.numerator).bit_length() + v.denominator.bit_length() for r in [*rows, diagonal] for v in r), default=0)
        demand(n * n * bits <= 2**22, "ldl: too much work")
        if sign is None:
            sign = -1 if diagonal and diagonal[0] < 0 else 1
        weak = end == 1 and hi is None
        demand(all(sign * d > 0 or (weak and d == 0) for d in diagonal), "ldl: not definite")
        for i, r in enumerate(rows):
            left = [*r, Q(1)]
            for j in range(i + 1):
                x, y = active[i], active[j]
                wanted = sum((ka * self_a.get(c, 0) + kb * self_b.get(c, 0) for self_a, self_b, c in ((p.a[x], p.b[x], y), (p.a[y], p.b[y], x))), Q(0)) / 2
                right = [*rows[j], Q(1)]
                demand(sum(left[k] * diagonal[k] * right[k] for k in range(j + 1)) == wanted, f"ldl: entry ({x}, {y})")


def positive_definite(s):
    """Fraction-free elimination (Bareiss) of a symmetric integer matrix: all leading minors positive."""
    previous = 1
    while s:
        pivot, *row = s[0]
        if pivot <= 0:
            return False
        s = [[(pivot * x - row[i] * y) // previous for x, y in zip(line[1:], row)] for i, line in enumerate(s[1:])]
        previous = pivot
    return True


def dot(a, b):
    return sum([x * y for x, y in zip(a, b)])


class Root:
    """The leaf `root` (C, Leaves)."""

    def __init__(self, pencil, window, lo, hi, anchor, state, s, claims, obj):
        pivot, interval, inverse, ey, left, right, ex, outcome = fields(obj, "pivot interval inverse inverse_exponent left right exponent outcome")
        moving = [j for j, st in enumerate(state) if st == MOVING]
        rest = [j for j, st in enumerate(state) if st == REST]
        place = {i: k for k, i in enumerate(s)}
        k = place.get(counter(pivot))
        demand(len(moving) + len(rest) == len(state) and k in moving, "root: undecided variables or pivot")
        ey, ex = counter(ey, 0, 2**32 - 1), counter(ex, 0, 2**32 - 1)
        demand(max(ex, ey) <= 16_384, "root: exponents")
        self.a, self.b = pair(interval)
        demand(self.a <= self.b, "root: interval")
        inside(window, self.a, self.b, "root")
        others = [j for j in moving if j != k]
        m = len(others)
        y = [[Q(integer(v), 2**ey) for v in sequence(r)] for r in sequence(inverse)]
        u, v = ([Q(integer(x), 2**ex) for x in sequence(l)] for l in (left, right))
        demand(len(y) == len(u) == len(v) == m and all(len(r) == m for r in y), "root: lengths")
        # What is alone up to infinity is alone up to b.
        self.hull = min(lo, self.a), self.b if hi is None else max(hi, self.b)
        self.support = tuple(s[j] for j in moving)
        self.yields = False
        by_chord = hi is None and not pencil.reversed(anchor)
        if by_chord:
            demand(self.hull[0] > 0, "root: from 0 to infinity")
            wide = pencil.ends(self.hull[0], None, anchor).chord(self.hull[0])
        else:
            wide = pencil.ends(self.hull[0], None if hi is None else self.hull[1], anchor)
        yt = list(zip(*y))
        abs_y, abs_yt = ([[abs(x) for x in r] for r in mat] for mat in (y, yt))
        full_u, full_v = dict(zip(others, u)) | {k: Q(1)}, dict(zip(others, v)) | {k: Q(1)}

        def norms(rows, abs_rows, transpose):
            """rho, or eta on the transposed matrices: the largest row sum."""
            worst = Q(0)
            for mat, rad in wide.both:
                get = (lambda i, j: (mat[j][i], rad[j][i])) if transpose else (lambda i, j: (mat[i][j], rad[i][j]))
                for a in range(m):
                    total = Q(0)
                    for b in range(m):
                        column = [get(i, others[b]) for i in others]
                        total += abs((a == b) - dot(rows[a], [Q(c, wide.unit) for c, _ in column])) + dot(abs_rows[a], [Q(c, wide.unit) for _, c in column])
                    worst = max(worst, total)
            return worst
        rho, eta = norms(y, abs_y, False), norms(yt, abs_yt, True)  # 1
        demand(rho < 1 and eta < 1, "root 1: the inverse")

        def residual(ends, e, full, transpose):
            """Residuals and their radii on the rows (columns) other than the pivot."""
            mat, rad = ends.both[e]
            get = (lambda a, b: (b, a)) if transpose else (lambda a, b: (a, b))
            q, r = [], []
            for i in others:
                at = [(get(i, j), x) for j, x in full.items()]
                q.append(sum(mat[a][b] * x for (a, b), x in at) / ends.unit)
                r.append(sum(rad[a][b] * abs(x) for (a, b), x in at) / ends.unit)
            return q, r

        def eps(ends, e, full, rows, abs_rows, bound, transpose):
            q, r = residual(ends, e, full, transpose)
            return max((abs(dot(rows[i], q)) + dot(abs_rows[i], r) for i in range(m)), default=Q(0)) / (1 - bound)

        def eps_v(ends, e):
            return eps(ends, e, full_v, y, abs_y, rho, False)
        ev = max(eps_v(wide, 0), eps_v(wide, 1))  # 2
        eu = max(eps(wide, e, full_u, yt, abs_yt, eta, True) for e in (0, 1))
        ru, rv = (Q(ceil(e * 2**ex), 2**ex) for e in (eu, ev))
        slope = bound = Q(0)  # 3, times the unit
        for i in moving:
            for j in moving:
                dm, dd = wide.both[1][0][i][j] - wide.both[0][0][i][j], wide.d[i][j]
                x, w = full_u[i], full_v[j]
                ei, ej = (Q(0) if i == k else ru), (Q(0) if j == k else rv)
                slope += x * dm * w
                bound += dd * abs(x * w) + (abs(dm) + dd) * (ei * abs(w) + abs(x) * ej + ei * ej)
        demand(abs(slope) > bound, "root 3: not monotone")

        def sign(ends, e):  # 4
            mat, rad = ends.both[e]
            value = sum(full_u[i] * mat[i][j] * full_v[j] for i in moving for j in moving) / ends.unit
            slack = sum(abs(full_u[i]) * rad[i][j] * abs(full_v[j]) for i in moving for j in moving) / ends.unit
            q, r = residual(ends, e, full_u, True)
            slack += sum(abs(a) + b for a, b in zip(q, r)) * eps_v(ends, e)
            return 0 if abs(value) <= slack else (1 if value > 0 else -1)
        if outcome == "absent":  # 5
            demand(sign(wide, 0) * sign(wide, 1) == 1, "root 5: absent")
            return
        if isinstance(outcome, dict) and "claim" in outcome:
            c = claims[place_in(fields(outcome, "claim")[0], len(claims))]
            demand(c[0] and set(c[0]) <= set(self.support) <= {*c[0], *c[1]}, "root 5: not a claim of this moving set")
            demand(self.a <= c[2] and c[3] <= self.b, "root 5: the claim's value is not in the interval")
            self.yields = set(c[0]) == set(self.support)
            self.a, self.b = c[2], c[3]  # what is yielded is the claim, with its own interval
            return
        if isinstance(outcome, dict) and "infinity" in outcome:
            x = [integer(v) for v in sequence(fields(outcome, "infinity")[0])]
            demand(hi is None and len(x) == pencil.p.n, "root 5: not at infinity, or length")
            null_at_infinity(pencil.p, self.support, pencil.reversed(anchor), x)
            return
        known = outcome == "solution" or isinstance(outcome, dict) and ("negative_x" in outcome or "negative_y" in outcome)
        demand(not (by_chord and known), "root 5: an outcome that is not read over a half line")
        demand(self.a < self.b, "root 5: an interval of one point")
        narrow = pencil.ends(self.a, self.b, anchor)
        demand(sign(narrow, 0) * sign(narrow, 1) == -1, "root 5: no change of sign")
        error = max(eps_v(narrow, 0), eps_v(narrow, 1))

        def y_sign(i):
            """The certain sign of y_i at both narrow ends, or 0."""
            signs = set()
            for mat, rad in narrow.both:
                value = sum(mat[i][j] * full_v[j] for j in moving)
                slack = sum(rad[i][j] * abs(full_v[j]) for j in moving) + error * sum(abs(mat[i][j]) + rad[i][j] for j in others)
                signs.add(1 if value > slack else -1 if value < -slack else 0)
            return signs.pop() if len(signs) == 1 else 0
        if outcome == "solution":
            exempt = {place[i] for i in vanishing_with(pencil.p, self.support)}
            demand(all(x > error for x in v) and all(y_sign(i) == 1 for i in rest if i not in exempt), "root 5: not a solution")
            self.yields = True
        elif isinstance(outcome, dict) and "negative_x" in outcome:
            i = place.get(counter(fields(outcome, "negative_x")[0]))
            demand(i in others and full_v[i] < -error, "root 5: negative_x")
        elif isinstance(outcome, dict) and "negative_y" in outcome:
            i = place.get(counter(fields(outcome, "negative_y")[0]))
            demand(i in rest and y_sign(i) == -1, "root 5: negative_y")
        else:
            raise Unreadable("root: outcome")


def null_at_infinity(p, support, reverse, x):
    """x is a null vector of the limit on the moving set: B x = 0 there and on the free rows (of A where the free rows are zero in B)."""
    demand(any(x[i] for i in support), "root 5: nothing moves at infinity")
    for i in range(p.n):
        free = i in p.free
        if not free and i not in support:
            demand(x[i] == 0, "root 5: x off the active variables at infinity")
            continue
        if free and not reverse:
            demand(not any(p.b[i].values()), "root 5: a free row of B at infinity")
        row = p.a[i] if free and not reverse else p.b[i]
        demand(sum(v * x[j] for j, v in row.items()) == 0, "root 5: no null vector at infinity")


# ---------------------------------------------------------------- one support, value by value

def sign_changes(poly, a, b):
    """Descartes' bound of the number of roots in the open interval (a, b), b None for infinity."""
    def shifted(c, by):
        """p(y + by)."""
        for i in range(len(c)):
            for k in range(len(c) - 2, i - 1, -1):
                c[k] += by * c[k + 1]
        return c
    unit = lcm(a.denominator, 1 if b is None else (b - a).denominator)
    # unit^n p(y / unit), then with y = unit a + z: integers only.
    c = [x * unit ** (len(poly) - 1 - k) for k, x in enumerate(poly)]
    c = shifted(c, int(a * unit))
    if b is not None:
        width = int((b - a) * unit)
        c = shifted([x * width ** k for k, x in enumerate(c)][::-1], 1)
    signs = [x > 0 for x in c if x]
    return sum(x != y for x, y in zip(signs, signs[1:]))


def sign_at(poly, t):
    value = horner(poly, t, t)[0]
    return (value > 0) - (value < 0)


class Budget:
    """What the signs of the support leaves of a file may cost, and the matrices of its regions (C, Limits)."""
    left = 0
    matrices = 0
    anchors = 0
    claims = 0

    @classmethod
    def of_anchors(cls, pencils):
        cls.anchors = (1 << 30) + (sum(pencil.numbers for pencil in pencils) << 12)

    @classmethod
    def take(cls, cost):
        cls.left -= cost
        demand(cls.left >= 0, "support: the signs take more work than the file's budget")

    # Lengths of polynomials are (coefficients, bits of the longest one).

    @classmethod
    def spend_product(cls, poly, a, b):
        count, bits = size(strip(list(poly)))
        cls.take(count * (bits + 256) * (max(a.bit_length(), b.bit_length()) + 256) >> 5)

    @classmethod
    def spend_remainder(cls, length, q):
        """Takes what the division costs; the length of what it leaves, with this many coefficients."""
        count, bits = length
        steps = max(count + 1 - len(q), 0)
        factor = size(q)[1] + 64
        cls.take(steps * count * factor * (steps * factor + bits) >> 9)
        return lambda rest: (len(rest), bits + steps * factor)

    @classmethod
    def spend_evaluation(cls, length, a, b):
        count, bits = length
        growth = count * (rational_bits(a) + rational_bits(b) + 64)
        cls.take(growth * (growth + bits) >> 8)

    @classmethod
    def spend_transformation(cls, length, a, b):
        count, bits = length
        ends = sum(rational_bits(v) for v in (a, b) if v is not None)
        cls.take(count ** 2 * (count * (ends + 64) + bits) * (1 + (ends >> 10)))


def size(poly):
    return len(poly), max(map(int.bit_length, poly), default=0)


def rootless(poly, bits, a, b):
    """Is it certain that the polynomial has no root in (a, b)? Its work is counted with these bits."""
    left = [200]

    def none(a, b, depth):
        Budget.spend_transformation((len(poly), bits), a, b)
        changes = sign_changes(poly, a, b)
        if changes <= 1:
            return changes == 0
        if depth == 0 or left[0] == 0:
            return False
        left[0] -= 1
        middle = a + abs(a) + 1 if b is None else (a + b) / 2
        return sign_at(poly, middle) != 0 and none(a, middle, depth - 1) and none(middle, b, depth - 1)
    return none(a, b, 24)


def without_factor(poly, q):
    """The polynomial (strictly: a multiple) without its factors q."""
    bits = size(poly)[1]

    def divides():
        Budget.spend_remainder((len(poly), bits), q)
        return not remainder(poly, q)
    while len(poly) >= len(q) and divides():
        rest, out = [Q(c) for c in poly], []
        while len(rest) >= len(q):
            top = rest[-1] / q[-1]
            out.append(top)
            for i, c in enumerate(q):
                rest[len(rest) - len(q) + i] -= top * c
            rest.pop()
        poly = over_common(out[::-1])[0]
    return poly


def sign_of_point(poly, point):
    q, a, b = point
    length_of = Budget.spend_remainder(size(strip(list(poly))), q)
    rest = remainder(poly, q)
    if not rest:
        return 0
    Budget.spend_evaluation(length_of(rest), a, b)
    low, high = horner(rest, a, b)
    return 1 if low > 0 else -1 if high < 0 else None


def sign_of_cell(poly, left, right):
    poly = strip(list(poly))
    if not poly:
        return 0
    bits = size(poly)[1]
    for q, a, b in (left, right) if right else (left,):
        if a < b:
            rest = without_factor(poly, q)
            if not (sign_at(rest, a) and sign_at(rest, b) and rootless(rest, bits, a, b)):
                return None
    a, b = left[2], right[1] if right else None
    return sign_at(poly, a + 1 if b is None else (a + b) / 2) if rootless(poly, bits, a, b) else None


class Held:
    """One solution of a support at an isolated value: for `count`."""

    def __init__(self, support, point, hull):
        self.support, (_, self.a, self.b), self.hull = support, point, hull


class Support:
    """The leaf `support` (C, Leaves)."""

    def __init__(self, p, rows, lo, hi, state, obj):
        points, cells, reasons = fields(obj, "points cells reasons")
        demand(OPEN not in state, "support: an open variable")
        self.p, self.rows, self.n = p, rows, p.n
        self.moving = [p.s[k] for k, st in enumerate(state) if st == MOVING]
        self.active = sorted([*p.free, *self.moving])
        self.found, self.families = [], []
        points = [fields(o, "polynomial interval reason") for o in sequence(points)]
        points = [([integer(c) for c in sequence(q)], *pair(i), counter(r)) for q, i, r in points]
        cells = [counter(c) for c in sequence(cells)]
        self.reasons = [self.read(r) for r in sequence(reasons)]
        demand(bool(self.moving) == bool(points or cells), "support: points exactly if something moves")
        if not self.moving:
            return
        self.bounded(points, cells)
        at = [self.isolated(q, a, b) for q, a, b, _ in points]
        demand(all(x[2] < y[1] for x, y in zip(at, at[1:])), "support: points out of order")
        demand(at and at[0][1] == at[0][2] == lo and (hi is None or at[-1][1] == at[-1][2] == hi), "support: the ends")
        demand(len(cells) == len(at) - (hi is not None), "support: cells")
        held = [None]
        for k, (_, _, _, reason) in enumerate(points):
            held.append(self.holds(reason, lambda g: sign_of_point(g, at[k])))
            if k < len(cells):
                right = at[k + 1] if k + 1 < len(at) else None
                held.append(self.holds(cells[k], lambda g: sign_of_cell(g, at[k], right)))
        held.append(None)
        for k in range(1, len(held) - 1):
            if held[k] is None:
                continue
            place = (k - 1) // 2
            if k % 2 == 1 and held[k] and held[k - 1] is None and held[k + 1] is None:
                before = (at[place - 1][2] + at[place][1]) / 2 if place else at[place][1]
                after = (at[place][2] + at[place + 1][1]) / 2 if place + 1 < len(at) else at[place][2]
                self.found.append(Held(tuple(self.moving), at[place], (before, after)))
            else:
                last = at[place] if k % 2 else at[place + 1] if place + 1 < len(at) else None
                self.families.append((tuple(self.moving), at[place][1:], last[1:] if last else None, k % 2 == 1))

    def read(self, obj):
        if not isinstance(obj, dict) or len(obj) != 1:
            raise Unreadable("support: a reason is none or some")
        (kind, body), = obj.items()
        if kind == "none":
            return kind, self.vector(body), None
        if kind != "some":
            raise Unreadable("support: a reason is none or some")
        x, alone = fields(body, "x", "alone")
        if alone is not None:
            pivot, rows = fields(alone, "pivot rows")
            rows = [sequence(r) for r in sequence(rows)]
            if any(len(r) != 2 for r in rows):
                raise Unreadable("support: alone")
            alone = counter(pivot), [(counter(j), self.vector(l)) for j, l in rows]
        return kind, self.vector(x), alone

    @staticmethod
    def vector(obj):
        return [[integer(c) for c in sequence(r)] for r in sequence(obj)]

    def bounded(self, points, cells):
        vectors = [v for _, w, alone in self.reasons for v in [w, *(l for _, l in (alone[1] if alone else []))]]
        polys = [q for q, *_ in points] + [r for v in vectors for r in v]
        numbers = [c for r in polys for c in r]
        bits = max([abs(c).bit_length() for c in numbers]
                   + [abs(v.numerator).bit_length() + v.denominator.bit_length() for _, a, b, _ in points for v in (a, b)], default=0)
        Budget.left += len(numbers) << 24
        demand(max(map(len, polys), default=0) <= 256 and (len(numbers) + len(points) + len(cells)) * bits <= 2**23, "support: too much work")

    @staticmethod
    def isolated(q, a, b):
        q = strip(q)
        g = gcd(*q) or 1
        q = [c // (g if q[-1] > 0 else -g) for c in q]
        Budget.spend_evaluation(size(q), a, b)
        demand(len(q) >= 2 and a <= b, "support: a point's polynomial or interval")
        if a == b:
            demand(sign_at(q, a) == 0, "support: a point that is no root")
        else:
            low, high = horner([k * c for k, c in enumerate(q)][1:], a, b)
            demand(sign_at(q, a) * sign_at(q, b) == -1 and (low > 0 or high < 0), "support: a point that is not isolated")
        return q, a, b

    def product(self, vectors):
        """Sum of (a + b t) times polynomials."""
        out = []
        for a, b, poly in vectors:
            if (a or b) and strip(list(poly)):
                Budget.spend_product(poly, a, b)
            out += [0] * (len(poly) + 1 - len(out))
            for k, c in enumerate(poly):
                out[k] += a * c
                out[k + 1] += b * c
        return strip(out)

    def column(self, w, j):
        return self.product([(ra.get(j, 0), rb.get(j, 0), w[i]) for i, (_, ra, rb) in enumerate(self.rows)])

    def holds(self, reason, sign):
        """None: nothing. Else whether what is there is alone."""
        demand(reason < len(self.reasons), "support: no such reason")
        kind, v, alone = self.reasons[reason]
        demand(len(v) == self.n, "support: length")
        off = [i for i in range(self.n) if i not in self.active]
        if kind == "none":
            weights = [sign(v[i]) for i in off]
            demand(all(s in (0, 1) for s in weights), "support: a negative weight")
            signs = {j: sign(self.column(v, j)) for j in self.active}
            demand(None not in signs.values() and not any(signs[j] for j in self.p.free), "support: w'T")
            seen = {s for s in signs.values() if s}
            demand(len(seen) == 1 and not (1 in seen and 1 in weights), "support: w'T is not of one sign")
            return None
        for i in self.p.s:
            demand(sign(v[i]) == (1 if i in self.moving else 0), f"support: x_{i}")
        y = [sign(self.product([(ra.get(j, 0), rb.get(j, 0), v[j]) for j in self.active])) for _, ra, rb in self.rows]
        demand(all(y[i] == 0 if i in self.active else y[i] in (0, 1) for i in range(self.n)), "support: y")
        if alone is None:
            return False
        pivot, rows = alone
        demand(pivot in self.moving, "support: pivot")
        known = set()
        for own, l in rows:
            demand(own in self.active and own != pivot and len(l) == self.n, "support: alone")
            one_sided = [i for i in off if strip(l[i])]
            demand(all(y[i] == 0 and sign(l[i]) in (0, 1) for i in one_sided), "support: alone, weights")
            signs = {j: sign(self.column(l, j)) for j in self.active if j != pivot}
            demand(all((s is not None) and (s != 0) == (j == own) for j, s in signs.items()), "support: alone, columns")
            known |= {(own, s) for s in ((signs[own],) if one_sided else (1, -1))}
        demand(len(known) == 2 * (len(self.active) - 1), "support: alone, not determined")
        return True


# ---------------------------------------------------------------- the cover

def branched(p, state, i, to):
    """The states of a region where variable number i of p.s has been decided (C, Trees)."""
    other = {p.s.index(half) for halves in p.halves if p.s[i] in halves for half in halves} - {i} if to == MOVING else ()
    return tuple(to if k == i else REST if k in other else st for k, st in enumerate(state))


def complete_set(p, rows, window, claims, obj):
    """The number of solutions, of families and of open leaves of the cover."""
    pieces, condensation = fields(obj, "pieces", "condensation")
    demand((condensation is not None) == bool(p.free), "condensation is present exactly if there are free variables")
    demand(len(p.s) <= 512, "cover: more than 512 complementarity variables")
    if condensation is not None:
        anchors = fields(condensation, "sigma stiffness_factor mass_sigma anchors", "mass_factor tail")[3]
        demand(len(sequence(anchors)) * len(p.s) ** 2 <= 3 << 20, "cover: too many anchors for matrices of this order")
    pencil = CondensedPencil(p, rows, condensation) if p.free else PlainPencil(p, rows)
    demand(sequence(pieces), "cover: no piece")
    Budget.left = 1 << 35
    Budget.of_anchors([pencil])
    nodes = sum(len(sequence(piece["tree"])) for piece in pieces if isinstance(piece, dict) and "tree" in piece)
    entries = sum(len({*ra, *rb}) for _, ra, rb in rows)
    Budget.matrices = (1 << 30) + (nodes << 22) + (entries << 16)
    definite_left = (1 << 26) + (nodes << 20) + (entries << 16)
    start, found, families, left_open = window[0], [], [], []
    for number_of, piece in enumerate(pieces):
        if not isinstance(piece, dict) or "max" not in piece:
            raise Unreadable("piece: max")
        end, tree, anchor = fields(piece, "max tree", "anchor")
        end = None if end is None else number(end)
        if anchor is not None:
            anchor = place_in(anchor, len(pencil.anchors)) if p.free else counter(anchor)
        pencil.name(anchor)
        if number_of == len(pieces) - 1:
            demand(end == window[1] and (end is None or end > start or len(pieces) == 1), "cover: the last piece")
        else:
            demand(end is not None and start < end and (window[1] is None or end < window[1]), "cover: a piece's max")
        regions = [(start, end, (OPEN,) * len(p.s))]
        for node in sequence(tree):
            demand(regions, "cover: nodes after the end of a tree")
            lo, hi, state = regions.pop()
            if isinstance(node, dict) and len(node) == 1:
                (kind, value), = node.items()
            else:
                kind, value = node, None
            if kind == "split" and value is not None:
                t = number(value)
                demand(lo < t and (hi is None or t < hi), "cover: split")
                regions += [(t, hi, state), (lo, t, state)]
            elif kind == "branch" and value is not None:
                i = place_in(value, p.n)
                demand(i in p.s and state[p.s.index(i)] == OPEN, "cover: branch")
                i = p.s.index(i)
                regions += [(lo, hi, branched(p, state, i, st)) for st in (MOVING, REST)]
            elif kind == "farkas" and value is not None:
                farkas([pencil.ends(lo, hi, anchor)], state, value)
            elif kind in ("positive_definite", "negative_definite", "weighted_definite"):
                definite_left -= sum(st != REST for st in state) ** 3
                demand(definite_left >= 0, "definite: more work than the file's budget")
                definite([pencil.ends(lo, hi, anchor)], state, diagonal(kind, value, len(state)))
            elif kind == "ldl" and value is not None:
                ldl(p, lo, hi, state, value)
            elif kind == "root" and value is not None:
                leaf = Root(pencil, window, lo, hi, anchor, state, p.s, claims, value)
                found += [leaf] if leaf.yields else []
            elif kind == "support" and value is not None:
                leaf = Support(p, rows, lo, hi, state, value)
                found += leaf.found
                families += leaf.families
            elif kind == "tail" and value is None:
                demand(p.free and pencil.tail_from is not None and pencil.tail_from <= lo, "tail: not covered")
            elif kind == "open" and value is None:
                left_open.append((lo, hi, {i: st for i, st in zip(p.s, state)}))
            else:
                raise Unreadable("unknown node")
        demand(not regions, "cover: a tree that ends early")
        start = end
    # A solution at the end of one leaf may belong to a family of the next.
    single = [f for f in found if not any(
        f.support == s and first[1] <= f.a and (last is None or f.b <= last[0]) for s, first, last, _ in families)]
    families += [(f.support, (f.a, f.b), (f.a, f.b), True) for f in found if f not in single]
    solutions = count(single)
    for k, claim in enumerate(claims):
        demand(belongs(claim, single, families, left_open), f"claim {k} has no place in the complete set")
    return solutions, len(set(families)), len(left_open)


def belongs(claim, single, families, left_open):
    """Has an accepted claim a place among what the cover yields or leaves open (C, Claims beside a cover)?"""
    support, _, a, b = claim

    def meets(lo, hi):
        return lo <= b and (hi is None or a <= hi)

    def admits(state):
        return all(st != REST if i in support else st != MOVING for i, st in state.items())
    return any(f.support == tuple(support) and meets(f.a, f.b) for f in single) \
        or any(s == tuple(support) and meets(first[0], last and last[1]) for s, first, last, _ in families) \
        or any(admits(state) and meets(lo, hi) for lo, hi, state in left_open)


def count(found):
    """Solutions yielded twice (C): what overlaps a group must be the same solution as one of it; a group counts once."""
    def is_same(x, y):
        return x.hull[0] <= y.a and y.b <= x.hull[1] or y.hull[0] <= x.a and x.b <= y.hull[1]
    distinct, group = 0, []
    for leaf in sorted(found, key=lambda f: (f.support, f.a, f.b)):
        if any(other.support == leaf.support and other.b >= leaf.a for other in group):
            demand(any(is_same(other, leaf) for other in group), "cover: two solutions that may be one")
        else:
            distinct, group = distinct + 1, []
        group.append(leaf)
    return distinct


# ---------------------------------------------------------------- absence below a friction

CRITICAL_ANCHOR = record(
    center=number, reversed=Maybe(flag, null=False), right=list_of(MATRIX), left=Maybe(list_of(MATRIX)), left_friction=list_of(MATRIX))
CRITICAL_TAIL = record(**{
    "from": number, "factor": FACTOR, "factor_below": FACTOR, "mass_factor": Maybe(FACTOR), "mass_factor_below": Maybe(FACTOR)})
CRITICAL_CONDENSATION = record(
    sigma=number, stiffness_factor=FACTOR, mass_sigma=number, mass_factor=Maybe(FACTOR), anchors=list_of(CRITICAL_ANCHOR),
    tail=Maybe(CRITICAL_TAIL))
REGULAR = record(
    pivot=place, inverse=list_of(INTEGERS), inverse_exponent=exponent, left=INTEGERS, right=INTEGERS, exponent=exponent)
CRITICAL_NODE = one_of(
    "positive_definite", "negative_definite", "tail", split=number, friction=number, branch=place, farkas=list_of(weight),
    weighted_definite=list_of(weight), regular=REGULAR)
CRITICAL = record(**{
    "format": text_of, "problem_sha256": text_of, "from": Maybe(number), "below": number, "condensation": Maybe(CRITICAL_CONDENSATION),
    "pieces": list_of(record(max=end, anchor=Maybe(place), tree=list_of(CRITICAL_NODE)))})


class Part:
    """One of the pencils T0 and T1 of T0 + mu T1 (C, mceip-critical/1): the free rows stand in
    both. `spread`, with radii of the data: RA, RB and the share of each row (C, 5.22)."""

    def __init__(self, p, a, b, spread=None):
        self.n, self.free, self.s, self.a, self.b, self.spread = p.n, p.free, p.s, a, b, spread


def zero_free(p):
    """The same system with its particles of zero reaction free (Z.4)."""
    test, trial = p.changes
    free = sorted({*p.system[6], *(d for tangent, normal, _ in p.system[5] for d in (*tangent, *normal))})
    units, slips = [{d: Q(1)} for d in free], slice(len(p.free), p.n - 3 * len(p.halves))
    trial, test = units + trial[slips], [(u, {}) for u in units] + test[slips]
    freed = range(len(trial))
    return SimpleNamespace(
        system=p.system, radii=None, changes=(test, trial), n=len(trial),
        free=list(freed[:len(free)]), s=list(freed[len(free):]))


def friction_parts(p):
    """T0 and T1, and their integral rows with one factor for row i of all four matrices."""
    stiffness, mass = p.system[:2]
    test, trial = p.changes
    parts = []
    for k, rows in enumerate((
            [u for u, _ in test], [w if i in p.s else u for i, (u, w) in enumerate(test)])):
        spread = None
        if p.radii is not None:  # |p|' (R_K + t R_M) |T|
            *of, shares = p.radii
            to, by = ([{d: abs(c) for d, c in v.items()} for v in x] for x in (rows, trial))
            spread = *(project(to, x, by) if x else [{}] * p.n for x in of), \
                shares if k == 1 else [Q(0)] * p.n
        parts.append(Part(p, project(rows, stiffness, trial), project(rows, mass, trial), spread))
    every = [m for x in parts for m in (x.a, x.b, *(x.spread or ())[:2])]
    common = [lcm(1, *(v.denominator for m in every for v in m[i].values())) for i in range(p.n)]
    integral = [[(f, {j: int(v * f) for j, v in a.items()}, {j: int(v * f) for j, v in b.items()})
                 for f, a, b in zip(common, x.a, x.b)] for x in parts]
    return parts, integral


def at_friction(ends, mu):
    """The ends of T0 + mu T1 from those of both."""
    p, q = mu.numerator, mu.denominator
    unit = lcm(*(e.unit for e in ends))
    f0, f1 = q * (unit // ends[0].unit), p * (unit // ends[1].unit)

    def both(x, y):
        return [[f0 * v + f1 * w for v, w in zip(rx, ry)] for rx, ry in zip(x, y)]
    (m0, r0), (m1, r1) = [tuple(both(x, y) for x, y in zip(e0, e1)) for e0, e1 in zip(ends[0].both, ends[1].both)]
    return Ends(m0, m1, r0, r1, None, unit * q, ends[0].unbounded)


def radius_at(parts, k, mu):
    """The radius of A (k = 0) or B (k = 1) of T0 + mu T1; free rows are those of T0."""
    (first, second), middle = (x.spread[k] for x in parts), (parts[1].a, parts[1].b)[k]
    out = []
    for i, (r, share) in enumerate(zip(first, parts[1].spread[2])):
        if i in parts[1].s:
            size = {j: abs(v) for j, v in middle[i].items()}
            r = plus(plus(r, second[i], mu * (1 + share)), size, mu * share)
        out.append(r)
    return out


def critical_pencils(p, parts, integral, obj, lowest, below, intervals=()):
    """The enclosures of T0 and T1, rows scaled alike, and where the tail begins. The intervals of
    the pieces are (lo, hi, anchor)."""
    bits = [[max(x) for x in zip(*(row_bits(rows, k) for rows in integral))] for k in (1, 2)]
    if obj is None:
        return [PlainPencil(x, rows, bits[0]) for x, rows in zip(parts, integral)], None
    pencils = []
    for x, rows, left in zip(parts, integral, ("left", "left_friction")):
        own = {key: v for key, v in obj.items() if key != "tail"}
        own["anchors"] = []
        for a in obj["anchors"]:
            same = {key: v for key, v in a.items() if key != "left_friction"}
            own["anchors"].append({**same, "left": a["right"] if a.get(left) is None else a[left]})
        pencils.append(CondensedPencil(x, rows, own, bits, intervals))
    tail = obj.get("tail")
    if tail is None:
        return pencils, None
    start = number(tail["from"])
    if p.halves:
        p = zero_free(p)
        parts = friction_parts(p)[0]
    for mu, which in ((lowest, ""), (below, "_below")):
        a, b = ([plus(r0, r1, mu if i in p.s else 0) for i, (r0, r1) in enumerate(zip(*m))]
                for m in ([x.a for x in parts], [x.b for x in parts]))
        ra, rb = ([{}] * p.n if p.radii is None else radius_at(parts, k, mu) for k in (0, 1))
        at_start = [[plus(x, y, start) for x, y in zip(*of)] for of in ((a, b), (ra, rb))]
        for m, radius, factor, strict in (
                (*at_start, tail["factor" + which], True),
                (b, rb, tail.get("mass_factor" + which), False)):
            s = [{} for _ in range(p.n)]
            for i, (r, of_data) in enumerate(zip(m, radius)):
                for j, v in r.items():
                    s[i][j] = s[i].get(j, 0) + v / 2
                    s[j][i] = s[j].get(i, 0) + v / 2
                for j, v in of_data.items():  # row sums of the symmetric part, off the diagonal
                    s[i][i] = s[i].get(i, 0) - v / 2
                    s[j][j] = s[j].get(j, 0) - v / 2
            covered(s, p.n, factor, strict, f"tail{which}")
    return pencils, start


def witness_bits(inverse, left, right, *exponents):
    numbers = [integer(x) for row in [*inverse, left, right] for x in row]
    return max([*exponents, *(abs(x).bit_length() for x in numbers)])


class Regular:
    """The leaf `regular` of a decided box (C, mceip-critical/1)."""

    def __init__(self, state, s, obj):
        pivot, inverse, ey, left, right, ex = fields(obj, "pivot inverse inverse_exponent left right exponent")
        pivot, ey, ex = counter(pivot), counter(ey), counter(ex)
        moving = [j for j, st in enumerate(state) if st == MOVING]
        demand(moving and OPEN not in state, "regular: undecided, or nothing moves")
        demand(pivot in [s[j] for j in moving], "regular: pivot")
        self.k = s.index(pivot)
        self.others = [j for j in moving if j != self.k]
        m = len(self.others)
        demand(len(inverse) == len(left) == len(right) == m and all(len(r) == m for r in inverse), "regular: lengths")
        demand(max(ex, ey) <= 16_384, "regular: exponents")
        self.bits = witness_bits(inverse, left, right, ex, ey)
        self.y = [[Q(integer(x), 2**ey) for x in row] for row in inverse]
        u, v = ([Q(integer(x), 2**ex) for x in vector] for vector in (left, right))
        self.u, self.v = dict(zip(self.others, u)) | {self.k: Q(1)}, dict(zip(self.others, v)) | {self.k: Q(1)}

    def check(self, list_of_ends):
        """Obligations 1 to 4; the largest values over the corners."""
        rho = size = p = Q(0)
        both = []
        for ends in list_of_ends:
            for m, r in ends.both:
                def sums(vector, get):
                    """On the rows (columns) of the moving variables other than k: a residual and its radius."""
                    return [(sum(x * get(m, i, j) for j, x in vector.items()) / ends.unit,
                             sum(abs(x) * get(r, i, j) for j, x in vector.items()) / ends.unit) for i in self.others]
                for i, row in zip(self.others, self.y):
                    total = Q(0)
                    for j in self.others:
                        total += abs((i == j) - sum(y * m[a][j] for y, a in zip(row, self.others)) / ends.unit)
                        total += sum(abs(y) * r[a][j] for y, a in zip(row, self.others)) / ends.unit
                    rho = max(rho, total)
                right = sums(self.v, lambda a, i, j: a[i][j])
                for row in self.y:
                    size = max(size, abs(dot(row, [q for q, _ in right])) + dot([abs(y) for y in row], [s for _, s in right]))
                p = max(p, sum(abs(q) + s for q, s in sums(self.u, lambda a, i, j: a[j][i])))
                h = sum(x * m[i][j] * w for i, x in self.u.items() for j, w in self.v.items()) / ends.unit
                g = sum(abs(x * w) * r[i][j] for i, x in self.u.items() for j, w in self.v.items()) / ends.unit
                both.append((h, g))
        demand(rho < 1, "regular 1: the inverse")
        bound = p * size / (1 - rho)
        demand(any(all(s * h - g > bound for h, g in both) for s in (1, -1)), "regular 4: no certain sign")


def whom(p):
    return "" if p.radii is None else ", for every body within the radii of the data"


def check_critical(p, doc):
    """No solution for mu in [from, below] and lambda^2 >= 0."""
    CRITICAL(doc)
    _, digest, below, pieces, obj, lowest = fields(doc, "format problem_sha256 below pieces", "condensation from")
    below, lowest = number(below), Q(0) if lowest is None else number(lowest)
    demand(digest == p.digest, f"the problem's digest is {p.digest}")
    demand(p.system is not None and p.unknown == "lambda2", "a mechanical system with the unknown lambda2 was expected")
    demand(not p.curved, "Curved: this kind of certificate speaks of flat obstacles")
    demand(below > 0, "below is not positive")
    demand(0 <= lowest < below, "from and below")
    ns = len(p.s)
    demand(ns <= 512, "more than 512 slip variables")
    demand(obj is None or 2 * len(obj["anchors"]) * ns**2 <= 3 << 20, "too many anchors for matrices of this order")
    demand((obj is not None) == bool(p.free), "condensation is present exactly if there are free variables")
    demand(pieces, "no piece")
    intervals, start = [], Q(0)
    for k, piece in enumerate(pieces):
        stop, anchor = None if piece["max"] is None else number(piece["max"]), piece.get("anchor")
        if anchor is not None:
            anchor = place_in(anchor, len(obj["anchors"])) if p.free else counter(anchor)
        is_last = k == len(pieces) - 1
        demand((stop is None) == is_last and (is_last or stop > start), "a piece's max")
        intervals.append((start, stop, anchor))
        start = stop
    parts, integral = friction_parts(p)
    pencils, tail = critical_pencils(p, parts, integral, obj, lowest, below, intervals)
    nodes = sum(len(piece["tree"]) for piece in pieces)
    Budget.of_anchors(pencils)
    entries = sum(len({*ra, *rb}) for rows in integral for _, ra, rb in rows)
    Budget.matrices = (1 << 30) + (nodes << 22) + (entries << 16)
    definite_left = (1 << 26) + (nodes << 20) + (entries << 16)
    leaves = 0
    for (start, end, anchor), piece in zip(intervals, pieces):
        for pencil in pencils:
            pencil.name(anchor)
        boxes, known = [(start, end, lowest, below, (OPEN,) * ns)], {}
        for node in piece["tree"]:
            demand(boxes, "nodes after the end of a tree")
            lo, hi, low, high, state = boxes.pop()
            (kind, value), = node.items() if isinstance(node, dict) else [(node, None)]

            def corners():
                if (lo, hi, low, high) not in known:
                    known.clear()
                    ends = [pencil.ends(lo, hi, anchor) for pencil in pencils]
                    t_bits = BITS + rational_bits(lo) + (0 if hi is None else rational_bits(hi))
                    mu_bits = rational_bits(low) + rational_bits(high)
                    demand(2 * ns * ns * (t_bits + mu_bits) <= 2**29, "a box's matrices are too large")
                    Budget.matrices -= ns * ns * (words(t_bits) * words(mu_bits) + 256)
                    demand(Budget.matrices >= 0, "matrices of boxes: more work than the file's budget")
                    known[lo, hi, low, high] = [at_friction(ends, mu) for mu in (low, high)]
                return known[lo, hi, low, high]
            if kind == "split":
                t = number(value)
                demand(lo < t and (hi is None or t < hi), "split")
                boxes += [(t, hi, low, high, state), (lo, t, low, high, state)]
                continue
            if kind == "friction":
                mu = number(value)
                demand(low < mu < high, "friction")
                boxes += [(lo, hi, mu, high, state), (lo, hi, low, mu, state)]
                continue
            if kind == "branch":
                i = place_in(value, p.n)
                demand(i in p.s and state[p.s.index(i)] == OPEN, "branch")
                i = p.s.index(i)
                boxes += [(lo, hi, low, high, branched(p, state, i, st)) for st in (MOVING, REST)]
                continue
            leaves += 1
            if kind == "farkas":
                farkas(corners(), state, value)
            elif kind == "tail":
                demand(tail is not None and tail <= lo, "tail: not covered")
            elif kind == "regular":
                demand(hi is not None or pencils[0].reversed(anchor), "regular: to infinity without a reversed anchor")
                leaf = Regular(state, p.s, value)
                t_bits = BITS + rational_bits(lo) + (0 if hi is None else rational_bits(hi))
                mu_bits = rational_bits(low) + rational_bits(high)
                definite_left -= 8 * len(leaf.v) ** 3 * words(leaf.bits) * words(t_bits + mu_bits)
                demand(definite_left >= 0, "regular: more work than the file's budget")
                leaf.check(corners())
            else:
                definite_left -= 2 * sum(st != REST for st in state) ** 3
                demand(definite_left >= 0, "definite: more work than the file's budget")
                definite(corners(), state, diagonal(kind, value, ns))
        demand(not boxes, "a tree that ends early")
    # At friction 0 a particle may slide both ways, of which (9) has one: the sentence leaves 0 out.
    bracket = "[" if lowest > 0 else "("
    where = f"friction in {bracket}{lowest}, {below}] and lambda2 in [0, infinity)"
    return 0, f"ACCEPTED: no solution for {where}{whom(p)}, {leaves} leaves"


# ---------------------------------------------------------------- presence on an interval of friction

PRESENCE_PIECE = record(
    to=number, interval=list_of(number, 2), anchor=Maybe(place), support=list_of(place), pivot=place, inverse=list_of(list_of(integer)),
    inverse_exponent=exponent, left=list_of(integer), right=list_of(integer), exponent=exponent)
PRESENCE = record(**{
    "format": text_of, "problem_sha256": text_of, "from": number, "to": number, "condensation": Maybe(record(
        sigma=number, stiffness_factor=FACTOR, mass_sigma=number, mass_factor=Maybe(FACTOR), anchors=list_of(CRITICAL_ANCHOR))),
    "pieces": list_of(PRESENCE_PIECE)})


class Box:
    """A piece [t0, t1] x [low, high] of mceip-presence/1, the obligations 3 to 7 of a piece (C)."""

    def __init__(self, p, obj):
        support, pivot, inverse, ey, left, right, ex = fields(
            obj, "support pivot inverse inverse_exponent left right exponent", "anchor to interval")[:7]
        support, pivot, ey, ex = [counter(i) for i in support], counter(pivot), counter(ey), counter(ex)
        demand(all(i < j for i, j in zip(support, support[1:])) and set(support) <= set(p.s), "presence: support")
        demand(pivot in support, "presence: pivot")
        self.k = p.s.index(pivot)
        self.others = [p.s.index(i) for i in support if i != pivot]
        self.rest = [j for j, i in enumerate(p.s) if i not in support]
        m = len(self.others)
        demand(len(inverse) == len(left) == len(right) == m and all(len(r) == m for r in inverse), "presence: lengths")
        demand(max(ex, ey) <= 16_384, "presence: exponents")
        self.bits = witness_bits(inverse, left, right, ex, ey)
        self.y = [[Q(integer(v), 2**ey) for v in r] for r in inverse]
        u, v = ([Q(integer(x), 2**ex) for x in vector] for vector in (left, right))
        self.u, self.v = dict(zip(self.others, u)) | {self.k: Q(1)}, dict(zip(self.others, v)) | {self.k: Q(1)}

    def around(self, ends, e):
        """M_c and R_c on the rows and columns that matter, as fractions."""
        def part(m):
            return {(i, j): Q(m[i][j], ends.unit) for i in [*self.v, *self.rest] for j in self.v}
        return tuple(map(part, ends.both[e]))

    def margins(self, corners):
        """v_i less the largest e_i(c)."""
        d = []
        for i, row in zip(self.others, self.y):
            e = Q(0)
            for m, r in corners:
                total = Q(0)
                for j in self.others:
                    product = sum((y * m[a, j] for y, a in zip(row, self.others)), Q(0))
                    total += (abs((i == j) - product) + sum(abs(y) * r[a, j] for y, a in zip(row, self.others))) * self.v[j]
                e = max(e, total)
            d.append(self.v[i] - e)
        demand(all(x > 0 for x in d), "presence 4: the inverse")
        return d

    def theta(self, corner, d):
        m, r = corner
        q = [sum(m[i, j] * x for j, x in self.v.items()) for i in self.others]
        s = [sum(r[i, j] * abs(x) for j, x in self.v.items()) for i in self.others]
        return max(((abs(dot(row, q)) + dot([abs(y) for y in row], s)) / x for row, x in zip(self.y, d)), default=Q(0))

    def resting(self, corners, theta):
        for i in self.rest:
            for m, r in corners:
                low = sum(m[i, j] * x - r[i, j] * x for j, x in self.v.items())
                demand(low >= theta * sum((abs(m[i, j]) + r[i, j]) * self.v[j] for j in self.others), f"presence 6: row {i}")

    def edge(self, both, d):
        """The sign of phi on an edge, 0 if it has none."""
        h, g, p, theta = [], [], [], []
        for m, r in both:
            pairs = [(i, j, x * w, abs(x) * w) for i, x in self.u.items() for j, w in self.v.items()]
            h.append(sum(m[i, j] * f for i, j, f, _ in pairs))
            g.append(sum(r[i, j] * f for i, j, _, f in pairs))
            p.append(sum((abs(sum(x * m[i, j] for i, x in self.u.items())) + sum(abs(x) * r[i, j] for i, x in self.u.items())) * self.v[j]
                         for j in self.others))
            theta.append(self.theta((m, r), d))
        for s in (1, -1):
            lower = [s * a - b for a, b in zip(h, g)]
            if lower[0] > p[0] * theta[0] and lower[1] > p[1] * theta[1] and sum(lower) > p[0] * theta[1] + p[1] * theta[0]:
                return s
        return 0


def check_presence(p, doc):
    """For every mu in [from, to] a solution with lambda^2 >= 0."""
    PRESENCE(doc)
    _, digest, start, stop, pieces, obj = fields(doc, "format problem_sha256 from to pieces", "condensation")
    start, stop = number(start), number(stop)
    demand(digest == p.digest, f"the problem's digest is {p.digest}")
    demand(p.system is not None and p.unknown == "lambda2", "a mechanical system with the unknown lambda2 was expected")
    demand(not p.curved, "Curved: this kind of certificate speaks of flat obstacles")
    demand(not p.halves, "presence on an interval of friction is not defined for zero reaction")
    demand(0 <= start < stop, "from and to")
    ns = len(p.s)
    demand(ns <= 512, "more than 512 slip variables")
    demand(obj is None or 2 * len(obj["anchors"]) * ns**2 <= 3 << 20, "too many anchors for matrices of this order")
    demand((obj is not None) == bool(p.free), "condensation is present exactly if there are free variables")
    demand(pieces, "no piece")
    intervals = []
    for piece in pieces:
        (t0, t1), anchor = map(number, piece["interval"]), piece.get("anchor")
        if anchor is not None:
            anchor = place_in(anchor, len(obj["anchors"])) if p.free else counter(anchor)
        demand(0 <= t0 < t1, "presence: interval")
        intervals.append((t0, t1, anchor))
    parts, integral = friction_parts(p)
    pencils, _ = critical_pencils(p, parts, integral, obj, start, stop, intervals)
    Budget.of_anchors(pencils)
    entries = sum(len({*ra, *rb}) for rows in integral for _, ra, rb in rows)
    Budget.matrices = (1 << 30) + (len(pieces) << 22) + (entries << 16)
    witnesses_left = (1 << 30) + (len(pieces) << 26)
    low = start
    for k, ((t0, t1, anchor), piece) in enumerate(zip(intervals, pieces)):
        high = number(piece["to"])
        demand(high > low and (high == stop if k == len(pieces) - 1 else high < stop), "a piece's to")
        for pencil in pencils:
            pencil.name(anchor)
        box = Box(p, piece)
        mu_bits = rational_bits(low) + rational_bits(high)
        corner_bits = BITS + rational_bits(t0) + rational_bits(t1) + mu_bits
        witnesses_left -= 8 * len(box.v) ** 3 * words(box.bits) * words(corner_bits)
        demand(witnesses_left >= 0, "presence: more work than the file's budget")

        def ends(lo, hi):
            """The matrices of [lo, hi] at both ends of [low, high]."""
            both = [pencil.ends(lo, hi, anchor) for pencil in pencils]
            t_bits = BITS + rational_bits(lo) + rational_bits(hi)
            demand(2 * ns * ns * (t_bits + mu_bits) <= 2**29, "a box's matrices are too large")
            Budget.matrices -= ns * ns * (words(t_bits) * words(mu_bits) + 256)
            demand(Budget.matrices >= 0, "matrices of boxes: more work than the file's budget")
            return [at_friction(both, mu) for mu in (low, high)]
        corners = [box.around(x, e) for x in ends(t0, t1) for e in (0, 1)]
        d = box.margins(corners)
        theta = max(box.theta(c, d) for c in corners)
        demand(theta < 1, "presence 5: x > 0")
        box.resting(corners, theta)
        signs = [box.edge([box.around(x, 0) for x in ends(t, t)], d) for t in (t0, t1)]
        demand(signs[0] * signs[1] == -1, "presence 7: no change of sign")
        low = high
    where = f"every friction in [{start}, {stop}] and some lambda2 >= 0"
    return 0, f"ACCEPTED: a solution for {where}{whom(p)}, {len(pieces)} pieces"


# ---------------------------------------------------------------- stability on an interval of friction

STABILITY_END = record(exponent=exponent, symmetric=list_of(INTEGERS), bounds=INTEGERS, factor=FACTOR)
STABILITY = record(**{
    "format": text_of, "problem_sha256": text_of, "from": Maybe(number), "to": number, "mass_sigma": number, "mass_factor": Maybe(FACTOR),
    "condensation": Maybe(record(sigma=number, stiffness_factor=FACTOR, right=MATRIX, left_friction=MATRIX, inertia=Maybe(MATRIX))),
    "lower": STABILITY_END, "upper": STABILITY_END})


def read_columns(obj, nf, ns, reason):
    """The columns of an integer matrix with a row for each free variable, as fractions."""
    exponent, rows = counter(obj["exponent"]), obj["rows"]
    demand(exponent <= 4096, "Cover.TooLarge: an exponent")
    demand(len(rows) == nf and all(len(r) == ns for r in rows), reason)
    return [[Q(integer(row[j]), 2**exponent) for row in rows] for j in range(ns)]


class Motions:
    """The numbers of the theorem of stability that do not depend on mu (C, 5.21); R, M1, C, c, E by rows of slip particles."""

    def __init__(self, p, parts, obj, sigma, mass_sigma, to):
        nf, ns = len(p.free), len(p.s)
        stiffness, mass = parts[0].a, parts[0].b
        friction, inertia = ([m[i] for i in p.s] for m in (parts[1].a, parts[1].b))
        g = [[Q(0)] * nf] * ns
        if obj is not None and obj.get("inertia") is not None:
            g = read_columns(obj["inertia"], nf, ns, "Length: inertia")
        self.within_limits(p, parts, None if obj is None else obj.get("inertia"))

        def less(row, weights, matrix):
            """row - weights' matrix, of its free rows."""
            for i, weight in zip(p.free, weights):
                if weight:
                    row = plus(row, matrix[i], -weight)
            return row
        c = [less(row, weights, stiffness) for row, weights in zip(friction, g)]
        self.e = [sum(map(abs, less(row, weights, mass).values()), Q(0)) for row, weights in zip(inertia, g)]
        demand(2 * to * sum(self.e) <= mass_sigma, "Inertia: the mass couples normals of slip particles with what moves")
        kappa = sum(abs(v) for row in stiffness for v in row.values()) + to * sum(abs(v) for row in c for v in row.values())
        self.omega = 2 * kappa / mass_sigma
        self.w, self.rest, self.a2 = Q(0), Q(0), [Q(0)] * ns
        if obj is None:
            return
        k_ff = [{j: v for j, v in stiffness[i].items() if j < nf} for i in p.free]

        def residual(given, column):
            return [x - sum(v * column[j] for j, v in row.items()) for x, row in zip(given, k_ff)]
        right, left = (read_columns(obj[name], nf, ns, f"Cover.Length: {name}") for name in ("right", "left_friction"))
        self.w = sum(abs(x) for column in right for x in column)
        for j, column in zip(p.s, right):  # K_ff^-1 K_fs itself is longer than `right` by |K_fs - K_ff W| / sigma at most
            self.w += sum(map(abs, residual([stiffness[i].get(j, Q(0)) for i in p.free], column))) / sigma
        for i in range(ns):
            u = [x - y for x, y in zip(left[i], g[i])]
            given = [c[i].get(j, Q(0)) for j in p.free]
            l = residual(given, u)
            self.a2[i] = dot(u, [x + y for x, y in zip(given, l)]) + dot(l, l) / sigma
        self.rest = 1 + 1 / sigma


    @staticmethod
    def within_limits(p, parts, inertia):
        """The limits of 5.16 for stability."""
        common, longest, count = 1, 0, 0
        for i in range(p.n):
            rows = [row for x in parts for row in (x.a[i], x.b[i])]
            factor = lcm(1, *(v.denominator for row in rows for v in row.values()))
            common = lcm(common, factor)
            longest = max([longest, *(abs(v.numerator) * (factor // v.denominator) for row in rows for v in row.values())])
            count += sum(len({j for row in (x.a[i], x.b[i]) for j, v in row.items() if v}) for x in parts)
        bits = common.bit_length() + longest.bit_length()
        demand(2 * count * bits <= 1 << 31, "Cover.TooLarge: the pencil with one denominator")
        if inertia is not None:
            bits += counter(inertia["exponent"]) + max((abs(integer(x)).bit_length() for row in inertia["rows"] for x in row), default=0)
        demand(2 * len(p.s) * p.n * bits <= 1 << 31, "Cover.TooLarge: R - G K_f and M1 - G M_f")


def stable_at(p, obj, ends, scales, motions, mu, name):
    """Obligation 7 at an end."""
    ns, unit = len(p.s), 2**counter(obj["exponent"])
    demand(counter(obj["exponent"]) <= 4096, "Cover.TooLarge: an exponent")
    q, b = [[integer(x) for x in row] for row in obj["symmetric"]], [integer(x) for x in obj["bounds"]]
    demand(len(q) == len(b) == ns and all(len(row) == ns for row in q), f"Length: {name}")
    demand(all(q[i][j] == q[j][i] for i in range(ns) for j in range(i)), f"NotSymmetric: {name}")
    demand(all(x >= 0 for x in b), f"Bound: {name}, a negative one")
    m, r = ends.both[0]
    per_rate = [mu * e * motions.omega for e in motions.e]
    for i in range(ns):
        theta = per_rate[i] * (1 + motions.w)
        for j in range(ns):
            demand(Q(q[i][j], unit) <= Q(m[i][j] - r[i][j], ends.unit) / scales[i] - theta, f"NotBelow: {name}, entry ({i}, {j})")
    for i in range(ns):
        beyond = Q(b[i], unit) - per_rate[i] * motions.rest
        demand(beyond >= 0 and beyond**2 >= mu**2 * motions.a2[i], f"Bound: {name}, slip particle {i}")
    rows = [{j: Q(4 * q[i][j] * unit - b[i] * b[j], unit**2) for j in range(ns)} for i in range(ns)]
    covered(rows, ns, obj["factor"], True, f"Cover.Hypothesis: {name}, 4 Q - b b'")


def check_stability(p, doc):
    """The equilibrium is stable for every mu in [from, to] but 0."""
    STABILITY(doc)
    _, digest, stop, mass_sigma, lower, upper, start, mass_factor, obj = fields(
        doc, "format problem_sha256 to mass_sigma lower upper", "from mass_factor condensation")
    start, stop, mass_sigma = Q(0) if start is None else number(start), number(stop), number(mass_sigma)
    demand(digest == p.digest, f"Digest: the problem's is {p.digest}")  # 1
    demand(p.radii is None, "Radii")
    demand(p.system is not None, "NotASystem")  # 2
    demand(p.unknown == "lambda2", "Unknown: lambda2 was expected")
    demand(not p.curved, "Curved")
    demand(not p.halves, "ZeroReaction")
    demand(0 <= start < stop, "FrictionRange: from and to")  # 3
    demand((obj is not None) == bool(p.free), "Cover.Condensation: present exactly if there are free variables")  # 4
    demand(len(p.s) <= 512, "Cover.TooLarge: more than 512 slip variables")
    parts, _ = friction_parts(p)
    weightless = [Part(p, x.a, [{}] * p.n) for x in parts]
    common = [lcm(1, *(v.denominator for x in weightless for v in x.a[i].values())) for i in range(p.n)]
    integral = [[(f, {j: int(v * f) for j, v in a.items()}, {}) for f, a in zip(common, x.a)] for x in weightless]
    sigma, own = None, None
    if obj is not None:
        sigma = number(obj["sigma"])
        own = {"sigma": obj["sigma"], "stiffness_factor": obj["stiffness_factor"], "mass_sigma": "0", "anchors": [
            {"center": "0", "right": [obj["right"]], "left_friction": [obj["left_friction"]]}]}
    pencils, _ = critical_pencils(p, weightless, integral, own, start, stop)
    Budget.of_anchors(pencils)
    Budget.matrices = 1 << 30
    anchor = None if obj is None else 0
    for pencil in pencils:
        pencil.name(anchor)
    ends = [pencil.ends(Q(0), Q(0), anchor) for pencil in pencils]
    demand(mass_sigma > 0, "Cover.Hypothesis: mass_sigma is not positive")  # 5
    covered([plus(row, {i: -mass_sigma}) for i, row in enumerate(parts[0].b)], p.n, mass_factor, False, "Cover.Hypothesis: mass")
    motions = Motions(p, parts, obj, sigma, mass_sigma, stop)  # 6
    bits = [max(x) for x in zip(*(row_bits(rows, 1) for rows in integral))]
    scales = [Q(common[i], 2**bits[i]) for i in p.s]
    for end, mu, name in ((lower, start, "lower"), (upper, stop, "upper")):  # 7
        stable_at(p, end, at_friction(ends, mu), scales, motions, mu, name)
    bracket = "[" if start > 0 else "("
    return 0, f"ACCEPTED: stable for every mu in {bracket}{start}, {stop}]"


# ---------------------------------------------------------------- plain LCPs and MCPs

def read_mcp(doc):
    """M, q and the bounds of mceip-mcp/1 (F); None for an absent bound."""
    _, m, q, lower, upper, *words = fields(doc, "format m q", "lower upper name comment")
    for word in words:
        Maybe(text_of)(word)
    m = [[number(v) for v in sequence(row)] for row in sequence(m)]
    q = [number(v) for v in sequence(q)]
    bounds = []
    for given, default in ((lower, Q(0)), (upper, None)):
        bounds.append([default] * len(q) if given is None else [None if v is None else number(v) for v in sequence(given)])
    lower, upper = bounds
    if not len(m) == len(lower) == len(upper) == len(q) or any(len(row) != len(q) for row in m):
        raise Unreadable("parts of different lengths")
    if any(lo is not None and hi is not None and lo > hi for lo, hi in zip(lower, upper)):
        raise Unreadable("crossed bounds")
    return m, q, lower, upper


def mcp_digest(m, q, lower, upper):
    bound = lambda v: "-" if v is None else str(v)
    lines = ["mceip-mcp-canonical/1", str(len(q))]
    lines += [" ".join([*map(str, row), str(c), bound(lo), bound(hi)]) for row, c, lo, hi in zip(m, q, lower, upper)]
    return hashlib.sha256("".join(line + "\n" for line in lines).encode()).hexdigest()


def check_mcp(doc, certificate_path):
    m, q, lower, upper = read_mcp(doc)
    claimed = read_json(certificate_path)
    if not isinstance(claimed, dict) or claimed.get("format") != "mceip-mcp-solution/1":
        raise Unreadable("format: mceip-mcp-solution/1 was expected")
    _, digest, points = fields(claimed, "format problem_sha256 z")
    text_of(digest)
    points = [[number(v) for v in sequence(z)] for z in sequence(points)]
    demand(digest == mcp_digest(m, q, lower, upper), "the digest is not the problem's")
    demand(points, "no solution is listed")
    most = min((1 << 24) // max(len(q), 1), 1 << 19)
    for k, z in enumerate(points):
        demand(len(z) == len(q), f"solution {k}: length")
        common = lcm(*(v.denominator for v in z))
        longest = max((abs(v.numerator) * (common // v.denominator) for v in z), default=0)
        demand(common.bit_length() + longest.bit_length() <= most, f"solution {k}: too large")
        for i, (v, row, lo, hi) in enumerate(zip(z, m, lower, upper)):
            demand((lo is None or lo <= v) and (hi is None or v <= hi), f"solution {k}: z[{i}] out of its bounds")
            f = q[i] + sum(a * b for a, b in zip(row, z) if a)
            demand((f >= 0 or v == hi) and (f <= 0 or v == lo), f"solution {k}: F[{i}] = {f}")
    return 0, f"ACCEPTED: {len(points)} solution(s)"


# ---------------------------------------------------------------- contact states under loads

class Loads:
    """A body under loads: K, M, candidates and loads without the held dofs, and the digest."""

    def __init__(self, doc, folder):
        _, system, steps, _, _, *words = fields(doc, "format system steps", "coordinates warnings name comment")
        for word in words:
            Maybe(text_of)(word)
        k, candidates, m, mu, held = fields(system, "stiffness candidates", "mass friction held")
        k = read_matrix(k, folder, "stiffness")
        m = None if m is None else read_matrix(m, folder, "mass")
        mu = None if mu is None else number(mu)
        if mu is not None and mu <= 0:
            raise Unreadable("friction must be positive (X8)")
        order = len(k.rows)
        for x in (k,) if m is None else (k, m):
            if (len(x.rows), x.cols) != (order, order) or any(x.rows[j].get(i) != v for i, r in enumerate(x.rows) for j, v in r.items()):
                raise Unreadable("stiffness and mass must be symmetric, of one order")
        held = {index(d, order) for d in sequence([] if held is None else held)}
        given = []  # of each step: forces, displacements
        for step in sequence(steps):
            name, endless, *values = fields(step, "", "name endless forces displacements")
            Maybe(text_of)(name)
            Maybe(flag)(endless)
            if endless and step is not steps[-1]:
                raise Unreadable("an endless step before another")
            given.append([self.values(pairs, order) for pairs in values])
        if not given:
            raise Unreadable("steps: expected one")
        for _, displacements in given:
            held |= set(displacements)
        kept = [d for d in range(order) if d not in held]
        new = {d: i for i, d in enumerate(kept)}
        self.loads = []
        for forces, displacements in given:
            if held & set(forces):
                raise Unreadable("a force on a held dof")
            load = {new[d]: v for d, v in forces.items()}
            for d, v in displacements.items():
                for e, entry in k.rows[d].items():
                    if e in new:
                        load[new[e]] = load.get(new[e], 0) - entry * v
            self.loads.append({d: v for d, v in load.items() if v})
        self.k, m = self.without(k, new), None if m is None else self.without(m, new)
        self.order, self.candidates, self.gaps = len(kept), [], []
        text = ["mceip-canonical-loads/1"]
        for obj in sequence(candidates):
            if not isinstance(obj, dict) or {"state", "sign", "friction_factor_range", "curvature", "reaction"} & set(obj):
                raise Unreadable("a candidate has no state, sign, friction_factor_range, curvature or reaction")
            obj, gap = {key: v for key, v in obj.items() if key != "gap"}, obj.get("gap")
            gap = Q(0) if gap is None else number(gap)
            obj = {**obj, "state": "stick"}
            t, n, _, tangent, normal, _, factor, *_ = Problem.read_particle(obj, order, None)
            if gap < 0 or t not in new or n not in new or t == n:
                raise Unreadable("a candidate on a held dof, or with a negative gap")
            tangent, normal = ({new[d]: c for d, c in v.items()} for v in (tangent, normal))
            text += particle_lines(new[t], new[n], "stick", None, tangent, normal, factor)
            self.candidates.append((new[t], new[n], tangent, normal, factor))
            self.gaps.append(gap)
        dofs = [d for t, n, *_ in self.candidates for d in (t, n)]
        if not dofs or len(set(dofs)) < len(dofs):
            raise Unreadable("expected candidates, each dof in one of them")
        text += matrix_lines(self.k, m) + [f"gap {gap}" for gap in self.gaps]
        for load in self.loads:
            text += ["load"] + [f"{d} {load[d]}" for d in sorted(load)]
        self.digest = hashlib.sha256("".join(line + "\n" for line in text).encode()).hexdigest()

    @staticmethod
    def values(pairs, order):
        out = {}
        for pair in sequence([] if pairs is None else pairs):
            if len(sequence(pair)) != 2 or (d := index(pair[0], order)) in out:
                raise Unreadable("a value is [dof, number], each dof once")
            out[d] = number(pair[1])
        return out

    @staticmethod
    def without(matrix, new):
        out = Matrix(len(new), len(new), "a matrix")
        for d, i in new.items():
            out.rows[i] = {new[e]: v for e, v in matrix.rows[d].items() if e in new}
        return out


class Equilibrium:
    """The pencil of which the stated equilibrium is a solution, with the variables in turn: the
    dofs of no candidate in contact, u_T in slip and zero, s, one for each inequality (C)."""

    def __init__(self, loads, mu, amounts, states):
        force = {}
        for load, amount in zip(loads.loads, amounts):
            for d, v in load.items():
                force[d] = force.get(d, 0) + amount * v
        contact = {d for (t, n, *_), (state, _) in zip(loads.candidates, states) if state != "free" for d in (t, n)}
        trial = [{d: Q(1)} for d in range(loads.order) if d not in contact]
        equations, given, inequalities, zeros = list(trial), {}, [], []
        minus = lambda v: {d: -c for d, c in v.items()}
        plus = lambda v, w: {d: v.get(d, 0) + w.get(d, 0) for d in {*v, *w}}
        for (_, _, tangent, normal, factor), gap, (state, value) in zip(loads.candidates, loads.gaps, states):
            friction = {d: mu * factor * c for d, c in normal.items()}
            if state == "free":
                inequalities.append((normal, gap))
                continue
            given = plus(given, {d: gap * c for d, c in normal.items()})
            if state == "zero":
                zeros.append(len(inequalities))
            inequalities.append((minus(normal), None))
            if state == "stick":
                given = plus(given, {d: value * c for d, c in tangent.items()})
                inequalities += [(minus(plus(friction, v)), None) for v in (tangent, minus(tangent))]
            else:
                side = {d: value * c for d, c in tangent.items()}
                trial.append(tangent)
                equations.append(plus(side, friction) if state == "slip" else tangent)
        self.load = len(trial)
        trial.append(given)
        self.a = []
        for row, p in zip(project(equations, loads.k.rows, trial), equations):
            self.a.append(self.with_load(row, -self.along(p, force)))
        self.a.append({self.load: Q(-1)})
        for vector, gap in inequalities:
            if gap is None:
                row, = project([vector], loads.k.rows, trial)
                self.a.append(self.with_load(row, -self.along(vector, force)))
            else:
                row = {j: -sum(vector.get(d, 0) * c for d, c in column.items()) for j, column in enumerate(trial)}
                self.a.append(self.with_load({j: v for j, v in row.items() if v}, gap))
        self.n = len(self.a)
        self.b = [{self.load: Q(1)} if i == self.load else {} for i in range(self.n)]
        self.free, self.s = list(range(self.load)), list(range(self.load, self.n))
        self.zeros = [self.load + 1 + i for i in zeros]
        self.halves, self.system = [], None

    @staticmethod
    def along(vector, force):
        return sum((c * force.get(d, 0) for d, c in vector.items()), Q(0))

    def with_load(self, row, value):
        row = {**row, self.load: row.get(self.load, 0) + value}
        return {j: v for j, v in row.items() if v}


def stated_state(obj):
    """(state, sign or u_T)."""
    if not isinstance(obj, dict) or obj.get("state") not in ("free", "stick", "slip", "zero"):
        raise Unreadable("a candidate has a state")
    state = obj["state"]
    if state == "stick":
        return state, number(fields(obj, "state tangential")[1])
    if state == "slip":
        sign = counter(fields(obj, "state sign")[1], -1, 1)
        if sign == 0:
            raise Unreadable("sign is 1 or -1")
        return state, sign
    fields(obj, "state")
    return state, 0


EQUILIBRIUM = record(format=text_of, loads_sha256=text_of, friction=number, amounts=list_of(number), candidates=list_of(stated_state), claim=CLAIM)


def check_equilibrium(loads, doc):
    if not isinstance(doc, dict) or doc.get("format") != "mceip-equilibrium/1":
        raise Unreadable("format: mceip-equilibrium/1 was expected")
    EQUILIBRIUM(doc)
    _, digest, mu, amounts, states, claim = fields(doc, "format loads_sha256 friction amounts candidates claim")
    mu, amounts, states = number(mu), [number(a) for a in amounts], [stated_state(c) for c in states]
    demand(digest == loads.digest, f"the digest of the loads is {loads.digest}")
    demand(mu > 0, "friction")
    demand(len(amounts) == len(loads.loads), "amounts: one for each load")
    demand(len(states) == len(loads.gaps), "candidates: one state for each")
    p = Equilibrium(loads, mu, amounts, states)
    Budget.claims = 2**43 + 2**34
    (kind, body), = claim.items()
    support, biactive, *_ = CLAIMS[kind](p, integral_rows(p), (Q(0), None), body)
    demand(support == [p.load], "the support is not the load alone")
    demand(sorted(biactive) == p.zeros, "the rows that vanish are not those of the candidates in state zero")
    return 0, "ACCEPTED: an equilibrium in these contact states"


CLAIMS = {"exact_solution": exact_solution, "enclosed_solution": enclosed_solution, "lifted_solution": lifted_solution}


def check(problem_path, certificate_path):
    plain = read_json(problem_path)
    if isinstance(plain, dict) and plain.get("format") == "mceip-mcp/1":
        return check_mcp(plain, certificate_path)
    if isinstance(plain, dict) and plain.get("format") == "mceip-loads/1":
        loads = Loads(plain, os.path.dirname(os.path.abspath(problem_path)))
        return check_equilibrium(loads, read_json(certificate_path))
    p = Problem(problem_path)
    doc = read_json(certificate_path)
    if isinstance(doc, dict) and doc.get("format") == "mceip-critical/1":
        return check_critical(p, doc)
    if isinstance(doc, dict) and doc.get("format") == "mceip-presence/1":
        return check_presence(p, doc)
    if isinstance(doc, dict) and doc.get("format") == "mceip-stability/1":
        return check_stability(p, doc)
    if not isinstance(doc, dict) or doc.get("format") != "mceip-certificate/1":
        raise Unreadable("format: mceip-certificate/1 was expected")
    CERTIFICATE(doc)
    _, digest, unknown, *of_file, negative = fields(doc, "format problem_sha256 unknown window claims", "complete_set negative")
    parts = [(p, 1, *of_file)]
    if negative is not None:
        if unknown != "eigenvalue":
            raise Unreadable("negative: only for eigenvalue")
        parts.append((p.reflected(), -1, *fields(negative, "window claims", "complete_set")))
    parts = [(pencil, sign, read_window(window), claims, complete) for pencil, sign, window, claims, complete in parts]
    demand(digest == p.digest, f"the problem's digest is {p.digest}")
    demand(p.radii is None, "Radii: this kind of certificate speaks of one body")
    demand(unknown == p.unknown, "the unknown is not the problem's")
    demand(any(claims or complete is not None for *_, claims, complete in parts), "no claim")
    texts, left_open = zip(*(check_part(*part) for part in parts))
    return (3, "UNDECIDED: " + "; ".join(texts)) if any(left_open) else (0, "ACCEPTED: " + "; ".join(texts))


def values(sign, lo, hi):
    """The values t = sign s with lo <= s <= hi."""
    if sign < 0:
        return f"(-infinity, {-lo}]" if hi is None else f"[{-hi}, {-lo}]"
    return f"[{lo}, infinity)" if hi is None else f"[{lo}, {hi}]"


def check_part(p, sign, window, claim_list, complete):
    """What is said of the values t = sign s, s in the window and p the pencil in s (C, 5.2), and the number of open leaves."""
    try:
        rows, claims = integral_rows(p), []
        Budget.claims = 2**43 + 2**34 * len(claim_list)
        for c in claim_list:
            (kind, body), = c.items()
            claims.append(CLAIMS[kind](p, rows, window, body))
        cover = None if complete is None else complete_set(p, rows, window, claims, complete)
    except Rejected as e:
        raise Rejected(f"negative: {e}" if sign < 0 else e) from None
    text = f"{len(claims)} claim(s)"
    if p.unknown == "eigenvalue":
        text = f"t in {values(sign, *window)}: {text}"
    if cover is None:
        return text, 0
    solutions, families, left_open = cover
    if left_open:
        return f"{text}; {left_open} open leaves, {solutions} solution(s) outside them", left_open
    more = f" and {families} families" if families else ""
    return f"{text}; complete set of {solutions} solution(s){more}", 0


def main(arguments):
    if len(arguments) != 2:
        print("usage: checker.py PROBLEM CERTIFICATE", file=sys.stderr)
        return 2
    sys.set_int_max_str_digits(0)
    try:
        code, line = check(*arguments)
    except Rejected as e:
        code, line = 1, f"REJECTED: {e}"
    except (Unreadable, RecursionError) as e:
        print(" ".join(f"checker.py: {e}".split())[:500], file=sys.stderr)
        return 2
    print(line)
    return code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
