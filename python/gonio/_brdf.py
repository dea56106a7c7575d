"""BRDFs: their values over arrays of directions, their properties, fits."""

from __future__ import annotations

import json
import warnings
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._scene import SceneWarning


@dataclass(frozen=True)
class Property:
    """A property that every physically plausible function has, measured."""

    name: str
    passed: bool
    value: float
    explanation: str


@dataclass(frozen=True)
class Fit:
    """A model fitted to a function."""

    model: str
    spec: str
    """The model with its parameters: an argument for `brdf`, or a material's `brdf`."""
    rms: float
    """Root mean square of the difference of (f cos)^(1/3)."""
    relative: float
    """The same relative to (f cos)^(1/3) itself."""
    at_limit: tuple[str, ...]
    """Parameters that ended at a limit of their range."""


class Brdf:
    """A function of two directions: a model with parameters, a measured table, or a GLSL function.

    Directions are in the local frame: tangent +X, bitangent +Y, normal +Z. `wi` points to the light, `wo` to the viewer.
    """

    def __init__(self, spec: str) -> None:
        self._native = _native.NativeBrdf(spec)
        for text in self._native.warnings:
            warnings.warn(f"{self.name}: {text}", SceneWarning, stacklevel=3)

    @property
    def name(self) -> str:
        """The model with its parameters, or the file."""
        return self._native.name

    @property
    def title(self) -> str:
        """One line about it."""
        return self._native.title

    @property
    def parameters(self) -> dict[str, Any]:
        """The values of the parameters."""
        return {parameter["name"]: parameter["value"] for parameter in json.loads(self._native.parameters())}

    def eval(self, wi: ArrayLike, wo: ArrayLike) -> NDArray[np.float64]:
        """f(wi, wo) in 1/sr for arrays of directions of the shape (..., 3), which are broadcast. Directions are made unit vectors. The
        result has the same shape: red, green, blue. It is 0 where a direction is at or below the horizon."""
        pairs, shape = _pairs(wi, wo)
        return np.asarray(self._native.evaluate(*pairs)).reshape(shape)

    def density(self, wi: ArrayLike, wo: ArrayLike) -> NDArray[np.float64]:
        """The density in 1/sr with which importance sampling draws `wi` for a viewer at `wo`."""
        pairs, shape = _pairs(wi, wo)
        return np.asarray(self._native.density(*pairs)).reshape(shape[:-1])

    def check(self) -> list[Property]:
        """Measures reciprocity, energy, positivity, and for models normalisation and sampling."""
        found = json.loads(self._native.check())
        return [Property(p["property"], p["passed"], p["value"], p["explanation"]) for p in found]

    def fit(self, models: str | Iterable[str] = ()) -> list[Fit]:
        """Fits models to it, best first; without names, those that suit it."""
        names = [models] if isinstance(models, str) else list(models)
        found = json.loads(self._native.fit(names))
        return [Fit(f["model"], f["spec"], f["rms"], f["relative"], tuple(f["at_limit"])) for f in found]

    def __repr__(self) -> str:
        return f"<gonio.Brdf {self.name}>"


def brdf(spec: str) -> Brdf:
    """A BRDF: `NAME` or `NAME:KEY=VALUE,...` of a model, such as `"ggx:f0=1/0.8/0.3,alpha=0.2"`; or a file: a MERL table (`.binary`), a
    `.brdf` or `.glsl` function, or fits (`.toml`)."""
    return Brdf(spec)


def brdf_models() -> dict[str, str]:
    """The models, each with one line about it."""
    return dict(_native.brdf_models())


def _pairs(
    wi: ArrayLike, wo: ArrayLike
) -> tuple[tuple[NDArray[np.float64], NDArray[np.float64]], tuple[int, ...]]:
    arrays = [np.asarray(w, dtype=np.float64) for w in (wi, wo)]
    if any(array.ndim == 0 or array.shape[-1] != 3 for array in arrays):
        shapes = " and ".join(str(array.shape) for array in arrays)
        raise _native.Error(f"invalid directions of the shapes {shapes}: expected (..., 3)")
    try:
        first, second = np.broadcast_arrays(*arrays)
    except ValueError:
        shapes = " and ".join(str(array.shape) for array in arrays)
        raise _native.Error(f"directions of the shapes {shapes} cannot be broadcast to one shape") from None
    return (np.ascontiguousarray(first), np.ascontiguousarray(second)), first.shape
