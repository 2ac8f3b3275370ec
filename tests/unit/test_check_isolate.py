# SPDX-License-Identifier: MIT
"""Work in child processes: whatever happens there, the parent gets an answer and goes on."""

from __future__ import annotations

import ctypes
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

from usersub.check.case import Case, one
from usersub.check.running import isolate

CASE = one((1e-2, 0.5), (0.0, -1.0), load=3.0)


def libc() -> ctypes.CDLL:
    return ctypes.CDLL(None)


def test_what_is_said_arrives_in_order():
    def work(child):
        child.say({"a": 1.5})
        child.say({"b": [np.float64(2.0), np.arange(3.0)], "nan": float("nan")})

    outcome = isolate.run(work, 5.0)
    assert outcome.how == isolate.RETURNED and not outcome.late
    assert outcome.said[0] == {"a": 1.5}
    assert outcome.said[1]["b"] == [2.0, [0.0, 1.0, 2.0]] and np.isnan(outcome.said[1]["nan"])


def test_much_is_said():
    outcome = isolate.run(lambda child: child.say({"many": list(range(300_000))}), 10.0)
    assert outcome.said[0]["many"][-1] == 299_999


def test_a_crash_keeps_what_was_said_and_the_case():
    def work(child):
        child.say({"before": True})
        child.tell(one((1.0,)))
        child.tell(CASE)
        ctypes.string_at(8)

    outcome = isolate.run(work, 5.0)
    assert (outcome.how, outcome.signal_name) == (isolate.SIGNALLED, "SIGSEGV")
    assert outcome.said == ({"before": True},)
    assert outcome.case == CASE


@pytest.mark.parametrize("number", [signal.SIGABRT, signal.SIGFPE, signal.SIGBUS, signal.SIGILL])
def test_signals(number):
    outcome = isolate.run(lambda child: os.kill(os.getpid(), number), 5.0)
    assert outcome.how == isolate.SIGNALLED and outcome.signal == number


def test_abort_of_the_c_library():
    assert isolate.run(lambda child: libc().abort(), 5.0).signal_name == "SIGABRT"


@pytest.mark.parametrize("code", [0, 3])
def test_an_exit_is_not_a_return(code):
    outcome = isolate.run(lambda child: libc()._exit(code), 5.0)
    assert (outcome.how, outcome.code) == (isolate.EXITED, code)


def test_an_endless_loop_is_ended():
    def work(child):
        while True:
            pass

    outcome = isolate.run(work, 0.3)
    assert outcome.how == isolate.TIME
    assert outcome.seconds >= 0.3


def test_a_deadlock_is_ended_at_the_limit():
    """And not after ten times the limit, as for a child that others keep from computing."""
    outcome = isolate.run(lambda child: libc().pause(), 3.0)
    assert outcome.how == isolate.TIME
    assert 3.0 <= outcome.seconds < 30.0


def test_waiting_for_a_compiler_is_no_deadlock():
    def work(child):
        grandchild = os.fork()
        if grandchild == 0:
            time.sleep(1.0)
            os._exit(0)
        os.waitpid(grandchild, 0)

    assert isolate.run(work, 0.5).how == isolate.RETURNED


def test_signals_that_end_a_program_politely_do_not_save_a_child():
    def work(child):
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            signal.signal(number, signal.SIG_IGN)
        while True:
            time.sleep(1.0)

    assert isolate.run(work, 0.3).how == isolate.TIME


def test_an_exception_is_told():
    outcome = isolate.run(lambda child: 1 / 0, 5.0)
    error = outcome.said[0]["error"]
    assert outcome.how == isolate.RETURNED
    assert error["kind"] == "ZeroDivisionError" and "1 / 0" in error["trace"]


def test_sys_exit_is_told():
    outcome = isolate.run(lambda child: sys.exit("enough"), 5.0)
    assert outcome.said[0]["error"]["kind"] == "SystemExit"


