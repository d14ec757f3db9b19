#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""How far the better solution is a matter of the keyframe, by which alone a network can choose it: of two images
matched with one keyframe, each better by one solution, how often is that the same? Beside it, how often it is with the
answers shuffled among the keyframes of a folder (mean and 95 % of 1000 shuffles).

Example:
  agreement.py data/hall data/house"""
import argparse
import csv
import random
from pathlib import Path

from examples import fail


def by_keyframe(folder):
    """Whether 2DP is better, of all images with a better solution: a list for each keyframe."""
    answers = {}
    with open(Path(folder) / 'trials.csv', newline='', encoding='utf-8') as file:
        for row in csv.DictReader(file):
            if row['better']:
                answers.setdefault(row['keyframe'], []).append(row['better'] == '2dp')
    return list(answers.values())


def agreement(keyframes):
    """Mean over the images of the share of the keyframe's other images that say the same."""
    same, images = 0, 0
    for answers in keyframes:
        count, of_two = len(answers), sum(answers)
        if count > 1:
            same += (of_two * (of_two - 1) + (count - of_two) * (count - of_two - 1)) / (count - 1)
            images += count
    if images == 0:
        raise ValueError('no keyframe has two images with a better solution')
    return same / images


def shuffled(keyframes, generator):
    answers = [answer for of_keyframe in keyframes for answer in of_keyframe]
    generator.shuffle(answers)
    rest = iter(answers)
    return [[next(rest) for _ in of_keyframe] for of_keyframe in keyframes]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('folders', nargs='+', help='as vmcl selector data wrote them')
    try:
        folders = [by_keyframe(folder) for folder in parser.parse_args().folders]
        measured = agreement([answers for keyframes in folders for answers in keyframes])
    except (OSError, ValueError, KeyError) as error:
        fail(error)
    generator = random.Random(1)
    chance = sorted(agreement([answers for keyframes in folders for answers in shuffled(keyframes, generator)])
                    for _ in range(1000))
    print(f'alike: {100 * measured:.1f} %; shuffled: {100 * sum(chance) / 1000:.1f} % '
          f'({100 * chance[25]:.1f} to {100 * chance[974]:.1f})')


if __name__ == '__main__':
    main()
