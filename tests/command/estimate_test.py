# SPDX-License-Identifier: BSD-3-Clause
"""`vmcl estimate`: what it makes of good, bad and no problems."""
import json
import math
import random

from command import DONE, FAILED, SOME_INPUT_BAD, CommandTest, main

FOCAL, CX, CY = 500.0, 320.0, 240.0
ROBOT_FROM_CAMERA = [0, 0, 1, 0, -1, 0, 0, 0, 0, -1, 0, 0]  # x forward, y left, z up from x right, y down, z forward


def camera(key):
    return {'width': 640, 'height': 480, 'fx': FOCAL, 'fy': FOCAL, 'cx': CX, 'cy': CY, key: ROBOT_FROM_CAMERA}


def pixel(point, robot_in_map):
    x, y, phi = robot_in_map
    c, s = math.cos(phi), math.sin(phi)
    forward = c * (point[0] - x) + s * (point[1] - y)
    left = -s * (point[0] - x) + c * (point[1] - y)
    return [CX - FOCAL * left / forward, CY - FOCAL * point[2] / forward]


def problem(name, robot_in_map, seed=1):
    """30 matches, half of them with depth, a pixel of noise; the reference camera stands at the origin of the map."""
    generator = random.Random(seed)
    matches = []
    for i in range(30):
        point = [generator.uniform(4, 8), generator.uniform(-2, 2), generator.uniform(-1, 1)]
        query = [p + generator.gauss(0, 1) for p in pixel(point, robot_in_map)]
        match = {'q': 0, 'uv': query, 'r': 0, 'ref_uv': pixel(point, (0, 0, 0))}
        matches.append({**match, 'point': point, 'sigma_depth': 0.02} if i % 2 else match)
    return {'id': name, 'query_cameras': [camera('robot_from_camera')],
            'reference_cameras': [camera('map_from_camera')], 'matches': matches}


def lines(*problems):
    return ''.join(json.dumps(p) + '\n' for p in problems)


