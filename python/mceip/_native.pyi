"""The part of the module that is written in Rust; use `mceip` itself."""

from collections.abc import Callable, Sequence

from .inputs import Contact, Triplets
from .loading import PlainStep
from .mesh import PlainMesh
from .progress import Listener

__version__: str

class MceipError(ValueError):
    """What was given is no problem, or a question about it cannot be answered."""

class RejectedError(MceipError):
    """The checker refuses a certificate; the message names the obligation that fails."""

class NotCertifiedError(MceipError):
    """No proof was found for a point; that is no proof that there is no solution."""

class NativeProblem:
    @staticmethod
    def read(path: str) -> NativeProblem: ...
    @staticmethod
    def from_json(text: str) -> NativeProblem: ...
    @staticmethod
    def lambda2(
        dofs: int,
        stiffness: Triplets,
        mass: Triplets,
        friction: str,
        contacts: Sequence[Contact] | str,
        radii: tuple[Triplets | None, Triplets | None],
    ) -> NativeProblem: ...
    @staticmethod
    def friction_threshold(
        dofs: int, stiffness: Triplets, contacts: Sequence[Contact] | str
    ) -> NativeProblem: ...
    @staticmethod
    def pencil(
        order: int, a: Triplets, b: Triplets, free: Sequence[int], unknown: str
    ) -> NativeProblem: ...
    @staticmethod
    def qeicp(order: int, a: Triplets, b: Triplets, c: Triplets) -> NativeProblem: ...
    def in_window(self, min: str | None, max: str | None) -> NativeProblem: ...
    def to_json(self) -> str: ...
    def sha256(self) -> str: ...
    def unknown(self) -> str: ...
    def warnings(self) -> list[str]: ...
    def without_warnings(self) -> NativeProblem: ...
    def solve(self, starts: int, seed: int, all: bool, progress: Listener | None) -> str: ...
    def complete(
        self,
        threads: int | None,
        earlier: str | None,
        part: tuple[int, int] | None,
        progress: Listener | None,
    ) -> str: ...
    def merge(self, parts: Sequence[str]) -> str: ...
    def kind(self) -> str: ...
    def friction(self) -> str | None: ...
    def window(self) -> str: ...
    def analyze(
        self,
        friction: str | None,
        samples: int,
        threads: int | None,
        progress: Listener | None,
    ) -> str: ...
    def certify(self, value: float, x: Sequence[float]) -> str: ...
    def check(self, text: str) -> str: ...

class NativeLoads:
    @staticmethod
    def made(
        dofs: int,
        stiffness: Triplets,
        mass: Triplets | None,
        candidates: Sequence[Contact],
        gaps: Sequence[str],
        held: Sequence[int],
        steps: Sequence[PlainStep],
        friction: str,
        mesh: PlainMesh | None,
        accept_warnings: bool,
    ) -> NativeLoads: ...
    def warnings(self) -> list[str]: ...
    def path(self, in_doubles: bool, progress: Listener | None) -> NativeLoadPath | None: ...

class NativeLoadPath:
    def loads(self) -> str: ...
    def stretches(self) -> str: ...
    def text(self) -> str: ...
    def end(self) -> str: ...
    def problem(self, stretch: int) -> NativeProblem | None: ...
    def analyze(self, progress: Listener | None) -> tuple[str, str]: ...
    def places(self) -> list[int | None]: ...
    def check(self, text: str) -> tuple[str, list[str], list[str]]: ...
    def certify(self, stretch: int) -> str: ...
    def own_critical(
        self,
        range: tuple[str, str],
        parts: int,
        width: str,
        end_alone: bool,
        progress: Listener | None,
    ) -> tuple[str, str]: ...

def solve_mcp(
    function: Callable[[list[float]], bytes],
    jacobian: Callable[[list[float]], bytes | Triplets] | None,
    lower: Sequence[float],
    upper: Sequence[float],
    start: Sequence[float],
    tolerance: float | None,
    check: bool,
) -> tuple[list[float], list[float], list[float], bool, str, list[int]]: ...
