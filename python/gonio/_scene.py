"""Scenes: models with lights and a camera, from files or built in."""

from __future__ import annotations

import json
import os
import warnings
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._picture import Picture

_SESSION = _native.NativeSession()

Size = tuple[int, int]
StrPath = str | os.PathLike[str]


class SceneWarning(UserWarning):
    """Something odd in a file that was survived; the text says how."""


class TracedPicture(Picture):
    """A picture by the path tracer: the mean of its paths."""

    def __init__(self, layers: Mapping[str, _native.NativePicture], samples: int, error: float) -> None:
        super().__init__(layers, "the path tracer")
        self.samples = samples
        """Paths of each pixel."""
        self.error = error
        """The error of a pixel's luminance relative to the mean luminance; infinite with one path for each pixel."""


class Probe:
    """The light equation at one pixel."""

    def __init__(self, data: dict[str, Any] | None, value: Sequence[float]) -> None:
        self.data: dict[str, Any] = data or {}
        """Every number, as `gonio probe --json` prints it under `probe`; empty where no surface is seen."""
        self.value: NDArray[np.float64] = np.array(value)
        """The pixel with one sample, through its centre: linear RGBA."""

    @property
    def hit(self) -> bool:
        """Whether a surface is seen there."""
        return bool(self.data)

    @property
    def terms(self) -> dict[str, NDArray[np.float64]]:
        """The terms of the equation at the pixel, linear RGB: ambient, emitted, diffuse, specular and so on; diffuse and specular are
        sums over the lights. Empty where no surface is seen."""
        terms = self.data.get("terms", {})
        colors = {name: value for name, value in terms.items() if _is_color(value)}
        return {name: np.array(value, dtype=float) for name, value in colors.items()}

    @property
    def lights(self) -> list[dict[str, Any]]:
        """Every vector, factor and term of each light."""
        return list(self.data.get("terms", {}).get("lights", []))

    def __getitem__(self, name: str) -> Any:
        terms = self.terms
        if name in terms:
            return terms[name]
        if name in self.data:
            return self.data[name]
        raise KeyError(f"no value `{name}`: the pixel has {', '.join([*terms, *self.data]) or 'no surface'}")

    def __repr__(self) -> str:
        what = self.data.get("object_name", "background")
        return f"<gonio.Probe {what}: {np.array2string(self.value, precision=4)}>"


def _is_color(value: object) -> bool:
    return isinstance(value, list) and len(value) == 3 and all(isinstance(number, (int, float)) for number in value)


