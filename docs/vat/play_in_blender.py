"""Blender: plays a vertex animation texture of `shoal export --vat` on its mesh (docs/vat.md).

In Blender's Scripting tab, or: blender --python play_in_blender.py -- FOLDER NAME
"""
import json
import os
import sys

import bpy
import numpy

numpy.bool = bool  # Debian's Blender 3.4 reads glTF by a name that its NumPy has no more


class Player:
    """Moves the vertices of the imported mesh to where they are in a frame."""

    def __init__(self, folder, name):
        before = set(bpy.data.objects)
        bpy.ops.import_scene.gltf(filepath=os.path.join(folder, name + ".glb"))
        self.object = next(o for o in set(bpy.data.objects) - before if o.type == "MESH")
        mesh = self.object.data
        with open(os.path.join(folder, name + "-remap_info.json")) as file:
            remap = json.load(file)["os-remap"]
        image = next(f for f in os.listdir(folder) if f in (name + "_vat.png", name + "_vat.exr"))
        image = bpy.data.images.load(os.path.join(folder, image))
        image.colorspace_settings.name = "Non-Color"
        width, height = image.size
        self.frames = remap["Frames"]
        low, high = numpy.array(remap["Min"]), numpy.array(remap["Max"])
        texels = numpy.array(image.pixels[:]).reshape(height, width, 4)[::-1, :, :3]  # rows from the top
        # The column of each vertex, from the second coordinates.
        self.column = numpy.zeros(len(mesh.vertices), int)
        for loop in mesh.loops:
            self.column[loop.vertex_index] = int(mesh.uv_layers[1].data[loop.index].uv[0] * width)
        rest = numpy.zeros(3 * len(mesh.vertices))
        mesh.vertices.foreach_get("co", rest)
        self.rest = rest.reshape(-1, 3)
        self.offsets = low + texels[: self.frames] * (high - low)
        self.normals = 2 * texels[self.frames :] - 1

    def places(self, frame):
        return self.rest + self.offsets[frame % self.frames][self.column]

    def show(self, scene, _=None):
        self.object.data.vertices.foreach_set("co", self.places(scene.frame_current).ravel())
        self.object.data.update()


if __name__ == "__main__":
    player = Player(*sys.argv[sys.argv.index("--") + 1 :][:2])
    bpy.context.scene.frame_end = player.frames - 1
    bpy.app.handlers.frame_change_pre.append(player.show)
