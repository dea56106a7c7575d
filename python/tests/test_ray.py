"""gonio on a real cluster: several nodes on this machine, each with processes of its own."""

import os
import signal
import sys
from collections.abc import Iterator
from pathlib import Path

import gonio
import gonio.ray
import numpy as np
import pytest
import ray
from ray.cluster_utils import Cluster
from shaders import RIGHT, WRONG


NODES = 2
PICTURES = 10_000
SIZE = (24, 18)


@pytest.fixture(scope="module")
def cluster() -> Iterator[Cluster]:
    memory = {"object_store_memory": 150 << 20}
    # The head has no cores: all work is done by the other nodes.
    cluster = Cluster(initialize_head=True, head_node_args={"num_cpus": 0, "include_dashboard": False, **memory})
    for _ in range(NODES):
        cluster.add_node(num_cpus=1, **memory)
    ray.init(address=cluster.address, log_to_driver=False, logging_level="ERROR")
    ray.data.DataContext.get_current().enable_progress_bars = False
    yield cluster
    ray.shutdown()
    cluster.shutdown()


def workers(cluster: Cluster, name: str) -> set[int]:
    """The processes of the nodes that run a transform."""
    raylets = {node.all_processes["raylet"][0].process.pid for node in cluster.list_all_nodes()}
    found = set()
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            title = (folder / "cmdline").read_bytes()
            parent = int((folder / "stat").read_text().rpartition(")")[2].split()[1])
        except OSError:
            continue
        if parent in raylets and name.encode() in title:
            found.add(int(folder.name))
    return found


def yaw(number: int) -> float:
    return number * 360 / PICTURES


def test_ten_thousand_pictures_and_a_worker_that_dies(cluster: Cluster) -> None:
    rows = [{"id": n, "scene": "builtin:cube", "options": {"camera": {"yaw": yaw(n)}}} for n in range(PICTURES)]
    views = ray.data.from_items(rows, override_num_blocks=PICTURES // 100)
    pictures = gonio.ray.render_pictures(views, size=SIZE, concurrency=NODES)
    found: list[tuple[int, bytes]] = []
    killed: set[int] = set()
    seen: set[int] = set()
    for batch in pictures.iter_batches(batch_size=100):
        found.extend(zip(batch["id"].tolist(), batch["picture"], strict=True))
        if len(found) >= PICTURES // 4 and not killed:
            seen = workers(cluster, "RenderPictures")
            assert len(seen) == NODES, "one worker for each core"
            killed.add(min(seen))
            os.kill(min(seen), signal.SIGKILL)
        elif killed:
            seen |= workers(cluster, "RenderPictures")
    assert len(seen) == NODES + 1, "it died while there was work for it, and another took its place"
    assert sorted(number for number, _ in found) == list(range(PICTURES)), "nothing lost, nothing twice"
    for number, png in found[:: PICTURES // 50]:
        expected = gonio.Scene("builtin:cube", size=SIZE, camera={"yaw": yaw(number)}).render().png()
        assert bytes(png) == expected, number


def test_arrays_views_and_times(cluster: Cluster) -> None:
    light = ["point position=2,2,2 motion=circle period=4 center=0,2,0"]
    rows = [{"scene": "builtin:cube", "options": '{"light": ["%s"]}' % light[0], "time": time} for time in (0.0, 1.0)]
    views = ray.data.from_items(rows)
    taken = gonio.ray.render_pictures(views, "diffuse", size=(20, 10), output="linear").take_all()
    scene = gonio.Scene("builtin:cube", size=(20, 10), light=light)
    for row in taken:
        assert row["picture"].dtype == np.float32
        assert np.array_equal(row["picture"], scene.render("diffuse", time=row["time"]).array)
    bytes_ = gonio.ray.render_pictures(views.limit(1), size=(20, 10), output="srgb8").take_all()[0]["picture"]
    assert np.array_equal(bytes_, scene.render().srgb8())


def test_a_scene_that_cannot_be_drawn(cluster: Cluster) -> None:
    views = ray.data.from_items([{"scene": "builtin:cube"}, {"scene": "missing.obj"}])
    with pytest.raises(Exception, match="missing.obj: there is no such file"):
        gonio.ray.render_pictures(views, size=SIZE).take_all()
    kept = {row["scene"]: row for row in gonio.ray.render_pictures(views, size=SIZE, errors="column").take_all()}
    assert kept["builtin:cube"]["error"] == "" and kept["builtin:cube"]["picture"].startswith(b"\x89PNG")
    assert "there is no such file" in kept["missing.obj"]["error"] and kept["missing.obj"]["picture"] is None
    with pytest.raises(gonio.Error, match="invalid output `jpg`: expected png, srgb8, linear"):
        gonio.ray.RenderPictures(output="jpg")


def test_submissions_are_checked(cluster: Cluster, tmp_path: Path) -> None:
    for student, files in (("anna", RIGHT), ("ben", WRONG)):
        (tmp_path / student).mkdir()
        for name, text in files.items():
            (tmp_path / student / name).write_text(text)
    answers = [{"student": s, "files": str(tmp_path / s)} for s in ("anna", "ben", "carl")]
    checked = gonio.ray.check_submissions(ray.data.from_items(answers), "ex04").take_all()
    by_student = {row["student"]: row for row in checked}
    assert by_student["anna"]["outcome"] == "correct" and by_student["anna"]["score"] == 1
    assert by_student["ben"]["outcome"] == "wrong" and list(by_student["ben"]["causes"]) == ["diffuse-absolute"]
    assert by_student["ben"]["line"] == 12
    assert by_student["carl"]["outcome"] == "unsure" and "cannot read" in by_student["carl"]["summary"]


def test_functions_are_fitted(cluster: Cluster) -> None:
    targets = ray.data.from_items([{"brdf": "beckmann:alpha=0.2"}, {"brdf": "ward:c=0.3"}])
    fitted = gonio.ray.fit_brdfs(targets, ["ward", "beckmann"]).take_all()
    assert {row["brdf"]: row["model"] for row in fitted} == {"beckmann:alpha=0.2": "beckmann", "ward:c=0.3": "ward"}
    assert all(row["fit"].startswith(row["model"]) and row["relative"] < 1e-3 for row in fitted)


def test_without_ray_the_reason_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "ray", None)
    with pytest.raises(gonio.Error, match=r'needs Ray: pip install "gonio\[ray\]"'):
        gonio.ray.render_pictures(None)
