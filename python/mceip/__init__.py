"""Can a static equilibrium of an elastic body in frictional contact diverge? With proofs.

    >>> import mceip
    >>> body = mceip.Problem.from_matrices(
    ...     stiffness=[[2.0, 1.5], [1.5, 2.0]], mass=[[1.0, 0.0], [0.0, 1.0]], friction="1.5",
    ...     contacts=[mceip.Contact(tangential=0, normal=1, state="slip+")])
    >>> everything = body.complete()
    >>> [solution.value for solution in everything.solutions], everything.is_complete
    ([0.25], True)
    >>> mceip.check(body, everything.certificate).is_complete
    True

Matrices are numpy arrays, anything of scipy.sparse, or lists of rows. A float stands for exactly
the binary fraction that it is, a text for the number that it spells. Exact numbers of answers are
`fractions.Fraction`, vectors are numpy arrays.

Every solution and every certificate that these functions return has been accepted by the checker;
`check` runs it again, as anybody else would.
"""

from ._native import MceipError, NotCertifiedError, RejectedError, __version__
from .answers import (
    Absence,
    Accepted,
    Analysis,
    Certificate,
    Certified,
    Claim,
    CriticalFriction,
    Evidence,
    Family,
    Found,
    Members,
    Mode,
    OpenRegion,
    Presence,
    Proof,
    Solution,
    SolutionSet,
    Stability,
    Statement,
    Uncertified,
)
from .complementarity import McpPoint, McpResiduals, mcp
from .drawing import Drawing, draw_mode
from .exact import Interval
from .inputs import Contact, Number
from .loading import (
    Body,
    Candidate,
    CertifiedEquilibrium,
    HeldState,
    LoadPath,
    OwnCritical,
    PathAnalysis,
    Step,
    Stretch,
)
from .mesh import Mesh
from .problem import ModelWarning, Problem, check
from .progress import Listener

__all__ = [
    "Absence",
    "Accepted",
    "Analysis",
    "Body",
    "Candidate",
    "Certificate",
    "Certified",
    "CertifiedEquilibrium",
    "Claim",
    "Contact",
    "CriticalFriction",
    "Drawing",
    "Evidence",
    "Family",
    "Found",
    "HeldState",
    "Interval",
    "Listener",
    "LoadPath",
    "MceipError",
    "McpPoint",
    "McpResiduals",
    "Mesh",
    "Members",
    "Mode",
    "ModelWarning",
    "NotCertifiedError",
    "Number",
    "OpenRegion",
    "OwnCritical",
    "PathAnalysis",
    "Presence",
    "Problem",
    "Proof",
    "RejectedError",
    "Solution",
    "SolutionSet",
    "Stability",
    "Statement",
    "Step",
    "Stretch",
    "Uncertified",
    "__version__",
    "check",
    "draw_mode",
    "mcp",
]
