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


def test_the_certificate_of_a_linkage_holds_for_its_file_alone(tmp_path: Path) -> None:
    linkage = lr.Linkage("linkage/3rpr")
    certificate = linkage.certificate()
    found = certificate.verify(file="linkage/3rpr")
    assert found.holds and (found.complex, found.real) == (6, len(linkage.solve().q))
    assert not certificate.verify(file="linkage/jansen").holds
    lengths = [name for name, is_angle in zip(linkage.names, linkage.angles) if not is_angle]
    other = linkage.certificate(input={lengths[0]: 3.25})
    assert other.verify().holds and not other.verify(file="linkage/3rpr").holds
    changed = {**certificate.document, "modes": certificate.document["modes"][1:]}
    assert not lr.Certificate(changed).verify().holds
    with pytest.raises(lr.UnsupportedError, match="irrational"):
        lr.Linkage("linkage/jansen").certificate(input={"O": 0.5})
    with pytest.raises(lr.UnsupportedError, match="on the sphere"):
        lr.Linkage("linkage/spherical_3rrr").certificate()
    with pytest.raises(ValueError, match="unknown joint"):
        linkage.certificate(input={"Z": 1.0})


def test_what_is_no_certificate_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "none.json"
    path.write_text("no certificate", encoding="utf-8")
    with pytest.raises(ValueError):
        lr.verify(path)
    with pytest.raises(OSError):
        lr.verify(tmp_path / "nowhere.json")
    with pytest.raises(TypeError):
        lr.verify(3)  # type: ignore[arg-type]
