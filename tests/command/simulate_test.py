# SPDX-License-Identifier: BSD-3-Clause
"""`vmcl simulate`: the same seed gives the same log; broken scenes are refused."""
import re

from command import SOURCE, CommandTest, main

SCENE = SOURCE / 'share/scenes/rooms.yaml'


class SimulateTest(CommandTest):
    def files(self, name, *arguments):
        """All that a drive of a second wrote, by name without the log's own."""
        self.succeed('simulate', SCENE, '--session', 'map', '--duration', 1, '-o', f'{name}.rawlog',
                     '--simplemap', f'{name}.simplemap', *arguments)
        written = [f for f in self.folder.rglob(f'{name}*') if f.is_file()]
        images = list(self.path(f'{name}_Images').iterdir())
        self.assertGreater(len(images), 3)
        return {str(f.relative_to(self.folder)).replace(name, '', 1): f.read_bytes() for f in written + images}

    def test_same_seed_same_bytes(self):
        once, twice, other = (self.files('a'), self.files('b'), self.files('c', '--seed', 2))
        self.assertEqual(sorted(once), sorted(twice))
        for name, content in once.items():
            self.assertEqual(content, twice[name], name)
        self.assertNotEqual(once['.rawlog'], other['.rawlog'])
        self.assertEqual(once['.groundtruth.tum'], other['.groundtruth.tum'])

    def assert_scene_refused(self, scene, *words):
        self.write('broken.yaml', scene)
        self.assert_refused(['simulate', 'broken.yaml', '--session', 'map', '-o', 'log.rawlog'], 'broken.yaml', *words)

    def test_scene_that_is_none(self):
        for scene in ('', 'garbage', '[1, 2', '{', '- 1', b'\0\xff' * 500, '[' * 100000, SCENE.read_text()[:2000]):
            with self.subTest(scene[:40]):
                self.assert_scene_refused(scene)

    def test_bad_values(self):
        good = SCENE.read_text()
        for key in ('rate', 'width', 'fov_deg', 'rays', 'max_range', 'sigma', 'max_speed', 'wall_height', 'brightness'):
            for value in ('.nan', '-1', 'x'):
                with self.subTest(key=key, value=value):
                    bad = re.sub(rf'\b{key}: [^,}}\n]+', f'{key}: {value}', good)
                    self.assertNotEqual(bad, good)
                    self.assert_scene_refused(bad, key)

    def test_unknown_keys(self):
        good = SCENE.read_text()
        self.assert_scene_refused(good + 'no_such_key: 1\n', 'no_such_key')
        self.assert_scene_refused(good.replace('rays: 361', 'rays: 361\n  no_such_key: 1'), 'no_such_key')

    def test_bad_arguments(self):
        for arguments, word in ((['--session', 'nowhere'], 'nowhere'), ([], '--session from: map, query'),
                                (['--session', 'map', '--duration', '-1'], 'duration'),
                                (['--session', 'map', '--duration', 'nan'], 'duration'),
                                (['--session', 'map', '--seed', '-1'], 'seed')):
            with self.subTest(arguments):
                self.assert_refused(['simulate', SCENE, '-o', 'log.rawlog', *arguments], word)
        self.assert_refused(['simulate', 'nowhere.yaml', '--session', 'map', '-o', 'log.rawlog'], 'nowhere.yaml')
        self.assert_refused(['simulate', SCENE, '--session', 'map', '-o', 'nowhere/log.rawlog'], 'nowhere/log.rawlog')


if __name__ == '__main__':
    main()
