#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes of weights of R2D2 (Revaud et al. 2019) a network for dense matches, the ONNX model that doc/features.md asks
for: two grey images in; for each cell of 4 x 4 pixels of the first, its place in the second and a confidence out.
Descriptors of cells are compared all with all, and a pair is as sure as it is likely both ways (dual softmax, as of
LoFTR, Sun et al. 2021). Needs PyTorch."""
import argparse

import torch
from torch import nn

from export_r2d2 import R2d2

CELL = 4  # pixels
TEMPERATURE = 0.02  # of cosines


class Matcher(nn.Module):
    def __init__(self, network, height, width):
        super().__init__()
        self.network, self.rows, self.columns = network, height // CELL, width // CELL
        y, x = torch.meshgrid(torch.arange(self.rows), torch.arange(self.columns), indexing='ij')
        places = torch.stack([(x + 0.5) / self.columns, (y + 0.5) / self.rows])
        self.register_buffer('places', places.reshape(2, -1, 1, 1).float())

    def normalized(self, grey):
        return (torch.cat([grey, grey, grey], 1) - self.network.mean) / self.network.deviation

    def forward(self, reference, query):
        images = torch.cat([self.normalized(reference), self.normalized(query)])
        descriptors = nn.functional.avg_pool2d(self.network.ops(images), CELL)
        descriptors = descriptors / torch.sqrt((descriptors * descriptors).sum(1, keepdim=True) + 1e-6)
        cells = self.rows * self.columns
        # OpenCV loses a factor that comes after a product of matrices.
        descriptors = descriptors / TEMPERATURE ** 0.5
        of_reference, of_query = descriptors.reshape(2, 128, cells).split(1)
        # By rows the cells of the query, by columns those of the reference.
        alike = torch.matmul(of_query.transpose(1, 2), of_reference)
        there, back = torch.softmax(alike, 1), torch.softmax(alike, 2)
        # Sums and maxima over the query's cells by layers that OpenCV has had for long.
        confidence = nn.functional.max_pool2d((there * back).reshape(1, 1, cells, cells), (cells, 1))
        places = nn.functional.conv2d(there.reshape(1, cells, self.rows, self.columns), self.places)
        return places, confidence.reshape(1, 1, self.rows, self.columns)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('weights')
    parser.add_argument('model')
    parser.add_argument('--width', type=int, default=160)
    parser.add_argument('--height', type=int, default=120)
    arguments = parser.parse_args()
    network = R2d2(torch.load(arguments.weights, map_location='cpu')['state_dict']).eval()
    matcher = Matcher(network, arguments.height, arguments.width)
    image = torch.zeros(1, 1, arguments.height, arguments.width)
    torch.onnx.export(matcher, (image, image), arguments.model, opset_version=11, input_names=['reference', 'query'],
                      output_names=['places', 'confidences'])


if __name__ == '__main__':
    main()
