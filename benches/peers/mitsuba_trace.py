"""Traces Mitsuba's own Cornell box: mitsuba_trace.py SAMPLES SEED OUT.pfm

Prints the CPU seconds of the rendering alone, of all threads: neither start-up nor loading. A pixel is the mean of its samples
(box filter), because pixels that share samples would seem less noisy.
"""

import sys
import time

try:
    import mitsuba as mi
except ImportError as error:
    sys.exit(f"{error}: install it with `pip install mitsuba`")

mi.set_variant("scalar_rgb")
mi.set_log_level(mi.LogLevel.Error)
samples, seed, out = int(sys.argv[1]), int(sys.argv[2]), sys.argv[3]
description = mi.cornell_box()
description["sensor"]["film"]["rfilter"] = {"type": "box"}
scene = mi.load_dict(description)
# The first rendering also pays for what is made once.
mi.render(scene, spp=1)
start = time.process_time()
image = mi.render(scene, spp=samples, seed=seed)
used = time.process_time() - start
mi.Bitmap(image).write(out)
print(used)
