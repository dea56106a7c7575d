"""Pictures: NumPy arrays of linear light with names, and what they look like."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np
from numpy.typing import DTypeLike, NDArray

from . import _native


class Picture(Mapping[str, NDArray[np.float32]]):
    """A picture and its layers: a mapping from names to arrays.

    Each array has the shape (height, width, 4): linear RGBA with premultiplied alpha, or the raw numbers of a quantity. The
    first row is the top one. Arrays share their memory with the picture and are read-only; `.copy()` makes one that can be changed.

    In a notebook, a picture shows itself.
    """

    def __init__(self, layers: Mapping[str, _native.NativePicture], backend: str) -> None:
        self._layers = dict(layers)
        self._first = next(iter(self._layers))
        self.backend = backend
        """What drew it: OpenGL with the driver's name, the CPU reference with the reason, or the path tracer."""

    @property
    def array(self) -> NDArray[np.float32]:
        """The first layer."""
        return self[self._first]

    @property
    def size(self) -> tuple[int, int]:
        """Width and height in pixels."""
        height, width, _ = self.array.shape
        return width, height

    def __getitem__(self, name: str) -> NDArray[np.float32]:
        return np.asarray(self._layer(name).linear())

    def __iter__(self) -> Iterator[str]:
        return iter(self._layers)

    def __len__(self) -> int:
        return len(self._layers)

    def __array__(self, dtype: DTypeLike | None = None, copy: bool | None = None) -> NDArray[np.float32]:
        return np.array(self.array, dtype=dtype, copy=copy)

    def srgb8(self, layer: str | None = None) -> NDArray[np.uint8]:
        """The displayed values of a layer, by default the first: uint8 of (height, width, 4), after exposure, tone mapping and
        encoding. Vectors and scalars are mapped to the range in which they are visible. Alpha is not premultiplied."""
        return np.asarray(self._layer(layer).displayed())

    def png(self, layer: str | None = None) -> bytes:
        """The displayed values of a layer as a PNG file."""
        return self._layer(layer).png()

    def exr(self) -> bytes:
        """All layers as an OpenEXR file: 32-bit floats, linear."""
        return _native.encode_exr([(name.replace(":", "-"), layer) for name, layer in self._layers.items()])

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a `.png` of the first layer, or an `.exr` of all layers."""
        path = Path(path)
        match path.suffix.lower():
            case ".png":
                data = self.png()
            case ".exr":
                data = self.exr()
            case _:
                raise _native.Error(f"`{path}`: expected a name that ends in .png (8 bits) or .exr (linear, all layers)")
        path.write_bytes(data)

    def _layer(self, name: str | None) -> _native.NativePicture:
        try:
            return self._layers[self._first if name is None else name]
        except KeyError:
            raise KeyError(f"no layer `{name}`: the picture has {', '.join(self._layers)}") from None

    def _repr_png_(self) -> bytes:
        return self.png()

    def __repr__(self) -> str:
        width, height = self.size
        return f"<gonio.Picture {width}x{height}: {', '.join(self._layers)}; by {self.backend}>"
