"""Run by Blender: imports the glTF file behind `--` and prints how many triangles it found."""

import sys

import numpy

numpy.bool = bool  # the importer of Blender 3.4 uses a name that newer numpy has dropped

import bpy  # noqa: E402

bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=sys.argv[sys.argv.index("--") + 1])
print("TRIANGLES", sum(len(thing.data.loop_triangles) or sum(len(p.vertices) - 2
                                                            for p in thing.data.polygons)
                       for thing in bpy.context.scene.objects if thing.type == "MESH"))
