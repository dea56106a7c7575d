# The whole exercise as a script of Blender 3.4 or later. In the folder of still_life.obj:
#     blender --background --python reference.py
# It writes baked.obj, baked.mtl and baked.png. `gonio bake still_life.obj -o baked` does the same without Blender.
import os

import bpy

FOLDER = os.getcwd()
SIZE = 1024

bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.wm.obj_import(filepath=os.path.join(FOLDER, "still_life.obj"))
objects = [thing for thing in bpy.data.objects if thing.type == "MESH"]

# A second UV map for every object, and all of them unwrapped together.
for thing in objects:
    thing.data.uv_layers.active = thing.data.uv_layers.new(name="Baking")
    thing.select_set(True)
bpy.context.view_layer.objects.active = objects[0]
bpy.ops.object.mode_set(mode="EDIT")
bpy.ops.mesh.select_all(action="SELECT")
bpy.ops.uv.smart_project(island_margin=0.01)
bpy.ops.object.mode_set(mode="OBJECT")

# The picture, as the active node of every material; unconnected, or the bake would read what it writes.
picture = bpy.data.images.new("baked", SIZE, SIZE)
for material in bpy.data.materials:
    if material.use_nodes:
        node = material.node_tree.nodes.new("ShaderNodeTexImage")
        node.image = picture
        material.node_tree.nodes.active = node

# The diffuse colour alone, without any light.
bpy.context.scene.render.engine = "CYCLES"
bpy.context.scene.cycles.samples = 1
bpy.context.scene.cycles.use_denoising = False
bpy.ops.object.bake(type="DIFFUSE", pass_filter={"COLOR"}, margin=16)
picture.filepath_raw = os.path.join(FOLDER, "baked.png")
picture.file_format = "PNG"
picture.save()

# One material that shows the picture, and only the new UV map.
baked = bpy.data.materials.new("Baked")
baked.use_nodes = True
node = baked.node_tree.nodes.new("ShaderNodeTexImage")
node.image = picture
baked.node_tree.links.new(node.outputs["Color"], baked.node_tree.nodes["Principled BSDF"].inputs["Base Color"])
for thing in objects:
    thing.data.materials.clear()
    thing.data.materials.append(baked)
    for layer in [layer for layer in thing.data.uv_layers if layer.name != "Baking"]:
        thing.data.uv_layers.remove(layer)
bpy.ops.wm.obj_export(
    filepath=os.path.join(FOLDER, "baked.obj"), export_triangulated_mesh=True, path_mode="RELATIVE"
)
