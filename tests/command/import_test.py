# SPDX-License-Identifier: BSD-3-Clause
"""`vmcl import tum`: a good data set, and each of its files missing or broken."""
from command import SOME_INPUT_BAD, CommandTest, main
from png import noise_png

CALIBRATION = """\
camera: {width: 32, height: 24, fx: 30, fy: 30, cx: 15.5, cy: 11.5, distortion: [0, 0, 0, 0, 0]}
robot_from_camera: {x: 0.1, y: 0, z: 0.3, yaw_deg: 0, pitch_deg: 0, roll_deg: 0}
"""
IMAGES = 4
IMPORT = ['import', 'tum', 'set', '-o', 'log.rawlog']


class ImportTest(CommandTest):
    def setUp(self):
        super().setUp()
        self.write('set/calibration.yaml', CALIBRATION)
        self.write('set/rgb.txt', '# time file\n' + ''.join(f'{i}.0 rgb/{i}.png\n' for i in range(IMAGES)))
        poses = ''.join(f'{i / 2} {0.1 * i} 0 0 0 0 0 1\n' for i in range(2 * IMAGES))
        for name in ('odometry', 'groundtruth'):
            self.write(f'set/{name}.txt', '# time tx ty tz qx qy qz qw\n' + poses)
        for i in range(IMAGES):
            self.write(f'set/rgb/{i}.png', noise_png(32, 24, seed=i))

    def test_good_set(self):
        printed = self.succeed(*IMPORT)
        self.assertIn('4 images', printed)
        self.assertEqual(len(list(self.path('log_Images').iterdir())), IMAGES)
        once = self.path('log.rawlog').read_bytes()
        self.succeed(*IMPORT)
        self.assertEqual(self.path('log.rawlog').read_bytes(), once)

    def test_odometry_and_ground_truth_are_optional(self):
        self.path('set/odometry.txt').unlink()
        self.path('set/groundtruth.txt').unlink()
        self.assertIn('4 images', self.succeed(*IMPORT))

    def test_missing_directory(self):
        self.assert_refused(['import', 'tum', 'nowhere', '-o', 'log.rawlog'], 'nowhere')

    def test_missing_files(self):
        for name in ('rgb.txt', 'calibration.yaml'):
            with self.subTest(name):
                text = self.path(f'set/{name}').read_text()
                self.path(f'set/{name}').unlink()
                self.assert_refused(IMPORT, name)
                self.write(f'set/{name}', text)

    def test_broken_calibration(self):
        for broken in ('', 'garbage', '{', '[1, 2]', CALIBRATION.replace('fx: 30', 'fx: .nan'),
                       CALIBRATION.replace('fx: 30', 'fx: .inf'), CALIBRATION.replace('fx: 30', 'fx: -30'),
                       CALIBRATION.replace('fx: 30, ', ''), CALIBRATION.replace('fx: 30', 'fx: [30]'),
                       CALIBRATION.replace('x: 0.1', 'x: .nan'), CALIBRATION.replace('width: 32', 'width: 1e12'),
                       CALIBRATION.replace('[0, 0, 0, 0, 0]', '[0, 0, .nan, 0, 0]'),
                       CALIBRATION + 'no_such_key: 1\n', '\x00\xff' * 100, '[' * 100000):
            with self.subTest(broken[:120]):
                self.write('set/calibration.yaml', broken)
                self.assert_refused(IMPORT, 'calibration.yaml')

    def test_broken_poses(self):
        for name in ('odometry.txt', 'groundtruth.txt'):
            good = self.path(f'set/{name}').read_text()
            for bad_line in ('garbage', '9.0 0 0 0 0 0 0', '9.0 nan 0 0 0 0 0 1', '9.0 inf 0 0 0 0 0 1',
                             '9.0 0 0 0 0 0 0 0', '1.0 0 0 0 0 0 0 1'):
                with self.subTest(name, line=bad_line):
                    self.write(f'set/{name}', good + bad_line + '\n')
                    self.assert_refused(IMPORT, name)
            self.write(f'set/{name}', good)

    def test_no_images(self):
        self.write('set/rgb.txt', '# time file\n')
        self.assert_refused(IMPORT, 'rgb.txt')

    def test_broken_images(self):
        """A bad image is named and left out; the rest is imported."""
        for broken in (b'', b'garbage', noise_png(32, 24)[:200], noise_png(16, 24)):
            with self.subTest(broken[:40]):
                self.write('set/rgb/1.png', broken)
                result = self.vmcl(*IMPORT)
                self.assert_complaint(result, SOME_INPUT_BAD, 'rgb.txt:3', '1.png')
                self.assertIn('3 images', result.stdout)
        self.path('set/rgb/1.png').unlink()
        self.assert_complaint(self.vmcl(*IMPORT), SOME_INPUT_BAD, '1.png')

    def test_images_out_of_the_directory(self):
        for name in ('/etc/passwd', '../../secret.png'):
            self.write('set/rgb.txt', f'0.0 rgb/0.png\n1.0 {name}\n')
            self.assert_complaint(self.vmcl(*IMPORT), SOME_INPUT_BAD, 'rgb.txt:2', name)

    def test_times_out_of_range(self):
        for time in ('nan', 'inf', '1e999', '1e300', '-1'):
            with self.subTest(time):
                self.write('set/rgb.txt', f'0.0 rgb/0.png\n{time} rgb/1.png\n')
                self.assert_complaint(self.vmcl(*IMPORT), SOME_INPUT_BAD, 'rgb.txt:2')

    def test_all_images_broken(self):
        for i in range(IMAGES):
            self.write(f'set/rgb/{i}.png', b'garbage')
        self.assert_refused(IMPORT, 'rgb.txt', '0.png')

    def test_output_that_cannot_be_written(self):
        self.assert_refused(['import', 'tum', 'set', '-o', 'nowhere/log.rawlog'], 'nowhere/log.rawlog')


if __name__ == '__main__':
    main()
