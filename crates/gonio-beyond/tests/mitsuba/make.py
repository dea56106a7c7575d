"""Traces two scenes with Mitsuba 3: what the tests of `fog/tracking.rs` and `polarisation/mueller.rs` compare with.

    pip install mitsuba==3.9.1
    python3 make.py > reference.txt

`crossed` is light of a white panel that a plate of glass and then water reflect, with planes of incidence that are turned by an
angle (degrees) against each other: its Stokes vector's first component and the length of the second and third. `slab` is the
light of a white sky that a medium reflects, by the cosine of the direction of sight: its extinction is 0.4 in the upper
quarter, 3.6 in the lower one, and linear between. Each number has its standard error beside it.
"""

import math
import statistics

import mitsuba as mi

GLASS, WATER, INCIDENCE = 1.5, 1.333, math.radians(70.0)
TURNS = [0.0, 20.0, 45.0, 70.0, 90.0]
COSINES = [1.0, 0.7, 0.4, 0.15]
EXTINCTION, ALBEDO, G = [0.4, 3.6], 0.9, 0.6
SEEDS = 32


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(v):
    length = math.sqrt(sum(c * c for c in v))
    return [c / length for c in v]


def along(origin, direction, distance):
    return [o + d * distance for o, d in zip(origin, direction)]


def reflected(direction, normal):
    cos = sum(d * n for d, n in zip(direction, normal))
    return [d - 2.0 * cos * n for d, n in zip(direction, normal)]


def placed(origin, normal, size):
    up = [1.0, 0.0, 0.0] if abs(normal[0]) < 0.9 else [0.0, 1.0, 0.0]
    look = mi.ScalarTransform4f().look_at(origin=origin, target=along(origin, normal, 1.0), up=up)
    return look @ mi.ScalarTransform4f().scale(size)


def estimates(runs):
    for values in zip(*runs):
        yield statistics.fmean(values), statistics.stdev(values) / math.sqrt(len(values))


def camera(origin, direction):
    up = [1.0, 0.0, 0.0] if abs(direction[0]) < 0.9 else [0.0, 1.0, 0.0]
    return {
        "type": "perspective",
        "fov": 0.01,
        "to_world": mi.ScalarTransform4f().look_at(origin=origin, target=along(origin, direction, 1.0), up=up),
        "film": {"type": "hdrfilm", "width": 1, "height": 1, "rfilter": {"type": "box"}, "pixel_format": "rgb"},
    }


def crossed(turn):
    """The camera sees water, in the water the glass, in the glass the panel."""
    sight = [math.sin(INCIDENCE), 0.0, -math.cos(INCIDENCE)]
    water = [0.0, 0.0, 1.0]
    after = reflected(sight, water)
    # The glass's normal: at the same angle of incidence, turned about the ray.
    side = unit(cross(sight, water))
    across = cross(side, after)
    angle = math.radians(turn)
    tilt = [math.cos(angle) * a + math.sin(angle) * s for a, s in zip(across, side)]
    glass = [-math.cos(INCIDENCE) * k + math.sin(INCIDENCE) * t for k, t in zip(after, tilt)]
    mirror = along([0.0, 0.0, 0.0], after, 10.0)
    last = reflected(after, glass)
    panel = along(mirror, last, 10.0)
    scene = mi.load_dict({
        "type": "scene",
        "integrator": {"type": "stokes", "nested": {"type": "path", "max_depth": 4}},
        "sensor": camera(along([0.0, 0.0, 0.0], sight, -10.0), sight),
        "water": {"type": "rectangle", "to_world": placed([0.0] * 3, water, 0.5), "bsdf": {"type": "dielectric", "int_ior": WATER, "ext_ior": 1.0}},
        "glass": {"type": "rectangle", "to_world": placed(mirror, glass, 0.5), "bsdf": {"type": "dielectric", "int_ior": GLASS, "ext_ior": 1.0}},
        "panel": {"type": "rectangle", "to_world": placed(panel, [-c for c in last], 0.5), "emitter": {"type": "area", "radiance": {"type": "spectrum", "value": 1.0}}},
    })
    # The panel itself: a spectrum of ones is not 1 in G.
    direct = mi.load_dict(camera(along(mirror, last, 1.0), last))
    white = mi.render(scene, sensor=direct, spp=400000, seed=0).numpy().flatten()[1]
    runs = []
    for seed in range(SEEDS):
        # R, G, B of the picture, then of each component.
        pixel = mi.render(scene, spp=80000, seed=seed).numpy().flatten()
        s = [pixel[3 + 3 * component + 1] / white for component in range(4)]
        runs.append([s[0], math.hypot(s[1], s[2])])
    return estimates(runs)


def slab(cosine):
    sine = math.sqrt(1.0 - cosine * cosine)
    grid = mi.TensorXf([value for value in EXTINCTION[::-1] for _ in range(4)], shape=(2, 2, 2, 1))
    to_world = mi.ScalarTransform4f().scale([2000.0, 2000.0, 1.0]) @ mi.ScalarTransform4f().translate([-0.5, -0.5, 0.0])
    scene = mi.load_dict({
        "type": "scene",
        "integrator": {"type": "volpath", "max_depth": 1000, "rr_depth": 1000},
        "sensor": camera([-10.0 * sine, 0.0, 1.0 + 10.0 * cosine], [sine, 0.0, -cosine]),
        "sky": {"type": "constant", "radiance": {"type": "rgb", "value": 1.0}},
        "slab": {
            "type": "cube",
            "to_world": mi.ScalarTransform4f().translate([0.0, 0.0, 0.5]) @ mi.ScalarTransform4f().scale([1000.0, 1000.0, 0.5]),
            "bsdf": {"type": "null"},
            "interior": {
                "type": "heterogeneous",
                "albedo": ALBEDO,
                "sigma_t": {"type": "gridvolume", "grid": mi.VolumeGrid(grid), "to_world": to_world, "filter_type": "trilinear", "wrap_mode": "clamp", "raw": True},
                "phase": {"type": "hg", "g": G},
            },
        },
        "ground": {"type": "rectangle", "to_world": mi.ScalarTransform4f().translate([0.0, 0.0, -0.01]) @ mi.ScalarTransform4f().scale(1500.0), "bsdf": {"type": "diffuse", "reflectance": {"type": "rgb", "value": 0.0}}},
    })
    return estimates([[mi.render(scene, spp=4000, seed=seed).numpy().flatten()[1]] for seed in range(SEEDS)])


def write(name, at, found):
    print(name, at, *(f"{number:.6g}" for estimate in found for number in estimate), flush=True)


print(f"# Mitsuba {mi.__version__}: see make.py")
mi.set_variant("scalar_spectral_polarized")
for turn in TURNS:
    write("crossed", turn, crossed(turn))
mi.set_variant("scalar_rgb")
for cosine in COSINES:
    write("slab", cosine, slab(cosine))
