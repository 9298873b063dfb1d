"""Scripts that measure answer --help at once: nothing is installed or built before."""

import subprocess
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"


class Help(unittest.TestCase):
    def test_comes_first(self):
        measuring = [path for path in SCRIPTS.iterdir() if (SCRIPTS / module_of(path)).is_dir()]
        self.assertGreaterEqual(len(measuring), 7)
        for script in measuring:
            for option in ("--help", "-h"):
                with self.subTest(script=script.name, option=option):
                    shown = subprocess.run(
                        [script, option], capture_output=True, text=True, check=True
                    )
                    self.assertEqual(shown.stdout.split()[:2], ["usage:", f"scripts/{script.name}"])

    def test_of_the_others_is_their_head(self):
        for name in ("demo", "test", "setup", "screenshot"):
            with self.subTest(script=name):
                shown = subprocess.run(
                    [SCRIPTS / name, "--help"], capture_output=True, text=True, check=True
                )
                head = (SCRIPTS / name).read_text().splitlines()[1]
                self.assertEqual(shown.stdout.splitlines()[0], head[2:])

    def test_screenshot_names_its_arguments(self):
        for arguments in ([], ["picture.png"]):
            refused = subprocess.run(
                [SCRIPTS / "screenshot", *arguments], capture_output=True, text=True
            )
            self.assertNotEqual(refused.returncode, 0)
            self.assertIn("Usage: scripts/screenshot PICTURE.png LAUNCH_FILE", refused.stderr)


def module_of(script):
    """The name of the folder with a script's Python: fit_reliability's is reliability_lib."""
    return script.name.replace("fit_", "", 1) + "_lib"


if __name__ == "__main__":
    unittest.main()
