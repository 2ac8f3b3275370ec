# SPDX-License-Identifier: MIT
"""`usersub.laws.coulomb(mu=0.3)`: properties, checks, use in every driver and in scene files."""

from __future__ import annotations

import inspect
import math
import pickle

import law_cases
import numpy as np
import pytest

import usersub
from usersub import laws
from usersub.errors import LoadError, SceneError


def test_properties_by_position_and_by_name():
    one, other = laws.exponential_decay(0.3, 0.2, dc=4.0), laws.exponential_decay(0.3, 0.2, 4.0)
    assert one == other and hash(one) == hash(other)
    assert one.props == (0.3, 0.2, 4.0)
    assert one.name == "exponential_decay" and one.kind == "coefficient"
    assert one.equation == laws.LAWS["exponential_decay"].equation
    assert repr(one) == "usersub.laws.exponential_decay(mus=0.3, muk=0.2, dc=4.0)"
    assert eval(repr(one)) == one
    assert one.replace(muk=0.1).props == (0.3, 0.1, 4.0)
    assert pickle.loads(pickle.dumps(one)) == one
    assert one.in_language("c") != one
    assert eval(repr(one.in_language("c"))) == one.in_language("c")
    with pytest.raises(AttributeError, match="cannot be changed"):
        one.props = ()


@pytest.mark.parametrize("law", law_cases.names())
def test_every_law_makes_its_example_and_its_cases(law):
    described = laws.law(law)
    made = described(**described.example)
    assert described.of(made.props) == made
    assert str(inspect.signature(described)).startswith("(")
    for case in law_cases.reference(law):
        props = [float(p) for p in case["props"]]
        assert described.of(props).props == tuple(props)


@pytest.mark.parametrize(
    ("make", "told"),
    [
        (lambda: laws.coulomb(), r"coulomb needs 'mu' \(friction coefficient, unit -\)"),
        (lambda: laws.coulomb(nu=0.3), "no property 'nu'; did you mean 'mu'"),
        (lambda: laws.coulomb(0.3, mu=0.3), "'mu' is given twice"),
        (lambda: laws.coulomb(0.3, 0.2), "2 properties by position; expected at most 1"),
        (lambda: laws.coulomb(-0.1), r"mu = -0.1; expected at least 0"),
        (lambda: laws.coulomb(math.nan), "mu = nan; expected a finite number"),
        (lambda: laws.coulomb("0.3"), "mu = '0.3'; expected a real number"),
        (lambda: laws.coulomb(True), "mu = True; expected a real number"),
        (lambda: laws.viscoplastic_creep(0.0), "k = 0; expected above 0"),
        (lambda: laws.coulomb_tabulated(table=3), "table = 3; expected an array"),
        (lambda: laws.coulomb_tabulated(nr=1, table=[1]), "'nr'; it is counted from 'rates'"),
        (lambda: laws.coulomb_tabulated(rates=[1.0, 0.5], table=[1, 2]), r"rates\[1\] = 0.5"),
        (lambda: laws.coulomb_tabulated(rates=[0, 1], table=[1, 2, 3]), r"shape \[3\]; expected"),
        (lambda: laws.coulomb_tabulated(rates=[0, 1], table=[[1], [2, 3]]), "different lengths"),
        (lambda: laws.coulomb_tabulated(rates=[0, 1], table=[0.1, -1]), r"table\[1\] = -1"),
        (lambda: laws.coulomb(0.3).in_language("cobol"), "language 'cobol'"),
    ],
)
def test_wrong_properties_are_refused(make, told):
    with pytest.raises(SceneError, match=told):
        make()


def test_tables_in_a_natural_form():
    table = np.array([[0.31, 0.36, 0.41], [0.21, 0.26, 0.30]])  # by rate, by pressure
    law = laws.coulomb_tabulated(rates=[0.0, 2.0], pressures=(1.0, 10.0, 100.0), table=table)
    driver = usersub.CoefficientDriver(law, usersub.Scene(points=6))
    rate, pressure = np.repeat([0.0, 2.0], 3), np.tile([1.0, 10.0, 100.0], 2)
    found = driver.evaluate(slip_rate=rate, pressure=pressure, time_increment=1.0)
    assert found.tolist() == table.ravel().tolist()
    assert laws.law("coulomb_tabulated").of(law.props).props == law.props