class EstimateTest(CommandTest):
    def test_answers_in_order(self):
        truths = {f'p{i}': (0.1 * i, -0.05 * i, 0.02 * i) for i in range(20)}
        printed = self.succeed('estimate', '--threads', 2, stdin=lines(*(problem(n, t) for n, t in truths.items())))
        answers = [json.loads(line) for line in printed.splitlines()]
        self.assertEqual([a['id'] for a in answers], list(truths))
        for answer in answers:
            self.assertEqual((answer['status'], answer['message']), ('ok', ''))
            self.assertEqual(len(answer['cov']), 9)
            for found, true, variance in zip(answer['robot_in_map'], truths[answer['id']], answer['cov'][::4]):
                self.assertLess(variance, 0.1**2)
                self.assertAlmostEqual(found, true, delta=6 * math.sqrt(variance))  # false alarm: 1e-7
            self.assertEqual(answer['modes'][0]['robot_in_map'], answer['robot_in_map'])
            self.assertIn(answer['solver'], ('1p1dp', '2dp'))
            self.assertTrue(0 < answer['inlier_rate'] <= 1)
            self.assertLess(answer['off_plane_log_odds'], 5)

    def test_degenerate_configuration_is_reported(self):
        printed = self.succeed('estimate', stdin=lines(problem('a', (0, 0, 0)), problem('b', (1.5, 0.5, 0.1))))
        self.assertEqual([json.loads(line)['degenerate'] for line in printed.splitlines()], [['no_baseline'], []])

    def test_same_seed_same_bytes_for_any_number_of_threads(self):
        problems = lines(*(problem(f'p{i}', (0.3, 0.1, 0.2), seed=i) for i in range(40)))
        once = self.succeed('estimate', '--seed', 7, stdin=problems)
        self.assertEqual(self.succeed('estimate', '--seed', 7, stdin=problems), once)
        self.assertEqual(self.succeed('estimate', '--seed', 7, '--threads', 2, stdin=problems), once)

    def test_motion_off_the_plane(self):
        lifted = problem('a', (0.3, -0.2, 0.1))
        for match in lifted['matches']:
            if 'point' in match:
                match['point'][2] += 0.5
        lifted['reference_cameras'][0]['map_from_camera'] = ROBOT_FROM_CAMERA[:11] + [0.5]
        answer = json.loads(self.succeed('estimate', '--motion', 'upright', stdin=lines(lifted)))
        self.assertEqual(answer['solver'], '2dp')
        for found, true in zip(answer['robot_in_map'] + answer['off_plane'], [0.3, -0.2, 0.1, 0, 0, 0.5]):
            self.assertAlmostEqual(found, true, delta=0.15)
        answer = json.loads(self.succeed('estimate', '--motion', 'free', stdin=lines(lifted)))
        self.assertEqual(answer['solver'], '3dp')
        self.assert_refused(['estimate', '--motion', 'magic'], 'motion')
        self.assert_refused(['estimate', '--motion', 'free', '--solver', '2dp'], 'solver')

    def test_bearings_alone(self):
        answer = json.loads(self.succeed('estimate', '--solver', '3b', stdin=lines(problem('a', (0.3, -0.2, 0.1)))))
        self.assertEqual(answer['solver'], '3b')
        self.assertEqual(answer['off_plane'], [0, 0, 0])

    def test_line_with_odds_out_of_range(self):
        for odds in 0, 1e9, 'x':
            bad = problem('bad', (0, 0.5, 0))
            bad['matches'][3]['inlier_odds'] = odds
            self.assert_bad_line(json.dumps(bad), 'match 3', 'inlier')

    def test_no_pose_is_an_answer(self):
        empty = {**problem('empty', (0, 0, 0)), 'matches': []}
        answer = json.loads(self.succeed('estimate', stdin=lines(empty)))
        self.assertEqual((answer['id'], answer['status']), ('empty', 'no_pose'))
        self.assertTrue(answer['message'])
        self.assertEqual(answer['reason'], 'too_few_matches')

    def assert_bad_line(self, bad, *words):
        """A bad line is answered and named; the good lines around it are answered all the same."""
        good = lines(problem('good', (0.3, 0.1, 0.2)))
        result = self.vmcl('estimate', stdin=good + bad.rstrip('\n') + '\n' + good)
        self.assert_complaint(result, SOME_INPUT_BAD, '<stdin>', 'line 2', *words)
        self.assertEqual([json.loads(line)['status'] for line in result.stdout.splitlines()], ['ok', 'error', 'ok'])

    def test_line_that_is_garbage(self):
        self.assert_bad_line('garbage', 'JSON')

    def test_line_that_is_cut_off(self):
        self.assert_bad_line(lines(problem('cut', (0, 0, 0)))[:500], 'JSON')

    def test_line_with_something_missing(self):
        for key in ('id', 'query_cameras', 'reference_cameras', 'matches'):
            broken = problem('broken', (0, 0, 0))
            del broken[key]
            self.assert_bad_line(json.dumps(broken), key, 'missing')

    def test_line_with_numbers_that_are_not_finite(self):
        text = lines(problem('broken', (0, 0, 0)))
        self.assert_bad_line(text.replace('"fx": 500.0', '"fx": NaN'))
        self.assert_bad_line(text.replace('"fx": 500.0', '"fx": 1e999'))

    def test_line_with_an_index_out_of_range(self):
        for key in ('q', 'r'):
            for index in (-1, 1, 2**40):
                broken = problem('broken', (0, 0, 0))
                broken['matches'][3][key] = index
                self.assert_bad_line(json.dumps(broken), 'match 3')

    def test_line_with_values_of_a_wrong_kind(self):
        for key in ('query_cameras', 'matches'):
            for value in (None, 1, 'x', {}, [1], [None]):
                self.assert_bad_line(json.dumps({**problem('broken', (0, 0, 0)), key: value}))

    def test_line_with_a_rotation_that_is_none(self):
        broken = problem('broken', (0, 0, 0))
        broken['query_cameras'][0]['robot_from_camera'] = [0] * 12
        self.assert_bad_line(json.dumps(broken), 'query camera 0', 'rotation')

    def test_unknown_keys_are_named_once_and_passed_over(self):
        good = problem('good', (0.3, 0.1, 0.2))
        camera_with_more, match_with_more = problem('camera', (0.3, 0.1, 0.2)), problem('match', (0.3, 0.1, 0.2))
        camera_with_more['query_cameras'][0]['focal'] = 1
        for match in match_with_more['matches']:
            match['sigma_dpeth'] = 1
        result = self.vmcl('estimate', stdin=lines(good, {**good, 'truth': 1}, {**good, 'truth': 2}, camera_with_more,
                                                   match_with_more))
        self.assertEqual(result.returncode, SOME_INPUT_BAD)
        self.assertEqual([json.loads(line)['status'] for line in result.stdout.splitlines()], ['ok'] * 5)
        complaints = result.stderr.splitlines()
        self.assertEqual(len(complaints), 3)
        for complaint, words in zip(complaints, (('line 2', 'truth'), ('line 4', 'focal'), ('line 5', 'sigma_dpeth'))):
            for word in words:
                self.assertIn(word, complaint)

    def test_only_bad_lines(self):
        self.assert_complaint(self.vmcl('estimate', stdin='garbage\n'), FAILED, '<stdin>', 'line 1')

    def test_no_line(self):
        self.assert_refused(['estimate'], '<stdin>', 'no problem')

    def test_options_out_of_range(self):
        for option, value in (('--iterations', '0'), ('--iterations', 'x'), ('--sigma-px', 'nan'), ('--sigma-px', '-1'),
                              ('--sigma-px', 'inf'), ('--threads', '0'), ('--solver', 'magic'), ('--seed', 'x'),
                              ('--seed', '-1'), ('--sigma-tilt-deg', '90'), ('--sigma-tilt-deg', '-1'),
                              ('--sigma-height', 'nan')):
            with self.subTest(option=option, value=value):
                name = option.strip('-').split('-', maxsplit=1)[0]
                self.assert_refused(['estimate', option, value], name)


class UsageTest(CommandTest):
    def test_help_and_version(self):
        self.assertIn('estimate', self.succeed('--help'))
        for verb in (['bench'], ['estimate'], ['import', 'tum'], ['localize'], ['map'], ['relocalize'], ['simulate']):
            self.assertIn('Example', self.succeed(*verb, '--help'), verb)
        self.assertRegex(self.succeed('--version'), r'^\d+\.\d+\.\d+\n$')

    def test_wrong_usage(self):
        self.assert_refused([], 'verb')
        self.assert_refused(['dance'], 'dance')
        self.assert_refused(['estimate', '--no-such-option'], '--no-such-option')


if __name__ == '__main__':
    main()
