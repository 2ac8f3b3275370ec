# SPDX-License-Identifier: MIT
"""Laws in place of routines: which interface a driver takes, and the scene that fits."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol, runtime_checkable

from usersub.driver.scene import Scene
from usersub.errors import SceneError

if TYPE_CHECKING:
    from usersub.routine.routine import Routine


@runtime_checkable
class LawLike(Protocol):
    """What `usersub.laws.coulomb(mu=0.3)` and the decorators of law functions give."""

    name: str

    @property
    def interfaces(self) -> tuple[str, ...]: ...

    def behind(self, interface: str, *, precision: str = "double") -> Routine: ...

    def states(
        self, interface: str, directions: int, dimension: int, props: tuple[float, ...]
    ) -> int: ...


#: Interfaces by kind of driver, the preferred one first.
_PREFERRED = {
    "standard": ("fric_coef", "fric"),
    "explicit": ("vfric_coef", "vfriction", "vfric"),
    "coefficient": ("vfric_coef", "fric_coef"),
}


def interface_of(kind: str, law: LawLike, scene: Scene) -> str:
    """The interface behind which a driver of `kind` takes a law.

    A scene that only VFRIC fits (`secondary_nodes` without `nodes`) takes it, and in two dimensions
    there is no VFRICTION; the coefficient driver takes FRIC_COEF where the scene asks for what only
    that has.

    Raises:
        SceneError: none of the driver's interfaces can carry the law.
    """
    names: tuple[str, ...] = _PREFERRED[kind]
    if kind == "explicit" and scene["secondary_nodes"] and not scene["nodes"]:
        names = ("vfric",)
    elif kind == "explicit" and scene["dimension"] == 2:
        names = tuple(name for name in names if name != "vfriction")
    if kind == "coefficient" and (scene["derivatives"] or scene["anisotropic"] or scene["states"]):
        names = ("fric_coef",)
    for name in names:
        if name in law.interfaces:
            return name
    raise SceneError(
        f"the {kind} driver takes a law behind {' or '.join(n.upper() for n in names)} here; "
        f"{law.name} stands behind {', '.join(n.upper() for n in law.interfaces)}"
    )


def solver_of(law: LawLike, scene: Scene) -> str:
    """ "explicit" where the scene has nodes or what only an explicit one has, else "standard"."""
    explicit = scene["nodes"] or scene["secondary_nodes"] or scene["precision"] == "single"
    if explicit or not any(name in law.interfaces for name in _PREFERRED["standard"]):
        return "explicit"
    return "standard"


def routine_and_scene(kind: str, law: Any, scene: Scene) -> tuple[Routine, Scene]:
    """The law's routine for a driver of `kind`, and the scene with its properties and states.

    Raises:
        SceneError: the scene contradicts the law.
        LoadError: the law does not exist in the scene's precision.
    """
    if not isinstance(law, LawLike) or not isinstance(scene, Scene):
        return law, scene  # a routine, or what the driver refuses
    interface = interface_of(kind, law, scene)
    return law.behind(interface, precision=scene["precision"]), completed(law, interface, scene)


def completed(law: LawLike, interface: str, scene: Scene) -> Scene:
    """`scene` with the law's properties and states where it gives none.

    Raises:
        SceneError: it gives others.
    """
    own, props = getattr(law, "props", None), scene.props
    if isinstance(own, tuple):  # a law with its properties; a law function has none
        if props and props != own:
            raise SceneError(
                f"props = {_short(props)} of the scene are not those of {law.name}, "
                f"{_short(own)}; leave them out"
            )
        props = own
    dimension = scene["dimension"]
    directions = scene["friction_directions"] or dimension - 1
    try:
        needed = law.states(interface, directions, dimension, props)
    except (IndexError, ValueError) as error:
        raise SceneError(
            f"props = {_short(props)} of the scene do not tell how many state variables "
            f"{law.name} has: {error}"
        ) from error
    given = scene["states"]
    if given and given < needed:
        raise SceneError(
            f"scene setting 'states' = {given}; {law.name} behind {interface.upper()} needs "
            f"{needed} (0 takes the law's)"
        )
    changes: dict[str, Any] = {"props": props, "states": given or needed}
    if interface == "fric_coef" and directions > 1 and getattr(law, "anisotropic", False):
        changes["anisotropic"] = 1
    return scene.replace(**changes)


def _short(props: tuple[float, ...]) -> str:
    text = ", ".join(f"{x:g}" for x in props[:8])
    return f"({text}, ... {len(props)} numbers)" if len(props) > 8 else f"({text})"
