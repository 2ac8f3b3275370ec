# SPDX-License-Identifier: MIT
"""Every problem fails without friction: a routine that does nothing, its outputs stay zero."""

from __future__ import annotations

import pytest

from usersub import laws, problems

#: Every problem by every method through every interface, in each precision.
RUNS = {
    (case.problem, case.law, case.interface, case.method, case.precision): case
    for case in problems.all_cases()
}


@pytest.fixture(params=RUNS.values(), ids=["-".join(key) for key in RUNS])
def case(request):
    return request.param


@pytest.fixture
def nothing(c_routine, case):
    """A routine without friction behind the interface of the case."""
    parameters = "fric_coef_2022" if case.interface == "fric_coef" else case.interface
    single = "#define USUB_SINGLE\n" if case.precision == "single" else ""
    # A scene with two coefficients wants both.
    anisotropic = case.interface == "fric_coef" and laws.LAWS[case.law].anisotropic
    body = "fCoef[0] = fCoef[*nBlock] = 0.0;" if anisotropic else ""
    source = (
        f"{single}#include <usersub/abi.h>\n"
        f"void {case.interface}_(USUB_{parameters.upper()}_PARAMETERS) {{{body}}}\n"
    )
    generation = "2022" if case.interface == "fric_coef" else None
    return c_routine(case.interface, source, generation=generation, precision=case.precision)


def test_fails_without_friction(case, nothing):
    problem = problems.PROBLEMS[case.problem]
    # Few increments: a block that nothing brakes slides until the host's patience ends.
    steps = {"steps": 16} if "steps" in problem.options else {}
    outcome = problem.run(
        nothing, law=case.law, precision=case.precision, method=case.method, **steps
    )
    # The right law is within the tolerance; friction that is missing is no matter of rounding.
    assert not outcome.ok, outcome
    assert not outcome.error <= 0.9
