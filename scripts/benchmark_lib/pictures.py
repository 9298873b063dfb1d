"""Pictures of the report: a scene of each part with its poses, and precision-recall curves."""

import math

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # after the choice of a backend that needs no display
from PIL import Image

from .programs import run

MAX_BYTES = 60_000
WIDTH_PX = 640
COLUMNS = 4
DARK = 30  # grey levels of what counts as black
DASHES = ("-", "--", "-.", ":")  # lines may lie on each other


def write_jpeg(image, path):
    """As good as fits into MAX_BYTES."""
    for quality in range(85, 10, -10):
        image.save(path, quality=quality, optimize=True)
        if path.stat().st_size <= MAX_BYTES:
            return


def with_poses(image):
    """check_poses draws the scene twice, below or beside each other. The second has the poses; black margins go."""
    if image.height > image.width:
        image = image.crop((0, image.height // 2, image.width, image.height))
    else:
        image = image.crop((image.width // 2, 0, image.width, image.height))
    return image.crop(image.point(lambda level: 255 * (level > DARK)).getbbox())


def draw_scene(bench, variant, scene, path):
    """The scene's depth image with the edges of the poses: green reliable, red not."""
    drawn = bench.folder / "pictures" / f"{scene.part}.png"
    drawn.parent.mkdir(parents=True, exist_ok=True)
    run(
        "check_poses",
        bench.result_path(variant, scene),
        *("--part", bench.part_folder(scene.part) / "part.yaml"),
        *bench.scene_arguments(scene),
        *("--config", bench.configs[variant], "--all", "--image", drawn),
    )
    image = Image.open(drawn).convert("RGB")
    image = with_poses(image)
    image.thumbnail((WIDTH_PX, WIDTH_PX))
    path.parent.mkdir(parents=True, exist_ok=True)
    write_jpeg(image, path)


def draw_curves(evaluations, parts, path):
    """A small precision-recall plot for each part, a line for each variant."""
    rows = math.ceil(len(parts) / COLUMNS)
    figure, axes = pyplot.subplots(
        rows, COLUMNS, figsize=(2.4 * COLUMNS, 2.2 * rows + 0.5), squeeze=False
    )
    for axis in axes.flat[len(parts) :]:
        axis.axis("off")
    curves = [evaluation["curves"] for evaluation in evaluations.values()]
    lowest = min([point[1] for c in curves for part in parts for point in c[part]], default=0)
    bottom = min(0.9, math.floor(10 * lowest) / 10)
    for axis, part in zip(axes.flat, parts):
        for k, (variant, evaluation) in enumerate(evaluations.items()):
            points = evaluation["curves"][part]
            recall = [point[2] for point in points]
            axis.plot(
                recall,
                [point[1] for point in points],
                DASHES[k % len(DASHES)],
                label=variant,
                linewidth=1.3,
            )
        axis.set(title=part, xlim=(0, 1.02), ylim=(bottom, 1.01))
        axis.grid(linewidth=0.3)
    for axis in axes[:, 0]:
        axis.set_ylabel("precision")
    for axis in axes[-1]:
        axis.set_xlabel("recall")
    lines, names = axes[0][0].get_legend_handles_labels()
    figure.legend(lines, names, loc="lower center", ncol=len(names), frameon=False)
    figure.tight_layout(rect=(0, 0.5 / (2.2 * rows + 0.5), 1, 1))
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=100, metadata={"Software": None})
    pyplot.close(figure)
