# SPDX-License-Identifier: BSD-3-Clause
"""Reads what `vmcl selector data` wrote."""
import csv
import sys
from pathlib import Path

import torch
from torchvision.io import ImageReadMode, read_image

SOLUTIONS = ('1p1dp', '2dp')


def read_folder(folder):
    """Heat maps as one tensor of bytes and the index of the better solution of each."""
    images, better = [], []
    with open(Path(folder) / 'labels.csv', newline='', encoding='utf-8') as file:
        for row in csv.DictReader(file):
            if row['better'] not in SOLUTIONS:
                raise ValueError(f'{folder}/labels.csv: no solution "{row["better"]}"')
            images.append(read_image(str(Path(folder) / row['image']), ImageReadMode.RGB))
            better.append(SOLUTIONS.index(row['better']))
    return images, better


def read_folders(folders):
    images, better = [], []
    for folder in folders:
        more_images, more_better = read_folder(folder)
        images += more_images
        better += more_better
    if len({tuple(image.shape) for image in images}) > 1:
        raise ValueError('heat maps differ in size: write them all with the same --width and --height')
    if len(set(better)) < 2:
        raise ValueError(f'{len(images)} examples, not both of 1P1DP and of 2DP: there is nothing to learn; '
                         'leave the choice to the analysis')
    return torch.stack(images), torch.tensor(better)


def balanced_order(better, generator):
    """Indices of one epoch: as many as there are examples, half of either solution."""
    half = (len(better) + 1) // 2
    picks = [torch.nonzero(better == solution).flatten() for solution in (0, 1)]
    drawn = torch.cat([pick[torch.randint(len(pick), (half,), generator=generator)] for pick in picks])
    return drawn[torch.randperm(len(drawn), generator=generator)]


def flipped(images, generator):
    """Half of the images mirrored: left and right are alike to the solutions."""
    is_flipped = torch.rand(len(images), generator=generator) < 0.5
    return torch.where(is_flipped.to(images.device).view(-1, 1, 1, 1), images.flip(3), images)


def fail(message):
    print(f'{Path(sys.argv[0]).name}: {message}', file=sys.stderr)
    sys.exit(2)
