# SPDX-License-Identifier: MIT
"""What acts between two surfaces: a law, and how it is enforced."""

from __future__ import annotations

import difflib
from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from usersub.errors import SceneError

if TYPE_CHECKING:
    from usersub.driver.scene import Scene

#: Settings of a scene that belong to the friction and not to the host's model.
SETTINGS = (
    "anisotropic",
    "damping",
    "elastic_slip",
    "enforcement",
    "fields",
    "props",
    "shear_limit",
    "slip_tolerance",
    "states",
    "stick_slope",
    "temperatures",
)

#: Those that have to be the same for a coefficient to change gradually: the method and its kind.
METHOD = ("anisotropic", "enforcement", "stick_slope")


@dataclass(frozen=True, init=False)
class Friction:
    """Friction of an interaction in one step.

    Args:
        law: a shipped law with its properties, such as `usersub.laws.coulomb(mu=0.3)`, or a routine
            or law function of the user's; None is frictionless.
        settings: how it is enforced: settings of a scene out of `SETTINGS`.

    Raises:
        SceneError: a setting is none of the friction's.
    """

    law: Any
    settings: Mapping[str, Any] = field(default_factory=dict)

    def __init__(self, law: Any = None, **settings: Any) -> None:
        for key in settings:
            if key not in SETTINGS:
                near = difflib.get_close_matches(key, SETTINGS, n=1, cutoff=0.5)
                hint = f"; did you mean '{near[0]}'?" if near else "; the scene has the others"
                raise SceneError(
                    f"'{key}' is no setting of a friction{hint} Expected: {', '.join(SETTINGS)}"
                )
        object.__setattr__(self, "law", law)
        object.__setattr__(self, "settings", MappingProxyType(dict(settings)))

    @property
    def of_user(self) -> bool:
        """Whether the law is the user's own, so that a step cannot change it."""
        from usersub.laws import LawObject

        return self.law is not None and not isinstance(self.law, LawObject)

    @property
    def rough(self) -> bool:
        """Whether there is no coefficient at all, but no slip."""
        return getattr(self.law, "name", "") in ("rough", "softened_rough") and not self.of_user

    def acting_law(self) -> Any:
        """The law that a driver gets: `frictionless` for None."""
        if self.law is not None:
            return self.law
        from usersub import laws

        return laws.frictionless()

    def scene(self, base: Scene) -> Scene:
        """The host's scene with the friction's settings."""
        return base.replace(**self.settings)
