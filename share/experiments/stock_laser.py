#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Starts MRPT's own pf-localization anywhere in the map, with the laser alone, at places of a drive and counts the
starts that come to the true pose: those of global_starts.yaml, by the rules of `vmcl evaluate`. Narrow, where vmcl says
that it is localized, is here a mean with a deviation (root of the covariance's trace) below 0.3 m and 10 deg together.
pf-localization cannot be seeded: each call gives other figures.

usage: stock_laser.py LASER.ini SCENE ...     with SCENE.rawlog, SCENE.simplemap and SCENE.groundtruth.tum"""
import argparse
import bisect
import math
import re
import statistics
import subprocess
import tempfile
from pathlib import Path

STARTS = [round(1.2 * i, 1) for i in range(50)]  # s after the log's beginning
NARROW = math.hypot(0.3, math.radians(10))
POSE = re.compile(r'PDF estimation: \(([-\d.]+),([-\d.]+),([-\d.]+)deg\), .*tr\(cov\): ([-\d.e+naif]+)')
REGION = 1000  # m: wider than any map, of which pf-localization then takes what is free


def read_truth(file):
    lines = [line.split() for line in Path(file).read_text().splitlines()]
    rows = [[float(v) for v in fields] for fields in lines if fields and not fields[0].startswith('#')]
    return [r[0] for r in rows], [(r[1], r[2], 2 * math.atan2(r[6], r[7])) for r in rows]


def pose_at(truth, time):
    times, poses = truth
    next_one = min(max(bisect.bisect_left(times, time), 1), len(times) - 1)
    a, b = poses[next_one - 1], poses[next_one]
    share = (time - times[next_one - 1]) / (times[next_one] - times[next_one - 1])
    turn = math.remainder(b[2] - a[2], math.tau)
    return a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), a[2] + share * turn


def way_between(truth, begin, end):
    inside = [pose for time, pose in zip(*truth) if begin < time < end]
    path = [pose_at(truth, begin), *inside, pose_at(truth, end)]
    return sum(math.dist(a[:2], b[:2]) for a, b in zip(path, path[1:]))


def scan_times(rawlog, folder):
    listing = folder / 'times.txt'
    subprocess.run(['rawlog-edit', '--list-timestamps', '-i', rawlog, '--text-file-output', listing], check=True,
                   stdout=subprocess.DEVNULL)
    stamped = [line.split() for line in listing.read_text().splitlines() if 'CObservation2DRangeScan' in line]
    return [float(fields[0]) for fields in stamped]


def edited(rawlog, log, *edits):
    subprocess.run(['rawlog-edit', *edits, '-i', rawlog, '-o', log, '-w'], check=True, stdout=subprocess.DEVNULL)
    return log


def configured(ini, log, simple_map, folder):
    changes = {'rawlog_file': log, 'init_PDF_min_x': -REGION, 'init_PDF_max_x': REGION, 'init_PDF_min_y': -REGION,
               'init_PDF_max_y': REGION}
    text = Path(ini).read_text()
    for key, value in changes.items():
        text, count = re.subn(rf'(?m)^{key}\s*=.*', f'{key} = {value}', text)
        if count != 1:
            raise SystemExit(f'{ini}: {key} is not there once')
    more = f'map_file = {simple_map}\nlogOutput_dir = {folder}/out\n' \
           '3DSceneFrequency = -1\nSHOW_PROGRESS_3D_REAL_TIME = false\n'
    changed = folder / 'stock.ini'
    changed.write_text(text.replace('[LocalizationExperiment]\n', '[LocalizationExperiment]\n' + more))
    return changed


def run(ini, times):
    """Estimates, one a scan: (time, x, y, heading, narrow)."""
    done = subprocess.run(['pf-localization', ini], check=True, text=True, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    estimates = [[float(v) for v in found] for found in POSE.findall(done.stdout)]
    if len(estimates) != len(times):
        raise SystemExit(f'{ini}: {len(estimates)} estimates of {len(times)} scans')
    return [(t, x, y, math.radians(turn), spread < NARROW) for t, (x, y, turn, spread) in zip(times, estimates)]


def judge(estimates, truth):
    """Time to converge, or None; whether it has, within 30 s, and is right at the end; whether it was ever sure and
    wrong (by 1 m or 15 deg)."""
    narrow, right, wrong = [], [], []
    for time, x, y, heading, is_narrow in estimates:
        true = pose_at(truth, time)
        position, turn = math.dist((x, y), true[:2]), abs(math.remainder(heading - true[2], math.tau))
        narrow.append(is_narrow)
        right.append(position <= 0.25 and turn <= math.radians(5))
        wrong.append(is_narrow and (position > 1 or turn > math.radians(15)))
    times = [estimate[0] for estimate in estimates]
    for i, time in enumerate(times):
        settled = all(right[j] for j in range(i, len(times)) if times[j] <= time + 0.5)
        if narrow[i] and settled:
            after = time - times[0]
            return after, after <= 30 and right[-1], any(wrong)
    return None, False, any(wrong)


def wilson(successes, trials, z=1.959964):
    share, square = successes / trials, z * z / trials
    middle, half = share + square / 2, z * math.sqrt(share * (1 - share) / trials + square / (4 * trials))
    return f'{share:.2f} ({(middle - half) / (1 + square):.2f} to {(middle + half) / (1 + square):.2f})'


def mean(values, unit):
    return f'{statistics.fmean(values):.2f} {unit}' if values else '-'


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--repetitions', type=int, default=2, help='of each start')
    parser.add_argument('ini')
    parser.add_argument('scenes', nargs='+')
    arguments = parser.parse_args()
    print('| scene | runs | found within 30 s, right at the end | ever sure and wrong | mean time | mean distance |')
    print('|---|---|---|---|---|---|')
    for scene in arguments.scenes:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            # pf-localization takes every observation but odometry for a step, images too
            log = edited(f'{scene}.rawlog', folder / 'laser.rawlog', '--keep-label', 'laser,odometry')
            rest = folder / 'rest.rawlog'
            ini = configured(arguments.ini, rest, Path(f'{scene}.simplemap').resolve(), folder)
            truth, results = read_truth(f'{scene}.groundtruth.tum'), []
            first = scan_times(log, folder)[0]
            for start in STARTS * arguments.repetitions:
                times = scan_times(edited(log, rest, '--cut', '--from-time', str(first + start)), folder)
                after, found, fooled = judge(run(ini, times), truth)
                begin = times[0]
                results.append((after, found, fooled, after and way_between(truth, begin, begin + after)))
        converged = [result for result in results if result[0] is not None]
        print(f'| {Path(scene).name} | {len(results)} | {wilson(sum(r[1] for r in results), len(results))} '
              f'| {wilson(sum(r[2] for r in results), len(results))} '
              f'| {mean([r[0] for r in converged], "s")} | {mean([r[3] for r in converged], "m")} |', flush=True)


if __name__ == '__main__':
    main()
