#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Table of 1P1DP, 2DP and the ways to choose between them, from what `vmcl relocalize --peers --out RUN` wrote: share
of images within 0.25, 0.5 and 1 m and 5 deg, the 95 % interval of the first, and the share of what the best of all
these methods reaches.

usage: solutions.py --choice NAME=TABLE ... RUN ...
TABLE is a CSV of `vmcl selector choose --table`; all RUNs are sessions in its map. Several runs add up."""
import argparse
import csv
import math
from pathlib import Path

LIMITS = (0.25, 0.5, 1.0)
FIVE_DEGREES = math.radians(5)


def rows_of(file):
    with open(file, newline='', encoding='utf-8') as stream:
        return list(csv.DictReader(stream))


def is_within(row, limit):
    return row['position_error'] != '' and float(row['position_error']) <= limit \
        and float(row['heading_error']) <= FIVE_DEGREES


def chosen(references, solutions):
    """The solution of the keyframes that most matches are with, as vmcl::chosenSolution."""
    votes = 0
    for reference in references.split():
        keyframe, matches = reference.split(':')
        votes += int(matches) * {'1p1dp': -1, '2dp': 1}.get(solutions[int(keyframe)], 0)
    return '2dp' if votes > 0 else '1p1dp' if votes < 0 else 'both'


def read_run(run, choices):
    """By image: name of the method -> its successes at the limits."""
    peers = {}
    for row in rows_of(Path(run) / 'peers.csv'):
        peers.setdefault((row['time'], row['camera']), {})[row['method']] = [is_within(row, limit) for limit in LIMITS]
    images = []
    for row in rows_of(Path(run) / 'relocalize.csv'):
        methods = peers[row['time'], row['camera']]
        for name, solutions in choices.items():
            solution = chosen(row['references'], solutions)
            methods[f'vmcl by {name}'] = methods[f'vmcl {solution}']
            methods[f'Mix by {name}'] = methods['2DP' if solution == '2dp' else '1P1DP']
        methods['upper bound'] = [any(of_limit) for of_limit in zip(*methods.values())]
        images.append(methods)
    return images


def wilson(successes, trials, z=1.959964):
    share, square = successes / trials, z * z / trials
    middle, half = share + square / 2, z * math.sqrt(share * (1 - share) / trials + square / (4 * trials))
    return (middle - half) / (1 + square), (middle + half) / (1 + square)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--choice', action='append', default=[], metavar='NAME=TABLE')
    parser.add_argument('runs', nargs='+', metavar='RUN')
    arguments = parser.parse_args()
    choices = {}
    for word in arguments.choice:
        name, table = word.split('=', 1)
        choices[name] = [row['solution'] for row in rows_of(table)]
    images = [image for run in arguments.runs for image in read_run(run, choices)]
    most = [sum(image['upper bound'][i] for image in images) for i in range(3)]
    print(f'{len(images)} images\n\n'
          '| method | 0.25 / 0.5 / 1 m, % | 0.25 m, 95 % | of the bound, % |\n|---|---|---|---|')
    for method in images[0]:
        counts = [sum(image[method][i] for image in images) for i in range(3)]
        low, high = wilson(counts[0], len(images))
        shares = ' / '.join(f'{100 * count / len(images):.1f}' for count in counts)
        bound = ' / '.join(f'{100 * count / max(1, best):.1f}' for count, best in zip(counts, most))
        print(f'| {method} | {shares} | {100 * low:.1f} to {100 * high:.1f} | {bound} |')


if __name__ == '__main__':
    main()
