# SPDX-License-Identifier: Apache-2.0
"""The shell commands of docs/howto/scale_out.md write, range by range, the files of one process."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import unittest

from command import PROGRAM, SOURCE, TIMEOUT, Case

LAYERS = 18
DOCUMENT = {"msq_model": 1,
            "scales": [{"shape": {"box": {"min": [0, 0, 0], "max": [8, 8, 9]}}},
                       {"structure": {"foam": {"grid": {"cell_size": 4}, "radius": 0.5}}}],
            "slicing": {"pitch": 0.25, "layer_height": 0.5}}


def script(word):
    """The block of the page that has the word, with ranges of 5 layers up to the 20th in place of
    100 and 10,000."""
    text = (SOURCE / "docs/howto/scale_out.md").read_text(encoding="utf-8")
    (block,) = [block for block in re.findall(r"^```sh\n(.*?)^```$", text, flags=re.S | re.M)
                if word in block and "msq slice" in block]
    return re.sub(r"\b100\b", "5", block.replace("9999", "19"))


class ScaleOut(Case):
    def setUp(self):
        super().setUp()
        (self.folder / "part.json").write_text(json.dumps(DOCUMENT))
        self.msq("slice", "part.json", "-o", "whole/", cwd=self.folder)

    def run_script(self, text, **variables):
        path = f"{pathlib.Path(PROGRAM).parent}:{os.environ['PATH']}"
        return subprocess.run(["sh", "-c", text], cwd=self.folder, capture_output=True, text=True,
                              timeout=TIMEOUT, env={**os.environ, "PATH": path, **variables})

    def compare(self):
        whole, layers = ({path.name: path.read_bytes() for path in (self.folder / name).iterdir()}
                         for name in ("whole", "layers"))
        self.assertEqual(len(whole), LAYERS)
        self.assertEqual(layers, whole)

    @unittest.skipUnless(shutil.which("parallel"), "no GNU parallel")
    def test_parallel(self):
        for _ in range(2):  # the second time all ranges are done
            done = self.run_script(script("parallel"), HOME=str(self.folder))
            self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
            log = (self.folder / "slices.log").read_text().splitlines()
            self.assertEqual(len(log), 1 + 4)
            self.compare()

    def test_slurm(self):
        text = script("SLURM_ARRAY_TASK_ID")
        for task in range(4):
            done = self.run_script(text, SLURM_ARRAY_TASK_ID=str(task), SLURM_CPUS_PER_TASK="2")
            self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        self.compare()
        # A task beyond the last layer says so.
        done = self.run_script(text, SLURM_ARRAY_TASK_ID="4", SLURM_CPUS_PER_TASK="2")
        self.assertEqual(done.returncode, 1)
        self.assertIn("20:25 is no window of the 18 layers", done.stderr)


if __name__ == "__main__":
    unittest.main()
