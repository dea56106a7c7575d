"""Checks of students' submissions."""

from __future__ import annotations

import html
import json
import os
import pickle
import subprocess
import sys
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from . import _native

StrPath = str | os.PathLike[str]
Files = StrPath | Iterable[StrPath] | Mapping[str, str | bytes]

_MOST_FILES = 2000
_MOST_BYTES = 128 << 20


@dataclass(frozen=True)
class Exercise:
    """An exercise of the lab."""

    id: str
    title: str
    summary: str
    files: dict[str, str]
    """The files to start from: names and texts."""


@dataclass(frozen=True)
class Cause:
    """A mistake that explains why an answer is wrong."""

    id: str
    """Its id in the catalogue of mistakes."""
    name: str
    """The mistake in half a sentence."""
    file: str | None
    """The student's file, where the mistake was located."""
    line: int | None
    """The line in that file, from 1."""
    looks_like: str
    """What it looks like."""
    fix: str
    """How to fix it."""


class Verdict:
    """The result of a check. In a notebook it shows its page, with pictures."""

    def __init__(self, data: dict[str, Any], page: str) -> None:
        self.data = data
        """Everything, as `gonio lab check --json` prints it."""
        self.page = page
        """The verdict as a web page with pictures, complete in itself."""

    @property
    def outcome(self) -> str:
        """`"correct"`, `"wrong"`, `"does-not-compile"` or `"unsure"`."""
        return str(self.data["verdict"])

    @property
    def is_correct(self) -> bool:
        """Whether the answer is right."""
        return self.outcome == "correct"

    @property
    def summary(self) -> str:
        """The verdict in one sentence."""
        return str(self.data["summary"])

    @property
    def score(self) -> float:
        """1 for right answers, for others the share of test scenes that are right."""
        return float(self.data["score"])

    @property
    def causes(self) -> list[Cause]:
        """The mistakes, the most significant first."""
        return [
            Cause(m["id"], m["name"], m.get("file"), m.get("line"), m["looks_like"], m["fix"])
            for m in self.data["mistakes"]
        ]

    def _repr_html_(self) -> str:
        # A frame of its own: the page's style stays there, and no script runs.
        page = html.escape(self.page, quote=True)
        style = "width: 100%; height: 560px; border: 1px solid #8888; border-radius: 6px; background: white; resize: vertical"
        return f'<iframe sandbox srcdoc="{page}" style="{style}" title="{html.escape(self.summary, quote=True)}"></iframe>'

    def __repr__(self) -> str:
        return f"<gonio.Verdict {self.data['exercise']}: {self.outcome}: {self.summary}>"


def exercises() -> list[Exercise]:
    """All exercises."""
    return [Exercise(**exercise) for exercise in json.loads(_native.exercises())]


def check(
    exercise: str,
    files: Files,
    *,
    pair: str | None = None,
    as_the_lab: bool = False,
    feedback: str | None = None,
    patience: float = 30.0,
) -> Verdict:
    """Checks a submission.

    `files` is a file, a folder, a list of files, or a mapping from names to contents. `pair` chooses one pair of shaders, by the name
    of its file, if there are several. `as_the_lab` accepts what the lab's own solutions do where they differ from the textbook.
    `feedback` is how much the verdict shows: `"verdict"`, `"name"`, `"line"` or `"fix"`; by default as the exercise states. A check
    that takes more than `patience` seconds is stopped.

    It runs in a process of its own, because a shader may crash a graphics driver.
    """
    if isinstance(files, Mapping):
        given, label = _contents(files), "submission"
    else:
        paths = _paths(files)
        given, label = _read(paths), paths[0].stem
    request = pickle.dumps((exercise, given, label, pair, as_the_lab, feedback))
    # Without the current folder in its path, where a student's file may have the name of a module.
    command = [sys.executable, "-P", "-m", "gonio._check_worker"]
    package = str(Path(__file__).parent.parent)
    search = os.pathsep.join(filter(None, [package, os.environ.get("PYTHONPATH")]))
    with subprocess.Popen(
        command,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        env={**os.environ, "PYTHONPATH": search},
    ) as worker:
        try:
            answer, _ = worker.communicate(request, timeout=patience)
        except subprocess.TimeoutExpired:
            worker.kill()
            return _verdict(_native.stopped_check(exercise, label, round(patience)))
        except BaseException:
            worker.kill()
            raise
    if worker.returncode != 0 or not answer:
        return _verdict(_native.stopped_check(exercise, label, None))
    found = json.loads(answer)
    if "error" in found:
        raise _native.Error(found["error"])
    return _verdict((found["verdict"], found["page"]))


def _verdict(found: tuple[str, str]) -> Verdict:
    data, page = found
    return Verdict(json.loads(data), page)


def _paths(files: StrPath | Iterable[StrPath]) -> list[Path]:
    return [Path(files)] if isinstance(files, (str, os.PathLike)) else [Path(path) for path in files]


def _contents(files: Mapping[str, str | bytes]) -> list[tuple[str, bytes]]:
    return [(name, text.encode() if isinstance(text, str) else bytes(text)) for name, text in files.items()]


def _read(paths: list[Path]) -> list[tuple[str, bytes]]:
    """The files at these paths and in these folders: their names and contents."""
    found: list[tuple[str, Path]] = []
    for path in paths:
        if path.is_dir():
            inside = sorted(p for p in path.rglob("*") if p.is_file() and not _is_hidden(p.relative_to(path)))
            prefix = "" if len(paths) == 1 else f"{path.name}/"
            found.extend((prefix + p.relative_to(path).as_posix(), p) for p in inside)
        else:
            found.append((str(path), path))
    try:
        whole = sum(path.stat().st_size for _, path in found)
        if len(found) > _MOST_FILES or whole > _MOST_BYTES:
            raise _native.Error(
                f"the submission has {len(found)} files of {whole >> 20} MiB: at most {_MOST_FILES} files of {_MOST_BYTES >> 20} MiB "
                "are read"
            )
        read = [(name, path.read_bytes()) for name, path in found]
    except OSError as error:
        raise _native.Error(f"cannot read `{error.filename}`: {error.strerror}") from None
    if not read:
        raise _native.Error("there are no files to check")
    return read


def _is_hidden(path: Path) -> bool:
    return any(part.startswith((".", "__MACOSX")) for part in path.parts)
