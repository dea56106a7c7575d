"""Evaluates BSDFs with Mitsuba 3 and writes the numbers that ../mitsuba.rs compares with.

    pip install mitsuba==3.9.1 numpy
    python3 make.py > reference.txt

The variant computes in f32. Parts of `principled` are differences of two evaluations.
"""

import math

import mitsuba as mi
import numpy as np

mi.set_variant("scalar_rgb")

PAIRS = 1000
TRANSMITTING = "roughdielectric"
REFLECTANCE = {"type": "rgb", "value": 0.6}


def conductor(distribution, **alpha):
    return {"type": "roughconductor", "material": "none", "distribution": distribution, **alpha}


def principled(color, **values):
    color = color if isinstance(color, list) else [color] * 3
    return {"type": "principled", "base_color": {"type": "rgb", "value": color}, **values}


PLAIN = dict(roughness=0.4, specular=0.0)
# Each column: what it holds, the BSDF, and one that is subtracted.
COLUMNS = [
    ("diffuse           reflectance 0.6", {"type": "diffuse", "reflectance": REFLECTANCE}, None),
    ("roughconductor    material none, distribution ggx, alpha 0.3", conductor("ggx", alpha=0.3), None),
    ("roughconductor    material none, distribution beckmann, alpha 0.4", conductor("beckmann", alpha=0.4), None),
    (
        "principled        base_color 0.8, metallic 1, roughness 0.6, anisotropic 0.5",
        principled(0.8, metallic=1.0, roughness=0.6, anisotropic=0.5),
        None,
    ),
    (
        "roughdielectric   distribution ggx, alpha 0.3, int_ior 1.5, ext_ior 1",
        {"type": TRANSMITTING, "distribution": "ggx", "alpha": 0.3, "int_ior": 1.5, "ext_ior": 1.0},
        None,
    ),
    (
        "principled        base_color 0.8, roughness 0.4, specular 0, less the same with base_color 0: the diffuse part",
        principled(0.8, **PLAIN),
        principled(0.0, **PLAIN),
    ),
    (
        "principled        the same with sheen 1, sheen_tint 0, less that without sheen",
        principled(0.8, sheen=1.0, sheen_tint=0.0, **PLAIN),
        principled(0.8, **PLAIN),
    ),
    (
        "principled        the same with clearcoat 1, clearcoat_gloss 0.3, less that without clearcoat",
        principled(0.8, clearcoat=1.0, clearcoat_gloss=0.3, **PLAIN),
        principled(0.8, **PLAIN),
    ),
]

HEADER = f"""\
# Written by make.py with Mitsuba {mi.__version__} (variant {mi.variant()}, which computes in f32), six digits.
#
# Columns: cosine and azimuth (radians) of the direction to the light, the same of the direction to the viewer, the side of
# the surface of each for {TRANSMITTING} (1 above, -1 below; the others have both above), then f = eval / |cos theta_i| of:
"""


def direction(cosine, azimuth, side=1.0):
    sine = math.sqrt(max(0.0, 1.0 - cosine * cosine))
    return mi.Vector3f(sine * math.cos(azimuth), sine * math.sin(azimuth), side * cosine)


def main():
    random = np.random.default_rng(19)
    rows = []
    for _ in range(PAIRS):
        cosines = np.round(random.uniform(0.05, 1.0, 2), 3)
        azimuths = np.round(random.uniform(0.0, 6.283, 2), 3)
        sides = random.choice([-1, 1], 2)
        rows.append((cosines[0], azimuths[0], cosines[1], azimuths[1], sides[0], sides[1]))
    loaded = [(mi.load_dict(bsdf), mi.load_dict(less) if less else None, bsdf["type"]) for _, bsdf, less in COLUMNS]
    context = mi.BSDFContext()

    def value(bsdf, light, viewer):
        si = mi.SurfaceInteraction3f()
        si.wi = viewer
        si.sh_frame = mi.Frame3f(mi.Vector3f(0, 0, 1))
        return bsdf.eval(context, si, light)[0] / abs(light.z)

    print(HEADER + "".join(f"#   {column}\n" for column, _, _ in COLUMNS).rstrip())
    for row in rows:
        numbers = []
        for bsdf, less, kind in loaded:
            sides = row[4:] if kind == TRANSMITTING else (1.0, 1.0)
            light, viewer = direction(row[0], row[1], sides[0]), direction(row[2], row[3], sides[1])
            f = value(bsdf, light, viewer) - (value(less, light, viewer) if less else 0.0)
            numbers.append(f"{f:.6g}")
        place = [f"{x:g}" for x in row]
        print(" ".join(place + numbers))


main()