def test_output_is_captured_and_counted(capfd):
    def work(child):
        print("from Python")
        libc().puts(b"from C")
        os.write(2, b"an error\n")
        child.say({"written": child.written()})

    outcome = isolate.run(work, 5.0)
    assert all(words in outcome.output for words in ("from Python", "from C", "an error"))
    assert (
        outcome.said[0]["written"] == outcome.output_bytes == len("from Pythonfrom Can error") + 3
    )
    assert capfd.readouterr() == ("", "")


def test_much_output_is_counted_but_not_kept():
    outcome = isolate.run(lambda child: os.write(1, b"x" * 1_000_000), 5.0)
    assert outcome.output_bytes == 1_000_000 and len(outcome.output) < 10_000


def test_input_is_empty():
    assert isolate.run(lambda child: child.say({"read": os.read(0, 10).decode()}), 5.0).said == (
        {"read": ""},
    )


def test_the_working_directory_is_a_scratch_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)

    def work(child):
        Path("fort.7").write_text("litter")
        child.say({"where": os.getcwd()})

    outcome = isolate.run(work, 5.0)
    assert not list(tmp_path.iterdir())
    assert not Path(outcome.said[0]["where"]).exists()


def test_children_of_children_are_ended():
    def work(child):
        grandchild = os.fork()
        if grandchild == 0:
            while True:
                time.sleep(10.0)
        child.say({"process": grandchild})

    outcome = isolate.run(work, 5.0)
    assert outcome.how == isolate.RETURNED
    for _ in range(3000):
        if not _runs(outcome.said[0]["process"]):
            return
        time.sleep(0.02)
    pytest.fail("the child of the child still runs")


def _runs(process: int) -> bool:
    try:
        state = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0]
    except FileNotFoundError:
        return False
    return state != "Z"


@pytest.mark.skipif(sys.platform != "linux", reason="glibc")
def test_a_damaged_heap_is_found_at_the_end():
    def work(child):
        library = libc()
        library.malloc.restype = ctypes.c_void_p
        # The last of many comes from the end of the heap, where the books of what is free stand.
        place = [library.malloc(100_000) for _ in range(60)][-1]
        ctypes.memset(place, 65, 100_100)

    outcome = isolate.run(work, 5.0)
    assert outcome.how == isolate.RETURNED and outcome.late
    assert outcome.signal_name == "SIGABRT" and "malloc" in outcome.output


def test_fresh_memory_is_not_zero():
    def work(child):
        library = libc()
        library.malloc.restype = ctypes.c_void_p
        child.say({"byte": ctypes.string_at(library.malloc(3000), 1)[0]})

    assert isolate.run(work, 5.0).said[0]["byte"] == 0x5A ^ 0xFF


def test_no_core_is_dumped():
    import resource

    outcome = isolate.run(
        lambda child: child.say({"limit": resource.getrlimit(resource.RLIMIT_CORE)[0]}), 5.0
    )
    assert outcome.said == ({"limit": 0},)


def test_a_case_that_is_too_large_is_no_case():
    large = Case((one((1.0,)).steps[0],) * 20_000)
    assert isolate.run(lambda child: child.tell(large), 5.0).case is None


def test_several_at_a_time_come_as_they_end():
    def sleeping(seconds):
        return lambda child: time.sleep(seconds)

    jobs = [(seconds, sleeping(seconds), 60.0) for seconds in (4.0, 0.3, 0.1)]
    done = [key for key, _ in isolate.run_all(jobs, workers=2)]
    assert done == [0.3, 0.1, 4.0]


def test_one_at_a_time():
    jobs = [(k, lambda child: None, 5.0) for k in range(3)]
    assert [key for key, _ in isolate.run_all(jobs)] == [0, 1, 2]


