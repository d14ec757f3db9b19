# SPDX-License-Identifier: BSD-3-Clause
"""`vmcl simulate` with every kind of sensor: same bytes twice, read by MRPT's own program; bad scenes, a full disk."""
import resource
import shutil
import signal
import subprocess

from command import BIN, FAILED, CommandTest, main

SCENE = """\
prototypes:
  post: [{shape: cylinder, center: [0, 0], radius: 0.1, height: 1.2, cover: {material: wood}}]
floors: [{from: [0, 0], to: [4, 3], cover: {material: planks, rgb: [170, 120, 80]}}]
walls:
  - {name: south wall, from: [0, 0], to: [4, 0], left: {material: bricks}, right: {material: plain},
     windows: [{at: 2, width: 1, sill: 0.8}]}
  - {name: east wall, from: [4, 0], to: [4, 3], left: {material: plaster}, right: {material: plain}}
furniture: [{name: post, kind: post, at: [3, 2, 0], rgb: [90, 60, 40]}]
lamps: [{at: [2, 1.5, 2.2]}]
view: {kind: city, center: [2, 1.5]}
robot: {tilt_deg: 0.3}
cameras:
  - {label: mono, rate: 3, width: 161, height: 120, distortion: [-0.1, 0, 0, 0, 0], exposure_time: 0.02,
     sigma_gain: 0.1, robot_from_camera: {z: 0.5}}
  - {label: depth, rate: 3, width: 160, height: 120, depth: {max_range: 5}, robot_from_camera: {z: 0.5, yaw_deg: 90}}
  - {label: pair, rate: 3, width: 160, height: 120, stereo_baseline: 0.1, robot_from_camera: {z: 0.5, yaw_deg: -90}}
laser: {rate: 5, rays: 91, robot_from_laser: {z: 0.3}}
odometry: {rate: 10, alpha5: 0.001, slips_per_m: 1}
sessions:
  only:
    start: [1, 1, 0]
    waypoints: [[2.5, 1, 0.3], [2, 2]]
    lamps: 0.8
    people: [{path: [[1, 2], [3, 2.6]]}, {path: [[3.5, 0.5]], sits: true}]
"""
SIMULATE = ['simulate', 'scene.yaml', '--duration', 2]
LABELS = ['mono', 'depth', 'pair_left', 'pair_right']


class SimulateSensorsTest(CommandTest):
    def setUp(self):
        super().setUp()
        self.write('scene.yaml', SCENE)

    def files(self, name):
        self.succeed(*SIMULATE, '-o', f'{name}.rawlog')
        return {str(f.relative_to(self.folder)).replace(name, '', 1): f.read_bytes()
                for f in self.folder.rglob('*') if f.is_file() and str(f.relative_to(self.folder)).startswith(name)}

    def test_same_bytes_twice_and_read_by_mrpt(self):
        once, twice = self.files('a'), self.files('b')
        self.assertEqual(sorted(once), sorted(twice))
        for name, content in once.items():
            self.assertEqual(content, twice[name], name)
        for label in LABELS:
            self.assertEqual(sum(f'/{label}_' in name and name.endswith('.jpg') for name in once), 7, label)
        if not shutil.which('rawlog-edit'):
            self.skipTest('rawlog-edit is not installed')
        self.assert_mrpt_reads('a.rawlog', LABELS)

    def assert_mrpt_reads(self, log, labels):
        info = subprocess.run(['rawlog-edit', '--info', '-i', log], cwd=self.folder, capture_output=True, text=True,
                              check=True).stdout
        for label in [*labels, 'laser', 'odometry']:
            self.assertIn(label, info)
        listed = self.path('images.txt')
        subprocess.run(['rawlog-edit', '--list-images', '-i', log, '--text-file-output', listed], cwd=self.folder,
                       capture_output=True, check=True)
        for label in labels:
            self.assertIn(label, listed.read_text())

    def test_scenes_that_cannot_be(self):
        for old, new, *words in (
                ('view:', 'models: [{name: m, uri: ghost.dae, pose: [0, 0, 0, 0, 0, 0]}]\nview:', 'ghost.dae'),
                ('[2.5, 1, 0.3]', '[2.5, -1]', 'only', 'path runs into south wall'),
                ('waypoints: [[2.5, 1, 0.3], [2, 2]]', 'trajectory: ghost.tum', 'ghost.tum'),
                ('label: depth', 'label: mono', 'label'),
                ('sits: true', 'sits: perhaps', 'sits'),
                ('kind: post', 'kind: ghost', 'kind')):
            with self.subTest(new):
                self.write('scene.yaml', SCENE.replace(old, new))
                self.assert_refused(['simulate', 'scene.yaml', '--session', 'only', '-o', 'log.rawlog'], *words)

    def test_full_disk_leaves_what_was_there(self):
        before = self.files('a')

        def little_room():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (2000, 2000))

        result = subprocess.run([BIN / 'vmcl', *map(str, SIMULATE), '--seed', '9', '-o', 'a.rawlog'], cwd=self.folder,
                                capture_output=True, text=True, check=False, preexec_fn=little_room)
        self.assert_complaint(result, FAILED, 'a')
        after = {str(f.relative_to(self.folder)).replace('a', '', 1): f.read_bytes() for f in self.folder.rglob('*')
                 if f.is_file() and f.name != 'scene.yaml'}
        self.assertEqual(after, before)


if __name__ == '__main__':
    main()
