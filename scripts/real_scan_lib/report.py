"""The report: counts as Markdown."""

import statistics

from ablation_lib.copies import NOISE_M
from benchmark_lib.report import number, table

from .scans import FLOOR_M, INSIDE, LEFT_OUT
from .seen import CLOUD_PINS, NEAR_M, PICTURE_PINS, VERDICTS

IMAGE_PICTURE = "images/real_scan_image.png"
CLOUD_PICTURE = "images/real_scan_cloud.png"
WHOLE_PICTURE = "images/real_scan_whole_cloud.png"


def with_mean(rows):
    """The rows and their mean."""
    means = [statistics.mean(column) for column in list(zip(*rows))[1:]]
    return rows + [["**mean**", *[number(mean, 1) for mean in means]]]


def write_page(facts, image_rows, cloud_rows):
    """The whole page."""
    low, high = (", ".join(f"{value:g}" for value in corner) for corner in INSIDE)
    image_heading = ["variant", "pins", *VERDICTS, "suspicious", "in the other bins"]
    cloud_heading = ["variant", "in the bin", *VERDICTS, "suspicious"]
    cloud_heading += ["whole cloud", *VERDICTS, "suspicious"]
    return f"""# Pins in a real scan

Reliable poses of a shiny pin in a depth image of four bins, of which one holds about 36 pins and the others none, and in a loose cloud of another bin
with about 20, of which {len(CLOUD_PINS)} can be told, a point each millimetre on pins six thick. What is told is how many poses pass, how many of them are right, and how many `check_poses` finds suspicious, which
does not tell head from tail where a pin is a few points wide. Beside the image there is a colour picture, in which a person sees {len(PICTURE_PINS)} pins and which end is the head, and the points of the
cloud have colours that show as much. A pose is right if its ends lie within {NEAR_M * 1000:g} mm of a pin's there, across the line of sight, end for end if they do the other way round, elsewhere if neither, also on a
pin too hidden to be listed (`scripts/real_scan_lib/seen.py`). One scan is one draw, so the same is looked for in variants of it that a sensor might have given as well: the camera turned about
its axis, noise of {NOISE_M * 1000:g} mm on the depth, {LEFT_OUT * 100:g} % of the points left out, another order,
and a region that ends {FLOOR_M * 1000:g} mm nearer or farther, as whoever measures a bin may give it. Written by

    {facts["command"]}

which keeps what is done in `{facts["folder"]}`. Commit {facts["commit"]}; {facts["machine"]}.

## Depth image, each bin's inside as the region

{table(image_heading, with_mean(image_rows))}
As it is:

![Poses over the depth image]({IMAGE_PICTURE})

## Loose cloud

In the bin: the region of interest is `{{min: [{low}], max: [{high}]}}`, the bin's inside from just above its floor to well under its rim. Whole
cloud: without a region; poses elsewhere lie on the rim or a wall.

{table(cloud_heading, with_mean(cloud_rows))}
As it is, in the bin:

![Poses in the bin over the loose cloud]({CLOUD_PICTURE})

In the whole cloud:

![Poses in the whole loose cloud]({WHOLE_PICTURE})
"""
