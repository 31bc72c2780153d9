# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Opens a glTF file with Blender and looks at what came of it:

    blender --background --factory-startup --python-exit-code 1 --python open_blender.py -- FILE NAME...

Fails unless each named object (by the beginning of its name) is there, with faces, and colours where it is a section or a
borehole; and unless z is up."""
import sys

import bpy
import numpy

numpy.bool = bool  # Debian's importer still says np.bool, which Debian's numpy 1.24 has no more

path, *wanted = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=path)
meshes = [object for object in bpy.data.objects if object.type == "MESH"]
for name in wanted:
    found = [object for object in meshes if object.name.startswith(name)]
    assert found, f"no object '{name}' among {[object.name for object in meshes]}"
    for object in found:
        assert len(object.data.polygons) > 0, f"{object.name} has no faces"
        if name.startswith(("section", "borehole")):
            assert len(object.data.color_attributes) > 0, f"{object.name} has no colours"
corners = [object.matrix_world @ vertex.co for object in meshes for vertex in object.data.vertices]
size = [max(corner[k] for corner in corners) - min(corner[k] for corner in corners) for k in range(3)]
print(f"Blender {bpy.app.version_string}: {len(meshes)} meshes, {' × '.join(f'{length:.1f}' for length in size)} m")
assert abs(size[0] - 800) < 8 and abs(size[1] - 600) < 8 and abs(size[2] - 500) < 8, size
