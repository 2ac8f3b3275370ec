# SPDX-License-Identifier: MIT
"""`usersub.laws.fit`: properties from measured coefficients, their errors, what data leave open."""

from __future__ import annotations

import subprocess
import sys
import warnings

import numpy as np
import pytest

import usersub
from usersub import laws
from usersub.errors import SceneError
from usersub.laws.fitting import FitWarning

RATE = np.array([0.0, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0]) * 1e-3
PRESSURE = np.array([3.0, 50.0, 8.0, 200.0, 20.0, 120.0, 5.0, 80.0, 30.0, 10.0])
TEMPERATURE = np.array([20.0, 300.0, 120.0, 60.0, 200.0, 90.0, 400.0, 150.0, 250.0, 35.0])
DECAY = {"rate": RATE, "mu": 0.1 + 0.2 * np.exp(-40.0 * RATE)}

#: Laws with true properties that are far from the example, and what is not fitted.
EXACT = {
    "coulomb": ({"mu": 0.17}, []),
    "exponential_decay": ({"mus": 0.3, "muk": 0.1, "dc": 40.0}, []),
    "stribeck": ({"mus": 0.25, "muk": 0.12, "vs": 0.02, "delta": 1.5, "cv": 0.05}, []),
    "temperature_pressure_decay": (
        {"Cs": 4e-4, "Ds": 5e-4, "Ck": 1e-4, "Dk": 2e-4, "dc": 25.0},
        [],
    ),
    "power_law": (
        {"c": 0.4, "a": -0.1, "b": 0.05, "d": -0.2, "p_floor": 1e-3, "rate_floor": 1e-4,
         "T_floor": 1.0},
        ["p_floor", "rate_floor", "T_floor"],
    ),
    "cohesion": ({"c": 2.5, "mu": 0.08}, []),
    "shear_limit": ({"mu": 0.3, "tau_max": 12.0}, []),
    "viscoplastic_creep": ({"k": 0.004}, []),
    "norton_hoff": ({"K": 30.0, "n": 0.3, "v0": 1e-6}, ["v0"]),
}  # fmt: skip


def _table(law) -> dict[str, np.ndarray]:
    """Coefficients of a law at the points above, by its routine in C behind VFRICTION."""
    n = len(RATE)
    slip, normal = np.zeros((3, n), order="F"), np.zeros((3, n), order="F")
    slip[1], normal[0] = RATE * 0.5, 1.0
    scene = usersub.Scene(points=n, nodes=n + 4, temperatures=1, props=law.props)
    driver = usersub.ExplicitDriver(law.behind("vfriction", "c"), scene)
    arrays = {
        "slip_increment": slip, "normal": normal, "normal_force": 2.0 * PRESSURE,
        "stick_force": np.full(n, 1e30), "area": np.full(n, 2.0),
        "temperature_secondary": TEMPERATURE, "temperature_main": TEMPERATURE,
        "secondary_node": np.arange(1, n + 1, dtype=np.int32).reshape(1, n, order="F"),
        "main_node": np.full((4, n), n + 1, np.int32, order="F"),
    }  # fmt: skip
    force = driver.step(0.5, **{k: a for k, a in arrays.items() if k in driver.layout.ports}).force
    mu = np.linalg.norm(force, axis=0) / (2.0 * PRESSURE)
    return {"rate": RATE, "pressure": PRESSURE, "temperature": TEMPERATURE, "mu": mu}


@pytest.mark.parametrize("name", EXACT)
def test_exact_data_give_the_properties_back(name):
    true, fixed = EXACT[name]
    law = laws.law(name)(**true)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = laws.fit(name, _table(law), fixed={k: true[k] for k in fixed})
    assert found.warnings == ()
    for key, value in true.items():
        assert found.parameters[key] == pytest.approx(value, rel=1e-7), key
        assert (found.errors[key] == 0.0) if key in fixed else found.errors[key] >= 0.0
    assert found.rms < 1e-9
    assert found.law.name == name and found.props == found.law.props
    assert set(found.names) == set(true) - set(fixed)


