"""Exercise 02: an object reader, complete.

    python3 obj_reader.py models/cube.obj cube.csv
    gonio lab check ex02 cube.csv
"""

import sys


def element(items, index, nothing):
    """The item that an index refers to: from 1, or back from the last one. `items` is the list read so far."""
    if index == "":
        return nothing
    index = int(index)
    return items[index - 1] if index > 0 else items[len(items) + index]


def corner_of(word, positions, tex_coords, normals):
    """v, v/vt, v//vn or v/vt/vn, as x y z u v nx ny nz; zeros if a slot is empty."""
    v, vt, vn = (word.split("/") + ["", ""])[:3]
    position = element(positions, v, None)
    return position + element(tex_coords, vt, [0.0, 0.0]) + element(normals, vn, [0.0, 0.0, 0.0])


def subtract(a, b):
    return [x - y for x, y in zip(a, b)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def triangles_of(corners):
    """Cuts off ears until a triangle is left. A convex polygon becomes a fan around its second corner."""
    normal = [0.0, 0.0, 0.0]
    for a, b in zip(corners, corners[1:] + corners[:1]):
        normal = [n + x for n, x in zip(normal, cross(a[:3], b[:3]))]

    def turn(a, b, c):
        return dot(cross(subtract(b, a), subtract(c, b)), normal)

    rest = [corner[:3] for corner in corners]
    left = list(range(len(corners)))
    triangles = []
    while len(left) > 3:
        for i in range(len(left)):
            a, b, c = left[i - 1], left[i], left[(i + 1) % len(left)]
            others = [p for p in left if p not in (a, b, c)]
            inside = [
                p
                for p in others
                if all(turn(rest[m], rest[n], rest[p]) >= 0 for m, n in ((a, b), (b, c), (c, a)))
            ]
            if turn(rest[a], rest[b], rest[c]) > 0 and not inside:
                break
        else:
            i = 1  # no ear: the polygon crosses itself
            a, b, c = left[0], left[1], left[2]
        triangles.append((a, b, c))
        del left[i]
    triangles.append(tuple(left))
    return [corners[place] for triangle in triangles for place in triangle]


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
            elif words[0] == "f":
                corners = [corner_of(word, positions, tex_coords, normals) for word in words[1:]]
                vertices += triangles_of(corners)
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
