# SPDX-License-Identifier: BSD-3-Clause
"""Other programs read what `vmcl evaluate` writes, and find the same: evo, where it is installed, and OpenLORIS' own
evaluate.py, where OPENLORIS_SCENE_TOOLS names its directory (and python3-tf, numpy and matplotlib are installed)."""
import csv
import os
import re
import shutil
import subprocess
import unittest
from pathlib import Path

from command import SAMPLE, SOURCE, CommandTest, main

TOOLS = os.environ.get('OPENLORIS_SCENE_TOOLS')
RUN = 'start.laser.laser.global.1'
GROUND_TRUTH = SAMPLE / 'start.groundtruth.tum'


class TrajectoryReadersTest(CommandTest):
    def setUp(self):
        super().setUp()
        self.write('experiment.yaml', f'''
rawlogs: [{{rawlog: {SAMPLE}/start.rawlog, maps: [{SAMPLE}/map.simplemap], ground_truth: {GROUND_TRUTH},
           openloris: {{scene: office, sequence: 1}}}}]
sensors: [laser]
configurations: [{{ini: {SOURCE}/share/config/laser.ini}}]
starts: [global]
seeds: 1
''')
        self.succeed('evaluate', 'experiment.yaml', '-o', 'out')
        self.run_row = next(csv.DictReader(self.path('out/runs.csv').read_text().splitlines()))

    def run_program(self, *command):
        result = subprocess.run([*map(str, command)], cwd=self.folder, text=True, capture_output=True, check=False,
                                env={**os.environ, 'MPLBACKEND': 'Agg'})
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout

    @unittest.skipUnless(shutil.which('evo_ape'), 'evo is not installed')
    def test_evo(self):
        printed = self.run_program('evo_ape', 'tum', GROUND_TRUTH, self.path(f'out/runs/{RUN}/trajectory.tum'))
        rmse = float(re.search(r'rmse\s+([\d.]+)', printed)[1])
        self.assertAlmostEqual(rmse, float(self.run_row['position_rmse_m']), delta=0.01)  # it does not interpolate

    @unittest.skipUnless(TOOLS, 'OPENLORIS_SCENE_TOOLS is not set')
    def test_openloris(self):
        poses = [line for line in GROUND_TRUTH.read_text().splitlines() if not line.startswith('#')]
        self.write('gt_office_1.txt', '\n'.join(['scene: office', 'frame: base_link', 'seq: 1', *poses]))
        file = self.path('out/openloris/laser.laser.global.1/office.txt')
        printed = self.run_program('/usr/bin/python3', Path(TOOLS) / 'benchmark/evaluate.py', '-np', '-k', '-t', 1,
                                   '-o', 30, '-g', self.folder, file)
        for title, measure in (('correct rate', 'correct_rate'), ('reloc score', 'relocalization_score')):
            found = float(re.search(title + r'\s+([\d.]+)', printed)[1])
            self.assertAlmostEqual(found, float(self.run_row[measure]), places=3)


if __name__ == '__main__':
    main()
