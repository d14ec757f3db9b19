# SPDX-License-Identifier: BSD-3-Clause
"""`vmcl localize` with broken experiments, logs and maps of a laser: the demo that MRPT comes with."""
import gzip
import unittest
from pathlib import Path

from command import FAILED, SOME_INPUT_BAD, CommandTest, main

MRPT = Path('/usr/share/mrpt')
INI = MRPT / 'config_files/pf-localization/localization_demo.ini'
LOG = MRPT / 'datasets/localization_demo.rawlog'
MAP = MRPT / 'datasets/localization_demo.simplemap.gz'


@unittest.skipUnless(INI.exists(), "MRPT's laser demo is not installed")
class LocalizeLaserTest(CommandTest):
    def assert_ini_refused(self, ini, *words):
        self.write('my.ini', ini)
        self.assert_refused(['localize', 'my.ini', '--rawlog', LOG, '--map', MAP, '--out', 'out'], 'my.ini', *words)

    def with_line(self, section, line):
        """The demo's ini with one more line at the head of a section, or a new one."""
        head = f'[{section}]\n'
        ini = INI.read_text()
        return ini.replace(head, head + line + '\n') if head in ini else f'{ini}\n{head}{line}\n'

    def with_value(self, key, value):
        lines = INI.read_text().splitlines()
        changed = [f'{key}={value}' if line.replace(' ', '').startswith(f'{key}=') else line for line in lines]
        self.assertNotEqual(changed, lines, key)
        return '\n'.join(changed) + '\n'

    def test_missing_ini(self):
        self.assert_refused(['localize', 'nowhere.ini'], 'nowhere.ini')
        self.assert_refused(['localize', '.'], '.')
        self.assert_refused(['localize'], 'config')

    def test_ini_that_is_none(self):
        for ini in ('', 'garbage', b'\0\xff' * 500):
            self.assert_ini_refused(ini, 'LocalizationExperiment')

    def test_unknown_keys(self):
        self.assert_ini_refused(self.with_line('vmcl', 'recovery_alpha_slwo = 0.001'), '[vmcl]', 'recovery_alpha_slwo')
        self.assert_ini_refused(self.with_line('MetricMap', 'visualKeyfarmes_count=1'), 'visualKeyfarmes_count')

    def test_values_of_a_wrong_kind(self):
        for key in ('recovery_alpha_slow', 'max_position_deviation', 'min_share'):
            for value in ('nan', 'inf', 'x', '', '-1', '1e999'):
                with self.subTest(key=key, value=value):
                    self.assert_ini_refused(self.with_line('vmcl', f'{key} = {value}'), '[vmcl]', key)
        for key, values in (('particles_count', ('x', '0', '1e30', '99999999999')), ('init_PDF_min_x', ('nan', 'x')),
                            ('init_PDF_mode', ('7',)), ('use_3D_poses', ('true', 'x')), ('minStdXY', ('nan', '-1')),
                            ('occupancyGrid_count', ('x', '-1', '1000000000')), ('KLD_binSize_XY', ('nan', '0')),
                            ('KLD_maxSampleSize', ('1', '-1')), ('resolution', ('nan',)), ('LF_stdHit', ('nan',))):
            for value in values:
                with self.subTest(key=key, value=value):
                    self.assert_ini_refused(self.with_value(key, value), key)

    def test_value_that_mrpt_refuses(self):
        self.assert_ini_refused(self.with_value('resolution', '0'), 'res')

    def test_options_out_of_range(self):
        for option in (('--threads', '0'), ('--seed', 'x'), ('--seed', '-1')):
            self.assert_refused(['localize', INI, *option], option[0])

    def test_broken_logs(self):
        good = gzip.decompress(LOG.read_bytes()) if LOG.read_bytes()[:2] == b'\x1f\x8b' else LOG.read_bytes()
        for broken in (b'', b'garbage' * 1000, MAP.read_bytes(), good[:40]):
            with self.subTest(broken[:20]):
                self.write('broken.rawlog', broken)
                self.assert_refused(['localize', INI, '--rawlog', 'broken.rawlog', '--out', 'out'], 'broken.rawlog')
        self.assert_refused(['localize', INI, '--rawlog', 'nowhere.rawlog', '--out', 'out'], 'nowhere.rawlog')
        self.assert_refused(['localize', INI, '--rawlog', '.', '--out', 'out'], '.')

    def test_log_that_is_cut_off(self):
        """What there is of it is used, and the end is named."""
        log = LOG.read_bytes()
        self.write('cut.rawlog', log[:len(log) // 2])
        result = self.vmcl('localize', INI, '--rawlog', 'cut.rawlog', '--out', 'out')
        self.assert_complaint(result, SOME_INPUT_BAD, 'cut.rawlog', 'entry')
        self.assertIn('updates', result.stdout)
        self.assertTrue(self.path('out/summary.json').exists())

    def test_broken_maps(self):
        good = gzip.decompress(MAP.read_bytes())
        for broken in (b'', b'garbage' * 1000, good[:len(good) // 2], LOG.read_bytes()):
            with self.subTest(broken[:20]):
                self.write('broken.simplemap', broken)
                self.assert_refused(['localize', INI, '--map', 'broken.simplemap', '--out', 'out'], 'broken.simplemap')
                self.write('broken.gridmap', broken)
                self.assert_refused(['localize', INI, '--map', 'broken.gridmap', '--out', 'out'], 'broken.gridmap')
        self.write('map.odd', good)
        for name in ('nowhere.simplemap', 'map.odd', '.'):
            self.assert_refused(['localize', INI, '--map', name, '--out', 'out'], name)

    def test_broken_ground_truth(self):
        self.assert_refused(['localize', INI, '--groundtruth', 'nowhere.tum', '--out', 'out'], 'nowhere.tum')
        self.write('broken.tum', '0 nan 0 0 0 0 0 1\n')
        self.assert_refused(['localize', INI, '--groundtruth', 'broken.tum', '--out', 'out'], 'broken.tum:1')

    def test_output_that_cannot_be_written(self):
        self.write('taken', '')
        taken = self.vmcl('localize', INI, '--rawlog', LOG, '--map', MAP, '--out', 'taken')
        self.assert_complaint(taken, FAILED, 'taken')
        absent = ['localize', INI, '--map', MAP, '--rawlog', 'nowhere.rawlog', '--out', 'new/out']
        self.assert_refused(absent, 'nowhere')


if __name__ == '__main__':
    main()
