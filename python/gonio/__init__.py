"""gonio: a light laboratory.

>>> import gonio
>>> picture = gonio.Scene("builtin:suzanne").render()
>>> picture.save("suzanne.png")

Pictures are drawn by the light equation (`Scene.render`) or by tracing paths (`Scene.trace`). `Scene.probe` lists every term of the
equation at a pixel, `brdf` evaluates and checks reflection, `inspect` lists what a model contains, and `check` judges shaders.
`gonio.ray` has the same for thousands of pictures on a cluster.
"""

from __future__ import annotations

from . import _native
from ._brdf import Brdf, Fit, Property, brdf, brdf_models
from ._picture import Picture
from ._scene import Probe, Scene, SceneWarning, TracedPicture, inspect, view_names
from ._verdict import Cause, Exercise, Verdict, check, exercises

Error = _native.Error
"""Something is wrong with a file, an argument or the machine. Its text is one sentence: what, where, what to do."""

__version__: str = _native.VERSION

__all__ = [
    "Brdf",
    "Cause",
    "Error",
    "Exercise",
    "Fit",
    "Picture",
    "Probe",
    "Property",
    "Scene",
    "SceneWarning",
    "TracedPicture",
    "Verdict",
    "brdf",
    "brdf_models",
    "check",
    "exercises",
    "inspect",
    "view_names",
]
