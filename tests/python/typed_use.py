"""For type checkers alone, which pass all lines but those that end in `# refused`."""

import numpy as np
import splatray as sr

mesh = sr.Mesh(np.eye(3), [[0, 1, 2]], attributes={"heat": [1, 2, 3]})
scene: sr.Scene = sr.make_scene([mesh, sr.Points(np.eye(3))], mesh_points=100, color_by="heat")
camera: sr.Camera = sr.Camera.from_pose(np.eye(4), np.eye(3), (8, 8))
image: sr.Image = scene.render(camera, (8, 8), lens_shift=(0.1, 0), look="ao", denoise=True, error=0.1, time=3)
hits: sr.Hits = sr.points(np.eye(3), scanned=True).trace((0, 0, 1), (0, 0, -1))
scene.render(camera, (8, 8), look="nice")  # refused
scene.render(camera, (8, 8), no_such_field=1)  # refused
scene.render(camera, 8)  # refused
sr.make_scene(3)  # refused
sr.open("a.ply", mesh_points="many")  # refused
