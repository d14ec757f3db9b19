#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Exports weights of R2D2 (Revaud et al. 2019, architecture Quad_L2Net_ConfCFS) to the ONNX model that doc/features.md
asks for: grey image in; descriptors, repeatability and reliability out. Needs PyTorch."""
import argparse

import torch
from torch import nn


class R2d2(nn.Module):
    def __init__(self, state):
        super().__init__()
        layers, inputs, dilation = [], 3, 1
        # Outputs, kernel size, stride that dilation stands for; the last has no normalization, and it and the two
        # before it no rectification.
        plan = [(32, 3, 1), (32, 3, 1), (64, 3, 2), (64, 3, 1), (128, 3, 2), (128, 3, 1), (128, 2, 2), (128, 2, 2),
                (128, 2, 2)]
        for outputs, kernel, stride in plan:
            layers.append(nn.Conv2d(inputs, outputs, kernel, padding=(kernel - 1) * dilation // 2, dilation=dilation))
            if len(layers) < 22:
                layers.append(nn.BatchNorm2d(outputs, affine=False))
            if kernel == 3:
                layers.append(nn.ReLU())
            inputs, dilation = outputs, dilation * stride
        self.ops = nn.Sequential(*layers)
        self.clf = nn.Conv2d(128, 2, 1)
        self.sal = nn.Conv2d(128, 1, 1)
        self.load_state_dict({name.removeprefix('module.'): value for name, value in state.items()})
        self.register_buffer('mean', torch.tensor([0.485, 0.456, 0.406]).view(1, 3, 1, 1))
        self.register_buffer('deviation', torch.tensor([0.229, 0.224, 0.225]).view(1, 3, 1, 1))

    def forward(self, grey):
        descriptors = self.ops((torch.cat([grey, grey, grey], 1) - self.mean) / self.deviation)
        squares = descriptors * descriptors
        logits = self.sal(squares)  # their softplus, as it does not overflow in OpenCV
        saliency = torch.relu(logits) + torch.log(1 + torch.exp(-torch.abs(logits)))
        return descriptors, saliency / (1 + saliency), torch.softmax(self.clf(squares), 1)[:, 1:2]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('weights')
    parser.add_argument('model')
    parser.add_argument('--width', type=int, default=320)
    parser.add_argument('--height', type=int, default=240)
    arguments = parser.parse_args()
    network = R2d2(torch.load(arguments.weights, map_location='cpu')['state_dict']).eval()
    torch.onnx.export(network, torch.zeros(1, 1, arguments.height, arguments.width), arguments.model, opset_version=11,
                      input_names=['image'], output_names=['descriptors', 'repeatability', 'reliability'])


if __name__ == '__main__':
    main()
