# SPDX-License-Identifier: BSD-3-Clause
"""`vmcl localize` with a camera: finds the robot, gives the same bytes again, and refuses broken logs and maps."""
import json

from command import SAMPLE, SOME_INPUT_BAD, SOURCE, CommandTest, main

INI = SOURCE / 'share/config/camera.ini'
MAP = SAMPLE / 'sample.vmap'
LOG = SAMPLE / 'start.rawlog'


class LocalizeCameraTest(CommandTest):
    def localize(self, log=LOG, vmap=MAP, ini=INI, out='out'):
        return ['localize', ini, '--map', vmap, '--rawlog', log, '--out', out]

    def test_finds_the_robot(self):
        self.succeed(*self.localize(SAMPLE / 'query.rawlog'), '--groundtruth', SAMPLE / 'query.groundtruth.tum')
        summary = json.loads(self.path('out/summary.json').read_text())
        self.assertTrue(summary['final']['localized'])
        truth = summary['ground_truth']
        self.assertTrue(truth['converged'])
        self.assertEqual(truth['false_accepts'], 0)
        self.assertLess(truth['position_error_after_convergence']['rmse'], 0.1)
        self.assertEqual(sorted(f.name for f in self.path('out').iterdir()),
                         ['frames.csv', 'health.csv', 'health.json', 'path.png', 'path.svg', 'pose.yaml',
                          'scene.3Dscene', 'summary.json', 'timing.csv', 'trajectory.tum'])
        health = json.loads(self.path('out/health.json').read_text())
        self.assertEqual(health['final'], 'tracking')
        self.assertEqual(health['became_lost_at'], [])
        self.assertEqual(sum(health['updates'].values()), summary['frames'])

    def test_same_seed_same_bytes_for_any_number_of_threads(self):
        outputs = []
        for name, threads in (('once', 1), ('twice', 1), ('threads', 2)):
            self.succeed(*self.localize(out=name), '--seed', 5, '--threads', threads)
            outputs.append({f.name: f.read_bytes() for f in self.path(name).iterdir() if f.name != 'timing.csv'})
        for output in outputs[1:]:
            self.assertEqual(sorted(output), sorted(outputs[0]))
            for name, content in output.items():
                self.assertEqual(content, outputs[0][name], name)

    def test_goes_on_where_an_earlier_run_ended(self):
        self.write('pose.yaml', 'robot_in_map: [1000, 0, 0]\ncovariance: [0.01, 0, 0, 0, 0.01, 0, 0, 0, 0.01]\n')
        off_the_map = self.vmcl(*self.localize(), '--initial-pose', 'pose.yaml')
        self.assert_complaint(off_the_map, SOME_INPUT_BAD, 'the initial pose is off the map')
        self.succeed(*self.localize(out='once'))
        self.succeed(*self.localize(), '--initial-pose', 'once/pose.yaml')
        self.write('broken.yaml', 'robot_in_map: [1]\n')
        self.assert_refused([*self.localize(), '--initial-pose', 'broken.yaml'], 'broken.yaml', 'robot_in_map')

    def test_broken_maps(self):
        good = MAP.read_bytes()
        flipped = bytearray(good)
        flipped[len(good) // 2] ^= 1
        for broken in (b'', b'garbage' * 1000, good[:len(good) // 2], bytes(flipped)):
            with self.subTest(broken[:20]):
                self.write('broken.vmap', broken)
                self.assert_refused(self.localize(vmap='broken.vmap'), 'broken.vmap')
        self.assert_refused(self.localize(vmap='nowhere.vmap'), 'nowhere.vmap')

    def test_logs_with_a_broken_camera(self):
        for how in ('nan_intrinsics', 'missing_image', 'no_intrinsics', 'nan_mount'):
            with self.subTest(how):
                self.assert_refused(self.localize(self.spoil('start.rawlog', how)), f'{how}.rawlog', "'camera'")

    def test_log_without_a_camera(self):
        self.assert_refused(self.localize(self.spoil('start.rawlog', 'no_camera')), 'no_camera.rawlog',
                            'no observation')

    def test_log_with_odometry_that_is_not_finite(self):
        """Such readings are passed over and named; the images still tell where the robot is."""
        result = self.vmcl(*self.localize(self.spoil('start.rawlog', 'nan_odometry')))
        self.assert_complaint(result, SOME_INPUT_BAD, 'nan_odometry.rawlog', 'odometry')

    def test_images_that_are_broken(self):
        """They are named; the others are used."""
        log = self.copy(LOG)
        images = self.path('start_Images')
        images.mkdir()
        for image in (SAMPLE / 'start_Images').iterdir():
            (images / image.name).symlink_to(image)
        bad = sorted(images.iterdir())[7]
        every_image = ['--set', 'vmcl.update_min_d=0', '--set', 'vmcl.update_min_a=0']
        for broken in (b'', b'garbage', bad.read_bytes()[:300]):
            with self.subTest(broken[:20]):
                bad.unlink()
                bad.write_bytes(broken)
                self.assert_complaint(self.vmcl(*self.localize(log), *every_image), SOME_INPUT_BAD,
                                      'start.rawlog', bad.name)

    def test_disturbed_drives(self):
        self.succeed(*self.localize(out='dark'), '--dim', 0.5, 100, 0, '--drop-images', 0.2, '--odometry-scale', 1.05)
        frames = self.path('dark/frames.csv').read_text().splitlines()[1:]
        self.assertTrue(all(frame.split(',')[-1] == '0' for frame in frames[-3:]), frames[-3:])  # no image matches

    def test_choices_that_make_no_sense(self):
        for options, word in ((['--sensors', 'sonar'], '--sensors'), (['--sensors', 'laser'], 'no map for a laser'),
                              (['--sensors', 'both'], 'no map for a laser'), (['--start', 'here'], '--start'),
                              (['--start', 'given'], '--groundtruth'), (['--kidnap', '1'], '--kidnap'),
                              (['--kidnap', '0', '1'], '--kidnap'),
                              (['--drop-images', '1'], 'drop_images'),
                              (['--odometry-scale', 'nan'], 'odometry_scale'),
                              (['--dim', '1', '0', '0'], 'dim.for'), (['--dim', '1', '1', '2'], 'dim.light'),
                              (['--set', 'min_share'], 'section.key=value'),
                              (['--set', 'vmcl.min_sahre=1'], 'min_sahre'), (['--set', 'PF.BETA=1'], 'PF'),
                              (['--kidnap', '1', '5'], 'ends before the kidnapped robot is seen again')):
            with self.subTest(options):
                self.assert_refused([*self.localize(), *options], word)

    def test_unknown_keys(self):
        for section, key in (('vmcl', 'injection_shore'), ('MetricMap_visualKeyframes_00_creationOpts', 'map_fiel'),
                             ('MetricMap_visualKeyframes_00_likelihoodOpts', 'retreived'),
                             ('MetricMap_visualKeyframes_00_insertOpts', 'max_featuers')):
            with self.subTest(section):
                head = f'[{section}]\n'
                ini = INI.read_text()
                ini = ini.replace(head, f'{head}{key} = 1\n') if head in ini else f'{ini}\n{head}{key} = 1\n'
                self.assert_refused(self.localize(ini=self.write('my.ini', ini)), 'my.ini', section, key)


if __name__ == '__main__':
    main()
