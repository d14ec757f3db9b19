# SPDX-License-Identifier: BSD-3-Clause
"""`vmcl selector`: from data to a network in share/selector, whose answers are PyTorch's, and what it does with bad
input."""
import csv
import subprocess
import unittest
from pathlib import Path

from command import DONE, FAILED, SAMPLE, SOME_INPUT_BAD, SOURCE, CommandTest, main
from png import noise_png

SELECTOR = SOURCE / 'share/selector'
MAP = SAMPLE / 'sample.vmap'
LOG = SAMPLE / 'start.rawlog'
TRUTH = SAMPLE / 'start.groundtruth.tum'


def python_with_torch():
    for python in ('python3', '/usr/bin/python3'):
        if Path(python).is_absolute() and not Path(python).exists():
            continue
        tried = subprocess.run([python, '-c', 'import torch, torchvision'], capture_output=True, check=False)
        if tried.returncode == 0:
            return python
    return None


PYTHON = python_with_torch()
COMPARE = """
import sys
import torch
sys.path.insert(0, sys.argv[1])
from torchvision.io import ImageReadMode, read_image
from networks import ARCHITECTURES, Normalized, export
torch.manual_seed(3)
images = torch.stack([read_image(file, ImageReadMode.RGB) for file in sys.argv[4:]])
network = Normalized(ARCHITECTURES[sys.argv[2]](), torch.tensor([0.1, 0.2, 0.1]), torch.tensor([0.3, 0.2, 0.2]))
with torch.no_grad():  # batch normalization sees images, as in training
    for _ in range(10):
        network(images.float() / 255)
network.eval()
export(network, images.shape[3], images.shape[2], sys.argv[3])
for outputs in network(images.float() / 255).tolist():
    print(*outputs)
"""


