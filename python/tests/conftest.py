"""What the tests share."""

import os
from pathlib import Path

import pytest


@pytest.fixture
def program() -> str:
    """The command line, with which pictures and numbers are compared."""
    name = os.environ.get("GONIO_PROGRAM")
    assert name and Path(name).is_file(), "GONIO_PROGRAM must name the command line; `cargo xtask test --only python` sets it"
    return name


@pytest.fixture(autouse=True)
def in_an_empty_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
