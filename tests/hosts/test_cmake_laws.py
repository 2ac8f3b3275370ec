# SPDX-License-Identifier: MIT
"""C laws in users' CMake projects: derivatives by a second reading of the file."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

PROJECT = """\
cmake_minimum_required(VERSION 3.20)
project(mine LANGUAGES {languages})
find_package(usersub 0.1 REQUIRED)
add_executable(host host.c)
target_link_libraries(host PRIVATE usersub::usersub)
usersub_add_routine(law law.c)
usersub_add_routine(law_single law.c SINGLE)
"""

LAW = """\
#define USUB_LAW "square"
#define USUB_LAW_PROPS 1
#define USUB_LAW_READS_RATE
#define USUB_LAW_DUAL
#include <usersub/coefficient_law.h>

USUB_LAW_FUNCTION {
  return props[0] * rate * rate;
}
"""

# Prints coefficient and derivative by the slip rate at the slip rate 3.
HOST = """\
#include <stdio.h>
#include <usersub/usersub.h>
int main(int count, char **arguments) {
  usub_error error = {0, ""};
  usub_routine *routine = NULL;
  usub_scene *scene = NULL;
  usub_driver *driver = NULL;
  double props[] = {0.25}, rate[] = {3.0}, pressure[] = {1.0}, mu[1] = {0}, derivative[3] = {0};
  usub_routine_open(arguments[count - 1], "fric_coef", NULL, "double", &routine, &error);
  usub_scene_create(&scene);
  usub_scene_set_props(scene, props, 1);
  usub_scene_set_int(scene, "derivatives", 1);
  usub_driver_create("coefficient", routine, scene, &driver, &error);
  usub_bind(driver, "slip_rate", rate, 1);
  usub_bind(driver, "pressure", pressure, 1);
  usub_bind(driver, "coefficient", mu, 1);
  usub_bind(driver, "derivative", derivative, 3);
  int32_t status = usub_evaluate(driver);
  printf("%s %g %g%s%s\\n", usub_status_name(status), mu[0], derivative[0], error.message,
         usub_message(driver));
  usub_driver_free(driver);
  usub_scene_free(scene);
  usub_routine_free(routine);
  return 0;
}
"""


def _run(*command: object) -> subprocess.CompletedProcess:
    return subprocess.run([str(c) for c in command], capture_output=True, text=True, timeout=300)


def _configure(folder: Path, prefix: Path, languages: str) -> subprocess.CompletedProcess:
    files = {"CMakeLists.txt": PROJECT.format(languages=languages), "law.c": LAW, "host.c": HOST}
    for name, text in files.items():
        (folder / name).write_text(text)
    generator = ["-G", "Ninja"] if shutil.which("ninja") else []
    return _run(
        "cmake", "-S", folder, "-B", folder / "build", f"-DCMAKE_PREFIX_PATH={prefix}", *generator
    )


def _built(folder: Path) -> str:
    done = _run("cmake", "--build", folder / "build")
    assert done.returncode == 0, done.stdout + done.stderr
    return _run(folder / "build/host", folder / "build/liblaw.so").stdout


def test_a_law_is_read_twice_and_follows_its_file(prefix, tmp_path):
    if shutil.which("c++") is None:
        pytest.skip("a C++ compiler is missing; install one, for example with `apt install g++`")
    folder = tmp_path / "users project"
    folder.mkdir()
    done = _configure(folder, prefix, "C CXX")
    assert done.returncode == 0, done.stdout + done.stderr
    assert _built(folder) == "OK 2.25 1.5\n"
    (folder / "law.c").write_text(LAW.replace("rate * rate", "rate * rate * rate"))
    assert _built(folder) == "OK 6.75 6.75\n"
    own = LAW.replace("#define USUB_LAW_DUAL\n", "").replace(
        "  return", "  if (derivative) derivative[0] = 7;\n  return"
    )
    (folder / "law.c").write_text(own)
    assert _built(folder) == "OK 2.25 7\n"
    needed = _run("ldd", folder / "build/liblaw.so").stdout
    assert "libstdc++" not in needed


def test_a_project_without_cxx_is_told(prefix, tmp_path):
    done = _configure(tmp_path, prefix, "C")
    assert done.returncode != 0
    words = " ".join(done.stderr.split())
    assert "law.c defines USUB_LAW_DUAL, so its derivatives need the language CXX" in words
    (tmp_path / "law.c").write_text(LAW.replace("#define USUB_LAW_DUAL\n", ""))
    assert _run("cmake", "-S", tmp_path, "-B", tmp_path / "build").returncode == 0