def test_noise_gives_the_textbook_errors():
    """A law that is linear in its properties: least squares in closed form."""
    rng = np.random.default_rng(3)
    matrix = np.column_stack([1.0 / PRESSURE, np.ones_like(PRESSURE)])  # mu = c/p + mu0
    mu = matrix @ [2.5, 0.08] + 1e-3 * rng.normal(size=len(RATE))
    weight = rng.uniform(0.2, 3.0, len(RATE))
    found = laws.fit("cohesion", {"pressure": PRESSURE, "mu": mu, "weight": weight})
    normal = np.linalg.inv(matrix.T @ (weight[:, None] * matrix))
    exact = normal @ matrix.T @ (weight * mu)
    residuals = mu - matrix @ exact
    variance = (weight * residuals**2).sum() / (len(mu) - 2)
    assert [found.parameters[n] for n in ("c", "mu")] == pytest.approx(exact, rel=1e-9)
    assert found.covariance == pytest.approx(variance * normal, rel=1e-6)
    assert [found.errors[n] for n in ("c", "mu")] == pytest.approx(
        np.sqrt(variance * np.diag(normal)), rel=1e-6
    )
    assert found.residuals == pytest.approx(residuals, abs=1e-12)
    assert found.predicted == pytest.approx(matrix @ exact, rel=1e-9)
    assert found.degrees == len(mu) - 2
    again = laws.fit("cohesion", {"pressure": PRESSURE, "mu": mu}, weights=weight)
    assert again.covariance == pytest.approx(found.covariance, rel=1e-9)


def test_errors_cover_the_truth():
    """Over many samples the true value lies within two standard errors about as often as it has
    to: 95 % for normal errors; 40 samples of 3 properties leave room for a few more."""
    rng = np.random.default_rng(11)
    inside = 0
    for _ in range(40):
        mu = DECAY["mu"] + 2e-3 * rng.normal(size=len(RATE))
        start = laws.exponential_decay(0.3, 0.1, 40.0)
        found = laws.fit(start, {"rate": RATE, "mu": mu})
        for name, value in (("mus", 0.3), ("muk", 0.1), ("dc", 40.0)):
            inside += abs(found.parameters[name] - value) < 2.36 * found.errors[name]  # 7 degrees
    assert inside >= 0.87 * 120


def test_a_property_that_the_data_do_not_show():
    with pytest.warns(FitWarning, match="dc is not identified: the data do not depend on it"):
        found = laws.fit("exponential_decay", {"rate": RATE, "mu": np.full(len(RATE), 0.3)})
    assert found.errors["dc"] == np.inf
    assert np.isfinite(found.errors["mus"]) and found.parameters["mus"] == pytest.approx(0.3)


def test_properties_that_only_act_together():
    table = {"rate": RATE + 1e-3, "pressure": np.full(10, 7.0), "temperature": np.full(10, 90.0)}
    table["mu"] = 0.2 * table["rate"] ** 0.1
    with pytest.warns(FitWarning, match="c, a, d are not identified: .* change together"):
        found = laws.fit("power_law", table, fixed={"rate_floor": 1e-6})
    assert found.parameters["b"] == pytest.approx(0.1, rel=1e-6)
    assert found.errors["b"] < 1e-6
    assert all(found.errors[n] == np.inf for n in ("c", "a", "d"))


def test_a_property_on_its_bound():
    with pytest.warns(FitWarning, match="muk lies on its bound 0.15"):
        found = laws.fit("exponential_decay", DECAY, bounds={"muk": (0.15, None)})
    assert found.parameters["muk"] == pytest.approx(0.15, rel=1e-6)


def test_bounds_of_the_law_hold():
    with pytest.warns(FitWarning, match="c lies on its bound 0"):
        found = laws.fit("cohesion", {"pressure": PRESSURE, "mu": 0.3 - 0.5 / PRESSURE})
    assert found.law.values["c"] >= 0.0


def test_as_many_properties_as_rows():
    table = {"rate": [0.0, 0.02, 5.0], "mu": [0.3, 0.2, 0.1]}
    with pytest.warns(FitWarning, match="3 parameters from 3 rows: no errors are told"):
        found = laws.fit("exponential_decay", table)
    assert found.parameters["dc"] == pytest.approx(np.log(2.0) / 0.02, rel=1e-8)
    assert np.isnan(found.errors["dc"])


def test_a_badly_determined_property():
    rng = np.random.default_rng(5)
    mu = 0.3 + 1e-3 * rng.normal(size=len(RATE))
    with pytest.warns(FitWarning, match="is badly determined: its standard error"):
        laws.fit(laws.exponential_decay(0.3, 0.299, 30.0), {"rate": RATE, "mu": mu})


