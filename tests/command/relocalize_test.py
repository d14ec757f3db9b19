# SPDX-License-Identifier: BSD-3-Clause
"""`vmcl relocalize`: finds the robot from single images, gives the same bytes again, and refuses broken input."""
import csv

from command import SAMPLE, CommandTest, main

MAP = SAMPLE / 'sample.vmap'
LOG = SAMPLE / 'query.rawlog'
TRUTH = SAMPLE / 'query.groundtruth.tum'


class RelocalizeTest(CommandTest):
    def relocalize(self, log=LOG, vmap=MAP, out='out'):
        return ['relocalize', '--map', vmap, '--rawlog', log, '--out', out]

    def test_finds_the_robot(self):
        printed = self.succeed(*self.relocalize(), '--groundtruth', TRUTH)
        self.assertIn('with ground truth', printed)
        self.assertRegex(printed, r'in 0\.25 m, 5 deg +(9\d|100)\.\d %')

    def test_same_seed_same_bytes_for_any_number_of_threads(self):
        for name, threads in (('once', 1), ('threads', 2)):
            self.succeed(*self.relocalize(out=name), '--seed', 5, '--threads', threads)
        once = self.path('once/relocalize.csv').read_bytes()
        self.assertEqual(self.path('threads/relocalize.csv').read_bytes(), once)
        self.assertGreater(len(list(csv.reader(once.decode().splitlines()))), 50)

    def test_broken_maps(self):
        good = MAP.read_bytes()
        for broken in (b'', b'garbage' * 1000, good[:len(good) // 2]):
            with self.subTest(broken[:20]):
                self.write('broken.vmap', broken)
                self.assert_refused(self.relocalize(vmap='broken.vmap'), 'broken.vmap')
        self.assert_refused(self.relocalize(vmap='nowhere.vmap'), 'nowhere.vmap')

    def test_broken_logs(self):
        for broken in (b'', b'garbage' * 1000, LOG.read_bytes()[:40], MAP.read_bytes()):
            with self.subTest(broken[:20]):
                self.write('broken.rawlog', broken)
                self.assert_refused(self.relocalize('broken.rawlog'), 'broken.rawlog')
        self.assert_refused(self.relocalize('nowhere.rawlog'), 'nowhere.rawlog')

    def test_logs_with_a_broken_camera(self):
        for how in ('no_intrinsics', 'nan_intrinsics', 'nan_mount', 'missing_image'):
            with self.subTest(how):
                self.assert_refused(self.relocalize(self.spoil('query.rawlog', how)), f'{how}.rawlog', "'camera'")
        self.assert_refused(self.relocalize(self.spoil('query.rawlog', 'no_camera')), 'no_camera.rawlog', 'camera')

    def test_images_of_another_size(self):
        self.assert_refused(self.relocalize(self.spoil('query.rawlog', 'small_images')), "'camera'", '320x200')

    def test_images_that_show_nothing(self):
        self.assertRegex(self.succeed(*self.relocalize(self.spoil('query.rawlog', 'white_images'))), r'found +0')

    def test_broken_ground_truth(self):
        self.write('broken.tum', '0 nan 0 0 0 0 0 1\n')
        self.assert_refused([*self.relocalize(), '--groundtruth', 'broken.tum'], 'broken.tum:1')

    def test_options_out_of_range(self):
        for option in (('--retrieved', '0'), ('--threads', '0'), ('--seed', 'x'), ('--seed', '-1')):
            self.assert_refused([*self.relocalize(), *option], option[0])


if __name__ == '__main__':
    main()
