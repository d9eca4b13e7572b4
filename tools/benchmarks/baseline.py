"""The ratios with which tools/bench --check compares a run. They do not depend on the speed of the
machine, but on its kind: another kind of processor needs a baseline of its own."""

import json
import os

PATH = os.path.join(os.path.dirname(os.path.abspath(__file__)), "baseline.json")
TOLERANCE = 0.15


def load():
    with open(PATH) as file:
        return json.load(file)["ratios"]


def store(results):
    kept = {"machine": results["machine"],
            "ratios": {name: float(f"{ratio:.4g}") for name, ratio in results["ratios"].items()}}
    with open(PATH, "w") as file:
        json.dump(kept, file, indent=1)
        file.write("\n")


def losses(ratios):
    """Maps each name in both whose ratio is worse to its ratios before and now."""
    before = load()
    return {name: (before[name], ratio) for name, ratio in ratios.items()
            if name in before and not ratio <= (1 + TOLERANCE) * before[name]}


def report(ratios):
    """Prints the comparison and returns the exit code."""
    compared = ratios.keys() & load().keys()
    lost = losses(ratios)
    print()
    for name, (before, now) in lost.items():
        print(f"slower: {name}: {before:.4g} -> {now:.4g} ({100 * (now / before - 1):+.0f} %)")
    print(f"check: {len(compared)} ratios compared with the baseline, {len(lost)} lost more than "
          f"{100 * TOLERANCE:.0f} %")
    return 1 if lost or not compared else 0
