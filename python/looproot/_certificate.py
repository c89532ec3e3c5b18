"""Certificates: proofs of answers that anyone can check."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass, field
from typing import Any

from . import _core
from ._answers import Document


@dataclass(frozen=True)
class Verification:
    """What the check of a certificate finds."""

    holds: bool
    """Whether every item of it holds."""
    complex: int | None
    """The number of solutions, complex ones included; None of other proofs and where an item does not hold."""
    real: int | None
    """How many of them are real; None of other proofs and where an item does not hold."""
    fault: str | None
    """The first item that does not hold."""
    mobility: int | None = None
    """Of a proof whether a loop moves: the dimension of the motion, 0 where there is none."""
    self_motion: int | None = None
    """Of a proof that solutions form a curve: 1."""


@dataclass(frozen=True)
class Certificate:
    """The proof of one answer, in the format of ``docs/certificate.md``.

    >>> import looproot as lr
    >>> arm = lr.robot("general_16real")
    >>> arm.certificate(arm.poses[0]).verify().complex
    16
    """

    document: Document = field(repr=False)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the file that ``looproot verify`` and ``verify/verify.py`` check."""
        with open(os.fspath(path), "w", encoding="utf-8") as file:
            file.write(json.dumps(self.document) + "\n")

    def verify(self, *, file: str | os.PathLike[str] | None = None) -> Verification:
        """Checks every item anew; solves nothing. With ``file`` the data are compared with those of a mechanism file."""
        return verify(self, file=file)[0]


def verify(
    certificate: Certificate | str | os.PathLike[str], *, file: str | os.PathLike[str] | None = None
) -> list[Verification]:
    """Checks a certificate, or those of a file, one for each line.

    A file that is no certificate is a ValueError, one that cannot be read an OSError. With ``file`` the data are compared with those
    of a mechanism file or of an entry of the library.
    """
    if isinstance(certificate, Certificate):
        text = json.dumps(certificate.document)
    elif isinstance(certificate, (str, os.PathLike)):
        with open(os.fspath(certificate), encoding="utf-8") as lines:
            text = lines.read()
    else:
        raise TypeError(f"found {type(certificate).__name__} as certificate, expected a Certificate or a path")
    found: list[dict[str, Any]] = json.loads(_core.verify(text, None if file is None else str(os.fspath(file))))
    return [Verification(**one) for one in found]


def read(text: str) -> Certificate:
    """A certificate by its document."""
    return Certificate(json.loads(text))
