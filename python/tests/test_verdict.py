"""Verdicts, against the command line."""

import json
import os
import subprocess
from pathlib import Path

import gonio
import pytest
from shaders import ENDLESS, RIGHT, WRONG


def write(folder: str, files: dict[str, str]) -> str:
    os.makedirs(folder)
    for name, text in files.items():
        Path(folder, name).write_text(text)
    return folder


def rounded(value: object) -> object:
    """The command line reads the verdict from its own worker, which rounds numbers of 32 bits in another way."""
    if isinstance(value, float):
        return float(f"{value:.6g}")
    if isinstance(value, list):
        return [rounded(one) for one in value]
    return {key: rounded(one) for key, one in value.items()} if isinstance(value, dict) else value


def test_right_and_wrong_answers(program: str) -> None:
    assert gonio.check("ex04", RIGHT).is_correct
    verdict = gonio.check("4", write("mine", WRONG))
    assert (verdict.outcome, verdict.is_correct) == ("wrong", False)
    [cause] = verdict.causes
    assert (cause.id, cause.file, cause.line) == ("diffuse-absolute", "answer.frag", 12)
    done = subprocess.run([program, "lab", "check", "ex04", "mine", "--json"], capture_output=True, text=True)
    assert rounded(verdict.data) == rounded(json.loads(done.stdout))
    assert gonio.check("ex04", ["mine/answer.vert", "mine/answer.frag"]).causes[0].id == "diffuse-absolute"


def test_a_notebook_shows_the_page() -> None:
    verdict = gonio.check("ex04", WRONG)
    shown = verdict._repr_html_()
    assert shown.startswith("<iframe sandbox srcdoc=") and "data:image/png" in shown
    # The page is within the attribute: nothing ends it.
    assert shown.count('"') == 6 and "<script" not in shown
    assert verdict.summary in verdict.page


def test_feedback_may_be_less() -> None:
    verdict = gonio.check("ex04", WRONG, feedback="verdict")
    assert verdict.outcome == "wrong" and not verdict.causes
    with pytest.raises(gonio.Error, match="invalid feedback `all`: expected verdict, name, line, fix"):
        gonio.check("ex04", WRONG, feedback="all")


def test_a_check_that_does_not_end_is_stopped() -> None:
    # Too short for any process.
    verdict = gonio.check("ex04", RIGHT, patience=0.001)
    assert verdict.outcome == "unsure" and verdict.score == 0
    assert gonio.check("ex04", ENDLESS).outcome in ("unsure", "wrong")


def test_files_that_cannot_be_checked() -> None:
    with pytest.raises(gonio.Error, match="cannot read `absent.frag`: No such file"):
        gonio.check("ex04", "absent.frag")
    with pytest.raises(gonio.Error, match="there is no exercise `ex99`; the exercises are"):
        gonio.check("ex99", RIGHT)
    os.makedirs("empty/.git")
    Path("empty/.git/config").write_text("")
    with pytest.raises(gonio.Error, match="there are no files to check"):
        gonio.check("ex04", "empty")


def test_modules_in_the_current_folder_are_not_run() -> None:
    Path("json.py").write_text("raise SystemExit(1)")
    Path("gonio.py").write_text("raise SystemExit(1)")
    assert gonio.check("ex04", RIGHT).is_correct


def test_every_exercise_has_files_to_start_from() -> None:
    found = {exercise.id: exercise for exercise in gonio.exercises()}
    assert "ex04" in found and any(name.endswith(".frag") for name in found["ex04"].files)