def test_fields_of_a_table_are_a_list_of_lists():
    table = np.arange(1.0, 13.0).reshape(2, 3, 2) / 100.0  # rate, first field, second field
    law = laws.coulomb_tabulated(
        rates=[0.0, 1.0], fields=[[0.0, 1.0, 2.0], [5.0, 6.0]], table=table
    )
    scene = usersub.Scene(points=12, fields=2)
    driver = usersub.CoefficientDriver(law, scene)
    rate, first, second = (a.ravel() for a in np.meshgrid([0, 1], [0, 1, 2], [5, 6], indexing="ij"))
    fields = np.asfortranarray(np.array([first, second], dtype=float))
    found = driver.evaluate(
        slip_rate=rate.astype(float), pressure=np.ones(12), field=fields, time_increment=1.0
    )
    assert found == pytest.approx(table.ravel(), rel=1e-15)


@pytest.mark.parametrize("numbers", [[], [2.0], [1, 1, 1, 0, 7, 8, 9], [-1, 1, 1, 0], [1.5, 1, 1]])
def test_numbers_that_are_no_table_are_refused(numbers):
    with pytest.raises(SceneError, match="coulomb_tabulated"):
        laws.law("coulomb_tabulated").of(numbers)


def test_each_driver_takes_a_law():
    law = laws.exponential_decay(mus=0.3, muk=0.1, dc=2.0)
    standard = usersub.StandardDriver(law, usersub.Scene(characteristic_length=1.0))
    assert standard.routine.interface.name == "fric_coef"
    assert standard.scene.props == law.props and standard.scene.states == 0
    explicit = usersub.ExplicitDriver(law, usersub.Scene(nodes=5))
    assert explicit.routine.interface.name == "vfric_coef"
    nodes = usersub.ExplicitDriver(law, usersub.Scene(secondary_nodes=1, main_nodes=4))
    assert nodes.routine.interface.name == "vfric"
    single = usersub.ExplicitDriver(law, usersub.Scene(nodes=5, precision="single"))
    assert single.scene.precision == "single"
    coefficient = usersub.CoefficientDriver(law, usersub.Scene(points=2))
    mu = coefficient.evaluate(
        slip_rate=np.array([0.0, 1.0]), pressure=np.ones(2), time_increment=1.0
    )
    assert mu == pytest.approx([0.3, 0.1 + 0.2 * math.exp(-2.0)], rel=1e-15)
    derived = usersub.CoefficientDriver(law, usersub.Scene(derivatives=1))
    assert derived.routine.interface.name == "fric_coef"
    compiled = usersub.CoefficientDriver(law.in_language("c"), usersub.Scene())
    assert compiled.routine.language == "c"


def test_driver_by_scene():
    law = laws.coulomb(0.3)
    assert usersub.driver(law, usersub.Scene(elastic_slip=1e-3)).kind == "standard"
    assert usersub.driver(law, usersub.Scene(nodes=5)).kind == "explicit"
    assert usersub.driver(law, usersub.Scene(nodes=5, precision="single")).kind == "explicit"


def test_laws_of_stress_stand_behind_fric():
    driver = usersub.StandardDriver(laws.cohesion(c=2.0, mu=0.1), usersub.Scene())
    assert driver.routine.interface.name == "fric"
    assert driver.scene.states == 2  # the elastic slip
    plane = usersub.StandardDriver(laws.cohesion(2.0, 0.1), usersub.Scene(dimension=2))
    assert plane.scene.states == 1
    twist = usersub.Scene(dimension=2, friction_directions=2)
    assert usersub.StandardDriver(laws.cohesion(2.0, 0.1), twist).scene.states == 2
    creep = usersub.driver(laws.viscoplastic_creep(0.1), usersub.Scene(nodes=5))
    assert creep.routine.interface.name == "vfriction"


def test_states_and_anisotropy_of_the_law_go_into_the_scene():
    weakening = laws.slip_weakening(**laws.law("slip_weakening").example)
    scene = usersub.StandardDriver(weakening, usersub.Scene(characteristic_length=1.0)).scene
    assert scene.states == 1
    two = laws.anisotropic(0.3, 0.2)
    scene = usersub.StandardDriver(two, usersub.Scene(characteristic_length=1.0)).scene
    assert scene.anisotropic == 1