class Scene:
    """A scene: models, lights, a camera, and the form of the light equation.

    `inputs` are models, scene files (`.toml`) or `builtin:NAME`; several become one scene. Options replace values of the scene. They
    are the tables and keys of a scene file: `picture`, `camera`, `background`, `environment` and `equation` are dicts of the values
    to replace; `light` is a list of lights; `shading`, `normals`, `crease_angle`, `up`, `material` and `parts` are set on all
    objects. An environment may be named alone, and a light or a material be written as for the command line.

    `size` is the picture's width and height, `samples` the samples of a pixel. With `sandbox`, files can name others only in their
    own folders; `max_memory` (bytes) and `max_triangles` limit what files may make gonio allocate.
    """

    def __init__(
        self,
        *inputs: StrPath | Iterable[StrPath],
        size: Size | None = None,
        samples: int | None = None,
        sandbox: bool = False,
        max_memory: int | None = None,
        max_triangles: int | None = None,
        **options: Any,
    ) -> None:
        names: list[str] = []
        for given in inputs:
            both = [given] if isinstance(given, (str, os.PathLike)) else list(given)
            names.extend(os.fspath(name) for name in both)
        picture = dict(options.get("picture", {}))
        if size is not None:
            picture["width"], picture["height"] = size
        if samples is not None:
            picture["samples"] = samples
        if picture:
            options["picture"] = picture
        self._inputs = names
        self._options = options
        self._limits = (sandbox, max_memory, max_triangles)
        self._native = self._load(options)
        self._settings: dict[str, Any] = json.loads(self._native.settings())
        self._other: tuple[tuple[Size, int], _native.NativeScene] | None = None
        self.notes: list[str] = []
        """What the files made gonio note, besides warnings."""
        for is_warning, text in self._native.diagnostics():
            if is_warning:
                warnings.warn(text, SceneWarning, stacklevel=2)
            else:
                self.notes.append(text)

    def _load(self, options: Mapping[str, Any]) -> _native.NativeScene:
        text = json.dumps(options, default=_plain)
        return _native.NativeScene.load(_SESSION, self._inputs, text, *self._limits)

    def _sized(self, size: Size | None, samples: int | None = None) -> _native.NativeScene:
        """The scene in another size: its camera and its lights suit the shape of the picture, as if it had been loaded so."""
        if size is None and samples is None:
            return self._native
        own = self.settings["picture"]
        size = (own["width"], own["height"]) if size is None else (int(size[0]), int(size[1]))
        picture = {**own, "width": size[0], "height": size[1], "samples": own["samples"] if samples is None else samples}
        if picture == own:
            return self._native
        key = (size, picture["samples"])
        if self._other is None or self._other[0] != key:
            replaced = {**self._options.get("picture", {}), "width": size[0], "height": size[1], "samples": key[1]}
            self._other = (key, self._load({**self._options, "picture": replaced}))
        return self._other[1]

    @property
    def settings(self) -> dict[str, Any]:
        """The complete scene file with every default filled in, as `gonio scene` prints it."""
        return self._settings

    @property
    def counts(self) -> dict[str, int]:
        """The numbers of objects, triangles, vertices, materials, textures and lights."""
        return dict(self._native.counts())

    def render(
        self,
        view: str | None = None,
        *,
        layers: Iterable[str] = (),
        size: Size | None = None,
        samples: int | None = None,
        time: float = 0.0,
        backend: str = "auto",
    ) -> Picture:
        """Draws the scene by the light equation.

        The first layer is the picture, `"picture"`, or the quantity `view`; `layers` are more quantities. `view_names` lists them;
        `"diffuse:0"` is the share of one light. `time` is in seconds, for lights and objects that move. `backend` is `"gl"`, `"cpu"`
        (in f64, slower) or `"auto"`: the CPU where OpenGL is missing.

        Other threads run meanwhile.
        """
        names = list(dict.fromkeys([view or "picture", *([layers] if isinstance(layers, str) else layers)]))
        # The native part has no name for the picture.
        views = ["" if name == "picture" else name for name in names]
        native = self._sized(size, samples)
        pictures, by, notes = native.draw(views, None, None, time, backend)
        for note in notes:
            warnings.warn(note, SceneWarning, stacklevel=2)
        return Picture(dict(zip(names, pictures, strict=True)), by)

    def probe(self, x: int, y: int, *, size: Size | None = None, time: float = 0.0) -> Probe:
        """Evaluates the light equation at a pixel, term by term and light by light, in f64. Column `x` and row `y` are counted from 0
        at the top left."""
        data, value = self._sized(size).probe(x, y, None, time)
        return Probe(json.loads(data), value)

    def trace(
        self,
        samples: int = 64,
        *,
        seed: int = 0,
        max_depth: int = 64,
        rgb: bool = False,
        denoise: bool = False,
        size: Size | None = None,
        time: float = 0.0,
    ) -> TracedPicture:
        """Traces paths of light: the rendering equation, with shadows and light between surfaces.

        The same `seed` gives the same picture, bit for bit. `max_depth` is the number of surfaces that a path meets at most; 2 is
        direct light. `rgb` traces red, green and blue instead of wavelengths. `denoise` filters most of the noise. The layer `"variance"`
        has the variance of each pixel's luminance, before the filter.

        Other threads run meanwhile, and Ctrl-C ends it.
        """
        picture, variance, error, notes = self._sized(size).trace(samples, seed, max_depth, rgb, denoise, None, time)
        for note in notes:
            warnings.warn(note, SceneWarning, stacklevel=2)
        return TracedPicture({"picture": picture, "variance": variance}, samples, error)

    def _repr_png_(self) -> bytes:
        return self.render().png()

    def __repr__(self) -> str:
        width, height = self.settings["picture"]["width"], self.settings["picture"]["height"]
        counts = ", ".join(f"{count} {what}" for what, count in self.counts.items() if count)
        return f"<gonio.Scene {' '.join(self._inputs)} {width}x{height}: {counts}>"


def inspect(
    path: StrPath, *, sandbox: bool = False, max_memory: int | None = None, max_triangles: int | None = None
) -> dict[str, Any]:
    """What a model's file contains and how it was interpreted: counts, bounds, materials, the files that it names, warnings. The same
    as `gonio inspect --json`."""
    found: dict[str, Any] = json.loads(_native.inspect(os.fspath(path), sandbox, max_memory, max_triangles))
    return found


def view_names() -> list[str]:
    """The quantities that `Scene.render` can draw: `normal`, `diffuse`, `specular`, `depth` and so on."""
    return _native.view_names()


def _plain(value: object) -> object:
    """A value of an option as JSON has it: arrays become lists, paths become texts."""
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    raise _native.Error(f"invalid value {value!r} of an option: expected numbers, texts, lists and dicts of them")
