"""Pictures and exact ray queries of point clouds, ray-traced as splats on any Vulkan device, a CPU included.

    import splatray as sr
    scene = sr.open("scan.laz")                              # or sr.points(xyz, normals=n, colors=c)
    image = scene.render(sr.frame(scene, azimuth=30, fov=35), (1280, 720), samples=64)
    image.save("scan.png"); a = image.pixels                 # float32 (720, 1280, 4), no copy
    hits = scene.trace(origins, directions)                  # exact: t, normal, object, splat
    width = scene.measure("distance", [(0, 0, 1), ((0, 0, 1), (1, 0, 0))]).values["distance"]  # value, within

World space is right-handed, in the units of the input, float64. Colours and radiances are linear sRGB, angles degrees. Long calls
run without the interpreter's lock, can be ended by Ctrl-C, and take `progress`, which is called as progress(stage, share) and ends
the call by returning False. It may make, use and drop scenes, but not use the one that it hears of: that is a ValueError. In a
process that was forked off after a Vulkan device was used, its use is a NoDeviceError; device="cpu" works there, and so does all in
processes that were started anew (multiprocessing.set_start_method("spawn")).

Exceptions: ValueError for arguments and files that make no sense, TypeError, FileNotFoundError, OSError where a file cannot be
written, NoDeviceError without a Vulkan device, Cancelled, MemoryError, RuntimeError for all else.
"""

from ._core import Cancelled, NoDeviceError, version as _version
from .camera import Camera, frame
from .device import Device, devices
from .image import Image
from .look import Light, Material, material, point_light, spot_light, sun
from .objects import Mesh, Points
from .request import Request
from .scene import Hits, Made, Measure, MeasureValue, Scene, Splats, make_picture, make_scene, open, points

__version__ = _version()
__all__ = ["Camera", "Cancelled", "Device", "Hits", "Image", "Light", "Made", "Material", "Measure", "MeasureValue", "Mesh", "NoDeviceError", "Points", "Request", "Scene", "Splats", "devices",
           "frame", "make_picture", "make_scene", "material", "open", "point_light", "points", "spot_light", "sun"]
