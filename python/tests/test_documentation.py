"""The examples of the documentation, page by page, each page in an empty folder."""

import re
from pathlib import Path

import pytest
import ray

ROOT = Path(__file__).parents[2]
BLOCK = re.compile(r"^```python\n(.*?)^```$", re.MULTILINE | re.DOTALL)


@pytest.mark.parametrize(("page", "least"), [("docs/python.md", 9), ("python/README.md", 2)])
def test_examples_run(page: str, least: int) -> None:
    text = (ROOT / page).read_text(encoding="utf-8")
    blocks = list(BLOCK.finditer(text))
    assert len(blocks) >= least
    names: dict[str, object] = {}
    try:
        for block in blocks:
            # Lines of errors are those of the page.
            above = "\n" * text[: block.start(1)].count("\n")
            exec(compile(above + block[1], page, "exec"), names)
    finally:
        # An example starts it.
        ray.shutdown()


def test_every_name_is_documented() -> None:
    import gonio

    for name in gonio.__all__:
        assert (getattr(gonio, name).__doc__ or "").strip(), name
