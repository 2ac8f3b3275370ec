# SPDX-License-Identifier: MIT
"""The folder of a study: one file a point, so that nothing that was run is run again.

study.json          which points, how many repeats
points/KEY.json     what each run of the point gave; replaced as a whole after every run
errors.csv          errors to the last bit: the same from any machine, pool or session
results.csv, .json  errors, and times as they were measured
"""

from __future__ import annotations

import contextlib
import json
import math
import os
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, fields
from pathlib import Path
from typing import Any

from usersub.errors import SceneError
from usersub.study.result import Point, Result
from usersub.study.running import Run
from usersub.study.timing import spread

#: Of the files; another one is not read.
FORMAT = 1

_STUDY, _POINTS, _LOCK = "study.json", "points", ".lock"
_OUTCOME = tuple(f.name for f in fields(Run) if f.name not in ("run_time_s", "ns_per_point"))

#: Columns of errors.csv, after the key.
_ERRORS = ("problem", "law", "interface", "language", "precision", "method", "options",
           "increments", "block", "points", "step", "error", "refused")  # fmt: skip


class Store:
    """Runs of points, kept in a folder, or in memory without one.

    Args:
        folder: where; made if it is not there.
        points: of the study, in their order.
        repeats: runs of each.
        fresh: forget what is there.

    Raises:
        SceneError: the folder holds another study, files that are none, or is in use.
    """

    def __init__(
        self, folder: Path | None, points: Sequence[Point], repeats: int, *, fresh: bool = False
    ) -> None:
        self.folder, self.points, self.repeats = folder, list(points), repeats
        self._records: dict[str, dict[str, Any]] = {}
        #: Runs of each point so far; all of them for one that is refused.
        self.done: dict[str, int] = {}
        self._lock: int | None = None
        if folder is None:
            return
        _make(folder)
        self._lock = _locked(folder)
        try:
            self._open(folder, fresh)
        except BaseException:
            self.close()
            raise

    def __enter__(self) -> Store:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Lets other processes use the folder."""
        if self._lock is not None:
            os.close(self._lock)
            self._lock = None

    def add(self, point: Point, run: Run) -> None:
        """Takes a run, and keeps it at once.

        Raises:
            OSError: it cannot be written.
        """
        record = self._records.get(point.key)
        if record is None or record["outcome"]["refused"]:
            outcome = {name: _plain(getattr(run, name)) for name in _OUTCOME}
            record = {"point": point.as_dict(), "outcome": outcome, "times": []}
            self._records[point.key] = record
        elif not run.refused and _plain(run.error) != record["outcome"]["error"]:
            record["outcome"] |= {
                "refused": f"two runs differ: errors {record['outcome']['error']!r} and "
                f"{_plain(run.error)!r}",
                "error": None,
            }  # fmt: skip
        elif run.refused:
            record["outcome"] |= {"refused": run.refused, "passing": run.passing}
        if not run.refused:
            record["times"].append([_plain(run.run_time_s), _plain(run.ns_per_point)])
            record.setdefault("machines", [])
            if run.machine not in record["machines"]:
                record["machines"].append(run.machine)
        self._count(point.key)
        if self.folder is not None:
            _write(self._file(point.key), json.dumps(record, indent=1) + "\n")

    def _count(self, key: str) -> None:
        record = self._records[key]
        refused = record["outcome"]["refused"]
        self.done[key] = self.repeats if refused else min(len(record["times"]), self.repeats)

    def results(self) -> list[Result]:
        """Results of the points that have all their runs, in the order of the points."""
        return [
            _result(point, self._records[point.key], self.repeats)
            for point in self.points
            if self.done.get(point.key, 0) >= self.repeats
        ]

    @property
    def machines(self) -> list[str]:
        """Machines that ran anything."""
        return sorted({m for record in self._records.values() for m in record.get("machines", [])})

    def write(self, stamp: Mapping[str, str]) -> list[Path]:
        """Writes errors.csv, results.csv and results.json; the files.

        Raises:
            OSError: one cannot be written.
        """
        from usersub.study import tables

        if self.folder is None:
            return []
        found = self.results()
        texts = {
            "errors.csv": errors_text(found),
            "results.csv": tables.csv_text(found),
            "results.json": tables.json_text(found, stamp),
        }
        for name, text in texts.items():
            _write(self.folder / name, text)
        return [self.folder / name for name in texts]

    # The folder.

    def _file(self, key: str) -> Path:
        assert self.folder is not None
        return self.folder / _POINTS / f"{key}.json"

    def _open(self, folder: Path, fresh: bool) -> None:
        head = {
            "format": FORMAT, "repeats": self.repeats,
            "points": [_named(point) for point in self.points],
        }  # fmt: skip
        there = folder / _STUDY
        if there.exists():
            if not fresh:
                _check(folder, _read(there), head)
        elif any(p.name != _LOCK for p in folder.iterdir()):
            raise SceneError(f"{folder} is not a folder of a study, and not empty")
        (folder / _POINTS).mkdir(exist_ok=True)
        keys = {point.key for point in self.points}
        for file in sorted((folder / _POINTS).glob("*.json")):
            if fresh or file.stem not in keys:  # of a file that has changed since, or a release
                file.unlink()
            else:
                self._take(file)
        _write(there, json.dumps(head, indent=1) + "\n")

    def _take(self, file: Path) -> None:
        record = _read(file)
        try:
            key = Point.of(record["point"]).key
            right = key == file.stem and len(record["times"]) >= 0
            passing = record["outcome"]["passing"]
            missing = [name for name in _OUTCOME if name not in record["outcome"]]
        except (KeyError, TypeError, AttributeError) as error:
            raise _unreadable(file, "it is no result of a study") from error
        if not right or missing:
            raise _unreadable(file, "it is the result of another point")
        if not passing:
            self._records[key] = record
            self._count(key)


def _named(point: Point) -> dict[str, Any]:
    """What tells studies apart: not the content of a user's file, which may be mended."""
    return {k: v for k, v in point.as_dict().items() if k != "content"}


