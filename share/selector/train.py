#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Trains a network that chooses between 1P1DP and 2DP, as Jiao et al. 2020 do (section V-B): SGD, batches of 12, 200
epochs; classes drawn alike often, images mirrored. Writes MODEL.onnx and, after each epoch, MODEL.checkpoint, from
which the same command goes on. One seed gives one network on one machine. Needs python3-torch and
python3-torchvision.

Example:
  train.py --architecture compact data/hall data/house data/rooms -o compact.onnx --validate data/office
"""
import argparse
import os
import sys
import zlib
from pathlib import Path

import torch
from torch import nn

from examples import balanced_order, fail, flipped, read_folders
from networks import ARCHITECTURES, Normalized, export


def make_network(arguments, images):
    network = ARCHITECTURES[arguments.architecture]()
    if arguments.weights:
        weights = torch.load(arguments.weights, map_location='cpu', weights_only=True)
        kept = {name: value for name, value in weights.items() if not name.startswith('fc.')}
        network.load_state_dict(kept, strict=False)
    scaled = images.float() / 255
    deviation = scaled.std((0, 2, 3)).clamp_min(1e-3)
    return Normalized(network, scaled.mean((0, 2, 3)), deviation)


def outputs_of(network, images, device):
    network.eval()
    with torch.no_grad():
        return torch.cat([network(batch.to(device).float() / 255).cpu() for batch in images.split(12)])


def train_epoch(network, optimizer, images, better, device, generator, with_bfloat16):
    """Returns the mean loss and the share that was answered rightly on the way."""
    network.train()
    losses, right = [], []
    for indices in balanced_order(better, generator).split(12):
        if len(indices) < 2:  # batch normalization needs more
            continue
        batch = flipped(images[indices].to(device).float() / 255, generator)
        with torch.autocast(device.type, torch.bfloat16, enabled=with_bfloat16):
            outputs = network(batch)
        loss = nn.functional.cross_entropy(outputs.float(), better[indices].to(device))
        optimizer.zero_grad()
        loss.backward()
        optimizer.step()
        losses.append(loss.item())
        right += (outputs.argmax(1).cpu() == better[indices]).tolist()
    return sum(losses) / len(losses), sum(right) / len(right)


def settings_of(arguments, images, better):
    """All that decides on the network."""
    names = ('architecture', 'weights', 'epochs', 'rate', 'seed', 'bfloat16')
    settings = {name: getattr(arguments, name) for name in names}
    return {**settings, 'examples': zlib.crc32(better.numpy().tobytes(), zlib.crc32(images.numpy().tobytes()))}


def save_checkpoint(file, settings, epoch, network, optimizer, scheduler, generator):
    aside = f'{file}.part'
    torch.save({'settings': settings, 'epoch': epoch, 'network': network.state_dict(),
                'optimizer': optimizer.state_dict(), 'scheduler': scheduler.state_dict(),
                'generator': generator.get_state()}, aside)
    os.replace(aside, file)


def load_checkpoint(file, settings, network, optimizer, scheduler, generator):
    """Returns how many epochs are done."""
    state = torch.load(file, map_location='cpu')
    if state.get('settings') != settings:
        raise ValueError(f'{file} is of other examples or settings: remove it to begin anew')
    network.load_state_dict(state['network'])
    optimizer.load_state_dict(state['optimizer'])
    scheduler.load_state_dict(state['scheduler'])
    generator.set_state(state['generator'])
    return state['epoch']


def accuracy(network, images, better, device):
    """Mean over the solutions of the share chosen rightly."""
    right = outputs_of(network, images, device).argmax(1) == better
    return sum(right[better == solution].float().mean().item() for solution in (0, 1)) / 2


def train(arguments):
    torch.manual_seed(arguments.seed)
    generator = torch.Generator().manual_seed(arguments.seed)
    device = torch.device('cuda' if torch.cuda.is_available() else 'cpu')
    images, better = read_folders(arguments.folders)
    validation = read_folders(arguments.validate) if arguments.validate else None
    network = make_network(arguments, images).to(device)
    optimizer = torch.optim.SGD(network.parameters(), lr=arguments.rate, momentum=0.9, weight_decay=1e-4)
    scheduler = torch.optim.lr_scheduler.CosineAnnealingLR(optimizer, arguments.epochs)
    checkpoint = Path(arguments.output).with_suffix('.checkpoint')
    settings = settings_of(arguments, images, better)
    done = 0
    if checkpoint.exists():
        done = load_checkpoint(checkpoint, settings, network, optimizer, scheduler, generator)
    counts = torch.bincount(better, minlength=2).tolist()
    print(f'{counts[0]} examples of 1P1DP, {counts[1]} of 2DP; on {device}, {done} epochs done before')
    for epoch in range(done, arguments.epochs):
        loss, right = train_epoch(network, optimizer, images, better, device, generator, arguments.bfloat16)
        scheduler.step()
        save_checkpoint(checkpoint, settings, epoch + 1, network, optimizer, scheduler, generator)
        if sys.stdout.isatty() or (epoch + 1) % 10 == 0 or epoch + 1 == arguments.epochs:
            print(f'epoch {epoch + 1} of {arguments.epochs}: loss {loss:.4f}, {100 * right:.1f} % right', flush=True)
    print(f'right on the training set: {100 * accuracy(network, images, better, device):.1f} %')
    if validation:
        print(f'right on the validation set: {100 * accuracy(network, *validation, device):.1f} %')
    export(network, images.shape[3], images.shape[2], arguments.output)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('folders', nargs='+', help='as vmcl selector data wrote them')
    parser.add_argument('-o', '--output', required=True, help='the .onnx file to write')
    parser.add_argument('--architecture', choices=ARCHITECTURES, default='compact')
    parser.add_argument('--weights', help="file of torchvision's weights of ImageNet to start ResNet-101 from")
    parser.add_argument('--validate', nargs='+', default=[], help='folders of other scenes, to see what was learnt')
    parser.add_argument('--epochs', type=int, default=200)
    parser.add_argument('--rate', type=float, default=0.01, help='of learning at the start; falls as a cosine')
    parser.add_argument('--bfloat16', action='store_true',
                        help='multiply in 16 bits, as GPUs and processors with avx512_bf16 do faster')
    parser.add_argument('--seed', type=int, default=1)
    try:
        train(parser.parse_args())
    except (OSError, ValueError, KeyError, RuntimeError) as error:
        fail(' '.join(str(error).split()))


if __name__ == '__main__':
    main()
