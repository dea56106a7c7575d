"""Unwraps a model with xatlas: xatlas_unwrap.py MODEL.obj OUT.obj SIZE MARGIN_TEXELS

Prints the seconds of adding the mesh and of making the atlas, and the number of textures. OUT has the triangles in the order of MODEL.
"""

import sys
import time

import numpy as np
import xatlas


def read(path):
    positions, triangles = [], []
    with open(path) as file:
        for line in file:
            words = line.split()
            if words and words[0] == "v":
                positions.append([float(word) for word in words[1:4]])
            elif words and words[0] == "f":
                corners = [int(word.split("/")[0]) for word in words[1:]]
                corners = [corner - 1 if corner > 0 else len(positions) + corner for corner in corners]
                triangles.extend([corners[0], corners[i], corners[i + 1]] for i in range(1, len(corners) - 1))
    return np.array(positions, np.float32), np.array(triangles, np.uint32)


def main():
    model, out, size, margin = sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4])
    positions, triangles = read(model)
    options = xatlas.PackOptions()
    options.resolution, options.padding, options.create_image = size, margin, False
    start = time.perf_counter()
    atlas = xatlas.Atlas()
    atlas.add_mesh(positions, triangles)
    atlas.generate(pack_options=options)
    seconds = time.perf_counter() - start
    mapping, indices, uvs = atlas[0]
    with open(out, "w") as file:
        for x, y, z in positions:
            file.write(f"v {x:.9g} {y:.9g} {z:.9g}\n")
        for u, v in uvs:
            file.write(f"vt {u:.9g} {v:.9g}\n")
        for triangle in indices:
            file.write("f " + " ".join(f"{mapping[i] + 1}/{i + 1}" for i in triangle) + "\n")
    print(seconds, atlas.atlas_count)


main()