def test_coefficients_of_a_table():
    law = laws.coulomb_tabulated(rates=[0.0, 0.01, 0.5], table=[0.2, 0.2, 0.2])
    rate = np.linspace(0.0, 0.5, 30)
    mu = np.interp(rate, [0.0, 0.01, 0.5], [0.31, 0.22, 0.14])
    found = laws.fit(law, {"rate": rate, "mu": mu})
    assert found.names == ("table[0]", "table[1]", "table[2]")
    assert found.law.values["table"] == pytest.approx([0.31, 0.22, 0.14], rel=1e-9)


def test_a_law_function():
    @usersub.strength(props=2)
    def mine(pressure, props):
        return props[0] + props[1] * pressure

    table = {"pressure": PRESSURE, "mu": 0.08 + 2.5 / PRESSURE}
    found = laws.fit(mine, table, start={"props": [1.0, 0.2]})
    assert found.props == pytest.approx((2.5, 0.08), rel=1e-9)
    assert found.names == ("props[0]", "props[1]") and found.law is mine
    with pytest.raises(SceneError, match="needs start="):
        laws.fit(mine, table)


def test_forms_of_a_table(tmp_path):
    columns = {"rate": RATE, "pressure": PRESSURE, "temperature": TEMPERATURE, "mu": DECAY["mu"]}
    file = tmp_path / "measured.csv"
    rows = np.column_stack(list(columns.values()))
    lines = [", ".join(repr(float(x)) for x in row) for row in rows]
    file.write_text("\n".join(["# measured", "slip_rate, p, T, mu", *lines]))
    results = [laws.fit("exponential_decay", t) for t in (columns, rows, file, str(file))]
    assert len({r.props for r in results}) == 1


@pytest.mark.parametrize(
    ("call", "told"),
    [
        (lambda: laws.fit("coulom", {"mu": [0.3]}), "did you mean 'coulomb'"),
        (lambda: laws.fit(3, {"mu": [0.3]}), "fit got int as its law"),
        (lambda: laws.fit("dahl", {"mu": [0.3]}), "depends on the motion so far"),
        (lambda: laws.fit("slip_weakening", {"mu": [0.3]}), "it has a memory"),
        (lambda: laws.fit("anisotropic", {"mu": [0.3]}), "it gives two coefficients"),
        (lambda: laws.fit("exponential_decay", {"mu": [0.3]}), "the table has no such column"),
        (lambda: laws.fit("cohesion", {"mu": [0.3], "pressure": [0.0]}), "a pressure above 0"),
        (lambda: laws.fit("coulomb", {"rate": [1.0]}), "expected 'mu' too"),
        (lambda: laws.fit("coulomb", {"mu": []}), "the table has no rows"),
        (lambda: laws.fit("coulomb", {"mu": [0.1, np.nan]}), "column 'mu', row 2 is nan"),
        (lambda: laws.fit("coulomb", {"mu": ["x"]}), "holds what is no number"),
        (lambda: laws.fit("coulomb", {"mu": [0.1], "rate": [1.0, 2.0]}), "has 2 rows, 'mu' has 1"),
        (lambda: laws.fit("coulomb", {"mu": [0.1], "rate": [-1.0]}), "expected >= 0"),
        (lambda: laws.fit("coulomb", {"mu": [0.1], "speed": [1.0]}), "a column 'speed'"),
        (lambda: laws.fit("coulomb", [[1.0, 2.0]]), r"shape \(1, 2\); expected \(rows, 4\)"),
        (lambda: laws.fit("coulomb", {"mu": [0.1]}, fixed=["nu"]), "no parameter 'nu'; did you"),
        (lambda: laws.fit("coulomb", {"mu": [0.1]}, start={"nu": 1.0}), "no property 'nu'"),
        (lambda: laws.fit("coulomb", {"mu": [0.1]}, fixed=["mu"]), "nothing is left to fit"),
        (lambda: laws.fit("coulomb", {"mu": [0.1]}, bounds={"mu": (2, 1)}), "expected room in"),
        (lambda: laws.fit("coulomb", {"mu": [0.1]}, weights=[1.0, 2.0]), "expected 1 numbers"),
        (lambda: laws.fit("coulomb", {"mu": [0.1]}, weights=[0.0]), "all weights are 0"),
        (lambda: laws.fit("coulomb", "no/such.csv"), "no/such.csv: cannot be read"),
    ],
)
def test_what_cannot_be_fitted_is_refused(call, told):
    with pytest.raises(usersub.Error, match=told):
        call()


def test_scipy_is_imported_by_a_fit_alone():
    code = "import sys, usersub.laws.fitting; print('scipy' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "False"
