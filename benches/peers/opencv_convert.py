"""Converts a panorama to six faces of a cubemap in memory with OpenCV: opencv_convert.py PANORAMA.png SIZE ROUNDS

Prints a JSON object of CPU seconds, round by round: with the map computed as a user has to, and with the map there
already; of 8 bits and of floats; and the CPU features in use. Six faces of SIZE x SIZE, bilinear, into memory that is there already.
"""

import json
import sys
import time

import cv2
import numpy as np

try:
    from numpy._core._multiarray_umath import __cpu_features__ as numpy_features
except ImportError:
    numpy_features = {}

# Middle, direction of columns, direction of rows, of each face as OpenGL has it.
AXES = [
    ((1, 0, 0), (0, 0, -1), (0, -1, 0)),
    ((-1, 0, 0), (0, 0, 1), (0, -1, 0)),
    ((0, 1, 0), (1, 0, 0), (0, 0, 1)),
    ((0, -1, 0), (1, 0, 0), (0, 0, -1)),
    ((0, 0, 1), (1, 0, 0), (0, -1, 0)),
    ((0, 0, -1), (-1, 0, 0), (0, -1, 0)),
]


def maps(size, width, height):
    centre = (np.arange(size, dtype=np.float32) + 0.5) * 2 / size - 1
    s, t = np.meshgrid(centre, centre)
    for middle, along_s, along_t in AXES:
        x, y, z = (middle[i] + along_s[i] * s + along_t[i] * t for i in range(3))
        u = (np.arctan2(x, -z) / (2 * np.pi) + 0.5) * width - 0.5
        v = (0.5 - np.arctan2(y, np.sqrt(x * x + z * z)) / np.pi) * height - 0.5
        yield u.astype(np.float32), v.astype(np.float32)


def main():
    picture = cv2.imread(sys.argv[1], cv2.IMREAD_COLOR)
    size, rounds = int(sys.argv[2]), int(sys.argv[3])
    # CPU time of one thread is what is asked for.
    cv2.setNumThreads(1)
    of_numpy = " ".join(name for name, has in numpy_features.items() if has)
    results = {"features": f"OpenCV {cv2.getCPUFeaturesLine()}; numpy {of_numpy}"}
    for name, image in (("8 bits", picture), ("floats", picture.astype(np.float32) / 255)):
        height, width = image.shape[:2]
        faces = [np.empty((size, size, 3), image.dtype) for _ in range(6)]

        def remap(places):
            for face, (u, v) in zip(faces, places):
                cv2.remap(image, u, v, cv2.INTER_LINEAR, dst=face, borderMode=cv2.BORDER_WRAP)

        known = list(maps(size, width, height))
        remap(known)
        times = {"map and remap": [], "remap": []}
        for _ in range(rounds):
            start = time.process_time()
            remap(maps(size, width, height))
            middle = time.process_time()
            remap(known)
            times["map and remap"].append(middle - start)
            times["remap"].append(time.process_time() - middle)
        results[name] = times
    print(json.dumps(results))


main()
