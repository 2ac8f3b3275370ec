# SPDX-License-Identifier: MIT
"""A process that has not called the routine yet, for what has to hold after a restart."""

from __future__ import annotations

import os
import pickle
import signal
from collections.abc import Callable
from typing import Any


class FreshProcess:
    """A copy of this process, made now, that runs a function later.

    What a routine keeps inside after now is not in the copy.

    Args:
        function: called with the argument of `finish`; that and its result are pickled.
    """

    def __init__(self, function: Callable[[Any], Any]) -> None:
        question, self._ask = os.pipe()
        self._answer, answer = os.pipe()
        self._child = os.fork()
        if self._child == 0:
            os.close(self._ask)
            os.close(self._answer)
            _serve(function, question, answer)
        os.close(question)
        os.close(answer)

    def finish(self, argument: Any) -> Any:
        """The function's result in the copy; None if the copy died."""
        with os.fdopen(self._ask, "wb") as ask:
            pickle.dump(argument, ask)
        with os.fdopen(self._answer, "rb") as answer:
            told = answer.read()
        os.waitpid(self._child, 0)
        self._child = 0
        return pickle.loads(told) if told else None

    def __enter__(self) -> FreshProcess:
        return self

    def __exit__(self, *exception: object) -> None:
        if self._child:
            os.kill(self._child, signal.SIGKILL)
            os.waitpid(self._child, 0)
            os.close(self._ask)
            os.close(self._answer)


def _serve(function: Callable[[Any], Any], question: int, answer: int) -> None:
    """Answers one question and ends the process, whatever happens."""
    try:
        with os.fdopen(question, "rb") as asked:
            # Not up to the end of the stream: copies that were made later hold it open.
            argument = pickle.load(asked)
        result = pickle.dumps(function(argument))
        with os.fdopen(answer, "wb") as told:
            told.write(result)
    finally:
        os._exit(0)
