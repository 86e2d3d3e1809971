"""Matrices, numbers and contacts: what is taken, exactly, and what is refused."""

import json
import pickle
from fractions import Fraction

import numpy as np
import pytest
import scipy.sparse

import mceip

STIFFNESS = np.array([[2.0, 1.5], [1.5, 2.0]])
ROW = {"tangential": 0, "normal": 1, "state": "slip+"}
REACTION = {"reaction_tangential": -1.5, "reaction_normal": -1.0}


def with_contacts(contacts, friction="1.5"):
    return mceip.Problem.from_matrices(STIFFNESS, np.eye(2), friction, contacts)


def test_matrices_of_numpy_scipy_and_lists_are_one_problem(point, example):
    matrices = [STIFFNESS, STIFFNESS.tolist(), STIFFNESS.astype(np.float32)]
    for kind in (scipy.sparse.csr_matrix, scipy.sparse.coo_array, scipy.sparse.lil_matrix):
        matrices.append(kind(STIFFNESS))

    digests = {point(matrix).sha256 for matrix in matrices}

    assert digests == {example("point").sha256}


def test_entries_at_one_place_are_added_without_rounding(point):
    places = ([0, 0, 0, 1, 1], [0, 0, 1, 0, 1])
    tiny = 2.0**-80
    sparse = scipy.sparse.coo_array(([2.0, tiny, 1.5, 1.5, 2.0], places), shape=(2, 2))

    problem = point(sparse)

    first = json.loads(problem.to_json())["system"]["stiffness"]
    assert str(2 + Fraction(1, 2**80)) in json.dumps(first)


def test_a_float_is_the_fraction_it_is_and_a_text_the_number_it_spells(point):
    def digest(friction):
        return point(friction=friction).sha256

    assert digest("0.1") == digest(Fraction(1, 10)) == digest("1/10")
    assert digest(0.1) != digest("0.1")
    assert digest(0.1) == digest(Fraction(0.1)) == digest(np.float64(0.1))
    assert digest(0.5) == digest("0.5") == digest(np.float32(0.5))


def test_tables_are_lists_of_contacts(tmp_path):
    expected = with_contacts([mceip.Contact(0, 1, "slip", sign=-1)]).sha256
    path = tmp_path / "contacts.csv"
    path.write_text("# a comment\nparticle,tangential,normal,state\nA,0,1,slip+\n")

    columns = {"tangential": [0], "normal": np.array([1]), "state": "slip+"}
    for table in (path, str(path), [ROW], columns):
        assert with_contacts(table).sha256 == expected

    assert with_contacts([{**ROW, **REACTION, "particle": None}]).unknown == "lambda2"


def test_an_oblique_obstacle_is_an_angle_or_a_frame_in_doubles():
    cosine, sine = np.cos(np.radians(30.0)), np.sin(np.radians(30.0))
    frame = [[cosine, sine], [-sine, cosine]]

    by_frame = with_contacts([mceip.Contact(0, 1, "slip+", frame=frame)])
    by_angle = with_contacts([{**ROW, "angle": 30}])

    assert by_frame.sha256 == by_angle.sha256
    assert by_frame.sha256 != with_contacts([ROW]).sha256


def test_a_particle_may_have_its_own_friction():
    halved = with_contacts([mceip.Contact(0, 1, "slip+", friction_factor=0.5)], friction="3")

    assert halved.sha256 == with_contacts([{**ROW, "friction_factor": "1/2"}], friction=3).sha256
    assert halved.solve().solutions[0].value == with_contacts([ROW]).solve().solutions[0].value


def test_a_particle_may_slip_on_a_curved_obstacle():
    stiffness, mass = np.diag([2.0, 2.0]), np.eye(2)
    reaction = {"reaction_tangential": 3, "reaction_normal": -3}

    def on(curvature, **given):
        contacts = [mceip.Contact(0, 1, "slip-", curvature=curvature, **given)]
        return mceip.Problem.from_matrices(stiffness, mass, 1, contacts, accept_warnings=True)

    # lambda^2 + 2 - 2 * 3/2 (spec/curvature.md, K.3).
    convex = on("1/2", **reaction)
    assert [solution.value for solution in convex.complete().solutions] == pytest.approx([1.0])
    assert on(-0.5, **reaction).complete().solutions == []

    with pytest.raises(mceip.MceipError, match="beside the curvature"):
        on(0.5)
    with pytest.raises(mceip.MceipError, match="curved obstacle"):
        convex.analyze(samples=0)


