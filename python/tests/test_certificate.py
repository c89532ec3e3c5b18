"""Certificates from Python."""

from pathlib import Path

import pytest

import looproot as lr


def test_a_certificate_is_checked_and_a_changed_one_refused(tmp_path: Path) -> None:
    arm = lr.robot("general_16real")
    certificate = arm.certificate(arm.poses[0])
    found = certificate.verify()
    assert found.holds and found.complex == 16 and found.real == len(arm.ik(arm.poses[0]))
    path = tmp_path / "proof.json"
    certificate.save(path)
    assert lr.verify(path) == [found]
    changed = {**certificate.document, "modes": certificate.document["modes"][1:]}
    refused = lr.Certificate(changed).verify()
    assert not refused.holds and refused.fault


def test_what_is_no_certificate_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "none.json"
    path.write_text("no certificate", encoding="utf-8")
    with pytest.raises(ValueError):
        lr.verify(path)
    with pytest.raises(OSError):
        lr.verify(tmp_path / "nowhere.json")
    with pytest.raises(TypeError):
        lr.verify(3)  # type: ignore[arg-type]
