"""Draws pictures with the Python package, by one plain process for each core or by a Ray cluster.

    gonio_ray.py plain CORES PICTURES SIZE
    gonio_ray.py cluster CORES PICTURES SIZE [kill]

Prints `result`, seconds, the number of pictures, and of different numbers of pictures. The cluster has one node for each core, and a head without
cores; with `kill`, one of its workers is killed after a third of the pictures. Its start does not count, nor do imports; that of the
workers and of their OpenGL contexts does.
"""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

BATCH = 16


def row(number: int, pictures: int) -> dict[str, object]:
    return {"id": number, "scene": "builtin:suzanne", "options": '{"camera": {"yaw": %.4f}}' % (number * 360 / pictures)}


def options(size: str) -> dict[str, object]:
    width, height = map(int, size.split("x"))
    return {"size": (width, height), "samples": 1}


def share(begin: int, end: int, pictures: int, size: str) -> None:
    """A plain process: waits for its start, and draws its share."""
    from gonio.ray import RenderPictures

    print("ready", flush=True)
    sys.stdin.readline()
    draw = RenderPictures(**options(size))
    ids: list[int] = []
    bytes_ = 0
    for first in range(begin, end, BATCH):
        rows = [row(number, pictures) for number in range(first, min(first + BATCH, end))]
        drawn = draw({key: [one[key] for one in rows] for key in rows[0]})
        bytes_ += sum(len(png) for png in drawn["picture"])
        ids += drawn["id"]
    print(len(ids), len(set(ids)), bytes_, flush=True)


def plain(cores: int, pictures: int, size: str) -> None:
    bounds = [pictures * n // cores for n in range(cores + 1)]
    processes = [
        subprocess.Popen(
            [sys.executable, __file__, "share", str(begin), str(end), str(pictures), size],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        for begin, end in zip(bounds, bounds[1:])
    ]
    for process in processes:
        process.stdout.readline()
    start = time.perf_counter()
    for process in processes:
        process.stdin.write("\n")
        process.stdin.flush()
    answers = [list(map(int, process.stdout.readline().split())) for process in processes]
    seconds = time.perf_counter() - start
    for process in processes:
        process.communicate()
    print("result", seconds, sum(answer[0] for answer in answers), sum(answer[1] for answer in answers))


def workers(cluster: object) -> list[int]:
    raylets = {node.all_processes["raylet"][0].process.pid for node in cluster.list_all_nodes()}
    found = []
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            title = (folder / "cmdline").read_bytes()
            parent = int((folder / "stat").read_text().rpartition(")")[2].split()[1])
        except OSError:
            continue
        if parent in raylets and b"RenderPictures" in title:
            found.append(int(folder.name))
    return sorted(found)


def cluster(cores: int, pictures: int, size: str, kill: bool) -> None:
    import gonio.ray
    import ray
    from ray.cluster_utils import Cluster

    memory = {"object_store_memory": 200 << 20}
    nodes = Cluster(initialize_head=True, head_node_args={"num_cpus": 0, "include_dashboard": False, **memory})
    for _ in range(cores):
        nodes.add_node(num_cpus=1, **memory)
    ray.init(address=nodes.address, log_to_driver=False, logging_level="ERROR")
    ray.data.DataContext.get_current().enable_progress_bars = False
    rows = [row(number, pictures) for number in range(pictures)]
    views = ray.data.from_items(rows, override_num_blocks=max(cores, pictures // 100))
    drawn = gonio.ray.render_pictures(views, concurrency=cores, batch_size=BATCH, **options(size))
    start = time.perf_counter()
    ids: list[int] = []
    killed = not kill
    # As they come: the plain processes do not convert their pictures either.
    for batch in drawn.iter_batches(batch_size=None, batch_format="pyarrow"):
        ids += batch["id"].to_pylist()
        if not killed and len(ids) > pictures // 3:
            os.kill(workers(nodes)[0], signal.SIGKILL)
            killed = True
    seconds = time.perf_counter() - start
    if not killed:
        sys.exit("no worker was killed")
    print("result", seconds, len(ids), len(set(ids)))
    ray.shutdown()
    nodes.shutdown()


if __name__ == "__main__":
    match sys.argv[1:]:
        case ["share", begin, end, pictures, size]:
            share(int(begin), int(end), int(pictures), size)
        case ["plain", cores, pictures, size]:
            plain(int(cores), int(pictures), size)
        case ["cluster", cores, pictures, size, *rest]:
            cluster(int(cores), int(pictures), size, rest == ["kill"])
        case _:
            sys.exit(__doc__)
