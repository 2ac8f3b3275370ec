# SPDX-License-Identifier: MIT
"""Loading Python files: routines found, errors with file and line, nothing left behind."""

from __future__ import annotations

import sys
import textwrap

import pytest

from usersub.errors import AbiError, CompileError, LoadError
from usersub.routine.pyfile import load_python

HEAD = "import dataclasses\nfrom usersub.routine.python import fric, fric_coef, vfric, vfric_coef\n"


def write(folder, text, name="law.py", encoding="utf-8"):
    path = folder / name
    path.write_text(HEAD + textwrap.dedent(text), encoding=encoding)
    return path


def test_every_interface_of_a_file_is_found(tmp_path):
    path = write(tmp_path, """
        @fric
        def standard(LM, TAU):
            LM[0] = 2

        @vfric(thread_safe=False)
        def explicit(fTangential):
            pass

        again = explicit
        not_a_routine = 3

        @dataclasses.dataclass
        class Numbers:
            mu: float = 0.3
    """)  # fmt: skip
    found = load_python(path)
    assert sorted(found) == ["fric", "vfric"]
    assert found["fric"].name == "standard"
    assert found["fric"].origin == f"{path.resolve()}:4"
    assert not found["vfric"].thread_safe
    assert sorted(p.name for p in tmp_path.iterdir()) == ["law.py"]


def test_files_of_one_name_do_not_meet(tmp_path):
    for folder, number in (("a", 1), ("b", 2)):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "usersub_test_constants.py").write_text(f"VALUE = {number}\n")
        write(tmp_path / folder, """
            from usersub_test_constants import VALUE
            @vfric_coef
            def law(fCoef):
                fCoef[0] = VALUE
        """)  # fmt: skip
    before = set(sys.modules)
    paths = list(sys.path)
    laws = [load_python(tmp_path / f / "law.py")["vfric_coef"] for f in ("a", "b")]
    values = []
    for law in laws:
        f = [0]
        law(f)
        values.append(f[0])
    assert values == [1, 2]
    new = set(sys.modules) - before
    assert all(name.startswith("usersub_file_law_") for name in new) and len(new) == 2
    assert sys.path == paths
    assert not list(tmp_path.rglob("__pycache__"))


def test_a_changed_file_is_read_anew(tmp_path):
    text = "@vfric_coef\ndef law(fCoef):\n    fCoef[0] = {}\n"
    for number in (1, 2):
        law = load_python(write(tmp_path, text.format(number)))["vfric_coef"]
        f = [0]
        law(f)
        assert f == [number]


def test_imported_routines_count_only_if_there_are_no_others(tmp_path):
    write(tmp_path, "@fric\ndef other(LM):\n    pass\n", "usersub_test_other.py")
    plain = write(tmp_path, "from usersub_test_other import other\n", "plain.py")
    assert load_python(plain)["fric"].name == "other"
    own = write(
        tmp_path,
        "from usersub_test_other import other\n@fric\ndef own(LM):\n    pass\n",
        "own.py",
    )
    assert load_python(own)["fric"].name == "own"


@pytest.mark.parametrize(
    ("text", "error", "words"),
    [
        ("x = 1\n", LoadError, "has no routine; decorate a function with @usersub.fric"),
        (
            "@fric\ndef a(LM): pass\n@fric\ndef b(LM): pass\n",
            LoadError,
            "defines FRIC twice: 'a' (",
        ),
        ("\ndef law(:\n    pass\n", CompileError, "law.py:4: "),
        ("x = 1\ny = x / 0\n", LoadError, "law.py:4: running the file failed: ZeroDivisionError"),
        (
            "import sys\nsys.exit(3)\n",
            LoadError,
            "law.py:4: running the file failed: SystemExit: 3",
        ),
        ("import usersub_no_such_module\n", LoadError, "law.py:3: running the file failed: Module"),
        ("@fric\ndef a(LN): pass\n", AbiError, "law.py:3: routine 'a': FRIC has no argument 'LN'"),
    ],
)
def test_errors_name_file_and_line(tmp_path, text, error, words):
    path = write(tmp_path, text)
    before = set(sys.modules)
    with pytest.raises(error) as caught:
        load_python(path)
    assert words in str(caught.value) and "law.py" in str(caught.value)
    if "x = 1\n" != text and "twice" not in words:
        assert set(sys.modules) == before


def test_no_such_file(tmp_path):
    with pytest.raises(LoadError, match="none.py cannot be read: No such file"):
        load_python(tmp_path / "none.py")
    (tmp_path / "zero.py").write_bytes(b"x = 1\0\n")
    with pytest.raises(CompileError, match="zero.py:1: "):
        load_python(tmp_path / "zero.py")


def test_source_encoding_is_read(tmp_path):
    path = tmp_path / "latin.py"
    path.write_bytes(
        b"# -*- coding: latin-1 -*-\r\nfrom usersub.routine.python import fric\r\n@fric\r\n"
        b"def law(LM):\r\n    'Reibwert \xb5'\r\n"
    )
    assert load_python(path)["fric"].function.__doc__ == "Reibwert µ"
