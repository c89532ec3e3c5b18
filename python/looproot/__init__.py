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

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from . import batch as batch
    from ._answers import Batch as Batch
    from ._answers import Derivation as Derivation
    from ._answers import Family as Family
    from ._answers import Polynomial as Polynomial
    from ._answers import Solutions as Solutions
    from ._answers import Sweep as Sweep
    from ._answers import Verdict as Verdict
    from ._arm import Arm as Arm
    from ._arm import from_dh as from_dh
    from ._arm import from_file as from_file
    from ._arm import from_screws as from_screws
    from ._arm import from_urdf as from_urdf
    from ._arm import robot as robot
    from ._certificate import Certificate as Certificate
    from ._certificate import Verification as Verification
    from ._certificate import verify as verify
    from ._closed import Loop as Loop
    from ._closed import Platform as Platform
    from ._core import InternalError as InternalError
    from ._core import UnsupportedError as UnsupportedError
    from ._core import __version__ as __version__
    from ._functions import conditions as conditions
    from ._functions import load as load
    from ._functions import mobility as mobility
    from ._functions import names as names
    from ._linkage import Linkage as Linkage
    from ._pose import Pose as Pose

# The modules of these names are read when a name of theirs is first used: scripts that only look at `--help` do not wait for them.
_MODULES = {
    "_answers": ["Batch", "Derivation", "Family", "Polynomial", "Solutions", "Sweep", "Verdict"],
    "_arm": ["Arm", "from_dh", "from_file", "from_screws", "from_urdf", "robot"],
    "_certificate": ["Certificate", "Verification", "verify"],
    "_closed": ["Loop", "Platform"],
    "_core": ["InternalError", "UnsupportedError", "__version__"],
    "_functions": ["conditions", "load", "mobility", "names"],
    "_linkage": ["Linkage"],
    "_pose": ["Pose"],
}

__all__ = ["batch", *(name for names in _MODULES.values() for name in names)]  # noqa: PLE0604


def __getattr__(name: str) -> Any:
    if name == "batch":
        return import_module(".batch", __name__)
    for module, held in _MODULES.items():
        if name in held:
            found = getattr(import_module(f".{module}", __name__), name)
            # The next use finds it without this function.
            globals()[name] = found
            return found
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return __all__
