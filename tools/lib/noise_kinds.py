"""The part of tools/denoise_table with noise that is not normal, or not equally strong everywhere.

Noise of each kind is added to the original of every pair in a folder (denoise_pairs.py).
--denoise runs with no other option; beside it, what the best of ten cut-offs with and without
creases reaches, chosen with the truth known.
"""

import math
import os
import random
import tempfile

from denoise_pairs import chosen, denoised, figures_of, folders_of_pairs, mesh_in
from tables import ibmfair, read_off, row, smooth, write_off

HEADINGS = ["original", "noise", "noisy", "Ea", "best", "chosen"]
WIDTHS = [22, 18, 6, 6, 6, 30]
BY_HAND = [("--cutoff", cutoff, *options) for cutoff in (2.8, 4, 5.7, 8, 11.3)
           for options in (("--laplacian", "umbrella", "--twicing", 1),
                           ("--keep-sharp", 15, "--first-stage", "normals"))]


def vector(number):
    """A function of a generator that makes three such numbers."""
    return lambda generator: [number(generator) for _ in range(3)]


def student(generator, freedom=3):
    squares = sum(generator.gauss(0, 1) ** 2 for _ in range(freedom))
    return generator.gauss(0, 1) / math.sqrt(squares / freedom) / math.sqrt(freedom / (freedom - 2))


normal = vector(lambda generator: generator.gauss(0, 1))


def outliers(share, strength, others=0):
    """Noise of `strength` at a share of the vertices, and of `others` elsewhere."""
    def noise(generator, _):
        chosen = strength if generator.random() < share else others
        return [chosen * x for x in normal(generator)]
    return noise


# Of a generator and the place along x, from 0 to 1; in mean edge lengths.
KINDS = {
    "normal 0.2": lambda g, x: [0.2 * c for c in normal(g)],
    "uniform 0.3": lambda g, x: [0.3 * c for c in vector(
        lambda g: math.sqrt(12) * (g.random() - 0.5))(g)],
    "+-0.3": lambda g, x: [0.3 * c for c in vector(lambda g: g.choice((-1, 1)))(g)],
    "Laplace 0.4": lambda g, x: [0.4 * c for c in vector(
        lambda g: g.choice((-1, 1)) * g.expovariate(math.sqrt(2)))(g)],
    "Student t3 0.2": lambda g, x: [0.2 * c for c in vector(student)(g)],
    "1 % of 3, 0.1": outliers(0.01, 3, 0.1),
    "1 % of 3": outliers(0.01, 3),
    "0.3 % of 10": outliers(0.003, 10),
    "5 % of 1": outliers(0.05, 1),
    "5 % of 3": outliers(0.05, 3),
    "along z 0.2": lambda g, x: [0, 0, 0.2 * g.gauss(0, 1)],
    "growing to 0.4": lambda g, x: [0.4 * x * c for c in normal(g)],
    "on half 0.3": lambda g, x: [(0.3 if x > 0.5 else 0) * c for c in normal(g)],
}


def noisy_points(points, kind, edge):
    generator = random.Random(7)
    least, most = (f(p[0] for p in points) for f in (min, max))
    return [[c + edge * n for c, n in zip(p, KINDS[kind](generator, (p[0] - least) / (most - least)))]
            for p in points]


def best_by_hand(source, original, target):
    errors = []
    for options in BY_HAND:
        smooth(source, target, *options)
        errors.append(figures_of(target, original)[0])
    return min(errors)


def show_kinds(folder):
    row(HEADINGS, WIDTHS)
    with tempfile.TemporaryDirectory() as scratch:
        original, source, by_hand = (os.path.join(scratch, name)
                                     for name in ("original.off", "noisy.off", "by_hand.ply"))
        for pair in folders_of_pairs(folder):
            smooth(mesh_in(pair, "original"), original, "--steps", 0)
            points, faces = read_off(original)
            edge = ibmfair("info", original, "--json")["edge_length"]["mean"]
            for kind in KINDS:
                write_off(source, noisy_points(points, kind, edge), faces)
                target, report, *_ = denoised(source, scratch)
                row([os.path.basename(pair), kind,
                     *(f"{figures_of(mesh, original)[0]:.2f}" for mesh in (source, target)),
                     f"{best_by_hand(source, original, by_hand):.2f}", "  " + chosen(report)], WIDTHS)
