"""Command line of scripts/real_scan."""

import argparse
import os
import sys
from pathlib import Path

from benchmark_lib.detection import write_configs
from benchmark_lib.programs import provenance, run_script

from .measurement import VARIANT, RealScan, in_clouds, in_images
from .report import CLOUD_PICTURE, IMAGE_PICTURE, WHOLE_PICTURE, write_page
from .scans import cloud_draws, image_draws


def arguments():
    parser = argparse.ArgumentParser(
        prog="scripts/real_scan",
        description="Looks for the pins of the real scans, as they are and changed a little; writes a report. What was done before is not done again.",
    )
    data = Path(os.environ.get("PPF_BIN_PICKING_DATA", "../shared/data"))
    parser.add_argument("--data", type=Path, default=data, help="holds real/pins")
    parser.add_argument("--folder", type=Path, default=Path("build/real_scan"))
    parser.add_argument("--report", type=Path, default=Path("docs/real_scan.md"))
    return parser.parse_args()


def work(options):
    """Returns the exit status."""
    data = options.data / "real/pins"
    facts = {**provenance("scripts/real_scan"), "folder": options.folder}
    folder = options.folder.resolve()
    configs = write_configs(folder / "configs", [VARIANT], [])
    bench = RealScan(folder, data, configs)
    image_rows, image = in_images(bench, image_draws(data))
    cloud_rows, (inside, whole) = in_clouds(bench, cloud_draws(data))
    for scene, picture in ((image, IMAGE_PICTURE), (inside, CLOUD_PICTURE), (whole, WHOLE_PICTURE)):
        bench.draw(scene, options.report.resolve().parent / picture)
    options.report.write_text(write_page(facts, image_rows, cloud_rows))
    print(f"Wrote {options.report}")
    return 0


if __name__ == "__main__":
    sys.exit(run_script("scripts/real_scan", arguments, work))
