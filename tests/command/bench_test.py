# SPDX-License-Identifier: BSD-3-Clause
"""`vmcl bench`: whole outputs, the same bytes for one seed on any number of threads; bad usage is refused."""
import csv
import json
from xml.etree import ElementTree

from command import CommandTest, main

METHODS = {'vmcl', '1P1DP', '2DP', 'AP3P', 'EPnP', 'MAGSAC', 'bound', 'Cramer-Rao'}


class BenchTest(CommandTest):
    def bench(self, name, *arguments):
        """What it printed and wrote, by name of the file."""
        printed = self.succeed('bench', '-o', name, *arguments)
        return printed, {f.name: f.read_bytes() for f in self.path(name).iterdir()}

    def test_same_seed_same_bytes_for_any_number_of_threads(self):
        arguments = ('--trials', 2, '--figures', 'accuracy')
        printed, files = self.bench('a', *arguments, '--threads', 1)
        self.assertEqual(set(files), {'results.csv', 'summary.json', 'timings.csv', 'accuracy_1_camera.svg',
                                      'accuracy_3_cameras.svg'})
        for name, threads in (('b', 1), ('c', 2)):
            printed_again, again = self.bench(name, *arguments, '--threads', threads)
            self.assertEqual(printed_again, printed)
            for file in set(files) - {'timings.csv'}:
                self.assertEqual(again[file], files[file], file)
        self.assertNotEqual(self.bench('d', *arguments, '--seed', 2)[1]['results.csv'], files['results.csv'])

    def test_tables(self):
        printed, files = self.bench('out', '--trials', 2, '--figures', 'accuracy', '--threads', 2)
        rows = list(csv.DictReader(files['results.csv'].decode().splitlines()))
        self.assertLessEqual(METHODS, {row['method'] for row in rows})
        self.assertEqual({row['noise_px'] for row in rows}, set('012345'))
        for row in rows:
            self.assertEqual((row['figure'], row['world'], row['trials']), ('accuracy', 'paper', '2'))
            if row['method'] == 'vmcl':
                self.assertEqual(row['answered'], '2')
                self.assertLessEqual(float(row['success_low']), float(row['success']))
                self.assertLessEqual(float(row['rmse_m_low']), float(row['rmse_m']))
                self.assertLessEqual(float(row['rmse_m']), float(row['rmse_m_high']))
                self.assertLess(float(row['rmse_m']), 0.2)
        times = list(csv.DictReader(files['timings.csv'].decode().splitlines()))
        self.assertTrue(all(float(row['median_ms']) > 0 for row in times))
        summary = json.loads(files['summary.json'])
        self.assertEqual((summary['seed'], summary['trials']), (1, 2))
        described = {method['name'] for method in summary['methods']}
        for name in described:
            self.assertIn(f'\n{name}: ', '\n' + printed)
        if 'GP3P' not in described:
            self.assertIn('without OpenGV', printed)

    def test_pictures(self):
        files = self.bench('out', '--trials', 1, '--threads', 2, '--figures', 'all')[1]
        pictures = {name for name in files if name.endswith('.svg')}
        self.assertEqual(len(pictures), 12, pictures)
        for name in pictures:
            self.assertTrue(ElementTree.fromstring(files[name]).tag.endswith('svg'), name)
        for name in ('success_paper_1_camera.svg', 'success_authors_3_cameras.svg', 'tilt_paper.svg',
                     'cost_matches.svg', 'cost_cameras.svg'):
            self.assertIn(name, pictures)
            text = ''.join(ElementTree.fromstring(files[name]).itertext())
            self.assertIn('vmcl', text)
        rows = list(csv.DictReader(files['results.csv'].decode().splitlines()))
        self.assertEqual({row['cameras'] for row in rows if row['figure'] == 'cost-cameras'}, set('123456'))

    def test_wrong_usage(self):
        self.assert_refused(['bench'], '--output')
        for option, value in (('--trials', '0'), ('--trials', 'x'), ('--threads', '0'), ('--figures', 'all-of-them'),
                              ('--seed', 'x'), ('--seed', '-1')):
            with self.subTest(option=option, value=value):
                self.assert_refused(['bench', '-o', 'out', option, value], option)

    def test_directory_that_cannot_be_made(self):
        file = self.write('file', 'in the way')
        self.assert_refused(['bench', '-o', 'file/out', '--trials', 1, '--figures', 'accuracy'], 'file/out')
        self.assert_refused(['bench', '-o', 'file', '--trials', 1, '--figures', 'accuracy'], 'file')
        self.assertEqual(file.read_text(), 'in the way')


if __name__ == '__main__':
    main()
