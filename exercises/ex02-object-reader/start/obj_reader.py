"""Exercise 02: an object reader.

    python3 obj_reader.py models/cube.obj cube.csv
    gonio lab check ex02 cube.csv

It runs, but its output is not yet the cube: it does not read the faces.
"""

import sys


def read_obj(path):
    """The vertices of a triangle list: rows of x y z u v nx ny nz, three rows per triangle."""
    positions, tex_coords, normals = [], [], []
    vertices = []
    with open(path, encoding="utf-8") as file:
        for line in file:
            words = line.split()
            if not words:
                continue
            if words[0] == "v":
                positions.append([float(word) for word in words[1:4]])
            elif words[0] == "vt":
                tex_coords.append([float(word) for word in words[1:3]])
            elif words[0] == "vn":
                normals.append([float(word) for word in words[1:4]])
            # TODO: the f lines. What do the numbers between the slashes mean? Where do they start counting?
            # What if a face has four corners, or five?

    # TODO: do not combine the lists by position, but as the corners of the faces define.
    for i, position in enumerate(positions):
        tex_coord = tex_coords[i] if i < len(tex_coords) else [0.0, 0.0]
        normal = normals[i] if i < len(normals) else [0.0, 0.0, 0.0]
        vertices.append(position + tex_coord + normal)
    return vertices


def write_csv(path, vertices):
    with open(path, "w", encoding="utf-8") as file:
        file.write("x,y,z,u,v,nx,ny,nz\n")
        for vertex in vertices:
            file.write(",".join(str(number) for number in vertex) + "\n")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: obj_reader.py MODEL.obj BUFFER.csv")
    write_csv(sys.argv[2], read_obj(sys.argv[1]))
