# SPDX-License-Identifier: MIT
"""What is wrong only with properties that nobody gave is a warning; what is wrong with all of them,
or with those that were given, is an error."""

from __future__ import annotations

import pytest

from usersub.check import check

#: Penalty friction whose tangent in slip is `FACTOR` times what it should be.
ROUTINE = """\
#include <math.h>
#include <usersub/abi.h>
#include <omi_for_c.h>
void FOR_NAME(fric, FRIC)(USUB_FRIC_PARAMETERS) {
  const int n = *NFDIR;
  if (*LM == 2)
    return;
  const double mu = PROPS[0], k = PROPS[1];
  double trial[2] = {0, 0}, size = 0;
  *LM = 0;
  for (int a = 0; a < n; ++a) {
    trial[a] = TAU[a] + k * DGAM[a];
    size = hypot(size, trial[a]);
  }
  const double limit = mu * *PRESS;
  const int slips = size > limit;
  for (int a = 0; a < n; ++a) {
    TAU[a] = slips ? trial[a] * limit / size : trial[a];
    DSLIP[a] = (trial[a] - TAU[a]) / k;
    DDTDDP[a] = slips ? mu * trial[a] / size : 0;
    for (int b = 0; b < n; ++b)
      DDTDDG[a + n * b] = !slips ? (a == b) * k
          : (FACTOR) * k * limit / size * ((a == b) - trial[a] * trial[b] / size / size);
  }
  const double kept = slips ? limit : size;
  *SED = kept * kept / (2 * k);
  *SFD = slips ? limit * (size - limit) / k : 0;
}
"""


def report_of(folder, factor, **options):
    path = folder / "mine.c"
    path.write_text(ROUTINE.replace("FACTOR", factor))
    (report,) = check(path, rules=["tangent.slip"], jobs=1, seconds=120, **options)
    return report


@pytest.mark.parametrize(
    ("factor", "given", "severity"),
    [
        ("1", None, None),
        ("2", None, "error"),
        ("mu < k ? 1 : 2", None, "warning"),  # chosen are 0.3 and 0.2
        ("mu < k ? 1 : 2", [0.3, 0.2], "error"),
    ],
)
def test_severity(tmp_path, factor, given, severity):
    report = report_of(tmp_path, factor, **({"props": given} if given else {}))
    result = report["tangent.slip"]
    assert result.verdict == ("pass" if severity is None else "fail"), report
    if severity:
        assert result.severity == severity, report
        assert ("the rule passes" in result.hint) == (severity == "warning")
        assert ("look again with those of your model" in result.hint) == (given is None)
    assert report.ok() == (severity != "error")