def test_answers_call_a_particle_by_its_name():
    named = with_contacts([mceip.Contact(0, 1, "slip+", name="heel")], friction=3)
    tabled = with_contacts([{**ROW, "particle": "heel"}], friction=3)
    plain = with_contacts([mceip.Contact(0, 1, "slip+")], friction=3)

    assert named.sha256 == tabled.sha256 == plain.sha256
    for problem, name in [(named, "heel"), (tabled, "heel"), (plain, "0")]:
        sentences = problem.analyze(samples=0).answer["sentences"]
        assert f"slipping: {name}; at rest: none" in str(sentences)


def test_a_table_may_be_a_data_frame():
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame([ROW])
    expected = with_contacts([ROW]).sha256
    assert with_contacts(frame).sha256 == expected


def test_reactions_that_contradict_the_state_are_refused():
    reactions = {"reaction_tangential": 1.5, "reaction_normal": -1.0}

    with pytest.raises(mceip.MceipError, match="E7.*line 2"):
        with_contacts([{**ROW, **reactions}])
    with pytest.raises(mceip.MceipError, match="no reactions"):
        mceip.Problem.friction_threshold(STIFFNESS, [{**ROW, **reactions}])

    contact = mceip.Contact(**ROW, **reactions)
    with pytest.raises(mceip.MceipError, match="E7: contact 0.*against the impending slip"):
        with_contacts([contact])
    with pytest.raises(mceip.MceipError, match="no reactions"):
        mceip.Problem.friction_threshold(STIFFNESS, [contact])
    with pytest.raises(mceip.MceipError, match="contact 0: expected both"):
        with_contacts([mceip.Contact(**ROW, reaction_normal=-1)])


def test_messages_name_arguments_and_no_options():
    threshold = mceip.Problem.friction_threshold(STIFFNESS, [ROW])
    for refused, message in [
        (threshold.analyze, r"friction=\.\.\."),
        (lambda: threshold.analyze(friction=1), "Problem.from_matrices"),
        (lambda: with_contacts([ROW], friction=0), r"Problem.analyze\(friction=0\)"),
        (lambda: with_contacts([{**ROW, "gap": 1}]), "candidates of a body under loads"),
    ]:
        with pytest.raises(mceip.MceipError, match=message) as error:
            refused()
        assert "--" not in str(error.value)


def test_reactions_of_contacts_are_those_of_a_table():
    # Turned by 30 degrees: r_T = -1.5, r_N = -1 along tangent and normal, in doubles.
    cosine, sine = np.cos(np.radians(30.0)), np.sin(np.radians(30.0))
    along = {
        "reaction_tangential": -1.5 * cosine + sine,
        "reaction_normal": -1.5 * sine - cosine,
    }
    frame = [[cosine, sine], [-sine, cosine]]

    by_contact = with_contacts([mceip.Contact(**ROW, **along, frame=frame)])
    by_table = with_contacts([{**ROW, **along, "angle": 30}])

    assert by_contact.to_json() == by_table.to_json()
    assert by_contact.warnings == []


@pytest.mark.parametrize(
    "changes, message",
    [
        ({"state": "slides"}, "contact 0.*slides"),
        ({"state": "slip"}, "contact 0.*sign"),
        ({"state": "slip+", "sign": 1}, "contact 0"),
        ({"state": "slip", "sign": 2}, "2"),
        ({"normal": 7}, "7"),
        ({"tangential": 1}, "1"),
        ({"normal_direction": 0}, "direction"),
        ({"normal": -1}, "contact 0: normal"),
        ({"tangential": 0.5}, "contact 0: tangential"),
        ({"state": 3}, "contact 0.*state"),
        ({"friction_factor": 0}, "factor"),
        ({"frame": [[1, 0, 0], [0, 1]]}, "contact 0.*2 x 2"),
        ({"frame": [[1, 0.5], [-0.5, 1]]}, "frame"),
        ({"frame": [["1", "0"], ["0", "one"]]}, "frame.*one"),
    ],
)
def test_what_is_no_contact_is_refused(point, changes, message):
    with pytest.raises(mceip.MceipError, match=message):
        point(**changes)


