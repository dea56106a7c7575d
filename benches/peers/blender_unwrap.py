"""Unwraps a model with Blender's smart projection: blender -b --factory-startup -P blender_unwrap.py -- MODEL.obj OUT.obj MARGIN,
or python blender_unwrap.py -- MODEL.obj OUT.obj MARGIN with the package bpy.

Prints `unwrapped SECONDS`: those of the operator alone. The margin is a share of the side where this Blender can do that ("FRACTION").
"""

import math
import sys
import time

import bpy

model, out, margin = sys.argv[sys.argv.index("--") + 1 :]
bpy.ops.object.select_all(action="SELECT")
bpy.ops.object.delete()
bpy.ops.wm.obj_import(filepath=model)
meshes = [one for one in bpy.context.scene.objects if one.type == "MESH"]
for one in meshes:
    one.select_set(True)
bpy.context.view_layer.objects.active = meshes[0]
bpy.ops.object.mode_set(mode="EDIT")
bpy.ops.mesh.select_all(action="SELECT")
options = {"angle_limit": math.radians(66), "island_margin": float(margin), "area_weight": 0.0}
known = bpy.ops.uv.smart_project.get_rna_type().properties
if "margin_method" in known:
    options["margin_method"] = "FRACTION"
start = time.perf_counter()
bpy.ops.uv.smart_project(**options)
seconds = time.perf_counter() - start
bpy.ops.object.mode_set(mode="OBJECT")
bpy.ops.wm.obj_export(filepath=out, export_materials=False, export_triangulated_mesh=True)
print("unwrapped", seconds)
