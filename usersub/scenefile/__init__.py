# SPDX-License-Identifier: MIT
"""Scene files: a routine, a scene and a history (or a problem) in one TOML file."""

from usersub.scenefile.reader import Output, SceneFile, read
from usersub.scenefile.run import Run, run_scene

__all__ = ["Output", "Run", "SceneFile", "read", "run_scene"]
