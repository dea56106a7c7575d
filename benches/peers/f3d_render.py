"""Draws MODEL to OUT with f3d, as its documentation shows: f3d_render.py MODEL OUT WIDTH HEIGHT"""

import os
import sys

import f3d

model, out, width, height = sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4])
f3d.Log.set_verbose_level(f3d.Log.VerboseLevel.WARN)
f3d.Engine.autoload_plugins()
engine = f3d.Engine.create_egl()
engine.window.size = width, height
engine.scene.add(model)
engine.window.render_to_image().save(out)
