# SPDX-License-Identifier: BSD-3-Clause
"""MRPT's own pf-localization, unchanged, localizes with a camera when libvmcl-mrpt.so is preloaded."""
import math
import os
import re
import shutil
import subprocess
import unittest

from command import LIB, SAMPLE, SHARED, SOURCE, CommandTest, main

STOCK = shutil.which('pf-localization')
INI = SOURCE / 'share/config/pf-localization-camera.ini'
PLUGIN = LIB / 'libvmcl-mrpt.so'
BOX = SHARED / 'data/turtlebot_box'
POSE = r'PDF estimation: \(([-\d.]+),([-\d.]+),([-\d.]+)deg\)'


@unittest.skipUnless(STOCK, 'stock pf-localization is not installed')
class StockTest(CommandTest):
    def run_stock(self, preload):
        """In the test's folder, which holds the map and the log under the names that the ini gives them."""
        environment = {**os.environ, **({'LD_PRELOAD': str(PLUGIN)} if preload else {})}
        return subprocess.run([STOCK, INI], cwd=self.folder, env=environment, text=True, timeout=600, check=False,
                              errors='backslashreplace', stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

    def errors_at_the_end(self, preload=True):
        """Of position, m, and of heading, deg, where the ground truth ends."""
        result = self.run_stock(preload)
        self.assertEqual(result.returncode, 0, result.stdout[-2000:])
        x, y, heading_deg = (float(v) for v in re.findall(POSE, result.stdout)[-1])
        true = [float(v) for v in self.path('query.groundtruth.tum').read_text().splitlines()[-1].split()[1:]]
        true_heading_deg = math.degrees(2 * math.atan2(true[5], true[6]))
        return math.dist((x, y), true[:2]), abs(math.remainder(heading_deg - true_heading_deg, 360))

    def assert_localizes(self):
        """In one of two runs, as stock starts at random, by a seed of its own, and has no way back when it is lost.

        Its filter, fed with images measured beforehand, was so in none of 278 runs of the real log and of 300 of the
        simulated one, the whole program in none of 8 and 15: by that in less than one of 75 (Wilson, 95 %), twice in a
        row in less than one of 5000.
        """
        errors = []
        while len(errors) < 2:
            errors.append(self.errors_at_the_end())
            if errors[-1][0] < 0.25 and errors[-1][1] < 5:
                return
        self.fail(f'errors at the end of two runs, m and deg: {errors}')

    def use(self, log):
        """Puts a log with its images and its ground truth in the folder as query."""
        for suffix in ('.rawlog', '_Images', '.groundtruth.tum'):
            self.path(f'query{suffix}').symlink_to(f'{log}{suffix}')

    def test_simulated_room(self):
        self.use(SAMPLE / 'query')
        self.path('map.vmap').symlink_to(SAMPLE / 'sample.vmap')
        self.assert_localizes()
        metres_without_plugin, _ = self.errors_at_the_end(preload=False)
        self.assertGreater(metres_without_plugin, 1)

    @unittest.skipUnless(BOX.exists(), f'{BOX} is not there')
    def test_real_robot(self):
        for name, first, last in (('drive', 0, 399), ('query', 770, 851)):  # the query is where 0 to 130 were
            self.succeed('import', 'tum', BOX, '-o', f'{name}.rawlog', '--first-frame', first, '--last-frame', last)
        self.succeed('map', 'drive.rawlog', '--trajectory', 'drive.groundtruth.tum', '-o', 'map.vmap',
                     '--mask-rows-from-top', 75)
        self.assert_localizes()


if __name__ == '__main__':
    main()
