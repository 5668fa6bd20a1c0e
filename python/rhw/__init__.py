# SPDX-License-Identifier: MIT
"""rhw: 3D pictures on the CPU, exact, and the same bytes on every machine.

No GPU, no display, no driver: what `pip` installs is all there is. A picture of a file:

    >>> import rhw
    >>> model = rhw.load("chair.glb")
    >>> pictures = model.render((640, 480), outputs=("color", "depth", "object"))
    >>> pictures["depth"].shape, pictures["depth"].dtype
    ((480, 640), dtype('float32'))
    >>> pictures.save("chair.png")

From another place, with less light, of your own mesh:

    >>> camera = rhw.Camera.orbit(215, 22, margin=12)
    >>> model.render(400, camera, samples=16, exposure=-1, background="transparent")
    >>> rhw.Model(vertices, faces, colors=colors).render(400, camera)

load, Model, Camera   models, and where they are seen from
Environment           light from a panorama
Pictures              what a render gives: a dictionary of NumPy arrays
write_png             an array as a file
pipeline              buffers, textures, passes and shaders of your own, for what no model and no material is needed for
diff                  rasterization with gradients, for those who learn from images; rhw.torch has it for autograd
Context               how many threads draw; nothing that is drawn depends on it
Error                 the work failed: one line that names the thing and the cause

Mistakes in arguments are TypeError and ValueError, whose line names the argument and the rule. Arrays are rows from
top to bottom: a picture of size=(640, 480) has the shape (480, 640). Matrices are for column vectors; the world is
right-handed. What is drawn is what the program `rhw render` draws with the same options, to the last bit.
"""

from . import _rhw, diff, pipeline
from ._rhw import Context, Error
from .camera import Camera, View
from .environment import Environment
from .model import Animation, Image, Light, Material, Mesh, Model, ModelCamera, Node, load
from .pictures import Pictures, write_png

__version__: str = _rhw.version

__all__ = ["Animation", "Camera", "Context", "Environment", "Error", "Image", "Light", "Material", "Mesh", "Model", "ModelCamera",
           "Node", "Pictures", "View", "diff", "load", "pipeline", "write_png"]
