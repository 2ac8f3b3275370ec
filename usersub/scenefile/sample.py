# SPDX-License-Identifier: MIT
"""Arrays of a small model at rest, for plans that are made without a history."""

from __future__ import annotations

from typing import Any

import numpy as np

from usersub import abi
from usersub.scenefile.geometry import Bound, FlatModel


def bind_sample(driver: Any, interface: str, settings: dict[str, Any]) -> None:
    """Binds what a host of `interface` would bind; `settings` are those of the driver's scene."""
    points, dimension = settings["points"], settings["dimension"]
    bound = Bound(driver, interface, settings["precision"])
    if abi.interface(interface).solver == "standard":
        rest = np.zeros((dimension - 1, points))
        coord = np.zeros((dimension, points))
        bound.put({"slip_increment": rest, "pressure": np.ones(points), "coord": coord})
        return
    model, rest = FlatModel(interface, settings, reach=1.0), np.zeros((points, dimension - 1))
    values = model.fixed(np.ones(points)) | model.moving(rest, rest)
    enforced = "condition" in driver.state  # then the driver makes the stick force itself
    names = ("normal_force", "mass" if enforced else "stick_force")
    values |= {name: np.ones(points) for name in names}
    bound.put(values | {"slip_increment": np.zeros((dimension, points))})