def _check(folder: Path, found: Any, wanted: dict[str, Any]) -> None:
    words = "give another --out, or --fresh to forget it"
    if not isinstance(found, dict) or found.get("format") != FORMAT:
        form = found.get("format") if isinstance(found, dict) else found
        raise SceneError(f"{folder} has files of format {form!r}, expected {FORMAT}; {words}")
    for name in ("points", "repeats"):
        if found.get(name) != wanted[name]:
            there, here = found.get(name), wanted[name]
            if name == "points":
                there, here = (f"{len(each or ())} points" for each in (there, here))
                if there == here:
                    here = f"{here} that differ"
                what = f"{there}, and this one has {here}"
            else:
                what = f"{there} repeats of each point, and this one has {here}"
            raise SceneError(f"{folder} holds another study, of {what}; {words}")


def _make(folder: Path) -> None:
    if folder.exists() and not folder.is_dir():
        raise SceneError(f"{folder} is a file, expected a folder")
    folder.mkdir(parents=True, exist_ok=True)


def _locked(folder: Path) -> int:
    """Holds the folder until the process ends, however it ends."""
    import fcntl

    handle = os.open(folder / _LOCK, os.O_RDWR | os.O_CREAT, 0o644)
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        os.close(handle)
        raise SceneError(f"{folder} is in use by another study that is running") from error
    return handle


def _read(file: Path) -> Any:
    try:
        return json.loads(file.read_text(encoding="utf-8"))
    except (ValueError, UnicodeDecodeError) as error:
        raise _unreadable(file, str(error)) from error


def _unreadable(file: Path, why: str) -> SceneError:
    return SceneError(f"{file} cannot be read: {why}; delete it, and its point runs again")


def _write(file: Path, text: str) -> None:
    """Replaces a file as a whole, whenever the process ends."""
    handle, name = tempfile.mkstemp(prefix=f".{file.name}.", dir=file.parent)
    try:
        with open(handle, "w", encoding="utf-8") as stream:
            stream.write(text)
        os.chmod(name, 0o644)
        os.replace(name, file)
    except BaseException:
        with contextlib.suppress(OSError):
            os.unlink(name)
        raise


def _plain(value: Any) -> Any:
    """JSON has neither nan nor infinity."""
    if isinstance(value, float) and not math.isfinite(value):
        return None if math.isnan(value) else ("inf" if value > 0 else "-inf")
    return value


def _number(value: Any) -> float:
    return math.nan if value is None else float(value)


def _result(point: Point, record: Mapping[str, Any], repeats: int) -> Result:
    outcome, times = record["outcome"], record["times"][:repeats]
    ran = not outcome["refused"]
    wall = spread([_number(t[0]) for t in times] if ran else [])
    call = spread([_number(t[1]) for t in times] if ran else [])
    return Result(
        problem=point.problem, law=point.law, interface=point.interface, language=point.language,
        precision=point.precision, method=point.method, step=_number(outcome["step"]),
        points=int(outcome["points"]), error=_number(outcome["error"]),
        error_of=outcome["error_of"], run_time_s=wall.median, ns_per_point=call.median,
        run_time_low=wall.low, run_time_high=wall.high, repeats=len(times) if ran else 0,
        increments=point.step, block=point.block, routine=point.routine, options=point.options,
        key=point.key, refused=outcome["refused"], reference=outcome["reference"],
        tolerance=_number(outcome["tolerance"]), refined=point.refined, says=outcome["says"],
    )  # fmt: skip


def errors_text(results: Sequence[Result]) -> str:
    """All that does not depend on the machine, as CSV."""
    return "".join(_lines(results))


def _lines(results: Sequence[Result]) -> Iterator[str]:
    yield ",".join(("key", *_ERRORS)) + "\n"
    for result in results:
        data = asdict(result)
        data["options"] = "; ".join(f"{n}={v}" for n, v in result.options)
        cells = ["" if data[name] is None else str(data[name]) for name in ("key", *_ERRORS)]
        yield ",".join(f'"{c}"' if set(c) & set(',"\n') else c for c in
                       (cell.replace('"', '""') for cell in cells)) + "\n"  # fmt: skip
