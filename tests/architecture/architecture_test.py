# SPDX-License-Identifier: BSD-3-Clause
"""The rules of architecture.py find what they are there to find, and nothing else."""
import tempfile
import unittest
from pathlib import Path

from architecture import LICENCE, violations

SPDX = f'// {LICENCE}\n'


class ArchitectureTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)

    def found(self, path, text):
        """Violations of a tree that holds this one file."""
        file = self.root / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding='utf-8')
        result = list(violations(self.root))
        file.unlink()
        return result

    def assert_allowed(self, path, include):
        self.assertEqual(self.found(path, f'{SPDX}#include {include}\n'), [])

    def assert_forbidden(self, path, include, reason):
        found = self.found(path, f'{SPDX}#include {include}\n')
        self.assertEqual(len(found), 1, found)
        self.assertTrue(found[0].startswith(f'{path}:2: '), found)
        self.assertIn(reason, found[0])

    def test_includes_run_downwards(self):
        self.assert_allowed('libs/mapping/src/a.cpp', '"vmcl/mapping/map_file.h"')
        self.assert_allowed('libs/mapping/src/a.cpp', '"vmcl/vision/image.h"')
        self.assert_allowed('libs/mapping/src/a.cpp', '<vector>')
        self.assert_forbidden('libs/geometry/src/a.cpp', '"vmcl/estimation/estimator.h"', 'geometry (floor 0)')
        self.assert_forbidden('libs/mapping/include/vmcl/mapping/a.h', '<vmcl/mrpt/a.h>', 'mapping (floor 2)')

    def test_neighbours_on_one_floor_do_not_meet(self):
        self.assert_forbidden('libs/estimation/src/a.cpp', '"vmcl/vision/image.h"', '(floor 1)')
        self.assert_forbidden('libs/datasets/src/a.cpp', '  "vmcl/evaluation/a.h"', '(floor 5)')

    def test_every_library_has_a_floor(self):
        self.assert_forbidden('libs/geometry/src/a.cpp', '"vmcl/helpers/a.h"', 'no library')
        self.assertEqual(self.found('libs/helpers/a.h', SPDX), ['libs/helpers/a.h:1: libs/helpers has no floor'])

    def test_no_way_around_the_include_path(self):
        self.assert_allowed('libs/geometry/src/deep/a.cpp', '"../a.h"')
        self.assert_forbidden('libs/geometry/src/a.cpp', '"../../mrpt/src/a.h"', 'outside of its library')

    def test_mrpt_stays_upstairs(self):
        self.assert_allowed('libs/mrpt/include/vmcl/mrpt/a.h', '<mrpt/obs/CObservation.h>')
        self.assert_allowed('libs/datasets/src/a.cpp', '<mrpt/obs/CObservation.h>')
        self.assert_forbidden('libs/relocalization/src/a.cpp', '<mrpt/obs/CObservation.h>', 'MRPT header')

    def test_opencv_stays_in_its_libraries(self):
        self.assert_allowed('libs/vision/src/a.cpp', '<opencv2/core.hpp>')
        self.assert_forbidden('libs/mrpt/src/a.cpp', '<opencv2/core.hpp>', 'OpenCV header')
        self.assert_forbidden('libs/vision/include/vmcl/vision/a.h', '<opencv2/core.hpp>', 'public header')

    def test_licence_length_and_width(self):
        self.assertEqual(self.found('apps/a.sh', f'#!/bin/bash\n# {LICENCE}\n'), [])
        self.assertIn('apps/a.sh:1: no line', self.found('apps/a.sh', '#!/bin/bash\n')[0])
        self.assertIn('tests/CMakeLists.txt:1: no line', self.found('tests/CMakeLists.txt', '\n')[0])
        self.assertEqual(self.found('libs/vision/src/a.cpp', SPDX + '\n' * 299), [])
        self.assertIn('longer than 300', self.found('libs/vision/src/a.cpp', SPDX + '\n' * 300)[0])
        self.assertEqual(self.found('apps/a.cpp', SPDX + 'é' * 120), [])
        self.assertIn('apps/a.cpp:2: wider than 120', self.found('apps/a.cpp', SPDX + 'x' * 121)[0])


if __name__ == '__main__':
    unittest.main()