@pytest.mark.parametrize(
    "table, message",
    [
        ([{"tangential": 0, "normal": 1}], "state"),
        ([{**ROW, "colour": "red"}], "colour"),
        ([{**ROW, "normal": 2}], "normal"),
        ([{**ROW, "particle": "a,b"}], "commas"),
        ({"tangential": [0, 1], "normal": [1, 2, 3], "state": "stick"}, "cells"),
        ([], "particle"),
        ([ROW, mceip.Contact(0, 1, "stick")], "list of mceip.Contact.* at 0"),
        ([(0, 1, "slip+")], r"\(0, 1, 'slip\+'\) at 0"),
        (3, "list of mceip.Contact"),
        ("no-such-table.csv", "no-such-table"),
    ],
)
def test_what_is_no_table_is_refused(table, message):
    with pytest.raises(mceip.MceipError, match=message):
        with_contacts(table)


@pytest.mark.parametrize(
    "stiffness, message",
    [
        ([[2.0, 1.0], [1.5, 2.0]], r"E3: .*K\[0\]\[1\]"),
        ([[2.0, 1.5], [1.5 + 2**-50, 2.0]], r"stiffness: .*up to rounding: \(A \+ A.T\) / 2"),
        ([[1.0, 2.0], [3.0]], "stiffness.*one length"),
        ([1.0, 2.0], "stiffness.*shape.*scipy.sparse.diags"),
        (np.ones((2, 3)), "stiffness.*shape"),
        (np.eye(3), "mass.*3 x 3"),
        ([[np.nan, 0.0], [0.0, 1.0]], r"stiffness: entry \(0, 0\)"),
        ([[np.inf, 0.0], [0.0, 1.0]], r"\(0, 0\)"),
        ([[2**53 + 1, 0], [0, 1]], "digits"),
        (np.array([[1 + np.finfo(np.longdouble).eps, 0], [0, 1]]), "digits"),
        (np.eye(2) * 1j, "real"),
        ([["2", "1.5"], ["1.5", "2"]], "real"),
    ],
)
def test_what_is_no_matrix_is_refused(point, stiffness, message):
    with pytest.raises(mceip.MceipError, match=message):
        point(stiffness)


@pytest.mark.parametrize("friction", ["a", "", float("nan"), float("inf"), None, [1.0]])
def test_what_is_no_number_is_refused(point, friction):
    with pytest.raises(mceip.MceipError, match="number"):
        point(friction=friction)


def test_windows_files_and_unknowns_that_are_none_are_refused(point, tmp_path):
    with pytest.raises(mceip.MceipError, match="finite"):
        point().in_window(float("nan"))
    with pytest.raises(mceip.MceipError):
        point().in_window(2, 1)
    with pytest.raises(mceip.MceipError):
        point().in_window(-1)
    with pytest.raises(mceip.MceipError, match="no-such-file"):
        mceip.Problem.read(tmp_path / "no-such-file.json")
    with pytest.raises(mceip.MceipError):
        mceip.Problem.from_json("{}")
    with pytest.raises(mceip.MceipError, match="unknown"):
        mceip.Problem.from_pencil(np.eye(2), np.eye(2), unknown="t")
    with pytest.raises(mceip.MceipError):
        mceip.Problem.from_pencil(np.eye(2), np.eye(2), free=[2])
    for free in ([-1], 1):
        with pytest.raises(mceip.MceipError, match="free"):
            mceip.Problem.from_pencil(np.eye(2), np.eye(2), free=free)


def test_a_problem_survives_its_file(point, tmp_path):
    problem = point(friction=0.1).in_window("1/3", 5)
    path = tmp_path / "problem.json"
    path.write_text(problem.to_json())

    assert mceip.Problem.read(path).sha256 == problem.sha256
    assert pickle.loads(pickle.dumps(problem)).sha256 == problem.sha256
    first, second = repr(problem).split("\n")
    assert "contacts: 1, mu = 0.1; sought: lambda2 in [1/3, 5]" in first
    assert problem.sha256[:12] in second
    assert "mu = 0.1: absent" in repr(problem.analyze(samples=0))


@pytest.mark.parametrize(
    "options",
    [{"starts": -1}, {"starts": 2.5}, {"seed": 2**70}, {"progress": 3}],
)
def test_what_is_no_option_of_solve_is_refused(point, options):
    with pytest.raises(mceip.MceipError, match=next(iter(options))):
        point().solve(**options)


