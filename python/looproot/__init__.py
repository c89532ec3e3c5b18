"""Every way to assemble a robot arm, a closed linkage or a Stewart platform.

All solutions, each polished and proved, with a verdict on whether the list is complete. Angles are radians, lengths metres.

>>> import looproot as lr
>>> arm = lr.robot("ur5")
>>> s = arm.ik(arm.fk([0.1, -1.0, 1.2, 0.3, 0.7, -0.4]))
>>> s.q.shape
(8, 6)
>>> s.verdict.status
'complete'
"""

from . import batch
from ._answers import Batch, Derivation, Family, Polynomial, Solutions, Sweep, Verdict
from ._arm import Arm, from_dh, from_file, from_screws, from_urdf, robot
from ._certificate import Certificate, Verification, verify
from ._closed import Loop, Platform
from ._core import InternalError, UnsupportedError, __version__
from ._functions import conditions, load, mobility, names
from ._linkage import Linkage
from ._pose import Pose

__all__ = [
    "Arm",
    "Batch",
    "Certificate",
    "Derivation",
    "Family",
    "InternalError",
    "Linkage",
    "Loop",
    "Platform",
    "Polynomial",
    "Pose",
    "Solutions",
    "Sweep",
    "UnsupportedError",
    "Verdict",
    "Verification",
    "__version__",
    "batch",
    "conditions",
    "from_dh",
    "from_file",
    "from_screws",
    "from_urdf",
    "load",
    "mobility",
    "names",
    "robot",
    "verify",
]
