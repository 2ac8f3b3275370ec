# SPDX-License-Identifier: MIT
"""The compile cache: place, rights, keys, reuse."""

from __future__ import annotations

import shutil
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

import usersub
from usersub.routine import cache

_FIELD = Path(__file__).resolve().parents[1] / "field"


@pytest.fixture
def fresh(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A cache of its own."""
    monkeypatch.setenv("USERSUB_CACHE", str(tmp_path / "cache"))
    return tmp_path / "cache"


def test_folder_is_made_for_the_user_alone(fresh):
    assert cache.folder() == fresh
    assert fresh.stat().st_mode & 0o777 == 0o700


def test_default_folder_follows_the_platform(tmp_path, monkeypatch):
    monkeypatch.delenv("USERSUB_CACHE", raising=False)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert cache.folder() == tmp_path / "usersub"


def test_folder_that_others_can_write_is_refused(fresh):
    fresh.mkdir()
    fresh.chmod(0o777)
    with pytest.raises(
        usersub.LoadError, match="can be written by others .mode 777., expected 700"
    ):
        cache.folder()


def test_folder_that_is_a_file_is_refused(fresh):
    fresh.write_text("x")
    with pytest.raises(usersub.LoadError, match="cannot be made"):
        cache.folder()


@given(st.lists(st.text()), st.lists(st.text()))
def test_key_tells_lists_apart(one, two):
    assert (cache.key(*one) == cache.key(*two)) == (one == two)


def test_name_has_stem_and_hash(fresh):
    found = cache.path("my law/ü", "0123456789abcdef", ".so")
    assert found.parent == fresh and found.name == "my_law__-0123456789abcdef.so"


def _libraries(folder: Path) -> set[str]:
    return {p.name for p in folder.iterdir()}


def test_same_source_in_another_folder_is_not_compiled_again(fresh, tmp_path, monkeypatch):
    for name in ("one", "two"):
        (tmp_path / name).mkdir()
        shutil.copy(_FIELD / "vfric_coef_table.c", tmp_path / name / "law.c")
    usersub.load(tmp_path / "one" / "law.c").only().entry()
    before = _libraries(fresh)
    again = usersub.load(tmp_path / "two" / "law.c")
    assert again.only().origin.startswith(str(tmp_path / "two"))
    assert again.only().entry().address
    assert _libraries(fresh) == before
    assert len(before) == 2  # the library and what is known of it, no leftovers


@pytest.mark.parametrize("change", ["source", "include", "precision"])
def test_what_makes_the_code_makes_the_key(fresh, tmp_path, change):
    source, header = tmp_path / "law.c", tmp_path / "own.h"
    source.write_text('#include "own.h"\n' + (_FIELD / "vfric_coef_table.c").read_text())
    header.write_text("static const int own = 1;\n")
    usersub.load(source)
    before = _libraries(fresh)
    if change == "source":
        source.write_text(source.read_text().replace("+ (props[0]", "+ 2 * (props[0]"))
    elif change == "include":
        header.write_text("static const int own = 2;\n")
    usersub.load(source, precision="single" if change == "precision" else "double")
    assert len(_libraries(fresh)) == len(before) + 2


@pytest.mark.needs_fortran
def test_include_file_of_a_fortran_source_makes_the_key(fresh, tmp_path):
    for name in ("vfriction_own_xit.f", "my_limits.inc"):
        shutil.copy(_FIELD / name, tmp_path)
    usersub.load(tmp_path / "vfriction_own_xit.f")
    before = _libraries(fresh)
    limits = tmp_path / "my_limits.inc"
    limits.write_text(limits.read_text().replace("0.6D0", "0.7D0"))
    usersub.load(tmp_path / "vfriction_own_xit.f")
    assert len(_libraries(fresh)) == len(before) + 2


def test_damaged_record_is_made_again(fresh):
    usersub.load(_FIELD / "vfric_coef_table.c")
    record = next(fresh.glob("*.json"))
    record.write_text("{")
    assert usersub.load(_FIELD / "vfric_coef_table.c").only().uses is not None
    assert record.read_text() != "{"


def test_refused_source_leaves_nothing(fresh, tmp_path):
    source = tmp_path / "law.c"
    source.write_text("void f(void) { return 1 }\n")
    with pytest.raises(usersub.CompileError, match=r"law\.c:1:\d+"):
        usersub.load(source)
    assert _libraries(fresh) == set()
    assert {p.name for p in tmp_path.iterdir()} == {"law.c", "cache"}


def test_threads_that_load_the_same_file_at_once_agree(fresh):
    def load(_) -> int:
        return usersub.load(_FIELD / "vfric_coef_table.c").only().entry().address

    with ThreadPoolExecutor(4) as pool:
        places = set(pool.map(load, range(8)))
    # Each name in the cache is one file; a second one of equal content may have been moved over it.
    assert 0 not in places
    assert {p.suffix for p in fresh.iterdir()} == {".so", ".json"}
    assert len(_libraries(fresh)) == 2


def test_a_folder_that_cannot_be_written(tmp_path, monkeypatch):
    """By what the system answers, since the administrator may write everywhere."""

    def refuse(**arguments):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setenv(cache.VARIABLE, str(tmp_path / "cache"))
    monkeypatch.setattr(cache.tempfile, "mkdtemp", refuse)
    with (
        pytest.raises(usersub.LoadError, match=r"cannot be written \(Permission denied\); set US"),
        cache.build_folder(),
    ):
        pass
