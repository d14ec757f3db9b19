# SPDX-License-Identifier: BSD-3-Clause
"""`vmcl evaluate`: whole reports, the same after a kill, failures recorded, bad experiments refused."""
import csv
import json
import re
import resource
import signal
import subprocess
import time
from html.parser import HTMLParser
from pathlib import Path

from command import BIN, FAILED, SAMPLE, SOME_INPUT_BAD, SOURCE, CommandTest, main

TABLES = ('results.csv', 'results.md', 'runs.csv')
GOOD = f'''
rawlogs:
  - {{rawlog: {SAMPLE}/start.rawlog, maps: [{SAMPLE}/sample.vmap, {SAMPLE}/map.simplemap],
     ground_truth: {SAMPLE}/start.groundtruth.tum, openloris: {{scene: office, sequence: 1}}}}
sensors: [laser]
configurations:
  - {{ini: {SOURCE}/share/config/both.ini, changes: {{LocalizationExperiment: {{particles_count: 2000}}}}}}
starts: [global]
seeds: 8
'''


class EvaluateTest(CommandTest):
    def setUp(self):
        super().setUp()
        self.experiment = self.write('experiment.yaml', GOOD)

    def tables(self, directory):
        return {name: self.path(f'{directory}/{name}').read_bytes() for name in TABLES}

    def rows(self, directory, name='results.csv'):
        return list(csv.DictReader(self.path(f'{directory}/{name}').read_text().splitlines()))

    def finished(self, directory):
        """When each finished run was put in its place."""
        runs = self.path(f'{directory}/runs')
        return {run.name: run.stat().st_mtime_ns for run in runs.iterdir()} if runs.exists() else {}

    def processes(self, word):
        """Those in whose command line it is."""
        found = []
        for process in Path('/proc').glob('[0-9]*/cmdline'):
            try:
                found += [process] if word.encode() in process.read_bytes() else []
            except OSError:  # it has ended
                pass
        return found

    def test_killed_and_resumed(self):
        self.succeed('evaluate', self.experiment, '-o', 'whole', '--workers', 2)
        killed = subprocess.Popen([BIN / 'vmcl', 'evaluate', self.experiment, '-o', 'killed', '--workers', '2'],
                                  cwd=self.folder, start_new_session=True)
        while len(self.finished('killed')) < 3:
            self.assertIsNone(killed.poll())
            time.sleep(0.01)
        killed.send_signal(signal.SIGKILL)
        killed.wait()
        for _ in range(100):
            if not self.processes(f'{self.folder}/killed/unfinished'):
                break
            time.sleep(0.1)
        else:
            self.fail('a run goes on alone')
        before = self.finished('killed')
        self.assertLess(len(before), 8)
        self.assert_complaint(self.vmcl('evaluate', self.experiment, '-o', 'killed'), FAILED, 'killed', '--resume')
        self.succeed('evaluate', self.experiment, '-o', 'killed', '--resume')
        after = self.finished('killed')
        self.assertEqual(len(after), 8)
        self.assertLessEqual(before.items(), after.items())
        self.assertEqual(self.tables('killed'), self.tables('whole'))
        for left_over in ('unfinished', 'lock'):
            self.assertFalse(self.path(f'killed/{left_over}').exists(), left_over)

    def test_report(self):
        self.write('experiment.yaml', GOOD.replace('[laser]', '[camera, laser, both, odometry]')
                   .replace('[global]', '[given, global]').replace('seeds: 8', 'seeds: 1'))
        printed = self.succeed('evaluate', self.experiment, '-o', 'out', '--workers', 2)
        self.assertIn('skipped start.odometry.both.global: odometry alone', printed)
        self.assertIn('7 of 7 runs done', printed)
        rows = {(row['start'], row['sensors']): row for row in self.rows('out')}
        self.assertEqual(len(rows), 7)
        for sensors in ('camera', 'laser', 'both'):
            row = rows['given', sensors]
            self.assertEqual((row['converged'], row['done'], row['failed']), ('1', '1', '0'), sensors)
            self.assertLess(float(row['position_rmse_m']), 0.1)
            self.assertEqual(float(row['false_accept_share']), 0)
        self.assertEqual(float(rows['given', 'odometry']['success_100']), 1)
        for row in self.rows('out', 'costs.csv'):
            self.assertGreater(float(row['peak_memory_mib']), 10)
            self.assertLessEqual(float(row['latency_p50_ms']), float(row['latency_p99_ms']))
        self.assert_page_is_whole(self.path('out/report.html').read_text())
        self.assert_openloris(self.path('out/openloris/camera.both.given.1/office.txt').read_text())
        jobs = [json.loads(line) for line in self.path('out/jobs.jsonl').read_text().splitlines()]
        self.succeed(*jobs[0]['command'], '--out', 'again')
        for name in ('frames.csv', 'summary.json', 'trajectory.tum'):
            self.assertEqual(self.path(f'again/{name}').read_bytes(),
                             self.path(f'out/runs/{jobs[0]["id"]}/{name}').read_bytes())

    def test_ground_truth_of_another_log(self):
        self.write('other.tum', '5000 0 0 0 0 0 0 1\n5040.5 1 0 0 0 0 0 1\n')
        self.write('experiment.yaml', GOOD.replace(f'ground_truth: {SAMPLE}/start.groundtruth.tum',
                                                   'ground_truth: other.tum').replace('seeds: 8', 'seeds: 1'))
        result = self.vmcl('evaluate', self.experiment, '-o', 'out')
        self.assert_complaint(result, SOME_INPUT_BAD, 'other.tum', '5000.0 to 5040.5 s', '1000.0 to 10')

    def assert_page_is_whole(self, page):
        opened, pictures, outside = [], 0, []

        class Page(HTMLParser):
            def handle_starttag(self, tag, attributes):
                nonlocal pictures
                pictures += tag == 'svg'
                outside.extend(v for k, v in attributes if k in ('src', 'href', 'xlink:href') and v[:1] != '#')
                if tag not in ('meta', 'br'):
                    opened.append(tag)

            def handle_endtag(self, tag):
                if tag in opened:
                    while opened.pop() != tag:
                        pass
        Page().feed(page)
        self.assertEqual((pictures, outside, opened), (8, [], []))
        for text in ('given start', 'vmcl localize', 'Wilson', 'start.odometry.both.global', 'seeds: 1'):
            self.assertIn(text, page)

    def assert_openloris(self, text):
        head, _, poses = text.partition('seq: 1\n')
        self.assertEqual(head.split(), ['scene:', 'office', 'frame:', 'base_link'])
        self.assertGreater(len(poses.splitlines()), 5)
        for line in poses.splitlines():
            values = [float(v) for v in line.split()]
            self.assertEqual(len(values), 8)
            self.assertAlmostEqual(sum(v * v for v in values[4:]), 1, places=6)

    def test_kidnapping(self):
        self.write('experiment.yaml', GOOD.replace('starts: [global]', 'kidnappings: [{at: 1, skip: 0.5}]')
                   .replace('seeds: 8', 'seeds: 2'))
        self.succeed('evaluate', self.experiment, '-o', 'out')
        row = self.rows('out')[0]
        self.assertEqual((row['done'], row['recovered_runs']), ('2', '2'))
        self.assertGreater(float(row['kidnapped_distance_m']), 0.1)

    def test_a_failing_run_is_recorded_and_the_rest_goes_on(self):
        self.write('broken.rawlog', 'garbage')
        broken = f"""rawlogs:
  - {{rawlog: broken.rawlog, maps: [{SAMPLE}/map.simplemap], ground_truth: {SAMPLE}/start.groundtruth.tum}}"""
        self.write('experiment.yaml', GOOD.replace('rawlogs:', broken).replace('seeds: 8', 'seeds: 1'))
        result = self.vmcl('evaluate', self.experiment, '-o', 'out')
        self.assert_complaint(result, SOME_INPUT_BAD, 'broken.laser.both.global.1', 'broken.rawlog', 'not a rawlog')
        single = self.vmcl('evaluate', self.experiment, '-o', 'out', '--job', 'broken.laser.both.global.1')
        self.assert_complaint(single, FAILED, 'broken.laser.both.global.1', 'not a rawlog')
        statuses = {row['run']: row['status'] for row in self.rows('out', 'runs.csv')}
        self.assertEqual(statuses, {'broken.laser.both.global.1': 'failed', 'start.laser.both.global.1': 'done'})
        self.assertIn('not a rawlog', self.path('out/report.html').read_text())
        self.copy(SAMPLE / 'start.rawlog', 'broken.rawlog')
        self.assertIn('2 of 2 runs done', self.succeed('evaluate', self.experiment, '-o', 'out', '--resume'))

    def test_single_jobs_give_the_same_tables(self):
        self.write('experiment.yaml', GOOD.replace('seeds: 8', 'seeds: 2'))
        self.succeed('evaluate', self.experiment, '-o', 'whole')
        names = self.succeed('evaluate', self.experiment, '-o', 'out', '--list').split()
        self.assertEqual(names, ['start.laser.both.global.1', 'start.laser.both.global.2'])
        self.succeed('evaluate', self.experiment, '-o', 'out', '--job', names[1])
        unfinished = self.vmcl('evaluate', self.experiment, '-o', 'out', '--report-only')
        self.assert_complaint(unfinished, SOME_INPUT_BAD, '1 runs have not been made yet')
        before = self.finished('out')
        for name in names:
            self.succeed('evaluate', self.experiment, '-o', 'out', '--job', name)
        self.assertLessEqual(before.items(), self.finished('out').items())
        self.succeed('evaluate', self.experiment, '-o', 'out', '--report-only')
        self.assertEqual(self.tables('out'), self.tables('whole'))
        unknown = self.vmcl('evaluate', self.experiment, '-o', 'out', '--job', 'nothing')
        self.assert_complaint(unknown, FAILED, 'nothing')

    def test_bad_experiments(self):
        for old, new, *words in (('start.rawlog', 'absent.rawlog', 'experiment.yaml:3', 'absent.rawlog'),
                                 ('sample.vmap', 'absent.vmap', 'experiment.yaml:3', 'absent.vmap'),
                                 ('start.groundtruth', 'absent', 'experiment.yaml:4', 'absent.tum'),
                                 ('both.ini', 'absent.ini', 'absent.ini'),
                                 ('seeds: 8', 'seeds: 8\nsedes: 1', 'experiment.yaml', 'sedes'),
                                 ('seeds: 8', 'seeds: 0', 'seeds'),
                                 ('seeds: 8', 'seeds: [', 'experiment.yaml'),
                                 ('[laser]', '[]', 'sensors'), ('[laser]', '[sonar]', 'sonar'),
                                 ('[laser]', '[odometry]', 'no combination makes sense'),
                                 ('particles_count', 'particles_cuont', 'both.ini', 'particles_cuont'),
                                 (': 2000', ': many', 'both.ini', 'particles_count', 'many')):
            with self.subTest(new):
                self.assertIn(old, GOOD)
                self.write('experiment.yaml', GOOD.replace(old, new))
                self.assert_refused(['evaluate', self.experiment, '-o', 'out'], *words)
        self.assert_refused(['evaluate', 'absent.yaml', '-o', 'out'], 'absent.yaml')
        self.assert_refused(['evaluate', self.experiment, '-o', 'out', '--workers', 0], '--workers')
        self.assert_refused(['evaluate', self.experiment, '-o', 'out', '--list', '--resume'], '--list')
        self.write('broken.tum', '0 nan 0 0 0 0 0 1\n')
        self.write('experiment.yaml', GOOD.replace(f'{SAMPLE}/start.groundtruth.tum', 'broken.tum'))
        self.assert_refused(['evaluate', self.experiment, '-o', 'out'], 'broken.tum:1')

    def test_changed_input_is_not_mixed_with_old_results(self):
        self.write('experiment.yaml', GOOD.replace('seeds: 8', 'seeds: 1'))
        self.succeed('evaluate', self.experiment, '-o', 'out')
        self.write('experiment.yaml', GOOD.replace('seeds: 8', 'seeds: 1').replace('2000', '1000'))
        self.assert_complaint(self.vmcl('evaluate', self.experiment, '-o', 'out', '--resume'), FAILED,
                              'start.laser.both.global.1', 'another configuration')

    def test_disk_that_is_full(self):
        """As one that takes no file of over 2000 bytes: there is one line, and what is finished stays."""
        def small_files():
            resource.setrlimit(resource.RLIMIT_FSIZE, (2000, resource.RLIM_INFINITY))
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        self.write('experiment.yaml', GOOD.replace('seeds: 8', 'seeds: 3'))
        self.succeed('evaluate', self.experiment, '-o', 'out', '--job', 'start.laser.both.global.1')
        before = self.finished('out')
        result = subprocess.run([BIN / 'vmcl', 'evaluate', self.experiment, '-o', 'out', '--resume'], cwd=self.folder,
                                text=True, capture_output=True, preexec_fn=small_files, restore_signals=False,
                                check=False)
        self.assert_complaint(result, FAILED, 'out/', 'cannot be written')
        self.assertLessEqual(before.items(), self.finished('out').items())
        self.succeed('evaluate', self.experiment, '-o', 'out', '--resume')

    def test_the_experiments_that_come_along(self):
        """They can be planned when there are the files that they name."""
        for experiment in (SOURCE / 'share/experiments').glob('*.yaml'):
            for file in set(re.findall(r'[\w.-]+\.(?:rawlog|vmap|simplemap|tum)\b', experiment.read_text())):
                self.write(file, '0 0 0 0 0 0 0 1\n100 1 0 0 0 0 0 1\n')
            self.assertGreater(len(self.succeed('evaluate', experiment, '-o', 'out', '--list').split()), 10)

    def test_output_that_cannot_be_written(self):
        self.write('taken', '')
        self.assert_complaint(self.vmcl('evaluate', self.experiment, '-o', 'taken'), FAILED, 'taken')


if __name__ == '__main__':
    main()
