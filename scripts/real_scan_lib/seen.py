"""Where a person sees the pins of the scans: in the colour picture beside the depth image, and in the colours that the
points of the loose cloud have. There a head is plain to the eye and tails are darker. The depth alone tells head from tail on
few pins."""

from dataclasses import dataclass
from typing import Callable

import numpy as np
import yaml

from benchmark_lib.meshes import UNITS_M, read_facets

# Head and tail of the line that shines along each pin, in pixels of the colour picture counted from its corner (the middle
# of the first pixel is at 0.5). Pins of which less than a third is to be seen are left out. Ends that other pins hide are
# where the others' length puts them.
PICTURE_PINS = (
    ((436.5, 196), (431, 250)),
    ((446, 209), (501, 198)),
    ((514, 205.5), (460, 218)),
    ((434, 270), (454.5, 220)),
    ((463, 229), (517, 244.5)),
    ((543, 241), (490, 226)),
    ((543, 263.5), (489, 249)),
    ((529.5, 273.5), (477, 255)),
    ((522.5, 302.5), (480, 265)),
    ((515.5, 220.5), (564, 195)),
    ((445.5, 314), (449.5, 260)),
    ((461, 254), (457, 310)),
    ((462, 313), (474, 260)),
    ((487.5, 286), (455.5, 332)),
    ((457.5, 350), (488, 303)),
    ((500, 304.5), (471, 353)),
    ((513.5, 309.5), (482.5, 355)),
    ((489, 370), (516, 322)),
    ((502, 395), (518.5, 342)),
    ((529.5, 377), (529, 323)),
    ((525, 336), (574, 358)),
    ((542.5, 287), (516.5, 336)),
    ((532, 282), (543.5, 338)),
    ((558, 326), (547, 271)),
    ((441.5, 429), (435, 373)),
    ((458, 427), (444, 371)),
    ((473.5, 428.5), (456, 376)),
    ((461.5, 357.5), (478.5, 410)),
    ((490, 411), (473.5, 358)),
    ((525, 387), (490, 430)),
    ((540.5, 389), (502, 431)),
    ((548, 402), (506.5, 441.5)),
    ((434.5, 453.5), (490.5, 441.5)),
    ((433.5, 281), (431, 337)),
)
# The same in the loose cloud, as directions from its camera: thousandths of x / z and y / z. The head of the pin at the wall
# is told by its width; its tail is hidden.
CLOUD_PINS = (
    ((-62.1, -72.3), (2.0, -51.5)),
    ((3.0, -94.5), (47.8, -45.6)),
    ((1.6, -74.7), (49.2, -27.7)),
    ((-20.6, -23.4), (-73.9, 13.4)),
    ((39.9, 12.8), (12.2, -48.5)),
    ((45.6, 18.9), (-14.9, 44.0)),
    ((66.3, -7.8), (52.1, 54.6)),
    ((63.5, 62.5), (86.9, 0.0)),
    ((87.9, 68.0), (22.2, 69.4)),
    ((-16.3, 89.4), (-29.8, 26.9)),
    ((-70.5, 55.2), (-52.6, 115.8)),
    ((-53.0, 58.2), (-37.7, 122.2)),
    ((-37.1, 58.8), (-26.9, 123.6)),
    ((-69.7, 147.0), (-73.9, 81.6)),
    ((16.5, 74.5), (7.3, 138.4)),
    ((19.3, 145.0), (27.3, 78.8)),
    ((37.8, 146.4), (37.8, 80.8)),
)
PIXELS = 2  # of the depth image, along a pixel of the colour picture
# Both ends of a right pose lie nearer to those of a pin than this, across the line of sight: a tenth of the part's diameter,
# as for evaluate_poses. The lines end half a millimetre within the pins.
NEAR_M = 0.0033
VERDICTS = ("right", "end for end", "elsewhere")


@dataclass(frozen=True)
class View:
    """What a person looked at."""

    places: Callable  # of points (n x 3, in the frame of the scan's camera [m]): n x 2, and a unit's width there [m]
    pins: tuple  # head and tail of each, in such places


def head_and_tail_m(part_file):
    """Ends of the axis of a part, which is one of revolution about its first continuous symmetry; rows, in its mesh's frame.
    Head: the end beside the widest place."""
    part = yaml.safe_load(part_file.read_text())
    symmetry = part["symmetries_continuous"][0]
    axis = np.array(symmetry["axis"]) / np.linalg.norm(symmetry["axis"])
    corners = read_facets(part_file.parent / part["mesh"])["corners"].reshape(-1, 3).astype(float)
    offsets = corners - symmetry["point"]
    along = offsets @ axis
    widest = along[np.linalg.norm(offsets - np.outer(along, axis), axis=1).argmax()]
    ends = sorted((along.min(), along.max()), key=lambda end: abs(end - widest))
    return (symmetry["point"] + np.outer(ends, axis)) * UNITS_M[part["unit"]]


def picture_view(camera, pins=PICTURE_PINS):
    """The colour picture. camera: of the depth image. Its places are pixels, counted from its corner."""

    def places(points):
        x, y, z = points.T
        columns = camera["fx"] * x / z + camera["cx"]
        rows = camera["fy"] * y / z + camera["cy"]
        return (np.column_stack([columns, rows]) + 0.5) / PIXELS, PIXELS * z / camera["fx"]

    return View(places, pins)


def cloud_view():
    """The loose cloud. Its places are directions, as in CLOUD_PINS."""
    return View(
        lambda points: (1000 * points[:, :2] / points[:, 2:], points[:, 2] / 1000), CLOUD_PINS
    )


def verdict(T_camera_model, ends_m, view):
    """One of VERDICTS, of each pose by itself. ends_m: as head_and_tail_m()."""
    ends_camera_m = ends_m @ T_camera_model[:3, :3].T + T_camera_model[:3, 3]
    places, width_m = view.places(ends_camera_m)
    seen = np.asarray(view.pins, float)

    def miss_m(order):
        """Of the pin that it misses least, the end that it misses most."""
        return (np.linalg.norm(seen[:, order] - places, axis=2) * width_m).max(axis=1).min()

    right_m, turned_m = miss_m([0, 1]), miss_m([1, 0])
    if min(right_m, turned_m) > NEAR_M:
        return "elsewhere"
    return "right" if right_m <= turned_m else "end for end"