class SelectorTest(CommandTest):
    def data(self, out='data'):
        return ['selector', 'data', '--map', MAP, '--rawlog', LOG, '--groundtruth', TRUTH, '--out', out, '--every', '5',
                '--width', '64', '--height', '48']

    def choose(self, *arguments):
        return ['selector', 'choose', MAP, '-o', 'chosen.vmap', *arguments]

    def draw(self, count):
        """Heat maps of noise, labelled one and the other in turn."""
        images = [self.write(f'drawn/{i}.png', noise_png(64, 48, seed=i)) for i in range(count)]
        lines = [f'{image.name},{("1p1dp", "2dp")[i % 2]}' for i, image in enumerate(images)]
        self.write('drawn/labels.csv', '\n'.join(['image,better', *lines]) + '\n')
        return images

    def run_python(self, *arguments):
        return subprocess.run([PYTHON, '-B', *map(str, arguments)], capture_output=True, text=True, cwd=self.folder,
                              check=False)

    def test_data_is_written_and_the_analysis_calibrated(self):
        printed = self.succeed(*self.data())
        self.assertIn('predicted', printed)
        with open(self.path('data/trials.csv'), encoding='utf-8') as file:
            trials = list(csv.DictReader(file))
        self.assertGreater(len(trials), 10)
        near = [trial for trial in trials if float(trial['error_2dp'] or 9) < 0.1]
        self.assertGreater(len(near), len(trials) / 2)  # the sample's drives are all but the same
        self.assertTrue(self.path('data/labels.csv').read_text().startswith('image,better\n'))

    def test_the_map_keeps_the_choice(self):
        printed = self.succeed(*self.choose('--table', 'table.csv'))
        self.assertIn('no choice at 0', printed)
        with open(self.path('table.csv'), encoding='utf-8') as file:
            self.assertTrue({row['solution'] for row in csv.DictReader(file)} <= {'1p1dp', '2dp'})
        self.succeed(*self.choose('--network', SELECTOR / 'compact.onnx'))
        for solution in ('1p1dp', '2dp', 'both', 'map'):
            found = self.succeed('relocalize', '--map', 'chosen.vmap', '--rawlog', LOG, '--groundtruth', TRUTH,
                                 '--solution', solution, '--every', '5')
            self.assertRegex(found, r'in 0\.25 m, 5 deg +(9\d|100)\.\d %')

    def test_the_analysis_takes_over_from_a_network_that_cannot_be_used(self):
        good = (SELECTOR / 'compact.onnx').read_bytes()
        self.succeed(*self.choose())
        chosen = self.path('chosen.vmap').read_bytes()
        for name, content in (('cut.onnx', good[:len(good) // 2]), ('text.onnx', b'no network'), ('absent.onnx', None)):
            if content is not None:
                self.write(name, content)
            self.assert_complaint(self.vmcl(*self.choose('--network', name)), SOME_INPUT_BAD, name, 'analysis')
            self.assertEqual(self.path('chosen.vmap').read_bytes(), chosen)

    def test_broken_input(self):
        self.assert_refused(['selector', 'choose', 'nowhere.vmap', '-o', 'x.vmap'], 'nowhere.vmap')
        self.assert_refused(['selector', 'ask', 'nowhere.onnx', 'a.png'], 'nowhere.onnx')
        self.write('text.png', 'no image')
        self.assert_refused(['selector', 'ask', SELECTOR / 'compact.onnx', 'text.png'], 'text.png')
        good = self.write('good.png', noise_png(160, 120, seed=0))
        some = self.vmcl('selector', 'ask', SELECTOR / 'compact.onnx', 'text.png', good)
        self.assert_complaint(some, SOME_INPUT_BAD, 'text.png')
        self.assertEqual(len(some.stdout.splitlines()), 2)
        self.write('early.tum', '1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n')
        self.assert_refused(['selector', 'data', '--map', MAP, '--rawlog', LOG, '--groundtruth', 'early.tum', '--out',
                             'data'], 'early.tum', 'covers no image')
        self.assert_refused(['selector'], 'subcommand')

    @unittest.skipUnless(PYTHON, 'python3-torch and python3-torchvision are not here')
    def test_answers_are_those_of_pytorch(self):
        images = self.draw(3)
        for architecture in ('compact', 'resnet101'):
            expected = self.run_python('-c', COMPARE, SELECTOR, architecture, 'net.onnx', *images)
            self.assertEqual(expected.returncode, DONE, expected.stderr)
            asked = self.succeed('selector', 'ask', 'net.onnx', *images)
            for row, line in zip(csv.DictReader(asked.splitlines()), expected.stdout.splitlines(), strict=True):
                for ours, theirs in zip((row['1p1dp'], row['2dp']), line.split(), strict=True):
                    self.assertAlmostEqual(float(ours), float(theirs), delta=1e-4)

    @unittest.skipUnless(PYTHON, 'python3-torch and python3-torchvision are not here')
    def test_the_recipe_from_data_to_network(self):
        self.draw(12)
        train = [SELECTOR / 'train.py', 'drawn', '--epochs', '3', '-o']
        for name in ('once.onnx', 'again.onnx'):
            trained = self.run_python(*train, name)
            self.assertEqual((trained.returncode, trained.stderr), (DONE, ''))
        self.assertEqual(self.path('once.onnx').read_bytes(), self.path('again.onnx').read_bytes())
        self.assertLess(self.path('once.onnx').stat().st_size, 1_000_000)
        self.path('half.checkpoint').write_bytes(self.path('once.checkpoint').read_bytes())
        self.assertIn('3 epochs done before', self.run_python(*train, 'half.onnx').stdout)
        other = self.run_python(*train, 'half.onnx', '--bfloat16')
        self.assertEqual((other.returncode, len(other.stderr.splitlines())), (FAILED, 1), other.stderr)
        self.assertIn('other examples or settings', other.stderr)
        self.succeed(*self.choose('--network', 'once.onnx'))

    @unittest.skipUnless(PYTHON, 'python3-torch and python3-torchvision are not here')
    def test_training_in_16_bits(self):
        self.draw(12)
        trained = self.run_python(SELECTOR / 'train.py', 'drawn', '--epochs', '1', '--bfloat16', '-o', 'net.onnx')
        self.assertEqual((trained.returncode, trained.stderr), (DONE, ''))
        self.succeed('selector', 'ask', 'net.onnx', *self.draw(1))

    @unittest.skipUnless(PYTHON, 'python3-torch and python3-torchvision are not here')
    def test_one_class_teaches_nothing(self):
        images = self.draw(4)
        self.write('drawn/labels.csv', 'image,better\n' + ''.join(f'{image.name},2dp\n' for image in images))
        trained = self.run_python(SELECTOR / 'train.py', 'drawn', '-o', 'net.onnx')
        self.assertEqual(trained.returncode, FAILED)
        self.assertIn('nothing to learn', trained.stderr)
        self.assertEqual(len(trained.stderr.splitlines()), 1)
        self.assertFalse(self.path('net.onnx').exists())

    @unittest.skipUnless(PYTHON, 'python3-torch and python3-torchvision are not here')
    def test_how_far_images_of_a_keyframe_agree(self):
        def trials(answers):
            lines = [f'{keyframe},{better}' for keyframe, better in answers]
            self.write('tried/trials.csv', '\n'.join(['keyframe,better', *lines]) + '\n')
            return self.run_python(SELECTOR / 'agreement.py', 'tried')
        of_keyframe = trials([(k, ('1p1dp', '2dp')[k % 2]) for k in range(10) for _ in range(4)] + [(10, '')])
        self.assertEqual(of_keyframe.returncode, DONE, of_keyframe.stderr)
        self.assertIn('alike: 100.0 %; shuffled: 4', of_keyframe.stdout)  # 19 of 39 others, 48.7 %
        of_image = trials([(k, better) for k in range(10) for better in ('1p1dp', '2dp', '2dp')])
        self.assertIn('alike: 33.3 %', of_image.stdout)
        alone = trials([(1, '2dp'), (2, '2dp'), (3, '')])
        self.assertEqual((alone.returncode, len(alone.stderr.splitlines())), (FAILED, 1), alone.stderr)


if __name__ == '__main__':
    main()
