"""Pictures, probes and traces, against the command line."""

import _thread
import json
import os
import subprocess
import sys
import threading
import warnings

import gonio
import numpy as np
import pytest


def run(program: str, *arguments: str) -> str:
    done = subprocess.run([program, *arguments], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def read(path: str) -> bytes:
    with open(path, "rb") as file:
        return file.read()


@pytest.mark.parametrize("backend", ["gl", "cpu"])
def test_a_picture_is_that_of_the_command_line(program: str, backend: str) -> None:
    run(program, "render", "builtin:suzanne", "--size", "200x100", "--backend", backend, "-o", "expected.exr")
    scene = gonio.Scene("builtin:suzanne")
    # In another shape than the scene's own, which moves its camera.
    assert scene.render(size=(200, 100), backend=backend).exr() == read("expected.exr")
    assert gonio.Scene("builtin:suzanne", size=(200, 100)).render(backend=backend).exr() == read("expected.exr")
    assert scene.render(size=(201, 100), backend=backend).exr() != read("expected.exr")


def test_a_displayed_picture_is_that_of_the_command_line(program: str) -> None:
    # By OpenGL the command line encodes on the GPU, with other roundings.
    run(program, "render", "builtin:suzanne", "--size", "100x80", "--backend", "cpu", "-o", "expected.png")
    picture = gonio.Scene("builtin:suzanne", size=(100, 80)).render(backend="cpu")
    picture.save("ours.png")
    assert read("ours.png") == read("expected.png")


def test_options_are_those_of_the_command_line(program: str) -> None:
    options = ["--size", "160x120", "--yaw", "40", "--specular", "phong", "--shading", "flat", "--environment", "sky"]
    light = "point position=3,5,4 intensity=1.5"
    more = ["--light", light, "--material", "shininess=9,diffuse=#ff8800", "--samples", "1", "--background", "0.5"]
    run(program, "render", "builtin:still-life", *options, *more, "-o", "expected.exr")
    scene = gonio.Scene(
        "builtin:still-life",
        size=(160, 120),
        samples=1,
        camera={"yaw": np.float64(40)},
        equation={"specular": "phong"},
        shading="flat",
        environment="sky",
        light=[light],
        material={"shininess": 9, "diffuse": "#ff8800"},
        background={"top": [0.5] * 3, "bottom": (0.5, 0.5, 0.5)},
    )
    assert scene.render().exr() == read("expected.exr")


def test_layers_have_names_and_are_those_of_the_command_line(program: str) -> None:
    size = ["--size", "120x90"]
    run(program, "render", "builtin:suzanne", *size, "--views", "normal,diffuse:1,depth", "-o", "expected.exr")
    picture = gonio.Scene("builtin:suzanne", size=(120, 90)).render(layers=["normal", "diffuse:1", "depth"])
    assert list(picture) == ["picture", "normal", "diffuse:1", "depth"]
    picture.save("ours.exr")
    assert read("ours.exr") == read("expected.exr")
    normal = picture["normal"]
    assert (normal.dtype, normal.shape) == (np.float32, (90, 120, 4))
    inside = picture["depth"][30:60, 40:80]
    lengths = np.linalg.norm(normal[30:60, 40:80, :3], axis=-1)[inside[..., 0] > 0]
    assert lengths.size > 100 and np.median(np.abs(lengths - 1)) < 1e-3
    with pytest.raises(KeyError, match="the picture has picture, normal"):
        picture["specular"]


def test_arrays_share_memory_and_outlive_the_picture() -> None:
    picture = gonio.Scene("builtin:cube", size=(40, 30)).render()
    first, second = picture.array, picture.array
    assert np.shares_memory(first, second)
    assert not first.flags.writeable
    with pytest.raises(ValueError, match="read-only"):
        first[0, 0] = 1
    before = first.copy()
    del picture, second
    gonio.Scene("builtin:suzanne", size=(40, 30)).render()
    assert np.array_equal(first, before)
    assert before.flags.writeable and np.array_equal(np.asarray(before, dtype=np.float64), before)


def test_displayed_values_are_those_of_the_png() -> None:
    picture = gonio.Scene("builtin:cube", size=(40, 30), background={"top": [0.5] * 3, "bottom": "#bcbcbc"}).render()
    displayed = picture.srgb8()
    assert (displayed.dtype, displayed.shape) == (np.uint8, (30, 40, 4))
    # Half of the light is sRGB 188.
    assert displayed[0, 0].tolist() == [188, 188, 188, 255]
    assert picture._repr_png_().startswith(b"\x89PNG") and picture._repr_png_() == picture.png()


def test_a_probe_has_every_term(program: str) -> None:
    printed = run(program, "probe", "builtin:suzanne", "--size", "200x150", "--at", "100,75", "--json")
    expected = json.loads(printed)
    probe = gonio.Scene("builtin:suzanne").probe(100, 75, size=(200, 150))
    assert probe.hit and probe.data == expected["probe"]
    assert probe.value.tolist() == expected["reference"]
    terms = probe.terms
    whole = terms["ambient"] + terms["emitted"] + terms["diffuse"] + terms["specular"]
    assert np.allclose(whole, terms["total"], rtol=1e-12)
    assert len(probe.lights) == 3 and np.array_equal(probe["diffuse"], terms["diffuse"])
    assert not gonio.Scene("builtin:suzanne").probe(0, 0).hit
    with pytest.raises(gonio.Error, match="pixel -1,0 is outside the picture of 1024x768 pixels"):
        gonio.Scene("builtin:suzanne").probe(-1, 0)


def test_a_trace_depends_on_its_seed_alone(program: str) -> None:
    run(program, "trace", "builtin:suzanne", "--samples", "5", "--seed", "3", "--size", "48x36", "-o", "expected.png")
    scene = gonio.Scene("builtin:suzanne", size=(48, 36))
    traced = scene.trace(5, seed=3)
    assert traced.png() == read("expected.png")
    assert not np.array_equal(scene.trace(5, seed=4).array, traced.array)
    assert 0 < traced.error < 1 and (traced["variance"] >= 0).all() and traced.samples == 5


def test_other_threads_run_meanwhile() -> None:
    scene = gonio.Scene("builtin:suzanne", size=(64, 48))
    scene.render()
    begun, ran = threading.Event(), threading.Event()

    def other() -> None:
        begun.wait()
        ran.set()

    interval = sys.getswitchinterval()
    # Python itself never switches in this time: the other thread runs only if gonio lets it.
    sys.setswitchinterval(1000)
    try:
        thread = threading.Thread(target=other)
        thread.start()
        begun.set()
        scene.trace(64)
        assert ran.is_set()
    finally:
        sys.setswitchinterval(interval)
    thread.join()


def test_ctrl_c_ends_a_trace() -> None:
    scene = gonio.Scene("builtin:suzanne", size=(320, 240))
    timer = threading.Timer(0.5, _thread.interrupt_main)
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        scene.trace(1 << 30)
    timer.join()


def test_many_threads_draw_their_own_pictures() -> None:
    expected = [gonio.Scene("builtin:cube", size=(32, 24), camera={"yaw": 20 * n}).render().png() for n in range(8)]
    assert len(set(expected)) == 8
    scenes = [gonio.Scene("builtin:cube", size=(32, 24), camera={"yaw": 20 * n}) for n in range(8)]
    found: list[set[bytes]] = [set() for _ in scenes]

    def draw(n: int) -> None:
        for _ in range(12):
            found[n].add(scenes[n].render().png())

    threads = [threading.Thread(target=draw, args=(n,)) for n in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [{png} for png in expected]


def test_a_moving_light_and_time() -> None:
    light = "point position=2,2,2 motion=circle period=4 center=0,2,0"
    scene = gonio.Scene("builtin:cube", size=(64, 48), light=[light])
    first, later, again = (scene.render(time=time).png() for time in (0.0, 1.0, 0.0))
    assert first == again and first != later


@pytest.mark.parametrize(
    ("arguments", "options", "text"),
    [
        (["missing.obj"], {}, r"missing\.obj: there is no such file"),
        ([], {}, "nothing to read: name a model"),
        (["builtin:cube"], {"camera": {"fov": 3}}, "camera: unknown field `fov`, expected one of"),
        (["builtin:cube"], {"shadin": "flat"}, "unknown option `shadin`: .*; did you mean `shading`?"),
        (["builtin:cube"], {"shading": "flatt"}, "flatt"),
        (["builtin:cube"], {"camera": 3}, "camera: expected a dict"),
        (["builtin:cube"], {"light": ["sun"]}, "sun"),
        (["builtin:cube"], {"size": (0, 3)}, "`width` of the picture must be 1 to 16384 pixels, not 0"),
        (["builtin:cube"], {"samples": 3}, "`samples` must be 1, 2, 4, 8 or 16, not 3"),
        (["builtin:cube"], {"camera": {"yaw": object()}}, "invalid value <object .* of an option"),
        (["builtin:suzanne"], {"max_triangles": 100}, "100"),
    ],
)
def test_errors_say_what_is_wrong(arguments: list[str], options: dict[str, object], text: str) -> None:
    with pytest.raises(gonio.Error, match=text) as caught:
        gonio.Scene(*arguments, **options)
    assert "\n" not in str(caught.value)


def test_memory_is_limited() -> None:
    with open("long.obj", "w") as file:
        file.write("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n" * 100)
    gonio.Scene("long.obj", max_memory=1 << 20)
    with pytest.raises(gonio.Error, match="long.obj: .*; max_memory=BYTES raises the limit"):
        gonio.Scene("long.obj", max_memory=1000)


def test_errors_of_views_and_backends() -> None:
    scene = gonio.Scene("builtin:cube", size=(16, 12))
    with pytest.raises(gonio.Error, match="invalid debug view `difuse`"):
        scene.render("difuse")
    with pytest.raises(gonio.Error, match="there is no light 9; the scene has 4"):
        scene.render("diffuse:9")
    with pytest.raises(gonio.Error, match="invalid backend `vulkan`"):
        scene.render(backend="vulkan")
    with pytest.raises(gonio.Error, match="not 3"):
        scene.render(samples=3)
    with pytest.raises(gonio.Error, match="invalid time NaN"):
        scene.render(time=float("nan"))
    with pytest.raises(gonio.Error, match="samples and max_depth must be at least 1"):
        scene.trace(0)
    with pytest.raises(gonio.Error, match=r"expected a name that ends in \.png"):
        scene.render().save("picture.jpg")


def test_a_file_cannot_leave_its_folder_in_the_sandbox() -> None:
    os.makedirs("inside")
    with open("secret.mtl", "w") as file:
        file.write("newmtl a\nKd 1 0 0\n")
    with open("inside/model.obj", "w") as file:
        file.write("mtllib ../secret.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    red = gonio.Scene("inside/model.obj", size=(16, 16)).render("albedo").array
    assert [1, 0, 0, 1] in red.reshape(-1, 4).tolist()
    with pytest.warns(gonio.SceneWarning) as caught:
        kept = gonio.Scene("inside/model.obj", size=(16, 16), sandbox=True)
    assert any("secret.mtl" in str(warning.message) for warning in caught)
    assert [1, 0, 0, 1] not in kept.render("albedo").array.reshape(-1, 4).tolist()


def test_oddities_are_warnings() -> None:
    with open("odd.obj", "w") as file:
        file.write("usemtl absent\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    with pytest.warns(gonio.SceneWarning, match="absent"):
        gonio.Scene("odd.obj")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        gonio.Scene("builtin:suzanne")


def test_inspect_is_that_of_the_command_line(program: str) -> None:
    expected = json.loads(run(program, "inspect", "builtin:suzanne", "--json"))["model"]
    assert gonio.inspect("builtin:suzanne") == expected


@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system has no fork")
def test_a_forked_process_is_told_so() -> None:
    script = (
        "import gonio, os, sys\n"
        "gonio.Scene('builtin:cube', size=(8, 8)).render()\n"
        "if os.fork() == 0:\n"
        "    try:\n"
        "        gonio.Scene('builtin:cube')\n"
        "    except gonio.Error as error:\n"
        "        os._exit(7 if 'spawn' in str(error) else 1)\n"
        "    os._exit(0)\n"
        "sys.exit(os.waitstatus_to_exitcode(os.wait()[1]))\n"
    )
    assert subprocess.run([sys.executable, "-c", script]).returncode == 7


def test_without_opengl_the_cpu_draws() -> None:
    script = (
        "import gonio\n"
        "scene = gonio.Scene('builtin:cube', size=(16, 12))\n"
        "picture = scene.render()\n"
        "assert picture.backend.startswith('the CPU reference: '), picture.backend\n"
        "assert picture.png() == scene.render(backend='cpu').png()\n"
        "try:\n"
        "    scene.render(backend='gl')\n"
        "except gonio.Error as error:\n"
        "    assert str(error).endswith('; backend=\"cpu\" needs no OpenGL'), error\n"
        "else:\n"
        "    raise AssertionError('OpenGL drew')\n"
    )
    # Mesa finds no drivers here.
    hidden = {**os.environ, "__EGL_VENDOR_LIBRARY_DIRS": os.getcwd(), "__EGL_VENDOR_LIBRARY_FILENAMES": ""}
    done = subprocess.run([sys.executable, "-c", script], env=hidden, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
