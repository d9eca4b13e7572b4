"""The part of tools/denoise_table with noise that is correlated over some edges.

White noise is averaged over each vertex and its neighbours one, two or four times, brought to a
standard deviation of 0.1 to 0.3 mean edge lengths, and added to the original of every pair in a
folder (denoise_pairs.py), in some rows together with as much or half as much white noise.
--denoise runs with no other option; beside it plain smooth, and what the best of ten settings
reaches, chosen with the truth known (noise_kinds.py).
"""

import math
import os
import random
import tempfile

from denoise_pairs import chosen, denoised, figures_of, folders_of_pairs, mesh_in
from noise_kinds import best_by_hand
from tables import ibmfair, read_off, row, smooth, write_off

HEADINGS = ["original", "averaged", "noise", "white", "noisy", "Ea", "smooth", "best", "chosen"]
WIDTHS = [22, 8, 6, 6, 6, 6, 6, 6, 30]
# Times averaged; standard deviations in mean edge lengths: of that noise, and of white noise.
KINDS = [(1, 0.1, 0), (1, 0.3, 0), (2, 0.1, 0), (2, 0.3, 0), (4, 0.3, 0),
         (1, 0.2, 0.2), (2, 0.2, 0.2), (4, 0.2, 0.2), (2, 0.2, 0.1)]


def neighbours_of(count, faces):
    """A set for each vertex; each vertex is a neighbour of itself."""
    rings = [{v} for v in range(count)]
    for line in faces:
        corners = list(map(int, line.split()[1:]))
        for v in corners:
            rings[v].update(corners)
    return rings


def averaged_noise(count, faces, times, seed=5):
    """Vectors with a standard deviation of 1 in each coordinate."""
    generator = random.Random(seed)
    noise = [[generator.gauss(0, 1) for _ in range(3)] for _ in range(count)]
    rings = neighbours_of(count, faces)
    for _ in range(times):
        noise = [[sum(noise[w][i] for w in ring) / len(ring) for i in range(3)] for ring in rings]
    rms = math.sqrt(sum(x * x for vector in noise for x in vector) / (3 * count))
    return [[x / rms for x in vector] for vector in noise]


def show_correlated(folder):
    row(HEADINGS, WIDTHS)
    with tempfile.TemporaryDirectory() as scratch:
        for pair in folders_of_pairs(folder):
            original, source, by_hand = (os.path.join(scratch, name)
                                         for name in ("original.off", "noisy.off", "by_hand.ply"))
            smooth(mesh_in(pair, "original"), original, "--steps", 0)
            points, faces = read_off(original)
            edge = ibmfair("info", original, "--json")["edge_length"]["mean"]
            for times, amount, white in KINDS:
                generator = random.Random(6)
                noise = averaged_noise(len(points), faces, times)
                write_off(source,
                          [[x + edge * (amount * e + white * generator.gauss(0, 1))
                            for x, e in zip(point, vector)]
                           for point, vector in zip(points, noise)], faces)
                target, report, *_, plain = denoised(source, scratch)
                row([os.path.basename(pair), times, amount, white,
                     *(f"{figures_of(mesh, original)[0]:.2f}" for mesh in (source, target, plain)),
                     f"{best_by_hand(source, original, by_hand):.2f}", "  " + chosen(report)], WIDTHS)
