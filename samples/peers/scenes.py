"""The twelve scenes of docs/peers.md: a mesh, a specification, and what the scene shows."""
from dataclasses import dataclass, field

import meshes

SIDE = 160  # pixels of the pictures

COLORS = [[0.0, 0.1, 0.2, 0.9], [0.35, 0.2, 0.9, 0.3], [0.6, 0.95, 0.8, 0.1], [1.0, 0.9, 0.1, 0.1]]
TWO_COLORS = [[0.0, 0.1, 0.2, 0.9], [1.0, 0.9, 0.6, 0.1]]
RAMP = [[0.0, 0.5], [1.0, 5.0]]
BUMPS = [[0.0, 0.2], [0.25, 0.6], [0.45, 4.0], [0.55, 0.5], [0.8, 6.0], [1.0, 1.0]]

ASLANT = {"projection": "orthographic", "eye": [3.1, 2.3, 2.7], "look_at": [0.5, 0.5, 0.5],
          "up": [0.0, 0.0, 1.0], "height": 1.75}
ALONG_AXIS = {"projection": "orthographic", "eye": [0.5, -3.0, 0.5], "look_at": [0.5, 0.5, 0.5],
              "up": [0.0, 0.0, 1.0], "height": 1.2}
CLOSE = {"projection": "perspective", "eye": [1.35, 1.15, 1.25], "look_at": [0.5, 0.5, 0.5],
         "up": [0.0, 0.0, 1.0], "fov": 70.0}


def colors_at(scalar, points):
    """The colour of piecewise-linear points at a scalar between the first and the last."""
    for (s, *a), (t, *b) in zip(points, points[1:]):
        if s <= scalar <= t:
            return [x + (scalar - s) / (t - s) * (y - x) for x, y in zip(a, b)]
    raise ValueError(scalar)


def with_points_of(extinction, colors):
    """The same colours, with a point at every point of the extinction, too."""
    scalars = sorted({p[0] for p in colors} | {p[0] for p in extinction})
    return [[s, *colors_at(s, colors)] for s in scalars]


def moved(camera, by):
    return camera | {key: [x + by for x in camera[key]] for key in ("eye", "look_at")}


def specification(camera, colors, extinction, name, side):
    """Of a square picture of a field."""
    of_camera = "\n".join(f"{key} = {value!r}".replace("'", '"') for key, value in camera.items())
    return (f"[image]\nwidth = {side}\nheight = {side}\n\n[camera]\n{of_camera}\n\n"
            f'[volume.color]\nfield = "{name}"\npoints = {colors}\n\n'
            f'[volume.extinction]\nfield = "{name}"\npoints = {extinction}\n')


@dataclass(frozen=True)
class Scene:
    name: str
    title: str
    mesh: tuple  # a function of meshes.py and its arguments
    camera: dict = field(default_factory=lambda: ASLANT)
    colors: list = field(default_factory=lambda: TWO_COLORS)
    extinction: list = field(default_factory=lambda: RAMP)
    first_frame: bool = False

    def write_mesh(self, path):
        make, *arguments = self.mesh
        meshes.write(path, *make(*arguments))

    def specification(self):
        return specification(self.camera, self.colors, self.extinction, "f", SIDE)


COARSE = (meshes.tetrahedra, 8, 0.25)
SCENES = [
    Scene("plain", "One segment of colour and of extinction", COARSE),
    Scene("lost-points", "Extinction has points where colour has none", COARSE, colors=COLORS,
          extinction=BUMPS),
    Scene("kept-points", "The same, with these points added to the colours", COARSE,
          colors=with_points_of(BUMPS, COLORS), extinction=BUMPS),
    Scene("perspective", "Eye close to the mesh, view angle 70 degrees", COARSE, camera=CLOSE),
    Scene("lattice", "Cubes in sixes of tetrahedra, seen along an axis", (meshes.tetrahedra, 8, 0.0),
          camera=ALONG_AXIS),
    Scene("fine", "Cells of few pixels", (meshes.tetrahedra, 24, 0.25)),
    Scene("dense", "Optical depths up to 60", COARSE, extinction=[[0.0, 5.0], [1.0, 50.0]]),
    Scene("hollow", "A cavity inside", (meshes.hollow, 10, 0.25)),
    Scene("far", "A million sizes away from the origin", (meshes.far_away, 8, 0.25),
          camera=moved(ASLANT, 1e6)),
    Scene("quadratic", "Ten-node tetrahedra", (meshes.quadratic, 3, 0.0), extinction=BUMPS,
          colors=with_points_of(BUMPS, COLORS)),
    Scene("bricks", "Hexahedra with curved faces", (meshes.bricks, 5, 0.25), extinction=BUMPS,
          colors=with_points_of(BUMPS, COLORS)),
    Scene("first-frame", "750 tetrahedra, first frame of the window", (meshes.tetrahedra, 5, 0.25),
          first_frame=True),
]