@pytest.mark.parametrize(
    ("kind", "law", "settings", "told"),
    [
        ("StandardDriver", lambda: laws.coulomb(0.3), {"props": [0.2]}, r"props = \(0.2\)"),
        ("StandardDriver", lambda: laws.cohesion(1.0, 0.3), {"states": 1}, "needs 2"),
        ("ExplicitDriver", lambda: laws.anisotropic(0.3, 0.2), {"nodes": 5}, "stands behind FRIC"),
        ("CoefficientDriver", lambda: laws.cohesion(1.0, 0.3), {}, "the coefficient driver takes"),
        ("StandardDriver", lambda: laws.coulomb, {}, "got Law as its routine"),
    ],
)
def test_scenes_that_contradict_a_law_are_refused(kind, law, settings, told):
    with pytest.raises(SceneError, match=told):
        getattr(usersub, kind)(law(), usersub.Scene(**settings))


def test_precision_that_no_interface_has_is_refused():
    with pytest.raises(LoadError, match="no precision 'single'"):
        usersub.StandardDriver(laws.coulomb(0.3), usersub.Scene(precision="single"))


def test_drivers_take_a_law_function():
    @usersub.coefficient(props=1, states=1)
    def worn(slip_increment, state, props):
        state[0] += slip_increment
        return props[0] / (1.0 + state[0])

    scene = usersub.Scene(props=[0.3], characteristic_length=1.0)
    driver = usersub.StandardDriver(worn, scene)
    assert driver.routine.interface.name == "fric_coef" and driver.scene.states == 1


SCENE = """
routine = "{law}"
interface = "{interface}"
{props}
[history]
time = [0.0, 1.0, 2.0]
slip = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.5]]
pressure = 10.0
"""


def _run(tmp_path, law, interface, props, scene="characteristic_length = 1.0"):
    file = tmp_path / "scene.toml"
    text = SCENE.format(law=law, interface=interface, props=props)
    file.write_text(text.replace("[history]", f"[scene]\n{scene}\n[history]"))
    return usersub.run_scene(file)


def test_scene_file_names_properties(tmp_path):
    run = _run(tmp_path, "exponential_decay", "fric", "[props]\nmus = 0.3\nmuk = 0.1\ndc = 0.5")
    rows = list(run.history.rows())
    slip_rate = 1.0 - 0.005  # what the elastic slip leaves
    mu = 0.1 + 0.2 * math.exp(-0.5 * slip_rate)
    tau = next(r for r in rows if r["time"] == 1.0)
    assert tau["tau_1"] == pytest.approx(10.0 * mu, rel=1e-14)


def test_scene_file_gives_the_states_of_a_law(tmp_path):
    run = _run(tmp_path, "cohesion", "fric", "props = [2.0, 0.1]")
    assert list(run.history.rows())[-1]["tau_1"] > 0


@pytest.mark.parametrize(
    ("law", "props", "told"),
    [
        ("coulomb", "[props]\nnu = 0.3", "no property 'nu'; did you mean 'mu'"),
        ("coulomb", "props = [0.1, 0.2]", "coulomb got 2 properties; expected 1"),
        ("coulomb", "props = [-0.1]", "mu = -0.1; expected at least 0"),
        ("law.py", "[props]\nmu = 0.3", "props by name are for built-in laws"),
    ],
)
def test_scene_file_with_wrong_properties_is_refused(tmp_path, law, props, told):
    (tmp_path / "law.py").write_text("")
    with pytest.raises(SceneError, match=told) as raised:
        _run(tmp_path, law, "fric_coef", props)
    assert "scene.toml" in str(raised.value)


def test_two_dimensions_have_no_vfriction():
    driver = usersub.ExplicitDriver(laws.rough(), usersub.Scene(dimension=2))
    assert driver.plan.title.startswith("VFRIC '")
    answer = driver.step(
        0.1, slip_increment=np.array([[0.01], [0.0]]), normal=np.array([[0.0], [1.0]]),
        normal_force=np.array([10.0]), stick_force=np.array([7.0]),
    )  # fmt: skip
    np.testing.assert_array_equal(answer.force[:, 0], [-7.0, 0.0])
