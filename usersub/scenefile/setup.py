# SPDX-License-Identifier: MIT
"""From a scene file to a routine, its scene and a complete history."""

from __future__ import annotations

from typing import Any

from usersub import abi
from usersub.errors import SceneError
from usersub.routine.routine import Routine
from usersub.scenefile.history import History, check_stick, complete
from usersub.scenefile.reader import SceneFile
from usersub.scenefile.tables import nearest


def routine_of(scene_file: SceneFile) -> Routine:
    """Loads (and compiles, if need be) the routine that a scene file names.

    Raises:
        LoadError, CompileError, MissingTool, AbiError: as `usersub.load`.
        SceneError: the file does not say which of several interfaces is meant.
    """
    precision = scene_file.settings.get("precision", "double")
    interface, path = scene_file.interface, scene_file.path
    if scene_file.law is not None:
        return _built_in(scene_file, precision)
    if scene_file.language is not None:
        raise SceneError(
            f'{path}: language = "{scene_file.language}" is for built-in laws; the language of '
            f"{scene_file.routine} follows from its suffix"
        )
    import usersub

    assert scene_file.routine is not None  # the reader has seen to it
    file = usersub.load(
        scene_file.routine,
        precision=precision,
        generation=scene_file.generation,
        interface=interface,
    )
    if interface is None and len(file) > 1:
        raise SceneError(
            f"{path}: {scene_file.routine} holds {', '.join(file)}; say which with "
            f'interface = "{next(iter(file))}"'
        )
    return file.only()


def _built_in(scene_file: SceneFile, precision: str) -> Routine:
    from usersub import laws

    assert scene_file.law is not None
    if scene_file.law not in laws.LAWS:
        hint = nearest(scene_file.law, laws.LAWS) or "."
        raise SceneError(
            f'{scene_file.path}: routine = "{scene_file.law}" is neither a file nor a built-in '
            f"law{hint} Built-in laws: {', '.join(laws.LAWS)}"
        )
    if scene_file.interface is None:
        raise SceneError(
            f"{scene_file.path}: the built-in law '{scene_file.law}' needs the key 'interface', "
            f"one of {', '.join(laws.LAWS[scene_file.law].interfaces)}"
        )
    language = scene_file.language or "python"
    return laws.routine(scene_file.law, scene_file.interface, language, precision=precision)


def scene_of(scene_file: SceneFile, interface: str, settings: dict[str, Any]) -> Any:
    """The scene, with the properties and the state variables of a built-in law.

    Raises:
        SceneError: a setting or a property is wrong.
    """
    import usersub
    from usersub import laws
    from usersub.driver.law import completed

    if scene_file.named is None:
        scene = usersub.Scene(props=scene_file.props or (), **settings)
    else:
        scene = usersub.Scene(**settings)
    if scene_file.law is None:
        return scene
    described = laws.law(scene_file.law)
    law = described.of(scene.props) if scene_file.named is None else described(**scene_file.named)
    return completed(law, interface, scene)


def history_of(scene_file: SceneFile, interface: abi.Interface) -> tuple[dict[str, Any], History]:
    """Settings for `usersub.Scene` and the history, made to fit each other.

    The numbers of fields and temperatures follow from the history where [scene] does not give
    them.
    """
    given = scene_file.history
    assert given is not None
    settings = dict(scene_file.settings)
    names = given.names
    explicit = interface.solver == "explicit"
    _infer(settings, given, "temperatures", "temperature", int("temperature" in " ".join(names)))
    _infer(settings, given, "fields", "field", _count_fields(given))
    for key, default in (("points", 1), ("dimension", 3)):
        settings.setdefault(key, default)
    directions = settings["dimension"] - 1
    if not explicit:
        directions = settings.get("friction_directions") or directions
    history = complete(given, settings["points"], directions, settings["fields"])
    check_stick(history, given.table, explicit)
    if explicit:
        _surfaces(settings, interface)
    elif "area" in names and "normal_force" not in names:
        raise given.table.error("gives 'area', which has no meaning with 'pressure' here")
    if scene_file.generation is not None and interface.name == "fric_coef":
        settings.setdefault("generation", scene_file.generation)
    return settings, history


def _infer(settings: dict[str, Any], given: Any, key: str, column: str, found: int) -> None:
    wanted = settings.setdefault(key, found)
    if wanted and not found:
        raise given.table.error(f"needs the column '{column}', as [scene] {key} = {wanted}")
    if found and not wanted:
        raise given.table.error(f"gives '{column}' columns, but [scene] {key} = 0")


def _count_fields(given: Any) -> int:
    for source in given.sources:
        for name in source.names():
            if name.startswith("field"):
                return source.components(name)
    return 0


def _surfaces(settings: dict[str, Any], interface: abi.Interface) -> None:
    """Sizes of the surfaces of the small model that stands for both bodies."""
    if settings.get("contact", "node-to-facet") == "edge-to-edge":
        corners = 2
    elif settings.get("contact") == "analytical-rigid":
        corners = 1
    else:
        corners = 2 if settings["dimension"] == 2 else 4
    points = settings["points"]
    if interface.name == "vfric":
        settings.setdefault("secondary_nodes", points)
        settings.setdefault("main_nodes", corners)
    else:
        nodes = points * (2 if corners == 2 and settings["dimension"] == 3 else 1)
        settings.setdefault("nodes", nodes + corners)
