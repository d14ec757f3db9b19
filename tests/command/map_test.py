# SPDX-License-Identifier: BSD-3-Clause
"""`vmcl map`: from a simplemap, and from a log with a trajectory; broken ones are refused."""
import resource
import signal
import subprocess

from command import BIN, FAILED, SAMPLE, SOME_INPUT_BAD, CommandTest, main
from png import grey_png

LOG = SAMPLE / 'map.rawlog'
POSES = SAMPLE / 'map.groundtruth.tum'
SIMPLE_MAP = SAMPLE / 'map.simplemap'


class MapTest(CommandTest):
    def map_of(self, log, trajectory=POSES):
        return ['map', log, '--trajectory', trajectory, '-o', 'out.vmap']

    def first_poses(self, seconds):
        """The trajectory of the log's beginning, for a map that is made quickly."""
        lines = POSES.read_text().splitlines(keepends=True)
        poses = [line for line in lines if not line.startswith('#')]
        end = float(poses[0].split()[0]) + seconds
        return self.write('first.tum', ''.join(line for line in poses if float(line.split()[0]) <= end))

    def test_log_with_trajectory(self):
        printed = self.succeed(*self.map_of(LOG, self.first_poses(2)))
        self.assertIn('keyframes', printed)
        printed = self.succeed('map', '--info', 'out.vmap')
        self.assertIn("camera 'camera': 640x480", printed)
        self.assertIn('not dense', printed)

    def test_network_of_places_that_is_none(self):
        self.assert_refused([*self.map_of(LOG), '--places', 'absent.onnx'], 'absent.onnx')
        self.write('text.onnx', 'no network')
        self.assert_refused([*self.map_of(LOG), '--places', 'text.onnx'], 'text.onnx')

    def test_same_input_same_bytes(self):
        for name in ('once', 'again'):
            self.succeed('map', SIMPLE_MAP, '-o', f'{name}.vmap', '--max-features', 100)
        self.assertEqual(self.path('again.vmap').read_bytes(), self.path('once.vmap').read_bytes())

    def shifted(self, name, seconds, shift, after=0):
        """first_poses, with those later than `after` s moved by `shift` m along x."""
        lines = [line.split() for line in self.first_poses(seconds).read_text().splitlines()]
        start = float(lines[0][0])
        for line in lines:
            if float(line[0]) >= start + after:
                line[1] = str(float(line[1]) + shift)
        return self.write(name, ''.join(' '.join(line) + '\n' for line in lines))

    def test_sessions(self):
        few = self.first_poses(1)
        start = SAMPLE / 'start.rawlog'
        both = ['map', LOG, start, '--trajectory', few, '--trajectory', SAMPLE / 'start.groundtruth.tum']
        self.succeed(*both, '-o', 'out.vmap', '--dense', '--max-features', 300, '--picture', 'out')
        printed = self.succeed('map', '--info', 'out.vmap')
        self.assertIn(', dense\n', printed)
        self.assertIn('session 0', printed)
        self.assertIn('session 1', printed)
        for picture in ('out.svg', 'out.png', 'out.3Dscene'):
            self.assertGreater(self.path(picture).stat().st_size, 1000, picture)
        elsewhere = self.vmcl('map', LOG, start, '--trajectory', few, '--trajectory', self.write(
            'elsewhere.tum', '1000 50 50 0 0 0 0 1\n1000.4 50.05 50 0 0 0 0 1\n1000.8 50.1 50 0 0 0 0 1\n'),
                              '-o', 'out.vmap', '--max-features', 300)
        self.assertEqual(elsewhere.returncode, SOME_INPUT_BAD)
        self.assertIn('shares no landmark', elsewhere.stderr)

    def test_trajectory_that_jumps(self):
        """The map is made, and the jump is named."""
        result = self.vmcl(*self.map_of(LOG, self.shifted('jump.tum', 2, 30, after=1)), '--max-features', 300)
        self.assert_complaint(result, SOME_INPUT_BAD, 'jump.tum', 'jumps by')
        self.succeed('map', '--info', 'out.vmap')

    def test_full_disk(self):
        """The map that is there stays."""
        self.write('out.vmap', 'precious')

        def allow_little():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (10_000, 10_000))

        result = subprocess.run(
            [BIN / 'vmcl', *map(str, self.map_of(LOG, self.first_poses(1))), '--max-features', '300'], text=True,
            capture_output=True, cwd=self.folder, timeout=300, check=False, preexec_fn=allow_little)
        self.assert_complaint(result, FAILED, 'out.vmap', 'cannot be written')
        self.assertEqual(self.path('out.vmap').read_text(), 'precious')
        self.assertEqual([file.name for file in self.folder.glob('out.vmap*')], ['out.vmap'])

    def test_masks(self):
        """What is masked has no features: nothing is left of a view all masked, and the map keeps the mask."""
        few = self.first_poses(2)
        self.write('half.png', grey_png([[0] * 320 + [255] * 320] * 480))
        self.succeed(*self.map_of(LOG, few), '--mask', 'camera=half.png')
        self.assertIn('50 % masked', self.succeed('map', '--info', 'out.vmap'))
        self.path('out.vmap').unlink()
        self.write('all.png', grey_png([[255] * 640] * 480))
        self.write('small.png', grey_png([[0] * 20] * 10))
        self.write('broken.png', 'none')
        for masks, words in ((['all.png'], ['features']), (['small.png'], ['map.rawlog', 'mask']),
                             (['broken.png'], ['broken.png']), (['half.png', 'half.png'], ['--mask']),
                             (['nose=half.png'], ['nose']), (['nowhere.png'], ['nowhere.png'])):
            with self.subTest(masks):
                options = [word for mask in masks for word in ('--mask', mask)]
                self.assert_refused([*self.map_of(LOG, few), *options], *words)

    def test_broken_logs(self):
        for broken in (b'', b'garbage' * 1000, LOG.read_bytes()[:40], SIMPLE_MAP.read_bytes()):
            with self.subTest(broken[:20]):
                self.write('broken.rawlog', broken)
                self.assert_refused(self.map_of('broken.rawlog'), 'broken.rawlog')
        for name in ('nowhere.rawlog', '.'):
            self.assert_refused(self.map_of(name), name)

    def test_logs_with_a_broken_camera(self):
        for how in ('no_intrinsics', 'nan_intrinsics', 'nan_mount', 'missing_image'):
            with self.subTest(how):
                self.assert_refused(self.map_of(self.spoil('map.rawlog', how)), f'{how}.rawlog', "'camera'")

    def test_images_that_do_not_fit_or_show_nothing(self):
        self.assert_refused(self.map_of(self.spoil('map.rawlog', 'small_images')), "'camera'", '320x200')
        self.assert_refused(self.map_of(self.spoil('map.rawlog', 'white_images')), 'no features in any image')

    def test_images_of_the_same_time(self):
        """They are one place."""
        self.assertIn(' 1 keyframes', self.succeed(*self.map_of(self.spoil('map.rawlog', 'same_times'))))

    def test_log_without_a_camera(self):
        self.assert_refused(self.map_of(self.spoil('map.rawlog', 'no_camera')), 'no_camera.rawlog', 'camera')

    def test_broken_trajectories(self):
        good = POSES.read_text()
        for broken in ('0 nan 0 0 0 0 0 1\n', good + '0 0 0 0 0 0 0 1\n', 'garbage\n', good[:len(good) // 2] + ' x\n'):
            with self.subTest(broken[-40:]):
                self.write('broken.tum', broken)
                self.assert_refused(self.map_of(LOG, 'broken.tum'), 'broken.tum')
        self.assert_refused(self.map_of(LOG, 'nowhere.tum'), 'nowhere.tum')
        self.write('other.tum', '5 0 0 0 0 0 0 1\n6 0 0 0 0 0 0 1\n')
        self.assert_refused(self.map_of(LOG, 'other.tum'), 'map.rawlog', 'pose')

    def test_broken_simplemaps(self):
        good = SIMPLE_MAP.read_bytes()
        for broken in (b'', b'garbage' * 1000, good[:len(good) // 2], LOG.read_bytes()):
            with self.subTest(broken[:20]):
                self.write('broken.simplemap', broken)
                self.assert_refused(['map', 'broken.simplemap', '-o', 'out.vmap'], 'broken.simplemap')
        self.assert_refused(['map', 'nowhere.simplemap', '-o', 'out.vmap'], 'nowhere.simplemap')

    def test_log_that_is_cut_off(self):
        """What there is of it is used, and the end is named."""
        log = LOG.read_bytes()
        self.write('map_Images/cut', '')
        self.write('cut.rawlog', log[:len(log) // 2])
        self.path('cut_Images').symlink_to(SAMPLE / 'map_Images')
        result = self.vmcl(*self.map_of('cut.rawlog', self.first_poses(2)))
        self.assert_complaint(result, SOME_INPUT_BAD, 'cut.rawlog', 'entry')
        self.succeed('map', '--info', 'out.vmap')

    def test_bad_arguments(self):
        for arguments, word in (([], 'INPUT'), ([LOG], 'output'), ([LOG, '-o', 'out.vmap'], 'trajectory'),
                                ([SIMPLE_MAP, '--trajectory', POSES, '-o', 'out.vmap'], 'trajectory'),
                                ([LOG, LOG, '--trajectory', POSES, '-o', 'out.vmap'], 'trajectory'),
                                ([SIMPLE_MAP, '-o', 'out.vmap', '--features', 'magic'], 'magic'),
                                ([SIMPLE_MAP, '-o', 'out.vmap', '--max-features', '0'], 'max_features'),
                                ([SIMPLE_MAP, '-o', 'out.vmap', '--seed', '-1'], 'seed'),
                                ([SIMPLE_MAP, '-o', 'out.vmap', '--keyframe-distance', 'nan'], 'keyframe_distance'),
                                ([SIMPLE_MAP, '-o', 'nowhere/out.vmap'], 'nowhere/out.vmap')):
            with self.subTest(arguments[-2:]):
                self.assert_refused(['map', *arguments], word)

    def test_info_of_broken_maps(self):
        good = (SAMPLE / 'sample.vmap').read_bytes()
        flipped = bytearray(good)
        flipped[len(good) // 2] ^= 1
        huge = good[:12] + b'\xff' * 8 + good[20:]
        for broken in (b'', b'garbage' * 1000, good[:len(good) // 2], bytes(flipped), huge, good + b'\0'):
            with self.subTest(broken[:20]):
                self.write('broken.vmap', broken)
                self.assert_refused(['map', '--info', 'broken.vmap'], 'broken.vmap')
        self.assert_refused(['map', '--info', 'nowhere.vmap'], 'nowhere.vmap')


if __name__ == '__main__':
    main()
