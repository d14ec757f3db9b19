# SPDX-License-Identifier: BSD-3-Clause
"""An ini made for stock pf-localization and a laser works unchanged, and ends where stock ends."""
import math
import re
import shutil
import subprocess
import unittest
from pathlib import Path

from command import CommandTest, main

MRPT = Path('/usr/share/mrpt')
INI = MRPT / 'config_files/pf-localization/localization_demo.ini'
STOCK = shutil.which('pf-localization')
POSE = r'\(([-\d.]+),([-\d.]+),([-\d.]+)deg\)'


@unittest.skipUnless(STOCK and INI.exists(), 'stock pf-localization and its demo are not installed')
class LaserDemoTest(CommandTest):
    def stock_end(self):
        """Where stock ends. It starts at random, wants a display unless told otherwise, looks for files here."""
        text = INI.read_text()
        text = re.sub(r'(?m)^SHOW_PROGRESS_3D_REAL_TIME.*', 'SHOW_PROGRESS_3D_REAL_TIME=false', text)
        text = re.sub(r'(?m)^logOutput_dir=.*', 'logOutput_dir=', text)
        text = text.replace('../../datasets', str(MRPT / 'datasets'))
        ini = self.write('stock.ini', text)
        result = subprocess.run([STOCK, ini], cwd=self.folder, text=True, timeout=120, check=True,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        return [float(v) for v in re.findall('PDF estimation: ' + POSE, result.stdout)[-1]]

    def test_ends_where_stock_ends(self):
        x, y, heading_deg = self.stock_end()
        for seed in (1, 2, 3):
            self.succeed('localize', INI, '--seed', seed, '--out', f'out{seed}')
            last = self.path(f'out{seed}/trajectory.tum').read_text().splitlines()[-1].split()
            position = [float(v) for v in last[1:3]]
            own_heading_deg = math.degrees(2 * math.atan2(float(last[6]), float(last[7])))
            self.assertLess(math.dist(position, (x, y)), 0.2)
            self.assertLess(abs(math.remainder(own_heading_deg - heading_deg, 360)), 3)

    def test_same_seed_same_bytes_for_any_number_of_threads(self):
        outputs = []
        for name, threads in (('once', 1), ('twice', 1), ('threads', 2)):
            printed = self.succeed('localize', INI, '--seed', 5, '--threads', threads, '--out', name)
            files = {f.name: f.read_bytes() for f in self.path(name).iterdir() if f.name != 'timing.csv'}
            outputs.append((printed, files))
        for output in outputs[1:]:
            self.assertEqual(sorted(output[1]), sorted(outputs[0][1]))
            for file, content in output[1].items():
                self.assertEqual(content, outputs[0][1][file], file)
            self.assertEqual(output[0], outputs[0][0])


if __name__ == '__main__':
    main()