@pytest.mark.parametrize("threads", [0, 10**9, "2"])
def test_threads_that_cannot_be_are_refused(point, threads):
    with pytest.raises(mceip.MceipError, match="threads"):
        point().complete(threads=threads)
    with pytest.raises(mceip.MceipError, match="threads"):
        point().analyze(threads=threads)


def heavy(**options):
    """A point and a free node whose mass belongs to another unit of length."""
    stiffness = [[2.0, 0.0, -1.0], [0.0, 2.0, 0.0], [-1.0, 0.0, 3.0]]
    rows = [{**ROW, **REACTION}]
    return mceip.Problem.from_matrices(stiffness, np.eye(3) * 1e9, "1.5", rows, **options)


def test_what_looks_wrong_in_a_model_is_said_and_kept(tmp_path):
    path = tmp_path / "problem.json"

    with pytest.warns(mceip.ModelWarning, match="the lowest frequency is .* below 1e-2") as said:
        problem = heavy()
    path.write_text(problem.to_json())
    with pytest.warns(mceip.ModelWarning) as repeated:
        again = mceip.Problem.read(path)

    assert said[0].filename == repeated[0].filename == __file__
    assert problem.warnings == [str(said[0].message)] == again.warnings
    assert pickle.loads(pickle.dumps(problem)).warnings == problem.warnings
    analysis = again.analyze(samples=0)
    assert analysis.warnings == problem.warnings
    assert "units that do not fit" in analysis._repr_html_()


@pytest.mark.filterwarnings("error")
def test_accepted_warnings_and_a_sound_model_say_nothing(point):
    accepted = heavy(accept_warnings=True)

    assert accepted.warnings == [] == point(**REACTION).warnings
    assert "warnings" not in json.loads(accepted.to_json())
    assert accepted.analyze(samples=0).warnings == []


def test_missing_reactions_and_supports_left_in_the_stiffness_are_said(point):
    with pytest.warns(mceip.ModelWarning, match="particle 0: no reaction is given"):
        point()

    stiffness, mass = np.eye(4), np.eye(4)
    stiffness[:2, :2] = STIFFNESS
    stiffness[2:, 2:] = [[3.0, -1.0], [-1.0, 1e12]]
    with pytest.warns(mceip.ModelWarning, match="1.0000e12 at dof 3 and nothing of that size"):
        mceip.Problem.from_matrices(stiffness, mass, "1.5", [{**ROW, **REACTION}])


def test_the_friction_threshold_warns_of_the_same_stiffness():
    stiffness = np.eye(4)
    stiffness[2:, 2:] = [[3.0, -1.0], [-1.0, 1e12]]
    with pytest.warns(mceip.ModelWarning, match="1.0000e12 at dof 3") as said:
        problem = mceip.Problem.friction_threshold(stiffness, [ROW])

    # No equilibrium is named, so that no reaction is asked for.
    assert problem.warnings == [str(said[0].message)]
    accepted = mceip.Problem.friction_threshold(stiffness, [ROW], accept_warnings=True)
    assert accepted.warnings == []


def test_warnings_name_particles_as_the_table_does():
    # On the friction cone, within a thousandth, and sticking all the same.
    nearly = {"reaction_tangential": 1.49999, "reaction_normal": -1.0}
    rows = [
        {"particle": "heel", "tangential": 0, "normal": 1, "state": "slip+"},
        {"particle": "toe", "tangential": 2, "normal": 3, "state": "stick", **nearly},
    ]

    with pytest.warns(mceip.ModelWarning, match="particle toe sticks"):
        mceip.Problem.from_matrices(np.eye(4), np.eye(4), "1.5", rows)


def test_orders_that_no_machine_holds_are_refused():
    for order in (10**12, 2**62):
        empty = scipy.sparse.coo_array((order, order))
        with pytest.raises(mceip.MceipError, match="1000000"):
            mceip.Problem.from_pencil(empty, empty)


def test_samples_beyond_any_plot_are_refused(example):
    with pytest.raises(mceip.MceipError, match="10000"):
        example("point").analyze(samples=10**9)


def test_masked_entries_and_numbers_beyond_text_are_refused(point):
    masked = np.ma.masked_array(STIFFNESS, mask=[[False, True], [True, False]])
    with pytest.raises(mceip.MceipError, match="masked"):
        point(masked)
    for friction in (10**5000, "\ud800"):
        with pytest.raises(mceip.MceipError):
            point(friction=friction)
