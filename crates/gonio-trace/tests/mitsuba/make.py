"""Traces the scenes of scenes.txt with Mitsuba 3 and writes the means of blocks of pixels: what ../mitsuba.rs compares with.

    pip install mitsuba==3.9.1
    python3 make.py [SCENE ...] > reference.txt

With names only these scenes are traced. Glossy and metallic surfaces, which Mitsuba does not have in this form, are written
here from their papers; everything else is Mitsuba's own: rays, lights, sampling, diffuse surfaces, mirrors and glass.
"""

import datetime
import math
import pathlib
import re
import sys
import tempfile
import tomllib

import mitsuba as mi

mi.set_variant("scalar_rgb")

SEEDS = 48
BLOCK = 8
# Samples per pixel and seed; where a surface is written in Python, which takes ten times as long.
NATIVE, PYTHON = 64, 24
SAMPLER = "multijitter"
GLASS = 1.52


class Rough(mi.BSDF):
    """Half of the samples follow the cosine, half the lobe. The derived class gives `value`, `lobe` and `lobe_density`."""

    def __init__(self, props):
        mi.BSDF.__init__(self, props)
        flags = mi.BSDFFlags.DiffuseReflection | mi.BSDFFlags.FrontSide
        self.m_components = [flags]
        self.m_flags = flags

    def eval(self, ctx, si, wo, active=True):
        return self.eval_pdf(ctx, si, wo, active)[0]

    def pdf(self, ctx, si, wo, active=True):
        return self.eval_pdf(ctx, si, wo, active)[1]

    def eval_pdf(self, ctx, si, wo, active=True):
        if si.wi.z <= 0 or wo.z <= 0:
            return mi.Color3f(0), 0.0
        density = 0.5 * wo.z / math.pi + 0.5 * self.lobe_density(si.wi, wo)
        return self.value(si.wi, wo) * wo.z, density

    def sample(self, ctx, si, choice, u, active=True):
        sample = mi.BSDFSample3f()
        if si.wi.z <= 0:
            return sample, mi.Color3f(0)
        wo = mi.warp.square_to_cosine_hemisphere(u) if choice < 0.5 else self.lobe(si.wi, u)
        value, density = self.eval_pdf(ctx, si, wo, active)
        if density <= 0:
            return sample, mi.Color3f(0)
        sample.wo, sample.pdf, sample.eta = wo, density, 1.0
        sample.sampled_type, sample.sampled_component = +mi.BSDFFlags.DiffuseReflection, 0
        return sample, value / density

    def to_string(self):
        return type(self).__name__


def mirrored(wi, half):
    return half * (2 * (wi @ half)) - wi


def about(axis, cos, phi):
    sin = math.sqrt(max(0.0, 1 - cos * cos))
    return mi.Frame3f(axis).to_world(mi.Vector3f(sin * math.cos(phi), sin * math.sin(phi), cos))


class Phong(Rough):
    """`kd / pi + ks (n + 2) / (2 pi) cos^n` about the mirror direction (Lafortune and Willems 1994)."""

    def __init__(self, props):
        Rough.__init__(self, props)
        self.kd, self.ks, self.n = (props[name] for name in ("kd", "ks", "n"))

    def value(self, wi, wo):
        cos = max(0.0, 2 * wi.z * wo.z - wi @ wo)
        lobe = (self.n + 2) / (2 * math.pi) * cos**self.n
        return mi.Color3f(self.kd) / math.pi + mi.Color3f(self.ks) * lobe

    def lobe(self, wi, u):
        return about(mi.Vector3f(-wi.x, -wi.y, wi.z), u.x ** (1 / (self.n + 1)), 2 * math.pi * u.y)

    def lobe_density(self, wi, wo):
        cos = max(0.0, 2 * wi.z * wo.z - wi @ wo)
        return (self.n + 1) / (2 * math.pi) * cos**self.n


