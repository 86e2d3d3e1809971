"""The conformance pack of the repository, as objects; damaged packs are refused."""

import json
import shutil
from pathlib import Path

import pytest

import mceip
from mceip.conformance import read_pack

FOLDER = Path(__file__).parent.parent.parent / "spec" / "conformance-pack"


@pytest.fixture(scope="module")
def pack():
    return read_pack(FOLDER)


def test_the_pack_has_cases_with_problems_answers_and_wrong_answers(pack):
    index = json.loads((FOLDER / "index.json").read_text())

    assert len(pack.cases) == index["cases"] > 250
    assert len({case.id for case in pack.cases}) == len(pack.cases)
    assert "fold" in pack.flags
    assert sum(len(case.wrong) for case in pack.cases) > 500
    assert {answer.label for case in pack.cases for answer in case.wrong} == {"incomplete", "wrong"}


def test_tier_2_says_what_is_known_of_each_answer_and_how_hard_it_is():
    large = read_pack(FOLDER.with_name("conformance-pack-2"))

    assert (large.tier, large.version) == (2, read_pack(FOLDER).version)
    assert {case.completeness for case in large.cases} == {"exact", "proved", "best_known"}
    assert {case.difficulty for case in large.cases} == {"easy", "medium", "hard"}
    for case in large.cases:
        assert (case.certificate_sha256 is not None) == (case.completeness == "proved"), case.id


def test_a_pack_without_version_tier_and_difficulty_is_read(tmp_path):
    def without(text):
        index = json.loads(text)
        del index["version"], index["tier"]
        return json.dumps(index)

    old = read_pack(damaged(tmp_path, "index.json", without))

    assert (old.version, old.tier) == ("", 1)
    assert {(case.completeness, case.difficulty) for case in old.cases} == {("exact", None)}


def test_complete_sets_have_the_values_of_the_answers(pack):
    folds = [case for case in pack.with_flag("fold") if not case.answer["continua"]]
    assert len(folds) > 3

    for case in folds:
        found = case.problem.complete()
        assert found.is_complete, case.id

        exact = sorted(float(solution["value"]) for solution in case.answer["solutions"])
        values = sorted(solution.value for solution in found.solutions)
        assert values == pytest.approx(exact, rel=1e-6), case.id


def test_unknown_cases_and_flags_are_key_errors(pack):
    with pytest.raises(KeyError, match="nowhere"):
        pack.case("nowhere")
    with pytest.raises(KeyError, match="no_flag"):
        pack.with_flag("no_flag")


def damaged(tmp_path, name, change):
    """A copy of the pack with one file changed."""
    copy = tmp_path / "pack"
    shutil.copytree(FOLDER, copy)
    file = copy / name
    file.write_text(change(file.read_text()))
    return copy


@pytest.mark.parametrize(
    ("name", "change", "words"),
    [
        ("folds.json", lambda text: text.replace("folds", "golds", 1), "digest"),
        ("index.json", lambda text: text.replace("index/1", "index/2"), "format"),
        ("index.json", lambda text: text[:-20], "expected JSON"),
        ("index.json", lambda text: "[]", "format"),
        ("index.json", lambda text: text.replace("folds.json", "../folds.json"), "beside it"),
        ("index.json", lambda text: text.replace("folds.json", ".."), "beside it"),
        ("index.json", lambda text: text.replace('"groups"', '"troops"'), "fields of a pack"),
        ("index.json", lambda text: text.replace('"sha256"', '"sha512"'), "fields of a pack"),
    ],
)
def test_damaged_packs_are_refused(tmp_path, name, change, words):
    with pytest.raises(mceip.MceipError, match=words):
        read_pack(damaged(tmp_path, name, change))


def test_a_missing_folder_is_an_os_error(tmp_path):
    with pytest.raises(OSError, match="index.json"):
        read_pack(tmp_path)
