"""gonio on a cluster, with Ray: transforms of `ray.data` datasets for pictures, checks and fits.

>>> import ray, gonio.ray
>>> views = ray.data.from_items([{"scene": "builtin:suzanne", "options": {"camera": {"yaw": a}}} for a in range(360)])
>>> gonio.ray.render_pictures(views, size=(256, 256)).write_parquet("views")

`render_pictures`, `check_submissions` and `fit_brdfs` take a dataset and return one, like any other transform. The classes behind them
are for `map_batches` with settings of your own. gonio must be installed on every node.
"""

from __future__ import annotations

import json
import os
from collections import OrderedDict
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _native
from ._brdf import brdf
from ._picture import Picture
from ._scene import Scene, Size
from ._verdict import check

if TYPE_CHECKING:
    from ray.data import Dataset

Batch = dict[str, Any]

_BATCH = 16
"""Pictures of a batch: few enough that little is done again when a worker dies."""
_KEPT_SCENES = 8


class RenderPictures:
    """Draws the scene of each row: the callable class behind `render_pictures`.

    A row has the column `scene`, a model, a scene file or `builtin:NAME`; where it has them, `options`, a dict of options of
    `gonio.Scene` or its JSON, and `time` in seconds. The result has all columns of the row and `picture`: `output` is `"png"`, the bytes
    of a file; `"srgb8"`, displayed values as an array of bytes; or `"linear"`, an array of float32. With `errors="column"` a row
    that cannot be drawn has the reason in the column `error` and an empty picture, instead of ending the whole.

    It draws on one core, as Ray counts them: a cluster is full when each core has a worker.
    """

    def __init__(
        self,
        view: str | None = None,
        *,
        size: Size | None = None,
        samples: int | None = None,
        backend: str = "auto",
        output: str = "png",
        errors: str = "raise",
    ) -> None:
        self._encode: Callable[[Picture], Any] = _chosen(
            "output", output, {"png": Picture.png, "srgb8": Picture.srgb8, "linear": lambda picture: picture.array}
        )
        self._keeps_errors: bool = _chosen("errors", errors, {"raise": False, "column": True})
        self._options: dict[str, Any] = {"size": size, "samples": samples}
        self._draw: dict[str, Any] = {"view": view, "backend": backend}
        self._empty: Any = None if output == "png" else np.zeros((0, 0, 4), np.uint8 if output == "srgb8" else np.float32)
        self._scenes: OrderedDict[str, Scene] = OrderedDict()
        _use_one_thread()

    def __call__(self, batch: Batch) -> Batch:
        scenes = batch["scene"]
        count = len(scenes)
        options = batch.get("options", [None] * count)
        times = batch.get("time", [0.0] * count)
        drawn = [self._row(str(scene), option, float(time)) for scene, option, time in zip(scenes, options, times)]
        result = {**batch, "picture": _column([picture for picture, _ in drawn])}
        if self._keeps_errors:
            result["error"] = np.array([error for _, error in drawn], dtype=object)
        return result

    def _row(self, scene: str, options: Any, time: float) -> tuple[Any, str]:
        try:
            return self._encode(self._scene(scene, options).render(time=time, **self._draw)), ""
        except _native.Error as error:
            if self._keeps_errors:
                return self._empty, str(error)
            raise

    def _scene(self, name: str, options: Any) -> Scene:
        """The scene, read once for rows that follow one another."""
        own = json.loads(options) if isinstance(options, str) else _without_none(options or {})
        key = json.dumps([name, own], sort_keys=True, default=str)
        if key not in self._scenes:
            self._scenes[key] = Scene(name, **self._options, **own)
        self._scenes.move_to_end(key)
        if len(self._scenes) > _KEPT_SCENES:
            self._scenes.popitem(last=False)
        return self._scenes[key]


class CheckSubmissions:
    """Checks the submission of each row: the callable class behind `check_submissions`.

    A row has the column `files`, a file or a folder that every node can read, and `exercise`, unless that is given here. The result
    has all columns and `outcome`, `summary`, `score`, `causes` (ids, the most significant first) and `line` (of the first cause, 0 if
    unknown). A submission that cannot be read is `"unsure"`.
    """

    def __init__(self, exercise: str | None = None, *, feedback: str | None = None, patience: float = 30.0) -> None:
        self._exercise = exercise
        self._options: dict[str, Any] = {"feedback": feedback, "patience": patience}
        _use_one_thread()

    def __call__(self, batch: Batch) -> Batch:
        files = batch["files"]
        exercises = batch["exercise"] if self._exercise is None else [self._exercise] * len(files)
        rows = [self._row(str(exercise), str(path)) for exercise, path in zip(exercises, files)]
        names = ("outcome", "summary", "score", "causes", "line")
        return {**batch, **{name: _column(list(column)) for name, column in zip(names, zip(*rows), strict=True)}}

    def _row(self, exercise: str, path: str) -> tuple[str, str, float, list[str], int]:
        try:
            verdict = check(exercise, path, **self._options)
        except _native.Error as error:
            return "unsure", str(error), 0.0, [], 0
        causes = verdict.causes
        line = causes[0].line if causes else None
        return verdict.outcome, verdict.summary, verdict.score, [cause.id for cause in causes], line or 0


