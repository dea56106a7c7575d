"""Draws with the Python package, a turn for each line of standard input: `SCENE WIDTH HEIGHT SAMPLES PICTURES`.

Answers each with the wall and CPU seconds of the turn, and the sum of the last picture's numbers.
"""

import sys
import time

import gonio

scenes: dict[str, gonio.Scene] = {}
for line in sys.stdin:
    name, width, height, samples, pictures = line.split()
    key = line.rsplit(" ", 1)[0]
    if key not in scenes:
        scenes[key] = gonio.Scene(name, size=(int(width), int(height)), samples=int(samples))
    wall, cpu = time.perf_counter(), time.process_time()
    for _ in range(int(pictures)):
        array = scenes[key].render(backend="gl").array
    wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
    print(wall, cpu, float(array.sum(dtype="float64")), flush=True)
