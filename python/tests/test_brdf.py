"""BRDFs."""

import json
import subprocess

import gonio
import numpy as np
import pytest


def test_values_are_those_of_the_formula() -> None:
    lambert = gonio.brdf("lambert:a=0.8/0.4/0.2")
    values = lambert.eval([[0, 0, 1], [0, 3, 4], [0, 0, -1]], [0.6, 0, 0.8])
    expected = np.array([0.8, 0.4, 0.2]) / np.pi
    assert np.allclose(values, [expected, expected, [0, 0, 0]], rtol=1e-15)
    assert values.shape == (3, 3) and values.dtype == np.float64


def test_directions_are_broadcast() -> None:
    ggx = gonio.brdf("ggx:alpha=0.3")
    wi = np.random.default_rng(1).normal(size=(4, 1, 3))
    wo = np.random.default_rng(2).normal(size=(5, 3))
    wi[..., 2], wo[..., 2] = abs(wi[..., 2]), abs(wo[..., 2])
    values = ggx.eval(wi, wo)
    assert values.shape == (4, 5, 3)
    assert np.allclose(values[2, 3], ggx.eval(wi[2, 0], wo[3]), rtol=1e-15)
    # Reciprocal, and of arrays that are not contiguous.
    assert np.allclose(ggx.eval(wo[:, None][:, ::-1], np.swapaxes(wi, 0, 1)), np.swapaxes(values, 0, 1), rtol=1e-9)
    assert ggx.density(wi, wo).shape == (4, 5)
    assert ggx.eval(np.zeros((0, 3)), [0, 0, 1]).shape == (0, 3)


def test_checks_and_fits(program: str) -> None:
    ward = gonio.brdf("ward:b=1,c=0.5")
    printed = subprocess.run([program, "brdf", "check", ward.name, "--json"], capture_output=True, text=True).stdout
    expected = json.loads(printed)["functions"][0]["properties"]
    found = ward.check()
    assert [(p.name, p.passed, p.value) for p in found] == [(p["property"], p["passed"], p["value"]) for p in expected]
    assert not all(p.passed for p in found)
    fits = gonio.brdf("beckmann:alpha=0.25").fit(["ward", "beckmann"])
    assert [fit.model for fit in fits] == ["beckmann", "ward"]
    assert fits[0].rms < 1e-4 < fits[1].rms
    assert abs(gonio.brdf(fits[0].spec).parameters["alpha"] - 0.25) < 0.005


def test_functions_of_files() -> None:
    with open("mine.glsl", "w") as file:
        file.write("vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y) { return vec3(0.25); }\n")
    assert np.allclose(gonio.brdf("mine.glsl").eval([0, 0.6, 0.8], [0, 0, 1]), 0.25)
    with open("wrong.glsl", "w") as file:
        file.write("vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y) {\n  return 0.25; }\n")
    with pytest.raises(gonio.Error, match=r"wrong\.glsl:2:"):
        gonio.brdf("wrong.glsl")


@pytest.mark.parametrize(
    ("wi", "wo", "text"),
    [
        ([0, 0, 0], [0, 0, 1], "direction 0, .* has no length"),
        ([0, 0, float("nan")], [0, 0, 1], "not finite"),
        ([0, 1], [0, 0, 1], r"invalid directions of the shapes \(2,\) and \(3,\)"),
        (np.ones((2, 3)), np.ones((4, 3)), "cannot be broadcast"),
    ],
)
def test_errors_of_directions(wi: object, wo: object, text: str) -> None:
    with pytest.raises(gonio.Error, match=text):
        gonio.brdf("ggx").eval(wi, wo)


def test_errors_of_models() -> None:
    with pytest.raises(gonio.Error, match="gxx"):
        gonio.brdf("gxx")
    with pytest.raises(gonio.Error, match="cannot read `absent.binary`"):
        gonio.brdf("absent.binary")
    with pytest.raises(gonio.Error, match="nonsense"):
        gonio.brdf("ggx").fit("nonsense")
    assert "ggx" in gonio.brdf_models()
