"""Scenes of shiny parts: slanted surfaces are lost, and what lies behind them may show through."""

import shutil
import zlib

import numpy as np
import yaml
from PIL import Image
from scipy import ndimage

SLANT_RAD = (
    0.5,
    1.0,
)  # of the surfaces that are just lost, from facing the camera; one value a scene
REACH_PX = (7, 17)  # width of the window in which the surface behind is looked for; both included
FILLED_SHARE = (0.4, 0.9)  # share of the image in which the surface behind shows through
BLOCK_PX = 16  # size of the regions in which it does
EMPTY_SHARE = 0.3  # of the pixels that were empty before, those that surely stay so
SMOOTHING_PX = 1.5  # of the depth, before its slope is taken
COPIED = ("camera.yaml", "gt.json", "roi.yaml")


def slope_of(depth, focal_px):
    """Tangent of the surface's slant; NaN at empty pixels and beside them."""
    seen = depth > 0
    weight = ndimage.gaussian_filter(seen.astype(float), SMOOTHING_PX)
    smooth = ndimage.gaussian_filter(depth, SMOOTHING_PX) / np.maximum(weight, 1e-6)
    smooth[~seen] = np.nan
    return np.hypot(*np.gradient(smooth)) * focal_px / smooth


def make_shiny(depth, focal_px, rng):
    """Takes slanted surfaces from a depth image, where a camera loses them because they mirror its light away.

    Where the depth is aligned to another camera, the pixels so lost are not empty: the surface behind, which the other
    camera would not see, fills them. Outlines count as slanted. Where nothing but a nearer surface is kept around a lost
    pixel, that one fills it: it grows a little.

    depth: in any unit, 0 where empty. Returns an image of which every pixel is as before, empty, or as deep as the deepest
    kept one near it.
    """
    limit = np.tan(rng.uniform(*SLANT_RAD))
    facing = slope_of(depth, focal_px) <= limit  # false for NaN
    kept = np.where(facing, depth, 0)
    behind = ndimage.maximum_filter(kept, size=int(rng.integers(*REACH_PX, endpoint=True)))
    rows, columns = depth.shape
    coarse = rng.random((rows // BLOCK_PX + 2, columns // BLOCK_PX + 2))
    blocks = ndimage.zoom(coarse, BLOCK_PX, order=1)[:rows, :columns]
    filled = blocks < rng.uniform(*FILLED_SHARE)
    filled &= (depth > 0) | (rng.random(depth.shape) >= EMPTY_SHARE)
    return np.where(kept > 0, kept, np.where(filled, behind, 0))


def write_shiny_scene(source, folder):
    """A shiny copy of a scene's folder. The copy's place in the data set is the seed."""
    folder.mkdir(parents=True, exist_ok=True)
    camera = yaml.safe_load((source / "camera.yaml").read_text())
    with Image.open(source / "depth.png") as image:
        depth = np.array(image).astype(float)
    seed = zlib.crc32(f"{folder.parent.name}/{folder.name}".encode())
    shiny = make_shiny(depth, camera["fx"], np.random.default_rng(seed))
    Image.fromarray(shiny.astype(np.uint16)).save(folder / "depth.png")
    for name in COPIED:
        shutil.copyfile(source / name, folder / name)
