"""The examples of the README, where scikit-fem is installed, and the program of chapter 11."""

import json
import runpy
from fractions import Fraction
from pathlib import Path
from xml.etree import ElementTree

import pytest

EXAMPLES = Path(__file__).parent.parent / "examples"
REPOSITORY = Path(__file__).parent.parent.parent


def test_the_block_has_a_certified_critical_friction_and_a_drawing(tmp_path, monkeypatch, capsys):
    pytest.importorskip("skfem")
    monkeypatch.chdir(tmp_path)

    answer = runpy.run_path(str(EXAMPLES / "block.py"))["answer"]

    lower, upper = answer.critical_friction
    assert Fraction("1.97649") < lower < upper < Fraction("1.97651")
    assert answer.critical.absent_evidence.kind == "certificate"
    assert answer.critical.evidence.kind == "certificate"
    for proof in answer.proofs:
        proof.check()

    assert "PRESENT" in capsys.readouterr().out
    root = ElementTree.parse(tmp_path / "block.svg").getroot()
    assert len(root.findall("{http://www.w3.org/2000/svg}circle")) == 5


def test_the_pad_slips_as_a_whole_in_the_end_and_has_a_critical_friction(capsys):
    pytest.importorskip("skfem")

    variables = runpy.run_path(str(EXAMPLES / "pad.py"))

    path, answer = variables["path"], variables["answer"]
    assert path.end == "all loads are applied"
    assert set(path.stretches[0].states) == {"stick"}
    assert set(path.stretches[-1].states) == {"slip-"}
    # The disc drags against the slip, with mu N in the end.
    tangential, normal = path.stretches[-1].reactions.T
    assert tangential == pytest.approx(-0.5 * normal)
    lower, upper = answer.critical_friction
    assert Fraction("2.6482") < lower < upper < Fraction("2.6483")
    assert "ABSENT" in capsys.readouterr().out


def test_the_first_program_of_chapter_11_runs(tmp_path, monkeypatch, capsys):
    chapter = (REPOSITORY / "spec" / "eigenvalues.md").read_text()
    program = chapter.split("```python\n")[1].split("```")[0]
    monkeypatch.chdir(tmp_path)
    exec(program, {})

    assert capsys.readouterr().out.startswith("True [-6.145")
    written = json.loads((tmp_path / "certificate.json").read_text())
    assert written["unknown"] == "eigenvalue" and "negative" in written

    readme = (REPOSITORY / "README.md").read_text()
    assert all(f"    {line}\n" in readme for line in program.splitlines())
