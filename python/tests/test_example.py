"""The example of the README, where scikit-fem is installed."""

import runpy
from fractions import Fraction
from pathlib import Path
from xml.etree import ElementTree

import pytest

EXAMPLE = Path(__file__).parent.parent / "examples" / "block.py"


def test_the_block_has_a_certified_critical_friction_and_a_drawing(tmp_path, monkeypatch, capsys):
    pytest.importorskip("skfem")
    monkeypatch.chdir(tmp_path)

    answer = runpy.run_path(str(EXAMPLE))["answer"]

    lower, upper = answer.critical_friction
    assert Fraction("1.97649") < lower < upper < Fraction("1.97651")
    assert answer.critical.absent_evidence.kind == "certificate"
    assert answer.critical.evidence.kind == "certificate"
    for proof in answer.proofs:
        proof.check()

    assert "PRESENT" in capsys.readouterr().out
    root = ElementTree.parse(tmp_path / "block.svg").getroot()
    assert len(root.findall("{http://www.w3.org/2000/svg}circle")) == 5
