# SPDX-License-Identifier: MIT
"""The hash of the argument tables is compared when two binaries meet."""

from __future__ import annotations

import subprocess

import pytest

import usersub
from usersub import abi, paths
from usersub.core import ffi, lib, text

_ROUTINE = """\
#include <usersub/abi.h>
void FOR_NAME(vfric_coef, VFRIC_COEF)(USUB_VFRIC_COEF_PARAMETERS) {
  for (int i = 0; i < *nBlock; ++i) fCoef[i] = props[0];
}
"""


@pytest.fixture
def library(tmp_path):
    """Builds the routine above with plain cc; `hash` takes the place of the header's."""

    def make(hash: str | None = None):
        include = tmp_path / "include"
        (include / "usersub").mkdir(parents=True, exist_ok=True)
        header = (paths.include_folder() / "usersub" / "abi.h").read_text()
        if hash is not None:
            header = header.replace(abi.abi_hash(), hash)
        (include / "usersub" / "abi.h").write_text(header)
        source, made = tmp_path / "law.c", tmp_path / f"liblaw{hash}.so"
        source.write_text(_ROUTINE)
        command = ["cc", "-shared", "-fPIC", f"-I{include}", str(source), "-o", str(made)]
        subprocess.run(command, check=True)
        return made

    return make


def _open(path):
    routine, error = ffi.new("usub_routine **"), ffi.new("usub_error *")
    status = lib.usub_routine_open(
        str(path).encode(), b"vfric_coef", ffi.NULL, b"double", routine, error
    )
    lib.usub_routine_free(routine[0])
    return status, text(error.message)


def test_same_tables_are_taken(library):
    made = library()
    assert _open(made) == (0, "")
    assert usersub.load(made).only().interface.name == "vfric_coef"


def test_other_tables_are_refused(library):
    made = library("0123456789abcdef")
    status, message = _open(made)
    assert status == -7
    assert "0123456789abcdef" in message and abi.abi_hash() in message
    with pytest.raises(usersub.AbiError, match="0123456789abcdef"):
        usersub.load(made).only().entry("double")


def test_hosts_can_ask():
    error = ffi.new("usub_error *")
    assert lib.usub_check_abi(abi.abi_hash().encode(), error) == 0
    assert lib.usub_check_abi(b"0123456789abcdef", error) == -7
    assert lib.usub_check_abi(ffi.NULL, error) == -7
    assert "(null)" in text(error.message)
