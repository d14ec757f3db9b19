# SPDX-License-Identifier: BSD-3-Clause
"""Networks that choose between 1P1DP and 2DP: in, a heat map of 1 x 3 x height x width, RGB in [0, 1]; out, two
numbers, the larger for the better solution, 1P1DP's first."""
import os

import torch
from torch import nn
from torchvision.models import resnet101


class Normalized(nn.Module):
    """Takes mean and deviation of the training set off the input, so that they travel with the network."""

    def __init__(self, network, mean, deviation):
        super().__init__()
        self.network = network
        self.register_buffer('mean', mean.view(1, 3, 1, 1))
        self.register_buffer('deviation', deviation.view(1, 3, 1, 1))

    def forward(self, image):
        return self.network((image - self.mean) / self.deviation)


def compact():
    """Some 24,000 weights; a thousandth of ResNet-101's work."""
    def block(inputs, outputs):
        return [nn.Conv2d(inputs, outputs, 3, stride=2, padding=1, bias=False), nn.BatchNorm2d(outputs), nn.ReLU()]
    return nn.Sequential(nn.AvgPool2d(2), *block(3, 16), *block(16, 32), *block(32, 64), nn.AdaptiveAvgPool2d(1),
                         nn.Flatten(), nn.Linear(64, 2))


def resnet():
    """As Jiao et al. 2020; a file of torchvision's weights may start it."""
    return resnet101(num_classes=2)


ARCHITECTURES = {'compact': compact, 'resnet101': resnet}


def export(network, width, height, file):
    """Writes the ONNX file that `vmcl selector choose --network` takes."""
    aside = f'{file}.part'
    torch.onnx.export(network.cpu().eval(), torch.zeros(1, 3, height, width), aside, opset_version=11,
                      input_names=['heat_map'], output_names=['solutions'])
    os.replace(aside, file)