class FitBrdfs:
    """Fits models to the BRDF of each row: the callable class behind `fit_brdfs`.

    A row has the column `brdf`, an argument of `gonio.brdf`. The result has all columns and, of the best fit, `model`, `fit` (the model
    with its parameters), `rms` and `relative`.
    """

    def __init__(self, models: str | Iterable[str] = ()) -> None:
        self._models = [models] if isinstance(models, str) else list(models)
        _use_one_thread()

    def __call__(self, batch: Batch) -> Batch:
        best = [brdf(str(spec)).fit(self._models)[0] for spec in batch["brdf"]]
        return {
            **batch,
            "model": np.array([fit.model for fit in best]),
            "fit": np.array([fit.spec for fit in best]),
            "rms": np.array([fit.rms for fit in best]),
            "relative": np.array([fit.relative for fit in best]),
        }


def render_pictures(
    dataset: Dataset,
    view: str | None = None,
    *,
    concurrency: int | tuple[int, int] | None = None,
    batch_size: int = _BATCH,
    **options: Any,
) -> Dataset:
    """Draws the scene of each row: see `RenderPictures`, whose arguments `options` are. `concurrency` is the number of workers, one
    for each core of the cluster by default."""
    return _mapped(dataset, RenderPictures, {"view": view, **options}, concurrency, batch_size)


def check_submissions(
    dataset: Dataset,
    exercise: str | None = None,
    *,
    concurrency: int | tuple[int, int] | None = None,
    batch_size: int = 4,
    **options: Any,
) -> Dataset:
    """Checks the submission of each row: see `CheckSubmissions`, whose arguments `options` are."""
    return _mapped(dataset, CheckSubmissions, {"exercise": exercise, **options}, concurrency, batch_size)


def fit_brdfs(
    dataset: Dataset,
    models: str | Iterable[str] = (),
    *,
    concurrency: int | tuple[int, int] | None = None,
    batch_size: int = 1,
) -> Dataset:
    """Fits models to the BRDF of each row: see `FitBrdfs`."""
    return _mapped(dataset, FitBrdfs, {"models": models}, concurrency, batch_size)


def _mapped(
    dataset: Dataset,
    transform: type,
    arguments: dict[str, Any],
    concurrency: int | tuple[int, int] | None,
    batch_size: int,
) -> Dataset:
    try:
        import ray
        from ray.data import ActorPoolStrategy

        resources: Callable[[], dict[str, float]] = ray.cluster_resources
    except ImportError:
        raise _native.Error('gonio.ray needs Ray: pip install "gonio[ray]"') from None
    if concurrency is None:
        concurrency = (1, max(1, int(resources().get("CPU", 1))))
    least, most = concurrency if isinstance(concurrency, tuple) else (concurrency, concurrency)
    return dataset.map_batches(
        transform,
        fn_constructor_kwargs=arguments,
        batch_size=batch_size,
        compute=ActorPoolStrategy(min_size=least, max_size=most),
        num_cpus=1,
    )


def _use_one_thread() -> None:
    """Draws and computes on one core. Both variables are read when the first picture is drawn."""
    for name in ("LP_NUM_THREADS", "RAYON_NUM_THREADS"):
        os.environ.setdefault(name, "1")


def _chosen(name: str, value: str, choices: dict[str, Any]) -> Any:
    if value not in choices:
        raise _native.Error(f"invalid {name} `{value}`: expected {', '.join(choices)}")
    return choices[value]


def _column(values: list[Any]) -> Any:
    """Values as a column: arrays of one shape as one array, others as objects."""
    if values and isinstance(values[0], np.ndarray) and len({value.shape for value in values}) == 1:
        return np.stack(values)
    if values and isinstance(values[0], (float, int)):
        return np.array(values)
    column = np.empty(len(values), dtype=object)
    column[:] = values
    return column


def _without_none(options: Any) -> Any:
    """Options as a row of a dataset has them, where each dict has the keys of all rows, without those that are not given."""
    if isinstance(options, dict):
        return {key: _without_none(value) for key, value in options.items() if value is not None}
    return options