def test_stages_have_an_end_of_their_own():
    def work(child):
        child.stage("first", 5.0)
        child.tell(CASE)
        print("one")
        child.say({"found": 1})
        child.stage("second", 5.0)
        time.sleep(0.1)
        child.stage("third", 0.2)
        print("three")
        libc().pause()

    outcome = isolate.run(work, 5.0)
    (first, one), (second, two), (third, three) = isolate.stages(outcome)
    assert (first, second, third) == ("first", "second", "third")
    assert (one.how, one.said) == (isolate.RETURNED, ({"found": 1},))
    assert (two.how, two.said) == (isolate.RETURNED, ()) and two.seconds > 0.09
    assert (three.how, three.output, three.case) == (isolate.TIME, "three\n", None)


def test_the_last_stage_ends_as_the_process_does():
    def work(child):
        child.stage("only", 5.0)
        child.tell(CASE)
        os.abort()

    ((_, only),) = isolate.stages(isolate.run(work, 5.0))
    assert (only.signal_name, only.case) == ("SIGABRT", CASE)
    assert isolate.stages(isolate.run(lambda child: None, 5.0)) == []


def test_leaving_early_ends_those_that_run():
    before = time.monotonic()
    jobs = [(0, lambda child: None, 5.0), (1, lambda child: time.sleep(600.0), 600.0)]
    for key, _ in isolate.run_all(jobs, workers=2):
        assert key == 0
        break
    assert time.monotonic() - before < 600.0


def test_no_descriptors_and_no_folders_are_left(tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    isolate.run(lambda child: None, 5.0)
    before = len(os.listdir("/proc/self/fd"))
    for work in (lambda child: None, lambda child: os.abort(), lambda child: libc().pause()):
        isolate.run(work, 0.2)
    assert len(os.listdir("/proc/self/fd")) == before
    assert not list(tmp_path.iterdir())


def test_threads_that_wait_do_no_harm():
    stop = threading.Event()
    thread = threading.Thread(target=stop.wait, daemon=True)
    thread.start()
    try:
        outcome = isolate.run(lambda child: child.say({"alive": 1}), 5.0)
        assert outcome.said == ({"alive": 1},)
    finally:
        stop.set()
        thread.join()


def test_ctrl_c_ends_the_children(tmp_path):
    """A terminal's Ctrl-C reaches the parent; the child is in a process group of its own."""
    script = tmp_path / "long.py"
    script.write_text(
        "import time\nfrom usersub.check.running import isolate\n"
        "def work(child):\n"
        f"    open({str(tmp_path / 'process')!r}, 'w').write(str(__import__('os').getpid()))\n"
        "    time.sleep(60)\n"
        "isolate.run(work, 60.0)\n"
    )
    parent = subprocess.Popen(
        [sys.executable, str(script)], stderr=subprocess.PIPE, start_new_session=True
    )
    noted = tmp_path / "process"
    for _ in range(5000):
        if noted.exists() and noted.read_text():
            break
        time.sleep(0.02)
    child = int(noted.read_text())
    parent.send_signal(signal.SIGINT)
    _, words = parent.communicate(timeout=100)
    assert b"KeyboardInterrupt" in words
    assert not _runs(child)


def test_a_parent_that_is_gone_takes_its_children_along(tmp_path):
    script = tmp_path / "gone.py"
    script.write_text(
        "import os, time\nfrom usersub.check.running import isolate\n"
        "def work(child):\n"
        "    print(os.getpid(), file=open('/dev/null', 'w'))\n"
        f"    open({str(tmp_path / 'process')!r}, 'w').write(str(os.getpid()))\n"
        "    time.sleep(60)\n"
        "isolate.run(work, 60.0)\n"
    )
    parent = subprocess.Popen([sys.executable, str(script)], start_new_session=True)
    noted = tmp_path / "process"
    for _ in range(5000):
        if noted.exists() and noted.read_text():
            break
        time.sleep(0.02)
    child = int(noted.read_text())
    parent.kill()
    parent.wait(timeout=100)
    for _ in range(3000):
        if not _runs(child):
            return
        time.sleep(0.02)
    pytest.fail("the child outlives its parent")