class MetallicRoughness(Rough):
    """glTF 2.0, appendix B: GGX with Smith's height-correlated masking, and Schlick's factor. The diffuse part gets what the
    facets' largest channel leaves of even light, at the flatter of both angles: glTF's `1 - F(V.H)` is more than there is."""

    def __init__(self, props):
        Rough.__init__(self, props)
        base, metallic, self.alpha = props["base"], props["metallic"], props["roughness"] ** 2
        self.diffuse = mi.Color3f(base) * (1 - metallic)
        self.f0 = mi.Color3f(0.04) * (1 - metallic) + mi.Color3f(base) * metallic
        # By the square root of the cosine: all that is steep happens at grazing.
        self.albedos = [self.facets_albedo(max(1e-4, (i / 48) ** 2)) for i in range(49)] if metallic < 1 else None

    def facets(self, wi, wo):
        half = mi.Vector3f(wi + wo)
        half = half / math.sqrt(half @ half)
        schlick = (1 - min(1.0, wi @ half)) ** 5
        f = self.f0 + (mi.Color3f(1) - self.f0) * schlick
        g = 1 / (1 + self.smith_lambda(wi.z) + self.smith_lambda(wo.z))
        return f * (self.distribution(half.z) * g / (4 * wi.z * wo.z))

    def facets_albedo(self, cos, rows=64):
        """What the facets reflect of even light: the mean of f cos / density over directions of the lobe."""
        wi, total = mi.Vector3f(math.sqrt(1 - cos * cos), 0, cos), 0.0
        for i in range(rows * rows):
            wo = self.lobe(wi, mi.Point2f((i // rows + 0.5) / rows, (i % rows + 0.5) / rows))
            if wo.z > 0:
                total += max(*self.facets(wi, wo)) * wo.z / self.lobe_density(wi, wo)
        return total / rows**2

    def albedo(self, cos):
        at = min(math.sqrt(cos) * 48, 47.999)
        low = int(at)
        return self.albedos[low] + (at - low) * (self.albedos[low + 1] - self.albedos[low])

    def distribution(self, cos):
        a2 = self.alpha**2
        return a2 / (math.pi * (cos * cos * (a2 - 1) + 1) ** 2)

    def smith_lambda(self, cos):
        tan2 = max(0.0, 1 / (cos * cos) - 1)
        return 0.5 * (math.sqrt(1 + self.alpha**2 * tan2) - 1)

    def value(self, wi, wo):
        left = 1 - max(self.albedo(wi.z), self.albedo(wo.z)) if self.albedos else 0
        return self.diffuse * (left / math.pi) + self.facets(wi, wo)

    def lobe(self, wi, u):
        cos = math.sqrt((1 - u.x) / (1 + (self.alpha**2 - 1) * u.x))
        return mirrored(wi, about(mi.Vector3f(0, 0, 1), cos, 2 * math.pi * u.y))

    def lobe_density(self, wi, wo):
        half = mi.Vector3f(wi + wo)
        half = half / math.sqrt(half @ half)
        return self.distribution(half.z) * half.z / (4 * max(1e-9, wi @ half))


mi.register_bsdf("written_phong", Phong)
mi.register_bsdf("written_metallic_roughness", MetallicRoughness)


def read_scenes(path):
    """The folders of the table, each with its files."""
    scenes, lines = {}, []
    for line in path.read_text().split("\n")[:-1]:
        header = re.fullmatch(r"-- (\S+)/(\S+?)( \[hex\])? --", line)
        if header:
            lines = []
            scenes.setdefault(header[1], {})[header[2]] = (lines, bool(header[3]))
        else:
            lines.append(line)
    for files in scenes.values():
        for name, (lines, is_hex) in files.items():
            text = "\n".join(lines) + "\n"
            files[name] = bytes.fromhex(text) if is_hex else text.encode()
    return scenes


def rgb(value):
    return {"type": "rgb", "value": value}


def material_of(folder, files, spec):
    """Mitsuba's BSDF of an object, and the radiance that it emits."""
    over, mtl = spec.get("material", {}), {}
    library = re.search(r"^mtllib (\S+)", files[spec["model"]].decode(), re.M)
    if library:
        for line in files[library[1]].decode().splitlines():
            key, _, value = line.partition(" ")
            mtl[key] = value
    if over.get("medium") == "glass":
        index = over.get("refraction_index", GLASS)
        return {"type": "dielectric", "int_ior": index, "ext_ior": 1.0}, None
    if over.get("reflectivity") == 1:
        return {"type": "twosided", "bsdf": {"type": "conductor", "material": "none"}}, None
    diffuse = over.get("diffuse") or [float(v) for v in mtl["Kd"].split()]
    if "Pm" in mtl:
        bsdf = {"type": "written_metallic_roughness", "base": mi.ScalarColor3f(diffuse)}
        bsdf |= {"metallic": float(mtl["Pm"]), "roughness": float(mtl["Pr"])}
    elif any(over.get("specular", [])):
        ks, n = over["specular"], float(over["shininess"])
        bsdf = {"type": "written_phong", "kd": mi.ScalarColor3f(diffuse), "ks": mi.ScalarColor3f(ks), "n": n}
    elif "map_Kd" in mtl:
        bitmap = mi.Bitmap(str(folder / mtl["map_Kd"]))
        bitmap = bitmap.convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, srgb_gamma=False)
        texels = mi.TensorXf(bitmap)
        scaled = [v * diffuse[i % 3] for i, v in enumerate(list(texels.array))]
        bitmap = mi.Bitmap(mi.TensorXf(scaled, texels.shape))
        bsdf = {"type": "diffuse", "reflectance": {"type": "bitmap", "bitmap": bitmap, "raw": True}}
    else:
        bsdf = {"type": "diffuse", "reflectance": rgb(diffuse)}
    return {"type": "twosided", "bsdf": bsdf}, over.get("emitted")


def panorama(data):
    """The texels of an uncompressed Radiance picture: rows from the top, linear RGB."""
    head, _, rest = data.partition(b"\n\n")
    size, _, texels = rest.partition(b"\n")
    _, height, _, width = size.split()
    value = lambda i: [texels[i + c] * 2.0 ** (texels[i + 3] - 136) for c in range(3)]
    width, height = int(width), int(height)
    return [[value(4 * (y * width + x)) for x in range(width)] for y in range(height)]


def environment(files, spec):
    """The panorama, whose centre is -Z, on Mitsuba's grid, whose left edge is -Z and whose first and last row are the poles."""
    texels = panorama(files[spec["image"]])
    rows, columns = len(texels), len(texels[0])
    # The centres of texels, where the slope changes, are on the grid.
    width, height = 17 * columns, 16 * rows + 1
    values = []
    for j in range(height):
        y = j / (height - 1) * rows - 0.5
        y0 = math.floor(y)
        top, bottom = (texels[min(max(r, 0), rows - 1)] for r in (y0, y0 + 1))
        for i in range(width):
            x = ((i + 0.5) / width + 0.5) * columns - 0.5
            x0 = math.floor(x)
            a, b = x0 % columns, (x0 + 1) % columns
            s, t = x - x0, y - y0
            for c in range(3):
                above = top[a][c] * (1 - s) + top[b][c] * s
                below = bottom[a][c] * (1 - s) + bottom[b][c] * s
                values.append((above * (1 - t) + below * t) * spec.get("intensity", 1))
    yaw, pitch, roll = spec["rotate"]
    turn = mi.ScalarTransform4f().rotate([0, 1, 0], yaw).rotate([1, 0, 0], pitch).rotate([0, 0, 1], roll)
    return {"type": "envmap", "bitmap": mi.Bitmap(mi.TensorXf(values, (height, width, 3))), "to_world": turn}


def light(spec):
    power = [v * spec.get("intensity", 1) for v in spec["color"]]
    direction = spec.get("direction")
    if spec["kind"] == "directional":
        return {"type": "directional", "direction": direction, "irradiance": rgb(power)}
    assert (spec["constant"], spec["linear"], spec["quadratic"]) == (0, 0, 1)
    position = spec["position"]
    if spec["kind"] == "point":
        return {"type": "point", "position": position, "intensity": rgb(power)}
    target = [p + d for p, d in zip(position, direction)]
    angle = spec["outer_angle"]
    assert spec["inner_angle"] == angle
    to_world = mi.ScalarTransform4f().look_at(origin=position, target=target, up=[0, 0, 1])
    # Equal angles would divide by zero.
    return {"type": "spot", "to_world": to_world, "intensity": rgb(power), "cutoff_angle": angle, "beam_width": angle - 1e-4}


def build(folder, files):
    """Mitsuba's scene, and whether a surface is written in Python."""
    spec = tomllib.loads(files["scene.toml"].decode())
    picture, camera = spec["picture"], spec["camera"]
    eye = mi.ScalarTransform4f().look_at(origin=camera["position"], target=camera["target"], up=[0, 1, 0])
    film = {"type": "hdrfilm", "width": picture["width"], "height": picture["height"], "rfilter": {"type": "box"}}
    film |= {"pixel_format": "rgb", "component_format": "float32"}
    sensor = {"type": "perspective", "fov_axis": "y", "fov": camera["fov_y"], "to_world": eye, "film": film}
    sensor |= {"near_clip": 1e-3, "far_clip": 1e3, "sampler": {"type": SAMPLER, "sample_count": NATIVE}}
    scene = {"type": "scene", "integrator": {"type": "path", "max_depth": -1, "rr_depth": 8}, "sensor": sensor}
    for i, object_spec in enumerate(spec["object"]):
        bsdf, emitted = material_of(folder, files, object_spec)
        shape = {"type": "obj", "filename": str(folder / object_spec["model"]), "face_normals": True, "bsdf": bsdf}
        if emitted:
            shape["emitter"] = {"type": "area", "radiance": rgb(emitted)}
        scene[f"object{i}"] = shape
    for i, light_spec in enumerate(spec["light"]):
        # Ambient lights, which no path finds, only keep gonio from adding its default lights.
        if light_spec["kind"] != "ambient":
            scene[f"light{i}"] = light(light_spec)
    if "environment" in spec:
        scene["environment"] = environment(files, spec["environment"])
    written = any("written" in repr(value) for value in scene.values())
    return mi.load_dict(scene), picture["width"], picture["height"], PYTHON if written else NATIVE


def block_means(pixels, width, height):
    """Rows of blocks from the top, RGB; at the end the mean of the picture."""
    columns = width // BLOCK
    sums = [0.0] * (3 * columns * (height // BLOCK))
    for i, value in enumerate(pixels):
        x, y, channel = i // 3 % width, i // 3 // width, i % 3
        sums[3 * (y // BLOCK * columns + x // BLOCK) + channel] += value
    whole = [sum(sums[c::3]) / (width * height) for c in range(3)]
    return [v / BLOCK**2 for v in sums] + whole


def main():
    here = pathlib.Path(__file__).parent
    chosen = sys.argv[1:]
    print(f"Mitsuba {mi.__version__} ({mi.variant()}), {datetime.date.today()}, python3 {' '.join(['make.py', *chosen])}")
    print(f"Means of {BLOCK}x{BLOCK} pixels, rows from the top, and their standard errors, of {SEEDS} seeds: r g b, errors of r g b.")
    for name, files in read_scenes(here / "scenes.txt").items():
        if chosen and name not in chosen:
            continue
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            for path, content in files.items():
                (folder / path).write_bytes(content)
            scene, width, height, samples = build(folder, files)
            pictures = [mi.render(scene, seed=seed, spp=samples) for seed in range(SEEDS)]
        means = [block_means(list(picture.array), width, height) for picture in pictures]
        mean = [sum(v) / SEEDS for v in zip(*means)]
        error = [math.sqrt(sum((x - m) ** 2 for x in v) / (SEEDS - 1) / SEEDS) for v, m in zip(zip(*means), mean)]
        print(f"\n-- {name}: {SEEDS} x {samples} samples per pixel --")
        for i in range(0, len(mean), 3):
            label = "all " if i == len(mean) - 3 else ""
            print(label + " ".join(f"{v:.6g}" for v in mean[i : i + 3]), *(f"{v:.2g}" for v in error[i : i + 3]))
        sys.stdout.flush()


if __name__ == "__main__":
    main()
